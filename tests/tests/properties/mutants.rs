//! What the properties are worth: each change of the table, of a time and of a threshold breaks one of them, and the run that
//! shows it is a few lines.

use std::fmt::Write as _;

use adsdv_conform::suite;
use adsdv_spec::mutation::{Change, TermChange};
use adsdv_spec::{Edition, Machine, Mutation, Readings};
use adsdv_tests::property::SHRINKING;
use expect_test::expect_file;
use proptest::strategy::{Strategy, ValueTree as _};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

use crate::clocks::Clocks;
use crate::handshake::Handshake;
use crate::operations::{Run, runs_of};
use crate::power::Power;
use crate::run::{Property, Seen, keeps};
use crate::second_opinion::SecondOpinion;
use crate::timeline::timeline;

/// So many runs tell all mutants apart.
const CASES: u32 = 2500;

/// The editions whose state machines differ: that of 2026 is the one of 4.0.
fn machines() -> impl Iterator<Item = &'static Edition> {
    let is_new = |place: usize, edition: &Edition| {
        Edition::ALL.iter().take(place).all(|before| before.rules != edition.rules)
    };
    (0..)
        .zip(Edition::ALL.iter().copied())
        .filter(move |&(place, edition)| is_new(place, edition))
        .map(|(_, edition)| edition)
}

/// The properties of every step, all at once, of the document as it is.
struct All(Clocks, Handshake, Power, SecondOpinion);

impl All {
    fn new(run: &Run) -> Self {
        Self(
            Clocks::new(run.edition.rules.timing, run.readings),
            Handshake::new(run),
            Power::new(run.readings),
            SecondOpinion::new(run),
        )
    }
}

impl Property for All {
    fn see(&mut self, seen: &Seen<'_>) -> Result<(), String> {
        let Self(clocks, handshake, power, second_opinion) = self;
        clocks.see(seen)?;
        handshake.see(seen)?;
        power.see(seen)?;
        second_opinion.see(seen)
    }
}

/// A source of runs that is the same every time.
fn runner() -> TestRunner {
    let config =
        Config { cases: CASES, max_shrink_iters: SHRINKING, failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

fn mutant(mutation: &Mutation, run: &Run) -> Machine {
    Machine::new(mutation.apply(run.edition), run.readings)
}

/// The run, as it shows most of a mutation: with readings under which it matters, and with short steps only where times count.
fn telling(run: &Run, mutation: &Mutation) -> Run {
    let mut run = run.clone();
    if let Change::Time(..) = mutation.change {
        run.cycle_ms = 1;
        return run;
    }
    run.cycle_ms = run.edition.rules.timing.cycle_ms.into();
    if let Change::Term(row, term, change) = mutation.change {
        let row = run.edition.rules.table.rows().get(row).expect("a row");
        for choice in row.terms().get(term).expect("a term").readings.iter() {
            let others = choice.reading().choices().iter().copied().filter(|&other| other != choice);
            run.readings = match change {
                // It is there anyway, but under another reading.
                TermChange::InEveryReading => others.fold(run.readings, Readings::with),
                _ => run.readings.with(choice),
            };
        }
    }
    run
}

#[test]
fn every_mutant_is_found() {
    std::thread::scope(|scope| {
        for edition in machines() {
            scope.spawn(move || every_mutant_is_found_in(edition));
        }
    });
}

fn every_mutant_is_found_in(edition: &'static Edition) {
    let mut runner = runner();
    let any = runs_of(edition);
    let runs: Vec<Run> = (0..CASES).map(|_| any.new_tree(&mut runner).expect("a run").current()).collect();
    let lives = |mutation: &Mutation| {
        runs.iter().all(|run| {
            let run = telling(run, mutation);
            keeps(&mutant(mutation, &run), &run, &mut All::new(&run)).is_ok()
        })
    };
    let alive: Vec<_> = Mutation::all(edition).filter(lives).map(|mutation| mutation.to_string()).collect();
    // Those that behave like the specification, which the test suite lists with the reasons.
    let proof = suite::prove(edition, &suite::generate(edition));
    let equivalent: Vec<_> = proof.equivalent.into_iter().map(|(name, _)| name).collect();
    assert_eq!(alive, equivalent, "{}", edition.version);
}

/// Mutants, each with its edition and the most operations that the run that shows it may have.
const SHRUNK: [(&Edition, &str, usize); 11] = [
    (&Edition::V3_0, "3.1 term 0: power-cycle-needed dropped", 20),
    (&Edition::V3_0, "3.2 term 0: steer-straight dropped", 20),
    (&Edition::V3_0, "3.2: leads to AS_FINISHED", 20),
    (&Edition::V3_0, "3.6: dropped", 20),
    (&Edition::V3_0, "3.7 term 1: go-on flipped", 20),
    (&Edition::V3_0, "EBS timer -1", 20),
    (&Edition::V3_0, "ready dwell -1", 20),
    (&Edition::V3_0, "handshake +1", 20),
    (&Edition::V4_0, "3.7 term 8: dropped", 20),
    (&Edition::V4_0, "3.7 term 10: dropped", 20),
    (&Edition::V4_0, "handshake -1", 20),
];

/// The shortest run that was found to show a mutant, as a timeline.
fn shown(edition: &'static Edition, name: &str, most: usize) -> String {
    let mutation = Mutation::all(edition)
        .find(|mutation| mutation.to_string() == name)
        .unwrap_or_else(|| panic!("{name} is a mutation"));
    let property = |run: &Run| All::new(run);
    let tried = runner().run(&runs_of(edition), |run| {
        keeps(&mutant(&mutation, &run), &run, &mut property(&run)).map_err(TestCaseError::fail)
    });
    let Err(TestError::Fail(_, run)) = tried else { panic!("{name} is found: {tried:?}") };
    let operations = run.operations.len();
    assert!(operations <= most, "{name}: {operations} operations: {run:?}");
    format!("# {name}\n{}", timeline(&mutant(&mutation, &run), &run, &mut property(&run)))
}

/// The timelines, which are scenarios as well, are those of the file.
/// `UPDATE_EXPECT=1 cargo test -p adsdv-tests --test properties mutant` writes it anew.
#[test]
fn a_mutant_is_shown_by_a_short_timeline() {
    let mut all = String::new();
    for (edition, name, most) in SHRUNK {
        let timeline = shown(edition, name, most);
        let scenario = timeline.parse::<adsdv_can::scenario::Scenario>();
        assert!(scenario.is_ok(), "{scenario:?}\n{timeline}");
        let _ = writeln!(all, "{timeline}");
    }
    expect_file!["../../golden/mutants.txt"].assert_eq(&all);
}
