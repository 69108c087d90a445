//! Memories and beliefs: what they allow, and which of two allows more.

use adsdv_spec::belief::{Belief, Causes, Handshakes, Memory, Span};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Control, Edition, Handshake, Timing, Truth};

const TIMING: Timing = Edition::V3_0.rules.timing;

/// Something in every field.
const CONTROL: Control = Control {
    state: AsState::Ready,
    in_state_ms: 7,
    go_seen_low: true,
    was_running: true,
    was_forward: true,
    handshake: Handshake { active: true, bit: true, unanswered_ms: 3 },
    power_cycle_needed: true,
    shutdown_cause: ShutdownCause::EbsFault,
};

/// The same with one field otherwise.
fn others() -> [Control; 7] {
    [
        Control { in_state_ms: 8, ..CONTROL },
        Control { go_seen_low: false, ..CONTROL },
        Control { was_running: false, ..CONTROL },
        Control { was_forward: false, ..CONTROL },
        Control { handshake: Handshake::IDLE, ..CONTROL },
        Control { power_cycle_needed: false, ..CONTROL },
        Control { shutdown_cause: ShutdownCause::NoShutdown, ..CONTROL },
    ]
}

#[test]
fn a_memory_allows_what_each_of_its_fields_does() {
    let memory = Memory::exact(&CONTROL);
    assert!(memory.allows(&CONTROL));
    assert!(memory.allows(&Control { state: AsState::Off, ..CONTROL }), "whatever the state");
    for other in others() {
        assert!(!memory.allows(&other), "{other:?}");
        let either = memory.or(Memory::exact(&other));
        assert!(either.allows(&CONTROL) && either.allows(&other), "{other:?}");
        assert!(either.covers(&memory) && !memory.covers(&either), "{other:?}");
    }
}

#[test]
fn anything_is_what_a_control_state_with_these_times_can_be() {
    let anything = Belief::anything(&TIMING);
    assert!(anything.allows(&Control::INITIAL) && anything.allows(&CONTROL));
    for state in AsState::ALL {
        let limit = TIMING.in_state_limit(state);
        let at = |in_state_ms| anything.allows(&Control { state, in_state_ms, ..CONTROL });
        assert!(at(limit) && !at(limit + 1), "{state}");
        let unanswered_ms = TIMING.handshake_ms;
        let waits = |ms| Handshake { active: true, bit: false, unanswered_ms: ms };
        let waits = |ms| anything.allows(&Control { state, in_state_ms: 0, handshake: waits(ms), ..CONTROL });
        assert!(waits(unanswered_ms) && !waits(unanswered_ms + 1), "{state}");
        let memory = anything.memory(state).expect("anything is in every state");
        assert_eq!(*memory, Memory::anything(state, &TIMING));
        assert_eq!((memory.go_seen_low, memory.shutdown_cause), (Truth::Unknown, Causes::ANY));
        assert_eq!(memory.in_state, Span::between(0, limit));
        assert_eq!(memory.handshake, Handshakes::any(unanswered_ms));
    }
}

#[test]
fn a_belief_has_a_memory_for_each_state_that_may_be() {
    assert!(Belief::NONE.is_empty() && Belief::NONE.states().next().is_none());
    let ready = Belief::exact(&CONTROL);
    assert!(!ready.is_empty() && ready.allows(&CONTROL));
    assert!(!ready.allows(&Control { state: AsState::Off, ..CONTROL }));
    assert_eq!(ready.given(AsState::Ready), ready);
    assert!(ready.given(AsState::Off).is_empty());
    let both = ready.with(AsState::Off, Memory::exact(&Control::INITIAL));
    assert_eq!(both.states().collect::<Vec<_>>(), [AsState::Off, AsState::Ready]);
    assert_eq!(both, ready.or(&Belief::exact(&Control::INITIAL)));
    assert_eq!(both, Belief::exact(&Control::INITIAL).or(&ready));
    assert_eq!(both.given(AsState::Ready), ready);
}

#[test]
fn a_belief_covers_what_it_allows_all_of() {
    let off = Belief::exact(&Control::INITIAL);
    let ready = Belief::exact(&CONTROL);
    let later = Belief::exact(&others()[0]);
    let any_time = ready.or(&later);
    assert!(any_time.covers(&ready) && any_time.covers(&later) && !ready.covers(&any_time));
    assert!(any_time.or(&off).covers(&any_time) && !any_time.covers(&any_time.or(&off)));
    assert!(off.covers(&Belief::NONE) && !Belief::NONE.covers(&off));
}
