//! After any run, whatever happened in it, the procedure of the document leads to AS_DRIVING once more.

use std::convert::Infallible;

use adsdv_conform::protocol::INPUTS;
use adsdv_spec::messages::{AmiState, EbsState, MissionStatus, ShutdownCause, SignalValue as _};
use adsdv_spec::{AsState, Choice, Edition, Inputs};

use crate::holds::{holds, regressions};
use crate::operations::{Operation, Run, runs};
use crate::run::{Silent, play};
use crate::runs::machine;
use crate::timeline::timeline;

/// How many runs are tried.
const CASES: u32 = 200;

/// Longer than any step of a run.
const A_WHILE: Operation = Operation::Wait(50);

/// Everybody lets go: the switches are off, the faults are gone, and nothing is requested, for as long as an emergency lasts.
fn all_off(edition: &Edition) -> Vec<Operation> {
    let off = Inputs::default();
    let fields = INPUTS.iter().filter(|field| field.is_in(edition) && field.key != "handshake");
    let mut operations: Vec<_> = fields.map(|field| Operation::Set(field, (field.get)(&off))).collect();
    let ebs_timer_ms = edition.rules.timing.ebs_timer_ms.into();
    operations.extend([Operation::Answers(true), A_WHILE, Operation::Wait(ebs_timer_ms), A_WHILE]);
    operations
}

/// Section 3.1.
fn to_ready() -> Vec<Operation> {
    let set = Operation::set;
    vec![
        set("tsms", 1),
        set("ami", AmiState::TrackDrive.to_raw()),
        set("ebs", EbsState::Armed.to_raw()),
        set("mission_status", MissionStatus::Selected.to_raw()),
        set("asms", 1),
        A_WHILE,
    ]
}

/// Section 3.2.
fn to_driving(edition: &Edition) -> Vec<Operation> {
    let ready_dwell_ms = edition.rules.timing.ready_dwell_ms.into();
    vec![Operation::Wait(ready_dwell_ms), A_WHILE, Operation::set("go", 1), A_WHILE]
}

/// Where it leads, step by step, when everybody lets go after a run and then does what the document says; and what was done
/// for it, for the timeline.
//= RDY-5, DRV-15, ETO-1 to ETO-4, D-11
fn recovers(run: &Run, done: &mut Vec<Operation>) -> Result<(), String> {
    let Ok(mut bench) = play::<Infallible>(&machine(run), run, &mut |_| Ok(()));
    let mut leads = |operations: Vec<Operation>, expected: AsState| {
        done.extend(&operations);
        for operation in operations {
            let Ok(()) = bench.perform::<Infallible>(operation, &mut |_| Ok(()));
        }
        let found = bench.control.state;
        let shut_down = bench.control.shutdown_cause != ShutdownCause::NoShutdown;
        if found == expected { Ok(shut_down) } else { Err(format!("it is {found}, not {expected}")) }
    };
    let shut_down = leads(all_off(run.edition), AsState::Off)?;
    if shut_down && run.readings.is(Choice::PowerCycleLatched) {
        // The procedure alone is not enough.
        leads(to_ready(), AsState::Off)?;
        leads(all_off(run.edition), AsState::Off)?;
        leads(vec![Operation::PowerCycle], AsState::Off)?;
    }
    leads(to_ready(), AsState::Ready)?;
    leads(to_driving(run.edition), AsState::Driving)?;
    Ok(())
}

#[test]
fn every_run_can_be_recovered_from() {
    let tell = |run: &Run| {
        let mut operations = run.operations.clone();
        let _ = recovers(run, &mut operations);
        timeline(&machine(run), &Run { operations, ..run.clone() }, &mut Silent)
    };
    holds(CASES, regressions!("recovery"), &runs(), |run| recovers(run, &mut Vec::new()), tell);
}
