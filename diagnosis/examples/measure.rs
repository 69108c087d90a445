//! How exact a diagnosis is: puts random deviations around the specification, and counts which of them are named.
//!
//! What a deviation is called does not matter, only what it does: another one in its place counts as the same where the program
//! behaves alike with it, and a diagnosis is exact as a whole where its model behaves as the program does. Two models behave alike
//! if they answer alike to all experiments that either leads to, and on random walks.
//!
//! ```text
//! measure 8 12 21                             # eight deviations in each of twelve programs, by this seed
//! measure ready-driving:missing go:level      # one program that has these
//! ```
//!
//! `EDITION` names the one edition to take, and `CYCLE` the one time that a step takes, in milliseconds; with `SHOW` each run tells
//! of what it was, and what it took.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::Answer;
use adsdv_diagnosis::{
    Deviation, Interface, Model, Record, Running, Subject, diagnose_within, difference, records,
};
use adsdv_oracle::chance::SplitMix64;
use adsdv_spec::mutation::{Change, Threshold, Time};
use adsdv_spec::{Edition, Inputs};

/// So many random walks where steps take any time, and where they take but one.
const WALKS: [usize; 2] = [1500, 150];

/// No diagnosis takes longer.
const LONGEST: Duration = Duration::from_mins(10);

/// A program that counts what it is asked.
struct Counted {
    program: Running,
    steps: u64,
}

impl Subject for Counted {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.program.reset()
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        self.steps += 1;
        self.program.step(dt_ms, inputs)
    }
}

/// What the models do that are compared again and again.
struct Comparison<'a> {
    edition: &'a Edition,
    interface: Interface,
    /// So many random walks by either model, to find where two differ.
    walks: usize,
}

impl Comparison<'_> {
    /// Whether two sets of deviations do the same in all that is tried.
    fn same(&self, one: &[Deviation], other: &[Deviation]) -> bool {
        self.asked(one, other) && self.asked(other, one) && {
            difference(self.edition, &self.interface, one, other, self.walks, 7).is_none()
        }
    }

    fn asked(&self, one: &[Deviation], other: &[Deviation]) -> bool {
        let (one, other) = (Model::new(self.edition, one), Model::new(self.edition, other));
        let mut running = one.clone().running();
        let asked: Vec<Record> = records(&mut running, &one, &self.interface).unwrap_or_default();
        asked.iter().all(|record| record.is_explained(&other))
    }

    /// So many that lead out of one state, each of which can be observed by itself: they are in each other's way.
    fn picked_near(&self, all: &[Deviation], count: usize, random: &mut SplitMix64) -> Vec<Deviation> {
        let rows = self.edition.rules.table.rows();
        let from = rows[random.below(rows.len())].from;
        let leads = |one: &&Deviation| match one {
            Deviation::Changed(
                Change::RowDropped(row)
                | Change::RowLeadsTo(row, _)
                | Change::RowFirst(row)
                | Change::Term(row, ..),
            )
            | Deviation::Joined { row, .. } => rows[*row].from == from,
            Deviation::Needs { from: own, .. }
            | Deviation::Also { from: own, .. }
            | Deviation::Late { from: own, .. } => *own == from,
            Deviation::Shows { .. } | Deviation::Writes { .. } => false,
            _ => true,
        };
        let near: Vec<Deviation> = all.iter().filter(leads).copied().collect();
        self.picked(&near, count, random)
    }

    /// So many different ones, each of which can be observed by itself.
    fn picked(&self, all: &[Deviation], count: usize, random: &mut SplitMix64) -> Vec<Deviation> {
        let mut picked = Vec::new();
        while picked.len() < count {
            let Some(one) = pick(self.edition, all, random) else { continue };
            if !picked.contains(&one) && !self.same(&[], &[one]) {
                picked.push(one);
            }
        }
        picked
    }

    /// The deviations without those that cannot be observed beside the others.
    fn observable(&self, deviations: &[Deviation]) -> Vec<Deviation> {
        let mut left = deviations.to_vec();
        let mut place = 0;
        while place < left.len() {
            let mut fewer = left.clone();
            fewer.remove(place);
            if self.same(&left, &fewer) {
                left = fewer;
            } else {
                place += 1;
            }
        }
        left
    }
}

/// One of them, each kind as often as another: of some kinds there are many more. Numbers are any.
fn pick(edition: &Edition, all: &[Deviation], random: &mut SplitMix64) -> Option<Deviation> {
    let kind = random.below(16);
    let is = |deviation: &&Deviation| match deviation {
        Deviation::Changed(Change::Time(..)) => kind == 0,
        Deviation::Changed(Change::Threshold(..)) => kind == 1,
        Deviation::Changed(Change::Term(..)) => (2..=3).contains(&kind),
        Deviation::Changed(Change::RowFirst(..)) => kind == 4,
        Deviation::Changed(_) => kind == 5,
        Deviation::Joined { .. } => kind == 6,
        Deviation::Needs { .. } => kind == 7,
        Deviation::Also { .. } => kind == 8,
        Deviation::Late { .. } => kind == 9,
        Deviation::Remembers(_) => kind == 10,
        Deviation::Causes { .. } | Deviation::Prefers { .. } => kind == 15,
        Deviation::Reads(_) => false,
        Deviation::Shows { .. } => kind == 11,
        Deviation::Writes { .. } => kind == 12,
        Deviation::Wheels(_) | Deviation::GoLevel | Deviation::GoNeedsHandshake => kind == 13,
        Deviation::Ignores { .. } | Deviation::Opens { .. } => kind == 14,
    };
    let these: Vec<&Deviation> = all.iter().filter(is).collect();
    let one = **these.get(random.below(these.len()))?;
    Some(match one {
        Deviation::Changed(Change::Time(time, _)) => {
            let timing = &edition.rules.timing;
            let usual = match time {
                Time::ReadyDwell => timing.ready_dwell_ms,
                Time::EbsTimer => timing.ebs_timer_ms,
                Time::Handshake => timing.handshake_ms,
            };
            Deviation::Changed(Change::Time(time, other(usual.into(), random)))
        }
        Deviation::Changed(Change::Threshold(threshold, _)) => {
            let thresholds = &edition.rules.thresholds;
            let usual = match threshold {
                Threshold::WheelSpeed => thresholds.wheel_speed.raw(),
                Threshold::Straight => thresholds.straight.raw(),
                Threshold::Missed => thresholds.missed_ms.unwrap_or_default().into(),
            };
            Deviation::Changed(Change::Threshold(threshold, other(usual, random)))
        }
        _ => one,
    })
}

/// By how much a number is another: at most twice as much as usual, and at least a tenth, or nothing.
fn other(usual: i32, random: &mut SplitMix64) -> i16 {
    if random.below(8) == 0 {
        return i16::try_from(-usual).unwrap_or(i16::MIN);
    }
    let span = i16::try_from(usual * 9 / 10).unwrap_or(1).max(1);
    let by = i16::try_from(1 + random.below(span.unsigned_abs().into())).unwrap_or(1);
    if random.below(2) == 0 { by } else { -by }
}

/// The ids of deviations.
fn ids(edition: &Edition, deviations: &[Deviation]) -> String {
    deviations.iter().map(|one| one.id(edition)).collect::<Vec<_>>().join(" ")
}

/// What was counted of an edition.
#[derive(Default)]
struct Tally {
    counts: BTreeMap<&'static str, usize>,
    longest: Duration,
    most_steps: u64,
    shows: bool,
}

impl Tally {
    fn add(&mut self, what: &'static str, many: usize) {
        *self.counts.entry(what).or_insert(0) += many;
    }

    /// Diagnoses a program that has these deviations, and compares what is named with what is there.
    fn run(&mut self, comparison: &Comparison<'_>, run: usize, injected: &[Deviation]) {
        let edition = comparison.edition;
        let program = Model::new(edition, injected).running();
        let mut program = Counted { program, steps: 0 };
        let start = Instant::now();
        let Ok(mut found) = diagnose_within(&mut program, edition, &comparison.interface, LONGEST) else {
            return;
        };
        found.deviations.extend(found.readings.iter().map(|choice| Deviation::Reads(*choice)));
        self.longest = self.longest.max(start.elapsed());
        self.most_steps = self.most_steps.max(program.steps);
        let observable = comparison.observable(injected);
        if self.shows {
            let (took, steps, asked) = (start.elapsed(), program.steps, found.experiments);
            println!(
                "  run {run}: {took:?}, {steps} steps, {asked} experiments; of {}",
                ids(edition, injected)
            );
            let hidden = injected.iter().filter(|one| !observable.contains(one));
            hidden.for_each(|one| println!("  not observable {}", one.id(edition)));
        }
        for what in ["exact", "missed", "invented"] {
            self.add(what, 0);
        }
        self.add("not observable", injected.len() - observable.len());
        if comparison.same(&observable, &found.deviations) {
            self.add("exact", observable.len());
            return;
        }
        // In the place of one of the program's own, what was found has to do the same.
        let replaces = |one: usize, other: &Deviation| {
            observable[one] == *other || {
                let mut with = observable.clone();
                with[one] = *other;
                comparison.same(&observable, &with)
            }
        };
        let mut named = vec![false; observable.len()];
        for other in &found.deviations {
            let own = observable.iter().position(|one| one == other);
            if let Some(place) = own.or_else(|| (0..observable.len()).find(|one| replaces(*one, other))) {
                named[place] = true;
            } else {
                self.add("invented", 1);
                println!("  invented {}", other.id(edition));
            }
        }
        for (one, named) in observable.iter().zip(&named) {
            self.add(if *named { "exact" } else { "missed" }, 1);
            if !named {
                println!("  missed {}", one.id(edition));
            }
        }
        println!("    run {run}: of {}", ids(edition, injected));
        println!("    found {}", ids(edition, &found.deviations));
        if !found.unexplained.is_empty() {
            self.add("runs with something unexplained", 1);
            println!("    not explained: {}", found.unexplained.len());
        }
    }
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let number =
        |place: usize, usual: usize| args.get(place).and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (count, runs, seed) = (number(0, 1), number(1, 20), number(2, 1));
    let has = |what: &str| args.iter().any(|arg| arg == what);
    let only = std::env::var("EDITION").ok();
    let cycle_ms: Option<u32> = std::env::var("CYCLE").ok().and_then(|text| text.parse().ok());
    let shows = std::env::var("SHOW").is_ok();
    let wanted = |edition: &&&Edition| only.as_ref().is_none_or(|only| only == edition.version);
    for edition in Edition::ALL.iter().filter(wanted) {
        let all = Deviation::every(edition);
        let mut random = SplitMix64(seed as u64);
        let mut tally = Tally { shows, ..Tally::default() };
        let interface = Interface::default().at_cycle(cycle_ms);
        let comparison = Comparison { edition, interface, walks: WALKS[usize::from(cycle_ms.is_some())] };
        let given: Vec<Deviation> = args.iter().filter_map(|id| Deviation::find(edition, id)).collect();
        if !given.is_empty() {
            tally.run(&comparison, 0, &given);
        } else if has("every") {
            all.iter().enumerate().for_each(|(run, one)| tally.run(&comparison, run, &[*one]));
        } else {
            for run in 0..runs {
                let injected = if has("near") {
                    comparison.picked_near(&all, count, &mut random)
                } else {
                    comparison.picked(&all, count, &mut random)
                };
                tally.run(&comparison, run, &injected);
            }
        }
        let Tally { counts, longest, most_steps, .. } = tally;
        println!(
            "{} k={count}: {counts:?}, longest {longest:?}, at most {most_steps} steps",
            edition.version
        );
    }
}
