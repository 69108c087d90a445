//! What always holds of the control state: it holds of the initial state, and every step keeps it.
//!
//! [`Control::is_consistent`] is the invariant. All theorems about steps start from a control state that keeps it, so that
//! what they say holds of every run. Here it is said once more, in plain words, one sentence each. That each other reading
//! keeps it as well is in [`readings`](crate::readings).

use adsdv_spec::messages::AsState::{self, Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Choice, Control, Readings};

use crate::prelude::*;

/// For how long the time in a state is counted, in milliseconds: not at all where no arrow asks for it.
pub(crate) fn counts_to_ms(state: AsState) -> u16 {
    match state {
        Ready => 5000,
        EmergencyBrake => 15000,
        Off | Driving | Finished => 0,
    }
}

/// No timer is beyond its limit: 5 s in AS_READY, 15 s in EMERGENCY_BRAKE, none elsewhere, and 50 ms for the handshake.
fn timers_are_bounded(control: &Control) -> bool {
    control.in_state_ms <= counts_to_ms(control.state) && control.handshake.unanswered_ms <= 50
}

/// A handshake that is not active rests: it sends 0 and waits for nothing.
fn handshake_rests(control: &Control) -> bool {
    let handshake = &control.handshake;
    handshake.active || !handshake.bit && handshake.unanswered_ms == 0
}

/// "Go" is remembered to have been off only in AS_READY, and only after the five seconds, unless any edge is enough.
fn go_is_seen_where_it_counts(control: &Control, readings: Readings) -> bool {
    let late_enough = control.in_state_ms == 5000 || readings.is(Choice::GoEdgeEnough);
    !control.go_seen_low || control.state == Ready && late_enough
}

/// RUNNING and FORWARD are remembered only in AS_DRIVING, and only where a change counts.
fn changes_are_seen_where_they_count(control: &Control, readings: Readings) -> bool {
    let counts = control.state == Driving && readings.is(Choice::FaultEdge);
    counts || !control.was_running && !control.was_forward
}

/// EMERGENCY_BRAKE has a cause.
fn an_emergency_has_a_cause(control: &Control) -> bool {
    control.state != EmergencyBrake || control.shutdown_cause != ShutdownCause::NoShutdown
}

/// A power cycle is needed from the first cause on, unless that is not latched; and until then the vehicle is where it
/// cannot drive.
fn a_cause_asks_for_a_power_cycle(control: &Control, readings: Readings) -> bool {
    let shut_down = control.shutdown_cause != ShutdownCause::NoShutdown;
    let cannot_drive = control.state == Off || control.state == EmergencyBrake;
    if readings.is(Choice::PowerCycleLatched) {
        control.power_cycle_needed == shut_down && (!shut_down || cannot_drive)
    } else {
        !control.power_cycle_needed
    }
}

/// **The invariant is these sentences**: under every reading, a control state keeps it if and only if they hold.
///
/// Requirements: DRV-4, ETO-1, HS-9, D-6, D-8, D-11, D-15.
#[cfg_attr(kani, kani::proof, kani::unwind(16))]
pub fn the_invariant_in_plain_words() {
    let (control, readings): (Control, Readings) = (kani::any(), kani::any());
    let keeps = subject().is_consistent(&control, readings);
    let said = timers_are_bounded(&control)
        && handshake_rests(&control)
        && go_is_seen_where_it_counts(&control, readings)
        && changes_are_seen_where_they_count(&control, readings)
        && an_emergency_has_a_cause(&control)
        && a_cause_asks_for_a_power_cycle(&control, readings);
    kani::cover!(keeps && control.go_seen_low, "it is kept with \"Go\" seen off");
    kani::cover!(
        keeps && control.state == EmergencyBrake && control.in_state_ms == 15000,
        "kept in an emergency"
    );
    kani::cover!(!keeps && control.state == EmergencyBrake && control.in_state_ms == 15001, "not kept");
    assert!(keeps == said, "the invariant is what the sentences say");
}

/// **The initial state keeps the invariant** under every reading: AS_OFF, no cause, nothing remembered.
///
/// Requirements: SM-3, D-15.
#[cfg_attr(kani, kani::proof, kani::unwind(16))]
pub fn the_initial_state_keeps_the_invariant() {
    let readings: Readings = kani::any();
    let initial = subject().initial();
    kani::cover!(readings.is(Choice::FaultEdge) && readings.is(Choice::GoEdgeEnough), "other readings");
    assert!(initial.state == Off, "the VCU starts in AS_OFF");
    assert!(initial.shutdown_cause == ShutdownCause::NoShutdown, "nothing has shut it down");
    assert!(subject().is_consistent(&initial, readings), "the invariant holds at first");
}

/// **Every step keeps the invariant**: from every control state that has it, with every input and after every time.
///
/// Requirements: DRV-4, ETO-1, ETO-3, HS-9, D-6, D-8, D-11, D-15.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn every_step_keeps_the_invariant() {
    let Step { before, dt_ms, after, .. } = any_step();
    kani::cover!(before.go_seen_low && after.state != Ready, "AS_READY is left with \"Go\" seen off");
    kani::cover!(!before.go_seen_low && after.go_seen_low, "\"Go\" is seen off");
    kani::cover!(before.state == Driving && after.state == EmergencyBrake, "an emergency begins");
    kani::cover!(before.state == EmergencyBrake && after.state == Off, "an emergency ends");
    kani::cover!(before.handshake.bit && !after.handshake.active, "the handshake stops");
    kani::cover!(before.state == after.state && before.in_state_ms > 0 && dt_ms == u32::MAX, "49 days later");
    assert!(timers_are_bounded(&after), "no timer is beyond its limit");
    assert!(handshake_rests(&after), "a handshake that is not active rests");
    assert!(go_is_seen_where_it_counts(&after, Readings::DEFAULT), "\"Go\" is seen off only where it counts");
    assert!(changes_are_seen_where_they_count(&after, Readings::DEFAULT), "no change is remembered");
    assert!(an_emergency_has_a_cause(&after), "EMERGENCY_BRAKE has a cause");
    assert!(a_cause_asks_for_a_power_cycle(&after, Readings::DEFAULT), "a cause asks for a power cycle");
}

theorems![
    the_invariant_in_plain_words,
    the_initial_state_keeps_the_invariant,
    every_step_keeps_the_invariant
];
