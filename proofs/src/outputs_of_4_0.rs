//! What the VCU of version 4.0 sends beside what 3.0 sends: 120h, and the two states of 524h (section 2.2 of that version, and
//! the decisions on it).
//!
//! The bound of the loops is that of a step of 4.0; the table of messages has 16, the longest message 25 signals, and names
//! have up to 41 letters.

use adsdv_spec::editions::V4_0;
use adsdv_spec::messages::{AsState, EbsState, Frame, SmAs, SmSys, StatusBrk, SysActionState};
use adsdv_spec::{AiSilence, VcuMessages};

use crate::prelude::*;

/// What the VCU sends after a step.
fn messages(step: &Step) -> VcuMessages {
    subject().messages(&step.outputs, &step.inputs)
}

/// The frame carries this message of 4.0, with this identifier and this length.
fn carries<M: Coded<V4_0>>(frame: Frame, id: u16, len: u8, message: &M) {
    let frame = subject().sent(frame);
    assert!(frame.id == id, "the identifier");
    assert!(frame.len == len, "the length");
    // As words: arrays are compared byte by byte.
    let content = u64::from_le_bytes(message.encode().data);
    assert!(u64::from_le_bytes(frame.data) == content, "the content");
}

/// **In 4.0 each message goes out in its frame.** The ten frames that the VCU sends have the identifiers and the lengths of
/// 120h, 500h, 502h and 520h to 526h, each that of its message.
///
/// Requirements: MSG-29, MSG-34, MSG-41, MSG-65, MSG-69, MSG-73, MSG-77, MSG-82, MSG-88, MSG-97, MSG-101.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn each_message_of_4_0_goes_out_in_its_frame() {
    let step = any_end();
    let messages = messages(&step);
    let frames = messages.all().map(|message| V4_0::write(&message).unwrap_or_default());
    let [status, drive_f, drive_r, steer, brake, speeds, counts, dynamics, vcu_status, log] = frames;
    kani::cover!(vcu_status.data[7] != 0, "something is in the last byte of 120h");
    carries(status, 0x520, 8, &messages.status);
    carries(drive_f, 0x521, 6, &messages.drive_f);
    carries(drive_r, 0x522, 6, &messages.drive_r);
    carries(steer, 0x523, 6, &messages.steer);
    carries(brake, 0x524, 5, &messages.brake);
    carries(speeds, 0x525, 8, &messages.wheel_speeds);
    carries(dynamics, 0x500, 8, &messages.log_dynamics);
    carries(vcu_status, 0x120, 8, &messages.vcu_status);
    carries(log, 0x502, 5, &messages.log_status);
    let counts = subject().sent(counts);
    assert!(counts.id == 0x526 && counts.len == 8, "526h");
}

/// **120h shows the timeouts as they are.** Each R1 flag of a message is on if and only if this message has not come for 100
/// ms while TSMS is on, and that of the handshake if and only if it has been unanswered for 100 ms: in every state, whatever
/// was before.
///
/// Requirements: MSG-92, MSG-93, D-51, D-52, D-56.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn status_120h_shows_the_timeouts() {
    let step = any_step_of_4_0();
    let shown = messages(&step).vcu_status;
    let AiSilence {
        status_silence_ms,
        drive_f_silence_ms,
        drive_r_silence_ms,
        steer_silence_ms,
        brake_silence_ms,
    } = step.inputs.ai_silence;
    let tsms = step.inputs.tsms;
    let alone = shown.steer_timeout && !shown.brake_timeout && (steer_silence_ms == 100);
    kani::cover!(alone, "513h alone has been missing for just 100 ms");
    let unwatched = !tsms && (steer_silence_ms == 100);
    kani::cover!(unwatched, "nobody watches");
    kani::cover!(shown.handshake_timeout, "the handshake is lost");
    assert!(shown.status_timeout == (tsms && status_silence_ms >= 100), "510h");
    assert!(shown.drive_f_timeout == (tsms && drive_f_silence_ms >= 100), "511h");
    assert!(shown.drive_r_timeout == (tsms && drive_r_silence_ms >= 100), "512h");
    assert!(shown.steer_timeout == (tsms && steer_silence_ms >= 100), "513h");
    assert!(shown.brake_timeout == (tsms && brake_silence_ms >= 100), "514h");
    let before = &step.before.handshake;
    let waits = before.active && tsms && step.inputs.ai.status.handshake != before.bit;
    let waited_ms = u64::from(before.unanswered_ms) + u64::from(step.dt_ms);
    assert!(shown.handshake_timeout == (waits && waited_ms >= 100), "the handshake");
}

/// **120h warns of what 520h shows.** Each WARN flag is the fault flag of its name; WARN_KL15_UNDER_V, which has none, is
/// never on.
///
/// Requirements: MSG-94, D-57.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn status_120h_warns_of_what_520h_shows() {
    let messages = messages(&any_end());
    let (faults, shown) = (&messages.status, &messages.vcu_status);
    let apart = shown.warn_brake_plausibility && !shown.warn_ai_comms_lost;
    kani::cover!(apart, "brake plausibility without a loss of communications");
    assert!(shown.warn_brake_plausibility == faults.brake_plausibility_fault, "WARN_BRAKE_PLAUSIBILITY");
    assert!(!shown.warn_kl15_under_v, "WARN_KL15_UNDER_V");
    assert!(shown.warn_ai_estop_req == faults.ai_estop_request, "WARN_AI_ESTOP_REQ");
    assert!(shown.warn_ai_comms_lost == faults.ai_comms_lost, "WARN_AI_COMMS_LOST");
    assert!(shown.warn_auto_braking == faults.autonomous_braking_fault, "WARN_AUTO_BRAKING");
    assert!(shown.warn_mission_status == faults.mission_status_fault, "WARN_MISSION_STATUS");
}

/// **120h shows the modes.** SM_SYS is DRIVE_AUTONOMOUS while TSMS is on and AUX otherwise. SM_AS is the state that 520h shows.
/// SYS_ACTION_STATE is charging, else driving while TSMS is on, else initialising.
///
/// Requirements: MSG-89 to MSG-91, D-58, D-59.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn status_120h_shows_the_modes() {
    let step = any_end();
    let messages = messages(&step);
    let shown = &messages.vcu_status;
    let charging = step.inputs.reports.charging && step.inputs.tsms;
    kani::cover!(charging, "charging with TSMS on");
    let sm_sys = if step.inputs.tsms { SmSys::DriveAutonomous } else { SmSys::Aux };
    assert!(shown.sm_sys == sm_sys, "SM_SYS");
    let sm_as = match messages.status.as_state {
        AsState::Off => SmAs::Off,
        AsState::Ready => SmAs::Ready,
        AsState::Driving => SmAs::Driving,
        AsState::EmergencyBrake => SmAs::EmergencyBrake,
        AsState::Finished => SmAs::Finished,
    };
    assert!(shown.sm_as == sm_as, "SM_AS");
    let action = if step.inputs.reports.charging {
        SysActionState::Charge
    } else if step.inputs.tsms {
        SysActionState::DriveAuto
    } else {
        SysActionState::Initialise
    };
    assert!(shown.sys_action_state == action, "SYS_ACTION_STATE");
}

/// **524h shows the brakes ready, and the EBS as 502h does**: TRIGGERED in EMERGENCY_BRAKE, else as it reports itself.
///
/// Requirements: MSG-86, MSG-87, D-28, D-55, D-60, D-61.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn states_of_524h() {
    let step = any_end();
    let messages = messages(&step);
    let braking = step.after.state == AsState::EmergencyBrake;
    let unavailable = braking && (step.inputs.ebs == EbsState::Unavailable);
    kani::cover!(unavailable, "it reports itself UNAVAILABLE in EMERGENCY_BRAKE");
    assert!(messages.brake.status_brk == StatusBrk::Ready, "STATUS_BRK");
    let ebs = if braking { EbsState::Triggered } else { step.inputs.ebs };
    assert!(messages.brake.status_ebs == ebs, "STATUS_EBS");
    assert!(messages.log_status.state_ebs == ebs, "State_EBS");
}

/// Whether two names are the same, letter by letter.
pub(crate) fn same(name: &str, other: &str) -> bool {
    let (name, other) = (name.as_bytes(), other.as_bytes());
    let mut same = name.len() == other.len();
    let mut place = 0;
    while same && place < name.len() {
        same = name[place] == other[place];
        place += 1;
    }
    same
}

/// What 4.0 calls otherwise than 3.0: the message, the start bit of the signal and its name.
pub(crate) const NAMES: [(u16, u8, &str); 25] = [
    (0x500, 0, "Speed_actual"),
    (0x500, 8, "Speed_target"),
    (0x500, 16, "Steer_actual"),
    (0x500, 24, "Steer_target"),
    (0x502, 5, "AMI_STATE"),
    (0x510, 48, "VEH_SPEED_ACTUAL"),
    (0x510, 56, "VEH_SPEED_DEMAND"),
    (0x511, 0, "FRONT_AXLE_TRQ_REQUEST"),
    (0x511, 16, "FRONT_MOTOR_SPEED_MAX"),
    (0x512, 0, "REAR_AXLE_TRQ_REQUEST"),
    (0x512, 16, "REAR_MOTOR_SPEED_MAX"),
    (0x513, 0, "STEER_REQUEST"),
    (0x521, 0, "FRONT_AXLE_TRQ"),
    (0x521, 16, "FRONT_AXLE_TRQ_REQUEST"),
    (0x521, 32, "FRONT_AXLE_TRQ_MAX"),
    (0x522, 0, "REAR_AXLE_TRQ"),
    (0x522, 16, "REAR_AXLE_TRQ_REQUEST"),
    (0x522, 32, "REAR_AXLE_TRQ_MAX"),
    (0x523, 0, "ANGLE"),
    (0x523, 16, "ANGLE_MAX"),
    (0x523, 32, "ANGLE_REQUEST"),
    (0x525, 0, "FL_WHEEL_SPEED"),
    (0x525, 16, "FR_WHEEL_SPEED"),
    (0x525, 32, "RL_WHEEL_SPEED"),
    (0x525, 48, "RR_WHEEL_SPEED"),
];

/// **The names that 4.0 changes**: those of 25 signals, each where it stands, and that of the message 525h.
///
/// Requirements: MSG-101, MSG-103.
#[cfg_attr(kani, kani::proof, kani::unwind(43))]
pub fn names_of_4_0() {
    let subject = subject();
    let (mut signals, mut speeds) = (0, false);
    for message in subject.machine_of_4_0().edition().bus.messages {
        speeds |= message.id == 0x525 && same(message.name, "VCU2AI_Speeds");
        for signal in message.signals {
            for (id, start, name) in NAMES {
                if message.id == id && signal.start == start {
                    assert!(same(signal.name, name), "the name");
                    signals += 1;
                }
            }
        }
    }
    kani::cover!(speeds, "VCU2AI_Speeds");
    assert!(speeds, "the name of 525h");
    assert!(signals == NAMES.len(), "each of them is there");
}

theorems![
    each_message_of_4_0_goes_out_in_its_frame,
    status_120h_shows_the_timeouts,
    status_120h_warns_of_what_520h_shows,
    status_120h_shows_the_modes,
    states_of_524h;
    every names_of_4_0
];
