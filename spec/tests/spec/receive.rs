//! What the VCU makes of the frames of the AI Computer.

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AxleTorqueRequest, BrakePressure,
    MissionStatus, MotorSpeedMax, SteerAngle,
};
use adsdv_spec::{AiMessages, Bus, Edition};

const BUS: Bus = Edition::V3_0.bus;

/// Messages of which none is the default.
fn requests() -> AiMessages {
    AiMessages {
        status: Ai2VcuStatus { mission_status: MissionStatus::Running, ..Ai2VcuStatus::default() },
        drive_f: Ai2VcuDriveF {
            front_axle_trq_request: AxleTorqueRequest::clamped(1),
            front_motor_speed_max: MotorSpeedMax::clamped(2),
        },
        drive_r: Ai2VcuDriveR {
            rear_axle_trq_request: AxleTorqueRequest::clamped(3),
            rear_motor_speed_max: MotorSpeedMax::clamped(4),
        },
        steer: Ai2VcuSteer { steer_request: SteerAngle::clamped(-5) },
        brake: Ai2VcuBrake {
            hyd_press_f_req: BrakePressure::clamped(6),
            hyd_press_r_req: BrakePressure::clamped(7),
        },
    }
}

fn received(sent: &AiMessages) -> AiMessages {
    let mut received = AiMessages::default();
    for frame in sent.frames(&BUS) {
        assert_eq!(received.receive(&BUS, frame.id, frame.data()), Ok(true), "{frame}");
    }
    received
}

#[test]
fn each_frame_brings_its_message() {
    assert_eq!(received(&requests()), requests());
}

//= D-35
#[test]
fn the_last_values_stay_until_new_ones_come() {
    let mut ai = received(&requests());
    let steer = Ai2VcuSteer { steer_request: SteerAngle::clamped(240) };
    let frame = BUS.encode(steer).expect("513h");
    assert_eq!(ai.receive(&BUS, frame.id, frame.data()), Ok(true));
    assert_eq!(ai, AiMessages { steer, ..requests() });
    // Messages of the VCU, and of nobody.
    for id in [0x520, 0x501, 0x000, 0x7FF] {
        assert_eq!(ai.receive(&BUS, id, &[0xFF; 8]), Ok(false), "{id:03X}h");
    }
    assert_eq!(ai, AiMessages { steer, ..requests() });
}

//= D-19, D-20, D-32
#[test]
fn a_frame_that_does_not_decode_changes_nothing() {
    let bad: [(u16, &[u8]); 7] = [
        (Ai2VcuStatus::ID, &[0x01, 0x80, 0, 0, 0, 0, 0, 0]), // DIRECTION_REQUEST is 2, REVERSE
        (Ai2VcuStatus::ID, &[0x01, 0x10]),                   // too short
        (Ai2VcuDriveF::ID, &[0x9F, 0x07, 0, 0]),             // 195.1 Nm
        (Ai2VcuDriveR::ID, &[0, 0, 0xA1, 0x0F]),             // 4001 rpm
        (Ai2VcuSteer::ID, &[0xF1, 0]),                       // 24.1 degrees
        (Ai2VcuBrake::ID, &[0, 0xC9]),                       // 100.5 %
        (Ai2VcuBrake::ID, &[]),
    ];
    for (id, data) in bad {
        let mut ai = received(&requests());
        assert!(ai.receive(&BUS, id, data).is_err(), "{id:03X}h {data:02X?}");
        assert_eq!(ai, requests(), "{id:03X}h {data:02X?}");
    }
}
