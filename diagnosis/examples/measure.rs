//! How exact a diagnosis is: puts random deviations around the specification, and counts which of them are named.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use adsdv_diagnosis::{Deviation, Model, Record, diagnose, records};
use adsdv_spec::Edition;
use adsdv_spec::mutation::Change;

/// The next of a row of numbers that look random.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap_or(0) % end.max(1)
    }
}

/// Whether two sets of deviations do the same in all that was asked.
fn same(edition: &Edition, one: &[Deviation], other: &[Deviation], asked: &[Record]) -> bool {
    let other = Model::new(edition, other);
    let mut program = Model::new(edition, one).running();
    asked
        .iter()
        .all(|record| Record::of(&mut program, &record.steps).is_ok_and(|record| record.is_explained(&other)))
}

/// One of them, each kind as often as another: of some kinds there are many more.
fn pick(all: &[Deviation], random: &mut Random) -> Deviation {
    let kind = random.below(9);
    let is = |deviation: &&Deviation| match deviation {
        Deviation::Changed(Change::Time(..) | Change::Threshold(..)) => kind == 0,
        Deviation::Changed(Change::Term(..)) => (1..=2).contains(&kind),
        Deviation::Changed(_) => (3..=4).contains(&kind),
        Deviation::Needs { .. } => kind == 5,
        Deviation::Also { .. } => kind == 6,
        Deviation::Late { .. } => kind == 7,
        _ => kind == 8,
    };
    let these: Vec<&Deviation> = all.iter().filter(is).collect();
    *these[random.below(these.len())]
}

fn main() {
    let mut args = std::env::args().skip(1);
    let mut number = |usual: usize| args.next().and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (count, runs, seed) = (number(1), number(20), number(1));
    let every = std::env::args().any(|arg| arg == "every");
    for edition in Edition::ALL {
        let all = Deviation::every(edition);
        let mut random = Random(seed as u64);
        let (mut tally, mut longest) = (BTreeMap::new(), Duration::ZERO);
        let mut add = |what| *tally.entry(what).or_insert(0) += 1;
        let runs = if every { all.len() } else { runs };
        for run in 0..runs {
            let injected: Vec<Deviation> =
                if every { vec![all[run]] } else { (0..count).map(|_| pick(&all, &mut random)).collect() };
            let mut program = Model::new(edition, &injected).running();
            let start = Instant::now();
            let Ok(found) = diagnose(&mut program, edition) else { return };
            longest = longest.max(start.elapsed());
            let asked = records(&mut program, &Model::new(edition, &injected)).unwrap_or_default();
            let alike = |one: &Deviation, other: &Deviation| {
                one == other || same(edition, &[*one], &[*other], &asked)
            };
            for one in &injected {
                if found.deviations.iter().any(|other| alike(one, other)) {
                    add("exact");
                } else {
                    let rest: Vec<Deviation> =
                        injected.iter().copied().filter(|other| other != one).collect();
                    let observed = !same(edition, &injected, &rest, &asked);
                    add(if observed { "missed" } else { "not observed" });
                    if observed {
                        println!("  missed {one:?}\n    of {injected:?}\n    found {:?}", found.deviations);
                    }
                }
            }
            for other in &found.deviations {
                if !injected.iter().any(|one| alike(one, other)) {
                    add("invented");
                    println!("  invented {other:?}\n    for {injected:?}");
                }
            }
            if !found.unexplained.is_empty() {
                add("runs with something unexplained");
            }
        }
        println!("{} k={count}: {tally:?}, longest {longest:?}", edition.version);
    }
}
