//! Sequences of any inputs, under any readings: each step is what the document's words say, and what it leads to is consistent.

use adsdv_proofs::words::{self, Verdict};
use adsdv_spec::messages::AnyMessage;
use adsdv_spec::{Control, Inputs, Interface, Machine, Observation};

use super::Bytes;
use crate::world::Chance;

/// The times between two steps that matter; others are drawn as well.
fn dt_ms(bytes: &mut Bytes<'_>) -> u32 {
    let timing = Interface::V3_0.timing;
    let limits =
        [timing.cycle_ms, timing.handshake_ms, timing.ready_dwell_ms, timing.ebs_timer_ms].map(u32::from);
    match bytes.below(4) {
        0 => bytes.any(),
        1 => bytes.pick(&limits) + u32::from(bytes.any::<bool>()),
        2 => bytes.pick(&limits) - 1,
        _ => limits[0],
    }
}

/// The inputs after those: others altogether, or one condition of Figure 2 changed, as close to its threshold as can be.
fn next(bytes: &mut Bytes<'_>, inputs: &Inputs) -> Inputs {
    if bytes.one_in(8) {
        return bytes.any();
    }
    let mut inputs = *inputs;
    let shown: Vec<_> = Observation::SCOPE.iter().collect();
    for _ in 0..=bytes.below(3) {
        inputs.show(bytes.pick(&shown), bytes.any(), &Interface::V3_0.thresholds);
    }
    inputs
}

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let readings = bytes.readings();
    let machine = Machine::new(Interface::V3_0, readings);
    let timing = &machine.interface().timing;
    let mut control = Control::INITIAL;
    if bytes.one_in(2)
        && let Some(any) =
            bytes.0.arbitrary().ok().filter(|any: &Control| any.is_consistent(timing, readings))
    {
        control = any;
    }
    let mut inputs = Inputs::default();
    while bytes.are_left() {
        inputs = next(&mut bytes, &inputs);
        let dt_ms = dt_ms(&mut bytes);
        let (after, outputs) = machine.step(&control, &inputs, dt_ms);
        let words = words::step(&control, &inputs, dt_ms, readings);
        assert_eq!(Verdict::of(after, &outputs), words, "{control:?}, {inputs:?}, {dt_ms} ms, {readings}");
        assert!(after.is_consistent(timing, readings), "{after:?} after {control:?}, {inputs:?}, {dt_ms} ms");

        let seen = inputs.observe(&machine.interface().thresholds);
        let reaction = machine.react(&control, seen, dt_ms);
        assert_eq!(
            (reaction.control, reaction.taken, reaction.faults),
            (after, outputs.taken, outputs.faults)
        );
        assert_eq!((control.state, after.state), (outputs.from, outputs.state));
        for frame in outputs.messages(&inputs).frames() {
            assert!(AnyMessage::decode(frame.id, frame.data()).is_ok(), "{frame}");
        }
        control = after;
    }
}
