//! What a frame says, in words.

use adsdv_spec::Edition;
use adsdv_spec::messages::{AmiState, AnyMessage, BrakePressure, Frame, ShutdownCause};

/// What a frame of an edition says, as far as it matters here.
pub(super) fn meaning(frame: &Frame, edition: &Edition) -> String {
    let pressed = |front: BrakePressure, rear: BrakePressure| format!("brakes {front} front, {rear} rear");
    let Ok(message) = edition.bus.decode(frame.id, frame.data()) else { return "not a message".to_owned() };
    match message {
        AnyMessage::Ai2VcuStatus(status) => format!(
            "HANDSHAKE {}, {}, {}",
            u8::from(status.handshake),
            status.mission_status,
            status.direction_request
        ),
        AnyMessage::Ai2VcuDriveF(drive) => format!("front torque {}", drive.front_axle_trq_request),
        AnyMessage::Ai2VcuDriveR(drive) => format!("rear torque {}", drive.rear_axle_trq_request),
        AnyMessage::Ai2VcuSteer(steer) => format!("steer {}", steer.steer_request),
        AnyMessage::Ai2VcuBrake(brake) => pressed(brake.hyd_press_f_req, brake.hyd_press_r_req),
        AnyMessage::Vcu2AiStatus(status) => {
            let mut words =
                vec![format!("HANDSHAKE {}", u8::from(status.handshake)), status.as_state.to_string()];
            if status.ami_state != AmiState::NotSelected {
                words.push(status.ami_state.to_string());
            }
            if status.shutdown_cause != ShutdownCause::NoShutdown {
                words.push(status.shutdown_cause.to_string());
            }
            words.join(", ")
        }
        AnyMessage::Vcu2AiDriveF(drive) => {
            format!("front torque request {}", drive.front_axle_trq_request)
        }
        AnyMessage::Vcu2AiDriveR(drive) => format!("rear torque request {}", drive.rear_axle_trq_request),
        AnyMessage::Vcu2AiBrake(brake) => pressed(brake.hyd_press_f_req, brake.hyd_press_r_req),
        AnyMessage::Vcu2AiWheelSpeeds(speeds) => format!("wheels at {}", speeds.fl_wheel_speed),
        other => format!("{:03X}h", other.id()),
    }
}
