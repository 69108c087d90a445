//! What holds of every step, from whatever state.

use adsdv_spec::messages::AsState::{Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::messages::{DirectionRequest, ShutdownCause};
use adsdv_spec::{Actuation, Handshake, Readings};

use crate::invariant::counts_to_ms;
use crate::prelude::*;
use crate::words::Arrow;

/// **The state changes only along an arrow of Figure 2.**
///
/// Requirements: SM-18, D-36.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn figure_2_arrows() {
    let step = any_step();
    let (from, to) = (step.before.state, step.after.state);
    kani::cover!(from != to, "the state changes");
    kani::cover!(from == to && from != Off && !step.inputs.tsms, "TSMS is off, and the state stays");
    assert!(from == to || Arrow::between(from, to).is_some(), "Figure 2 has the arrow");
}

/// **EMERGENCY_BRAKE is entered only for a reason that the document names**: in AS_READY, AS_DRIVING and AS_FINISHED an open
/// shutdown circuit, ESTOP_REQUEST or a lost handshake; in AS_DRIVING also "Go" or ASMS off, and FINISHED or NEUTRAL while
/// moving.
///
/// Requirements: SM-12, SM-13, SM-15, HS-10, D-9, D-10, D-24, D-26, D-27.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn brake_founded() {
    let step = any_step();
    let enters = step.before.state != EmergencyBrake && step.after.state == EmergencyBrake;
    let still_in_time = matches!(step.unanswered_ms(), Some(49));
    kani::cover!(enters, "EMERGENCY_BRAKE is entered");
    kani::cover!(step.after.state == Ready && still_in_time, "unanswered for 49 ms, which is no reason");
    assert!(!enters || step.has_reason_to_brake(), "there is a reason");
}

/// **A standing vehicle is switched off only by ASMS**: AS_READY and AS_FINISHED are left for AS_OFF only with ASMS off.
///
/// Requirements: SM-10, SM-16.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn off_founded() {
    let step = any_step();
    let switched_off = step.leads(Ready, Off) || step.leads(Finished, Off);
    kani::cover!(step.leads(Ready, Off), "AS_READY is left");
    kani::cover!(step.leads(Finished, Off), "AS_FINISHED is left");
    assert!(!switched_off || !step.inputs.asms, "ASMS is off");
}

/// **With TSMS off, no silence of the AI Computer causes an emergency**: SHUTDOWN_CAUSE does not become AI_COMMS_FAULT.
///
/// Requirements: D-8.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn comms_tsms() {
    let step = any_step();
    let (before, after) = (step.before.shutdown_cause, step.after.shutdown_cause);
    let by_silence = after != before && after == ShutdownCause::AiCommsFault;
    kani::cover!(by_silence, "silence causes an emergency");
    let waited = step.before.handshake.active && step.before.handshake.unanswered_ms == 50;
    kani::cover!(
        step.before.state == Driving && waited && !step.inputs.tsms,
        "TSMS goes off in a long silence"
    );
    assert!(!by_silence || step.inputs.tsms, "TSMS is on");
}

/// **The AI Computer moves the vehicle only in AS_DRIVING.** Drive and steering requests reach the actuators only there, with
/// ASMS and "Go" on and the shutdown circuit closed.
///
/// Requirements: DRV-2, DRV-3, FIN-5, FIN-6, D-21.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn actuators() {
    let step = any_step();
    let Actuation {
        front_axle_trq,
        front_motor_speed_max,
        rear_axle_trq,
        rear_motor_speed_max,
        direction,
        steer,
        hyd_press_f: _,
        hyd_press_r: _,
        ebs_triggered: _,
    } = subject().actuation(&step.outputs, &step.inputs);
    let moves = front_axle_trq.raw() != 0
        || rear_axle_trq.raw() != 0
        || front_motor_speed_max.raw() != 0
        || rear_motor_speed_max.raw() != 0
        || direction != DirectionRequest::Neutral
        || steer.is_some();
    kani::cover!(moves && rear_axle_trq.raw() != 0, "torque reaches the rear axle");
    let still_steers = step.inputs.ai.steer.steer_request.raw() != 0;
    kani::cover!(step.after.state == Finished && still_steers, "steering is requested in AS_FINISHED");
    let allowed = step.inputs.asms && step.inputs.go && !step.words().section_3_5_sdc_open();
    assert!(
        !moves || step.after.state == Driving && allowed,
        "only in AS_DRIVING, and while that is allowed"
    );
}

/// **GO_SIGNAL tells of the accepted edge.** It is 1 exactly in AS_DRIVING while "Go" is on, and that only once an edge of
/// "Go" has been accepted.
///
/// Requirements: DRV-14, D-7.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn go_signal() {
    let step = any_step();
    let shown = step.outputs.go_signal;
    let accepted = step.before.state == Driving || step.before.state == Ready && step.before.go_seen_low;
    kani::cover!(shown && step.before.state == Ready, "shown at the edge itself");
    kani::cover!(
        !shown && step.inputs.go && step.after.state == Ready,
        "\"Go\" is on, and no edge is accepted"
    );
    assert!(shown == (step.after.state == Driving && step.inputs.go), "1 in AS_DRIVING while \"Go\" is on");
    assert!(!shown || accepted, "the edge has been accepted");
}

/// **What the VCU remembers is what has been.** The invariant is kept. The time in a state goes on by the time since the last
/// step, up to its limit, and begins anew with every state. The handshake is active while TSMS is on: an answer turns the
/// bit, and without one it stays and the time goes on by the time since the last step, up to 50 ms, from the first active
/// step on.
///
/// Requirements: HS-1, HS-4, HS-6, HS-7, HS-9, HS-15, D-8, D-11, D-44.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn control_invariant() {
    let step = any_step();
    assert!(subject().is_consistent(&step.after, Readings::DEFAULT), "the invariant is kept");

    let stays = step.before.state == step.after.state;
    let lasted_ms = step.lasted_ms().min(counts_to_ms(step.before.state).into());
    kani::cover!(
        stays && step.dt_ms > 0 && lasted_ms == 5000 && step.before.in_state_ms < 5000,
        "5 s are full"
    );
    assert!(u64::from(step.after.in_state_ms) == if stays { lasted_ms } else { 0 }, "the time in the state");

    let (before, after) = (step.before.handshake, step.after.handshake);
    let answered = step.inputs.ai.status.handshake == before.bit;
    kani::cover!(after.active && after.unanswered_ms == 50 && before.unanswered_ms == 0, "lost in one step");
    kani::cover!(before.active && after.active && answered, "answered");
    let expected = if !step.inputs.tsms {
        Handshake { active: false, bit: false, unanswered_ms: 0 }
    } else if answered {
        Handshake { active: true, bit: !before.bit, unanswered_ms: 0 }
    } else {
        Handshake { active: true, bit: before.bit, unanswered_ms: after.unanswered_ms }
    };
    assert!(after == expected, "the bit turns when it is answered, and rests while TSMS is off");
    let waited_ms = step.unanswered_ms().unwrap_or(0);
    assert!(u64::from(after.unanswered_ms) == waited_ms.min(50), "the time without an answer");
}

theorems![figure_2_arrows, brake_founded, off_founded, comms_tsms, actuators, go_signal, control_invariant];
