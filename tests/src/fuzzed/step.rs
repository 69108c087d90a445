//! Sequences of any inputs, under any readings of any edition: each step is what the words of the edition's document say, and what
//! it leads to is consistent.

use adsdv_proofs::words::{self, Verdict};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Control, Inputs, Machine, Observation, Readings, Rules, Taken, Timing};

use super::Bytes;
use crate::world::Chance;

/// The times between two steps that matter; others are drawn as well.
pub(super) fn dt_ms(bytes: &mut Bytes<'_>, timing: &Timing) -> u32 {
    let limits =
        [timing.cycle_ms, timing.handshake_ms, timing.ready_dwell_ms, timing.ebs_timer_ms].map(u32::from);
    match bytes.below(4) {
        0 => bytes.any(),
        1 => bytes.pick(&limits) + u32::from(bytes.any::<bool>()),
        2 => bytes.pick(&limits) - 1,
        _ => limits[0],
    }
}

/// The inputs after those: now and then others altogether; what one way out of this state asks for; and some conditions of Figure 2
/// changed. What is shown is as close to its threshold as can be.
pub(super) fn next(bytes: &mut Bytes<'_>, machine: &Machine, state: AsState, inputs: &Inputs) -> Inputs {
    let Rules { table, thresholds, .. } = &machine.edition().rules;
    let mut inputs = if bytes.one_in(8) { bytes.any() } else { *inputs };
    if bytes.one_in(2) {
        let ways: Vec<_> = machine.arrows(state).filter_map(|way| way.term(table)).collect();
        // That one alone.
        for (atom, value) in ways.iter().filter_map(|way| way.literals().next()) {
            inputs.show(atom, !value, thresholds);
        }
        for (atom, value) in bytes.pick(&ways).literals() {
            // What is seen of one that memory has a part in.
            inputs.show(atom.input().unwrap_or(atom), value, thresholds);
        }
    }
    let shown: Vec<_> = Observation::SCOPE.iter().collect();
    for _ in 0..bytes.below(4) {
        inputs.show(bytes.pick(&shown), bytes.any(), thresholds);
    }
    inputs
}

/// Any control state that keeps the invariant: as few as possible of its fields are as they are at first.
pub(super) fn any_control(bytes: &mut Bytes<'_>, timing: &Timing, readings: Readings) -> Control {
    let first = Control::INITIAL;
    let mut any: Control = bytes.0.arbitrary().unwrap_or(first);
    any.in_state_ms %= timing.in_state_limit(any.state) + 1;
    any.handshake.unanswered_ms %= timing.handshake_ms + 1;
    let mut tried: Vec<u8> = (0..1 << 6).collect();
    tried.sort_by_key(|tried| tried.count_ones());
    let mut tried = tried.into_iter().map(|tried| {
        let keeps = |field: u8| tried >> field & 1 == 0;
        Control {
            go_seen_low: if keeps(0) { any.go_seen_low } else { first.go_seen_low },
            was_running: if keeps(1) { any.was_running } else { first.was_running },
            was_forward: if keeps(2) { any.was_forward } else { first.was_forward },
            handshake: if keeps(3) { any.handshake } else { first.handshake },
            power_cycle_needed: if keeps(4) { any.power_cycle_needed } else { first.power_cycle_needed },
            shutdown_cause: if keeps(5) { any.shutdown_cause } else { first.shutdown_cause },
            ..any
        }
    });
    tried.find(|tried| tried.is_consistent(timing, readings)).unwrap_or(first)
}

/// The body.
pub fn body(bytes: &[u8]) {
    taken(bytes);
}

/// A term of Figure 2 that decided, and the edition.
pub type Decided = (&'static str, Taken);

/// Runs the body; the terms of Figure 2 that decided in it, in their order.
pub fn taken(bytes: &[u8]) -> Vec<Decided> {
    let mut taken = Vec::new();
    let mut bytes = Bytes::new(bytes);
    let edition = bytes.edition();
    let machine = Machine::new(*edition, bytes.readings(edition));
    let in_words = words::of_version(edition.version).expect("every edition has its words");
    // Those that the edition has, of which the words speak.
    let readings = machine.readings();
    let timing = &edition.rules.timing;
    let mut control =
        if bytes.one_in(2) { any_control(&mut bytes, timing, readings) } else { Control::INITIAL };
    let mut inputs = Inputs::default();
    while bytes.are_left() {
        inputs = next(&mut bytes, &machine, control.state, &inputs);
        let dt_ms = dt_ms(&mut bytes, timing);
        let (after, outputs) = machine.step(&control, &inputs, dt_ms);
        let words = in_words(&control, &inputs, dt_ms, readings);
        let of = edition.version;
        assert_eq!(
            Verdict::of(after, &outputs),
            words,
            "{of}: {control:?}, {inputs:?}, {dt_ms} ms, {readings}"
        );
        assert!(
            after.is_consistent(timing, readings),
            "{of}: {after:?} after {control:?}, {inputs:?}, {dt_ms} ms"
        );

        let seen = inputs.observe(&edition.rules.thresholds);
        let reaction = machine.react(&control, seen, dt_ms);
        assert_eq!(
            (reaction.control, reaction.taken, reaction.faults),
            (after, outputs.taken, outputs.faults)
        );
        assert_eq!((control.state, after.state), (outputs.from, outputs.state));
        for frame in outputs.messages(&inputs).frames(&edition.bus) {
            assert!(edition.bus.decode(frame.id, frame.data()).is_ok(), "{of}: {frame}");
        }
        taken.extend(outputs.taken.map(|taken| (edition.version, taken)));
        control = after;
    }
    taken
}
