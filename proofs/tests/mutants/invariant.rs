//! What the theorems of `invariant.rs` catch.

use adsdv_proofs::subject::Subject;
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Choice, Control, Readings};

use crate::Mutant;
use crate::otherwise::{Otherwise, ReadAs};

pub(crate) fn mutants() -> Vec<Mutant> {
    let plain = "the_invariant_in_plain_words";
    let initial = "the_initial_state_keeps_the_invariant";
    let kept = "every_step_keeps_the_invariant";
    let otherwise = |what, change| Mutant::new(kept, what, Otherwise(change));
    let read_as = |choice: Choice| Mutant::new(kept, &choice.to_string(), ReadAs::new(choice));
    vec![
        Mutant::new(plain, "the timers may go on", TimersGoOn),
        Mutant::new(plain, "an emergency needs no cause", NoCause),
        Mutant::table(plain, "handshake -1"),
        Mutant::new(initial, "the VCU starts in EMERGENCY_BRAKE", Starts(AsState::EmergencyBrake)),
        Mutant::new(initial, "the VCU starts in AS_READY", Starts(AsState::Ready)),
        Mutant::table(kept, "3.7 term 1: fault dropped"),
        Mutant::table(kept, "ready dwell +1"),
        read_as(Choice::FaultEdge),
        read_as(Choice::PowerCycleNotLatched),
        otherwise("that \"Go\" was seen off is never forgotten", |before, _, after, _| {
            after.go_seen_low |= before.go_seen_low;
        }),
        otherwise("the handshake keeps its bit while TSMS is off", |before, _, after, _| {
            if !after.handshake.active {
                after.handshake.bit = before.handshake.bit;
            }
        }),
        otherwise("AS_OFF forgets that a power cycle is needed", |_, _, after, _| {
            after.power_cycle_needed &= after.state != AsState::Off;
        }),
    ]
}

/// A control state is consistent with any time in its state.
#[derive(Clone)]
struct TimersGoOn;

impl Subject for TimersGoOn {
    fn is_consistent(&self, control: &Control, readings: Readings) -> bool {
        let limit = self.machine().edition().rules.timing.in_state_limit(control.state);
        let control = Control { in_state_ms: control.in_state_ms.min(limit), ..*control };
        control.is_consistent(&self.machine().edition().rules.timing, readings)
    }
}

/// A control state without a cause is consistent if it would be with one.
#[derive(Clone)]
struct NoCause;

impl Subject for NoCause {
    fn is_consistent(&self, control: &Control, readings: Readings) -> bool {
        let timing = &self.machine().edition().rules.timing;
        let caused = Control { shutdown_cause: ShutdownCause::EbsFault, ..*control };
        control.is_consistent(timing, readings) || caused.is_consistent(timing, readings)
    }
}

/// The VCU does not start in AS_OFF.
#[derive(Clone)]
struct Starts(AsState);

impl Subject for Starts {
    fn initial(&self) -> Control {
        Control { state: self.0, ..Control::INITIAL }
    }
}
