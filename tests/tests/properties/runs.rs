//! What holds at every step of every run.

use std::cell::RefCell;
use std::collections::BTreeSet;

use adsdv_spec::{Edition, Machine};

use crate::clocks::Clocks;
use crate::handshake::Handshake;
use crate::holds::{holds, regressions};
use crate::operations::{Run, runs};
use crate::power::Power;
use crate::run::{Event, Property, keeps, play};
use crate::second_opinion::SecondOpinion;
use crate::timeline::timeline;

/// How many runs are tried.
const CASES: u32 = 400;

/// The machine of a run.
pub(crate) fn machine(run: &Run) -> Machine {
    Machine::new(*Edition::DEFAULT, run.readings)
}

/// Tries a property of every step; `property` makes one that has seen nothing yet.
fn always<P: Property>(property: impl Fn(&Run) -> P) {
    holds(
        CASES,
        regressions!("runs"),
        &runs(),
        |run| keeps(&machine(run), run, &mut property(run)),
        |run| timeline(&machine(run), run, &mut property(run)),
    );
}

#[test]
fn the_machine_does_what_the_text_says() {
    always(|run| SecondOpinion::new(run.readings));
}

#[test]
fn ready_and_emergency_last_for_their_times() {
    always(|run| Clocks::new(Edition::DEFAULT.rules.timing, run.readings));
}

#[test]
fn the_motors_obey_only_while_the_vehicle_drives() {
    always(|run| Power::new(run.readings));
}

#[test]
fn comms_are_lost_when_nobody_answers() {
    always(|run| Handshake::new(Edition::DEFAULT.rules.timing, run.readings));
}

/// The runs are worth trying: each arrow of Figure 2 is taken in some of them.
#[test]
fn every_arrow_is_taken() {
    let taken = RefCell::new(BTreeSet::new());
    let runs_of = |run: &Run| {
        let machine = machine(run);
        let played: Result<_, String> = play(&machine, run, &mut |event| {
            if let Event::Step(seen) = event
                && let Some(row) = seen.outputs.row(&machine)
            {
                taken.borrow_mut().insert(row.section);
            }
            Ok(())
        });
        played.map(drop)
    };
    holds(CASES, regressions!("runs"), &runs(), runs_of, |run| format!("{run:?}"));
    let rows = Edition::DEFAULT.rules.table.rows().iter().map(|row| row.section);
    assert_eq!(taken.into_inner(), rows.collect(), "the sections whose arrow is taken");
}
