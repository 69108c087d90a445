//! The lemmas that make the exploration fast, tried on every control state that can be reached.

use std::collections::{BTreeMap, HashSet};

use adsdv_model::Vectors;
use adsdv_spec::messages::{AsState, ShutdownCause};
use adsdv_spec::{Atoms, Control, Edition, Fault, Faults, Observation};

use crate::{SHORT, machine, reachable, some_choices_alone};

/// `short-timers`: from the length of the short timers on, what can be remembered beside a running timer does not depend
/// on how long it has run.
#[test]
fn from_80_ms_on_a_running_timer_changes_nothing_else() {
    let timing = Edition::DEFAULT.rules.timing;
    let short = |state| SHORT.in_state_limit(state);
    for readings in some_choices_alone() {
        let mut beside: BTreeMap<(AsState, u16), HashSet<Control>> = BTreeMap::new();
        for control in reachable(&machine(timing, readings), Vectors::Few) {
            beside
                .entry((control.state, control.in_state_ms))
                .or_default()
                .insert(Control { in_state_ms: 0, ..control });
        }
        let (mut times, mut first) = (0, BTreeMap::new());
        for ((state, in_state_ms), controls) in beside {
            let limit = timing.in_state_limit(state);
            // "Go" is seen in the last cycle, when the dwell is over.
            if (short(state)..limit).contains(&in_state_ms) && short(state) > 0 {
                times += 1;
                let usual = first.entry(state).or_insert_with(|| controls.clone());
                let differs = usual.symmetric_difference(&controls).next();
                assert_eq!(differs, None, "{state} after {in_state_ms} ms, {readings}");
            }
        }
        let cycles = |state| (timing.in_state_limit(state) - short(state)) / timing.cycle_ms;
        assert_eq!(times, cycles(AsState::Ready) + cycles(AsState::EmergencyBrake), "{readings}");
    }
}

/// `which-fault`: faults that open the shutdown circuit differ in the cause that they leave, and in nothing else.
#[test]
fn opening_faults_differ_in_their_cause_alone() {
    for readings in some_choices_alone() {
        let machine = machine(SHORT, readings);
        for control in reachable(&machine, Vectors::Few) {
            let reads = machine.reads(&control, u32::from(SHORT.cycle_ms));
            // A vehicle that is ready to drive, one that is off, and one of which all that is read is on.
            for atoms in [Atoms::NONE, Observation::SCOPE, reads.atoms] {
                let mut usual = None;
                for fault in Faults::OPENING.iter() {
                    let seen = Observation::new(atoms, Faults::NONE.with(fault));
                    let mut after = machine.react(&control, seen, u32::from(SHORT.cycle_ms)).control;
                    if control.shutdown_cause == ShutdownCause::NoShutdown
                        && after.shutdown_cause != control.shutdown_cause
                    {
                        after.shutdown_cause = Fault::HvilOpenFault.cause();
                    }
                    assert_eq!(*usual.get_or_insert(after), after, "{fault} at {control:?}, {readings}");
                }
            }
        }
    }
}
