//! The invariant of the control state: what it allows, and that each of its conditions counts.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Choice, Control, Edition, Handshake, Readings, Timing};

const TIMING: Timing = Edition::V3_0.rules.timing;
const CAUSE: ShutdownCause = ShutdownCause::AiComputerRequest;

fn reading(choice: Choice) -> Readings {
    Readings::DEFAULT.with(choice)
}

/// In a state, as the last step left it.
fn control(state: AsState) -> Control {
    let shutdown_cause =
        if state == AsState::EmergencyBrake { CAUSE } else { Control::INITIAL.shutdown_cause };
    let power_cycle_needed =
        state == AsState::EmergencyBrake && Readings::DEFAULT.is(Choice::PowerCycleLatched);
    Control { state, shutdown_cause, power_cycle_needed, ..Control::INITIAL }
}

fn holds(control: &Control) -> bool {
    control.is_consistent(&TIMING, Readings::DEFAULT)
}

fn holds_under(choice: Choice, control: &Control) -> bool {
    control.is_consistent(&TIMING, reading(choice))
}

#[test]
fn each_state_is_entered_consistent() {
    for state in AsState::ALL {
        assert!(holds(&control(state)), "{state}");
    }
}

#[test]
fn a_state_lasts_as_long_as_is_counted() {
    for state in AsState::ALL {
        let limit = TIMING.in_state_limit(state);
        assert!(holds(&Control { in_state_ms: limit, ..control(state) }), "{state}");
        assert!(!holds(&Control { in_state_ms: limit + 1, ..control(state) }), "{state}");
    }
}

#[test]
fn a_handshake_counts_to_its_limit_and_rests_when_it_is_not_performed() {
    let with = |handshake| holds(&Control { handshake, ..Control::INITIAL });
    let lost = Handshake { active: true, bit: false, unanswered_ms: TIMING.handshake_ms };
    assert!(with(lost) && with(Handshake { bit: true, ..lost }));
    assert!(!with(Handshake { unanswered_ms: TIMING.handshake_ms + 1, ..lost }));
    assert!(with(Handshake::IDLE));
    assert!(!with(Handshake { bit: true, ..Handshake::IDLE }));
    assert!(!with(Handshake { unanswered_ms: 1, ..Handshake::IDLE }));
}

#[test]
fn only_as_ready_remembers_that_go_was_off_and_only_after_its_time() {
    let waited = Control { go_seen_low: true, in_state_ms: TIMING.ready_dwell_ms, ..control(AsState::Ready) };
    let early = Control { in_state_ms: TIMING.ready_dwell_ms - 1, ..waited };
    assert!(holds(&waited) && holds_under(Choice::GoEdgeEnough, &waited));
    assert!(!holds(&early), "the edge counts only with all other conditions");
    assert!(holds_under(Choice::GoEdgeEnough, &early));
    for state in AsState::ALL.into_iter().filter(|&state| state != AsState::Ready) {
        let control = Control { go_seen_low: true, ..control(state) };
        assert!(!holds(&control) && !holds_under(Choice::GoEdgeEnough, &control), "{state}");
    }
}

#[test]
fn only_as_driving_remembers_requests_and_only_where_edges_count() {
    for state in AsState::ALL {
        let running = Control { was_running: true, ..control(state) };
        let forward = Control { was_forward: true, ..control(state) };
        for remembers in [running, forward, Control { was_forward: true, ..running }] {
            assert!(!holds(&remembers), "{state}: the level counts");
            assert_eq!(holds_under(Choice::FaultEdge, &remembers), state == AsState::Driving, "{state}");
        }
    }
}

#[test]
fn what_led_to_emergency_brake_has_a_cause() {
    let braking = control(AsState::EmergencyBrake);
    assert!(holds(&braking));
    let none = Control { shutdown_cause: ShutdownCause::NoShutdown, power_cycle_needed: false, ..braking };
    assert!(!holds(&none));
    for &choice in Choice::ALL {
        assert!(!holds_under(choice, &none), "{choice}");
    }
}

#[test]
fn a_power_cycle_is_needed_after_a_shutdown_where_it_is_remembered() {
    for state in AsState::ALL {
        for shutdown_cause in [ShutdownCause::NoShutdown, CAUSE] {
            for power_cycle_needed in [false, true] {
                let control = Control { shutdown_cause, power_cycle_needed, ..control(state) };
                let shut_down = shutdown_cause == CAUSE;
                let may_follow =
                    matches!(state, AsState::EmergencyBrake | AsState::Off) || !power_cycle_needed;
                let braked = shut_down || state != AsState::EmergencyBrake;
                assert_eq!(
                    holds_under(Choice::PowerCycleLatched, &control),
                    power_cycle_needed == shut_down && may_follow && braked,
                    "{control:?}"
                );
            }
        }
    }
}
