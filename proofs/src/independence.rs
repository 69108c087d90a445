//! What exists only for the data logger, or only to be reported, changes nothing: two runs that differ only there are one.

use adsdv_spec::messages::{Ai2VcuBrake, Ai2VcuStatus, AsState};
use adsdv_spec::{AiMessages, Inputs, Reports, Vehicle};

use crate::prelude::*;

/// These inputs, with any other values of what is only logged or reported.
///
/// In the messages of the AI Computer: laps, cones and speeds, the motor speed limits and the brake requests. On the
/// vehicle: all that is measured but the steer angle and the wheel speeds. Of the reports: the two warnings.
fn otherwise_logged(inputs: &Inputs) -> Inputs {
    let other: Inputs = kani::any();
    let Inputs { ai, vehicle, reports, .. } = *inputs;
    let mut drive_f = ai.drive_f;
    let mut drive_r = ai.drive_r;
    drive_f.front_motor_speed_max = other.ai.drive_f.front_motor_speed_max;
    drive_r.rear_motor_speed_max = other.ai.drive_r.rear_motor_speed_max;
    let Ai2VcuStatus { handshake, estop_request, mission_status, direction_request, .. } = ai.status;
    Inputs {
        ai: AiMessages {
            status: Ai2VcuStatus {
                handshake,
                estop_request,
                mission_status,
                direction_request,
                ..other.ai.status
            },
            drive_f,
            drive_r,
            brake: Ai2VcuBrake { ..other.ai.brake },
            steer: ai.steer,
        },
        vehicle: Vehicle {
            steer_angle: vehicle.steer_angle,
            wheel_speeds: vehicle.wheel_speeds,
            ..other.vehicle
        },
        reports: Reports {
            batt_temp_high: other.reports.batt_temp_high,
            batt_soc_low: other.reports.batt_soc_low,
            ..reports
        },
        ..*inputs
    }
}

fn what_is_only_logged_decides_nothing(state: AsState) {
    let one = any_step_from(state);
    let inputs = otherwise_logged(&one.inputs);
    let other = Step::of(one.before, inputs, one.dt_ms);
    kani::cover!(
        one.outputs.taken.is_some()
            && one.inputs.ai.status.cones_count_all != inputs.ai.status.cones_count_all,
        "an arrow is taken, with other cones"
    );
    assert!(one.after == other.after, "the same control state");
    assert!(one.outputs == other.outputs, "the same arrow, faults and outputs");
}

harnesses! {
    /// **What is only logged decides nothing.** Two steps whose inputs differ only in laps, cones, speeds, motor speed limits,
    /// brake requests, measured torques, pressures, counts and limits, and warnings, come to the same control state, arrow,
    /// faults and outputs.
    ///
    /// Requirements: SM-1, SM-18.
    unwind 13;
    what_is_only_logged_decides_nothing_in_off = what_is_only_logged_decides_nothing(AsState::Off);
    what_is_only_logged_decides_nothing_in_ready = what_is_only_logged_decides_nothing(AsState::Ready);
    what_is_only_logged_decides_nothing_in_driving = what_is_only_logged_decides_nothing(AsState::Driving);
    what_is_only_logged_decides_nothing_in_finished = what_is_only_logged_decides_nothing(AsState::Finished);
    what_is_only_logged_decides_nothing_in_emergency_brake = what_is_only_logged_decides_nothing(AsState::EmergencyBrake);
}

/// **The messages of the data logger reach nobody.** Whatever is received under an identifier that is not one of the AI
/// Computer's five (500h to 502h among them), the VCU's view of the AI Computer stays as it was.
///
/// Requirements: SM-1, D-35.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn messages_for_the_logger_reach_nobody() {
    let before: AiMessages = kani::any::<Inputs>().ai;
    let id: u16 = kani::any_where(|id| !(0x510..=0x514).contains(id));
    let data: [u8; 8] = kani::any();
    let mut after = before;
    let taken = subject().receive(&mut after, id, &data);
    kani::cover!((0x500..=0x502).contains(&id), "a message for the logger");
    assert!(!taken && after == before, "nothing is taken over");
}

theorems![
    what_is_only_logged_decides_nothing_in_off,
    what_is_only_logged_decides_nothing_in_ready,
    what_is_only_logged_decides_nothing_in_driving,
    what_is_only_logged_decides_nothing_in_finished,
    what_is_only_logged_decides_nothing_in_emergency_brake,
    messages_for_the_logger_reach_nobody
];
