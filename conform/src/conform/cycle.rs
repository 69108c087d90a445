//! Scenarios for a program that steps at a fixed cycle: a step after a longer time becomes as many steps as it takes.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Control, Faults, Inputs, Machine, Outputs};

use crate::suite::{Scenario, Step};

/// One step of a scenario never becomes more cycles than this: the longest time of the document is 15 s.
const MOST: u32 = 20_000;

/// A scenario in steps of one cycle; `None` if they cannot express it.
///
/// A time that is no multiple of the cycle becomes the next one on the same side of the nearest multiple: just below a
/// limit stays just below it. Until the time is over the inputs are as they were before, or, where that would not do, as
/// they are afterwards. The AI Computer answers the handshake in each step if it did in the scenario, and does not if it
/// did not.
///
/// What the reference does at the end of each of the scenario's steps has to be the same.
pub(super) fn in_cycles(machine: &Machine, scenario: &Scenario, cycle_ms: u32) -> Option<Scenario> {
    let mut steps = Vec::with_capacity(scenario.steps.len());
    let (mut control, mut original) = (Control::INITIAL, Control::INITIAL);
    let mut before = Inputs::default();
    for Step { dt_ms, inputs } in &scenario.steps {
        let answers = inputs.ai.status.handshake == original.handshake.bit;
        let (next, outputs) = machine.step(&original, inputs, *dt_ms);
        original = next;
        let count = Some(cycles(*dt_ms, cycle_ms)).filter(|&count| count <= MOST)?;
        let hold = |held: &Inputs| {
            let mut made = Vec::with_capacity(count as usize);
            let (mut control, mut last) = (control, None);
            for left in (0..count).rev() {
                let mut inputs = if left == 0 { *inputs } else { *held };
                inputs.ai.status.handshake = control.handshake.bit == answers;
                let (next, outputs) = machine.step(&control, &inputs, cycle_ms);
                control = next;
                last = Some(outputs);
                made.push(Step { dt_ms: cycle_ms, inputs });
            }
            last.filter(|last| visible(last) == visible(&outputs)).map(|_| (made, control))
        };
        let (made, after) = hold(&before).or_else(|| hold(inputs))?;
        steps.extend(made);
        control = after;
        before = *inputs;
    }
    Some(Scenario { steps })
}

/// How many cycles a time takes.
fn cycles(dt_ms: u32, cycle_ms: u32) -> u32 {
    let cycle_ms = cycle_ms.max(1);
    let (whole, over) = (dt_ms / cycle_ms, dt_ms % cycle_ms);
    // A remainder in the upper half lies just below the next multiple.
    let above = over > 0 && over <= cycle_ms / 2;
    (whole + u32::from(above)).max(1)
}

/// What a step shows but for the phase of the handshake, which another number of steps changes.
fn visible(outputs: &Outputs) -> (AsState, Faults, ShutdownCause, bool) {
    (outputs.state, outputs.faults, outputs.shutdown_cause, outputs.go_signal)
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Inputs, Machine};

    use super::{cycles, in_cycles};
    use crate::suite::{Scenario, Step};

    #[test]
    fn a_time_of_too_many_cycles_is_left_out() {
        let steps = |dt_ms| {
            let scenario = Scenario { steps: vec![Step { dt_ms, inputs: Inputs::default() }] };
            in_cycles(&Machine::REFERENCE, &scenario, 1).map(|scenario| scenario.steps.len())
        };
        assert_eq!((steps(15_001), steps(u32::MAX)), (Some(15_001), None));
    }

    #[test]
    fn a_time_stays_on_its_side_of_a_limit() {
        let cases = [
            (0, 1),
            (1, 1),
            (9, 1),
            (10, 1),
            (49, 4),
            (50, 5),
            (51, 6),
            (4999, 499),
            (5000, 500),
            (5001, 501),
        ];
        for (dt_ms, expected) in cases {
            assert_eq!(cycles(dt_ms, 10), expected, "{dt_ms} ms");
        }
        assert_eq!(cycles(5000, 1), 5000);
    }
}
