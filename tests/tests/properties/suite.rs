//! Any run, as a test of a suite: its line of JSON reads back to the same test, which is written as the same line.

use std::convert::Infallible;

use adsdv_conform::suite::{Kind, Scenario, Step, Test, read};
use adsdv_spec::Edition;
use proptest::prelude::any;

use crate::holds::{holds, regressions};
use crate::operations::{Operation, Run, runs};
use crate::run::{Event, Silent, play};
use crate::runs::machine;
use crate::timeline::timeline;

/// How many runs are tried.
const CASES: u32 = 50;

/// So many steps of a run make a test; a line of a suite holds some thousands at most.
const STEPS: usize = 200;

fn test(run: &Run, about: &str) -> Test {
    let mut steps = Vec::new();
    let Ok(_) = play::<Infallible>(&machine(run), run, &mut |event| {
        if let Event::Step(seen) = event
            && steps.len() < STEPS
        {
            steps.push(Step { dt_ms: seen.dt_ms, inputs: *seen.inputs });
        }
        Ok(())
    });
    Test {
        name: format!("a run, {about}"),
        kind: Kind::Output,
        about: about.to_owned(),
        section: "3".to_owned(),
        requirements: Vec::new(),
        reading: None,
        scenario: Scenario { steps },
    }
}

fn reads_back(run: &Run, about: &str) -> Result<(), String> {
    let machine = machine(run);
    let test = test(run, about);
    if test.scenario.steps.is_empty() {
        return Ok(());
    }
    let line = test.to_line(&machine);
    let suite = read(line.as_bytes(), &machine).map_err(|error| error.to_string())?;
    match suite.tests.as_slice() {
        [again] if suite.bad.is_empty() => {
            if *again != test {
                return Err(format!("it reads back as {again:?}"));
            }
            let written = again.to_line(&machine);
            if written == line { Ok(()) } else { Err(format!("{line}\nis written again as\n{written}")) }
        }
        tests => Err(format!("{} tests, and {:?}", tests.len(), suite.bad)),
    }
}

/// The run of which `regressions/suite.txt` had the seed, in an edition that has the input: a silence.
#[test]
fn a_silence_reads_back() {
    for &edition in Edition::ALL.iter().filter(|edition| edition.rules.thresholds.missed_ms.is_some()) {
        let operations = vec![Operation::set("status_silence_ms", 1), Operation::Wait(20)];
        let run = Run { edition, readings: edition.readings, cycle_ms: 10, operations };
        assert_eq!(reads_back(&run, ""), Ok(()), "{run:?}");
    }
}

#[test]
fn a_test_reads_back() {
    holds(
        CASES,
        regressions!("suite"),
        &(runs(), any::<String>()),
        |(run, about)| reads_back(run, about),
        |(run, about)| format!("about {about:?}\n{}", timeline(&machine(run), run, &mut Silent)),
    );
}
