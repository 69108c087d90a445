//! What holds at every step of every run.

use std::cell::RefCell;
use std::collections::BTreeSet;

use adsdv_spec::messages::{AmiState, EbsState, MissionStatus, SignalValue as _};
use adsdv_spec::{Choice, Edition, Machine};

use crate::clocks::Clocks;
use crate::handshake::Handshake;
use crate::holds::{holds, regressions};
use crate::operations::{Operation, Run, runs};
use crate::power::Power;
use crate::run::{Event, Property, keeps, play};
use crate::second_opinion::SecondOpinion;
use crate::timeline::timeline;

/// How many runs are tried.
const CASES: u32 = 400;

/// The machine of a run.
pub(crate) fn machine(run: &Run) -> Machine {
    Machine::new(*run.edition, run.readings)
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

/// The run of which `regressions/runs.txt` had the seed: of when a handshake that has just begun is lost.
#[test]
fn a_handshake_that_began_with_the_dwell_is_lost_in_time() {
    let set = Operation::set;
    for &edition in Edition::ALL {
        let limit_ms = u32::from(edition.rules.timing.handshake_ms);
        for ms in [limit_ms - 1, limit_ms, limit_ms + 1] {
            let run = Run {
                edition,
                readings: edition.admit(edition.readings.with(Choice::CommsDriving)),
                cycle_ms: 10,
                operations: vec![
                    Operation::Answers(false),
                    set("tsms", 1),
                    set("ami", AmiState::TrackDrive.to_raw()),
                    set("ebs", EbsState::Armed.to_raw()),
                    set("mission_status", MissionStatus::Selected.to_raw()),
                    set("asms", 1),
                    Operation::Wait(20),
                    Operation::Wait(ms),
                ],
            };
            assert_eq!(keeps(&machine(&run), &run, &mut Handshake::new(&run)), Ok(()), "{run:?}");
            assert_eq!(keeps(&machine(&run), &run, &mut SecondOpinion::new(&run)), Ok(()), "{run:?}");
        }
    }
}

#[test]
fn the_machine_does_what_the_text_says() {
    always(SecondOpinion::new);
}

#[test]
fn ready_and_emergency_last_for_their_times() {
    always(|run| Clocks::new(run.edition.rules.timing, run.readings));
}

#[test]
fn the_motors_obey_only_while_the_vehicle_drives() {
    always(|run| Power::new(run.readings));
}

#[test]
fn comms_are_lost_when_nobody_answers_or_a_message_is_missed() {
    always(Handshake::new);
}

/// The runs are worth trying: each arrow of each edition's Figure 2 is taken in some of them.
#[test]
fn every_arrow_is_taken() {
    let taken = RefCell::new(BTreeSet::new());
    let taken_in = |run: &Run| {
        let machine = machine(run);
        let played: Result<_, String> = play(&machine, run, &mut |event| {
            if let Event::Step(seen) = event
                && let Some(row) = seen.outputs.row(&machine)
            {
                taken.borrow_mut().insert((run.edition.version, row.section));
            }
            Ok(())
        });
        played.map(drop)
    };
    holds(CASES, regressions!("runs"), &runs(), taken_in, |run| format!("{run:?}"));
    let sections = |edition: &&'static Edition| {
        let Edition { version, rules, .. } = edition;
        rules.table.rows().iter().map(|row| (*version, row.section))
    };
    let expected = Edition::ALL.iter().flat_map(sections).collect();
    assert_eq!(taken.into_inner(), expected, "the sections whose arrow is taken");
}
