//! Frames as recordings have them, and fields that no recording fills.

use super::*;

#[track_caller]
fn recorded(text: &str, expected: impl Into<AnyMessage>) {
    let frame = frame(text);
    let expected = expected.into();
    assert_eq!(BUS.decode(frame.id, frame.data()), Ok(expected), "{text}");
    let encoded = encode(&BUS, expected);
    assert_eq!(encoded.id, frame.id);
    // Some senders leave out the bytes at the end that no signal uses.
    assert!(encoded.data().starts_with(frame.data()), "{encoded} for {text}");
}

//= MSG-5, MSG-6, MSG-8, MSG-10, MSG-16, MSG-17, MSG-19 to MSG-24, MSG-26 to MSG-28, HS-2, D-30
#[test]
fn recorded_frames_of_the_ai_computer() -> Result<(), QuantityError> {
    recorded(
        "510#0160000000000000",
        Ai2VcuStatus {
            handshake: true,
            mission_status: MissionStatus::Running,
            direction_request: DirectionRequest::Forward,
            ..Ai2VcuStatus::default()
        },
    );
    recorded(
        "510#0030000000000000",
        Ai2VcuStatus { mission_status: MissionStatus::Finished, ..Ai2VcuStatus::default() },
    );
    let (torque, speed) = (AxleTorqueRequest::from_nm(80.0)?, MotorSpeedMax::from_rpm(1750.0)?);
    recorded("511#2003D606", Ai2VcuDriveF { front_axle_trq_request: torque, front_motor_speed_max: speed });
    recorded("512#2003D606", Ai2VcuDriveR { rear_axle_trq_request: torque, rear_motor_speed_max: speed });
    recorded("513#9CFF", Ai2VcuSteer { steer_request: SteerAngle::from_deg(-10.0)? });
    let half = BrakePressure::from_pct(50.0)?;
    recorded("514#6464", Ai2VcuBrake { hyd_press_f_req: half, hyd_press_r_req: half });
    Ok(())
}

//= MSG-41 to MSG-49, MSG-64 to MSG-83, HS-3, D-30
#[test]
fn recorded_frames_of_the_vcu() -> Result<(), QuantityError> {
    let driving = Vcu2AiStatus {
        as_switch_status: true,
        ts_switch_status: true,
        go_signal: true,
        steering_status: true,
        as_state: AsState::Driving,
        ami_state: AmiState::TrackDrive,
        ..Vcu2AiStatus::default()
    };
    recorded("520#001E430000000000", driving);
    recorded("520#011E430000000000", Vcu2AiStatus { handshake: true, ..driving });
    recorded(
        "520#000E440100810008",
        Vcu2AiStatus {
            steering_status: false,
            as_state: AsState::EmergencyBrake,
            fault_status: true,
            ai_estop_request: true,
            mission_status_fault: true,
            shutdown_cause: ShutdownCause::MissionStatusFault,
            ..driving
        },
    );
    recorded("520#0000010000000000", Vcu2AiStatus::default());
    let request = AxleTorqueRequest::from_nm(80.0)?;
    recorded(
        "521#200320039E07",
        Vcu2AiDriveF {
            front_axle_trq: AxleTorque::from_nm(80.0)?,
            front_axle_trq_request: request,
            front_axle_trq_max: AxleTorqueRequest::MAX,
        },
    );
    recorded(
        "522#200320039E07",
        Vcu2AiDriveR {
            rear_axle_trq: AxleTorque::from_nm(80.0)?,
            rear_axle_trq_request: request,
            rear_axle_trq_max: AxleTorqueRequest::MAX,
        },
    );
    recorded(
        "523#F6FFF0009CFF",
        Vcu2AiSteer {
            steer_angle: SteerAngle::from_deg(-1.0)?,
            steer_angle_max: SteerAngleMax::from_deg(24.0)?,
            steer_angle_request: SteerAngle::from_deg(-10.0)?,
        },
    );
    let half = BrakePressure::from_pct(50.0)?;
    recorded(
        "524#64646464",
        Vcu2AiBrake {
            hyd_press_f: half,
            hyd_press_f_req: half,
            hyd_press_r: half,
            hyd_press_r_req: half,
            ..Vcu2AiBrake::default()
        },
    );
    let speed = WheelSpeed::from_rpm(400.0)?;
    recorded(
        "525#9001900190019001",
        Vcu2AiWheelSpeeds {
            fl_wheel_speed: speed,
            fr_wheel_speed: speed,
            rl_wheel_speed: speed,
            rr_wheel_speed: speed,
        },
    );
    recorded(
        "526#E82CE82CE82CE82C",
        Vcu2AiWheelCounts {
            fl_pulse_count: 11496,
            fr_pulse_count: 11496,
            rl_pulse_count: 11496,
            rr_pulse_count: 11496,
        },
    );
    Ok(())
}

//= MSG-29 to MSG-32, MSG-34 to MSG-39, D-30
#[test]
fn recorded_frames_for_the_logger() -> Result<(), QuantityError> {
    recorded(
        "500#2800131400000000",
        Vcu2LogDynamics1 {
            speed_actual: SpeedKmh::from_kmh(40.0)?,
            steer_actual: LogSteerAngle::from_deg(9.5)?,
            steer_target: LogSteerAngle::from_deg(10.0)?,
            ..Vcu2LogDynamics1::default()
        },
    );
    recorded(
        "500#0000F20064640000",
        Vcu2LogDynamics1 {
            steer_actual: LogSteerAngle::from_deg(-7.0)?,
            brake_actual: LogBrake::MAX,
            brake_target: LogBrake::MAX,
            ..Vcu2LogDynamics1::default()
        },
    );
    recorded(
        "502#9307000000",
        Vcu2LogStatus {
            state_assi: AsState::Driving,
            state_ebs: EbsState::Armed,
            state_ami: AmiState::TrackDrive,
            state_steering: true,
            state_service_brake: ServiceBrake::Available,
            ..Vcu2LogStatus::default()
        },
    );
    Ok(())
}

//= MSG-1 to MSG-4, MSG-7, MSG-11 to MSG-15, MSG-33, MSG-40, D-30
#[test]
fn fields_that_no_recording_fills() -> Result<(), QuantityError> {
    recorded(
        "501#FFFF000200FF",
        Ai2LogDynamics2 {
            accel_longitudinal: Acceleration::from_raw(-1)?,
            accel_lateral: Acceleration::from_mps2(1.0)?,
            yaw_rate: YawRate::from_degps(-2.0)?,
        },
    );
    recorded(
        "510#00010AFF0180FF64",
        Ai2VcuStatus {
            estop_request: true,
            lap_counter: LapCounter::from_raw(10)?,
            cones_count_actual: 255,
            cones_count_all: 0x8001,
            veh_speed_actual: SpeedKmh::MAX,
            veh_speed_demand: SpeedKmh::from_kmh(100.0)?,
            ..Ai2VcuStatus::default()
        },
    );
    recorded(
        "500#000000000000649C",
        Vcu2LogDynamics1 {
            drive_trq_actual: LogDriveTorque::from_pct(100.0)?,
            drive_trq_target: LogDriveTorque::from_pct(-100.0)?,
            ..Vcu2LogDynamics1::default()
        },
    );
    // 1 | 1 << 3 | 1 << 9 | 9 << 11 | 200 << 15 | 131071 << 23
    recorded(
        "502#094AE4FFFF",
        Vcu2LogStatus {
            lap_counter: LapCounter::from_raw(9)?,
            cones_count_actual: 200,
            cones_count_all: ConesCountAll::MAX,
            ..Vcu2LogStatus::default()
        },
    );
    Ok(())
}

#[test]
fn fields_of_one_type_have_their_own_places() -> Result<(), QuantityError> {
    let pct = BrakePressure::from_raw;
    recorded("514#0102", Ai2VcuBrake { hyd_press_f_req: pct(1)?, hyd_press_r_req: pct(2)? });
    recorded(
        "524#01020304",
        Vcu2AiBrake {
            hyd_press_f: pct(1)?,
            hyd_press_f_req: pct(2)?,
            hyd_press_r: pct(3)?,
            hyd_press_r_req: pct(4)?,
            ..Vcu2AiBrake::default()
        },
    );
    let nm = AxleTorqueRequest::from_raw;
    recorded(
        "521#FFFF02000300",
        Vcu2AiDriveF {
            front_axle_trq: AxleTorque::from_raw(-1)?,
            front_axle_trq_request: nm(2)?,
            front_axle_trq_max: nm(3)?,
        },
    );
    recorded(
        "522#FFFF02000300",
        Vcu2AiDriveR {
            rear_axle_trq: AxleTorque::from_raw(-1)?,
            rear_axle_trq_request: nm(2)?,
            rear_axle_trq_max: nm(3)?,
        },
    );
    let rpm = WheelSpeed::from_raw;
    recorded(
        "525#0100020003000400",
        Vcu2AiWheelSpeeds {
            fl_wheel_speed: rpm(1)?,
            fr_wheel_speed: rpm(2)?,
            rl_wheel_speed: rpm(3)?,
            rr_wheel_speed: rpm(4)?,
        },
    );
    recorded(
        "526#0100020003000400",
        Vcu2AiWheelCounts { fl_pulse_count: 1, fr_pulse_count: 2, rl_pulse_count: 3, rr_pulse_count: 4 },
    );
    recorded(
        "500#0102030405060708",
        Vcu2LogDynamics1 {
            speed_actual: SpeedKmh::from_raw(1)?,
            speed_target: SpeedKmh::from_raw(2)?,
            steer_actual: LogSteerAngle::from_raw(3)?,
            steer_target: LogSteerAngle::from_raw(4)?,
            brake_actual: LogBrake::from_raw(5)?,
            brake_target: LogBrake::from_raw(6)?,
            drive_trq_actual: LogDriveTorque::from_raw(7)?,
            drive_trq_target: LogDriveTorque::from_raw(8)?,
        },
    );
    Ok(())
}
