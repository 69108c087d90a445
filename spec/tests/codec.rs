//! The codec against a second reading of the table, bit by bit, and against recorded frames.

use adsdv_spec::messages::{
    Acceleration, Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer,
    AmiState, AnyMessage, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, ConesCountAll, DecodeError,
    DirectionRequest, EbsState, Frame, LapCounter, LogBrake, LogDriveTorque, LogSteerAngle, MESSAGES,
    Message, MessageDef, MissionStatus, MotorSpeedMax, Node, QuantityError, ServiceBrake, ShutdownCause,
    SignalDef, SpeedKmh, SteerAngle, SteerAngleMax, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus,
    Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds, Vcu2LogDynamics1, Vcu2LogStatus, WheelSpeed, YawRate,
    message_by_id,
};

/// Bit `index` of a frame's data, bit 0 being the lowest of the first byte.
fn bit(data: &[u8], index: u8) -> bool {
    data[usize::from(index / 8)] >> (index % 8) & 1 == 1
}

fn set_bit(data: &mut [u8], index: u8, on: bool) {
    let mask = 1 << (index % 8);
    let byte = &mut data[usize::from(index / 8)];
    *byte = if on { *byte | mask } else { *byte & !mask };
}

/// Reads a signal bit by bit: the codec's reading must agree.
fn read(signal: &SignalDef, data: &[u8]) -> i32 {
    (0..signal.width).map(|place| value_of_bit(signal, place, bit(data, signal.start + place))).sum()
}

fn value_of_bit(signal: &SignalDef, place: u8, on: bool) -> i32 {
    let weight = if signal.signed && place + 1 == signal.width { -(1 << place) } else { 1 << place };
    if on { weight } else { 0 }
}

/// Writes a signal bit by bit.
fn write(signal: &SignalDef, data: &mut [u8], raw: i32) {
    for place in 0..signal.width {
        set_bit(data, signal.start + place, raw >> place & 1 == 1);
    }
}

fn used_bits(message: &MessageDef) -> Vec<u8> {
    message.signals.iter().flat_map(|signal| signal.start..signal.start + signal.width).collect()
}

/// Whether the row allows a raw value, said a second time.
fn allowed(signal: &SignalDef, raw: i32) -> bool {
    let named = signal.values.iter().any(|(value, _)| *value == raw);
    (signal.min..=signal.max).contains(&raw) && (signal.values.is_empty() || named)
}

fn decode(message: &MessageDef, data: &[u8]) -> Result<AnyMessage, DecodeError> {
    AnyMessage::decode(message.id, data)
}

/// Data in which every signal has the lowest value it may have.
fn lowest(message: &MessageDef) -> [u8; 8] {
    let mut data = [0; 8];
    for signal in message.signals {
        write(signal, &mut data, signal.min);
    }
    data
}

/// The xorshift generator of Marsaglia: the same numbers in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A value that the signal allows, often one of the outermost.
    fn value(&mut self, signal: &SignalDef) -> i32 {
        let count = u64::from(signal.max.abs_diff(signal.min)) + 1;
        let raw = match self.next() % 4 {
            0 => signal.min,
            1 => signal.max,
            _ => signal.min + i32::try_from(self.next() % count).expect("a range of at most 32 bits"),
        };
        if allowed(signal, raw) { raw } else { signal.min }
    }
}

// The table

#[test]
fn every_message_stands_once_by_ascending_identifier() {
    let ids: Vec<u16> = MESSAGES.iter().map(|message| message.id).collect();
    let expected: Vec<u16> = (0x500..=0x502).chain(0x510..=0x514).chain(0x520..=0x526).collect();
    assert_eq!(ids, expected);
    for (index, message) in MESSAGES.iter().enumerate() {
        assert!(MESSAGES[..index].iter().all(|other| other.name != message.name), "{} twice", message.name);
    }
}

#[test]
fn an_identifier_finds_its_message_and_no_other() {
    for id in 0..=u16::MAX {
        let found = message_by_id(id);
        assert_eq!(found, MESSAGES.iter().copied().find(|message| message.id == id), "{id:03X}h");
        if found.is_none() {
            assert_eq!(AnyMessage::decode(id, &[0; 8]), Err(DecodeError::UnknownId { id }));
        }
    }
}

#[test]
fn the_sender_is_in_the_name() {
    for message in MESSAGES {
        let sender = if message.name.starts_with("AI2") { Node::Ai } else { Node::Vcu };
        let section = if sender == Node::Ai { "2.1" } else { "2.2" };
        assert_eq!((message.sender, message.section), (sender, section), "{}", message.name);
        assert!(message.name.starts_with(&sender.to_string()), "{}", message.name);
        assert!(!message.doc.is_empty() && message.doc.trim() == message.doc, "{}", message.name);
    }
}

#[test]
fn no_two_signals_of_a_message_share_a_bit_or_a_name() {
    for message in MESSAGES {
        let mut bits = used_bits(message);
        assert!(bits.iter().all(|&bit| bit < message.len * 8), "{}: a signal ends after it", message.name);
        let count = bits.len();
        bits.sort_unstable();
        bits.dedup();
        assert_eq!(bits.len(), count, "{}", message.name);
        for (index, signal) in message.signals.iter().enumerate() {
            assert!(
                message.signals[..index].iter().all(|other| other.name != signal.name),
                "{}",
                signal.name
            );
            assert_eq!(message.signal(signal.name), Some(signal));
        }
        assert_eq!(message.signal("NO_SUCH_SIGNAL"), None);
    }
}

#[test]
fn every_row_is_well_formed() {
    for signal in MESSAGES.iter().flat_map(|message| message.signals) {
        let name = signal.name;
        assert!(signal.min < signal.max, "{name}");
        assert_eq!(signal.signed, signal.min < 0, "{name}");
        assert!(signal.values.windows(2).all(|pair| pair[0].0 < pair[1].0), "{name}: names out of order");
        assert!(signal.values.iter().all(|(_, text)| !text.is_empty()), "{name}");
        if let (Some(first), Some(last)) = (signal.values.first(), signal.values.last()) {
            assert_eq!((first.0, last.0), (signal.min, signal.max), "{name}: the range of an enumeration");
        }
        assert!(!signal.doc.is_empty() && signal.doc.trim() == signal.doc, "{name}");
        for raw in [signal.min, signal.max] {
            assert_eq!(signal.check(raw), Ok(()), "{name}");
        }
        for given in [signal.min - 1, signal.max + 1, i32::MIN, i32::MAX] {
            let refused = signal.check(given).expect_err(name);
            assert_eq!((refused.given, refused.def), (given, signal));
        }
    }
}

#[test]
fn lengths_are_those_of_the_database() {
    for message in MESSAGES {
        let len = match message.id {
            0x501 => 6,
            0x502 => 5,
            _ => 8,
        };
        assert_eq!(message.len, len, "{}", message.name);
    }
}

#[test]
fn the_bytes_needed_end_with_the_last_signal() {
    for message in MESSAGES {
        let last = used_bits(message).into_iter().max().expect("every message has signals");
        assert_eq!(message.bytes_needed(), usize::from(last / 8) + 1, "{}", message.name);
        for signal in message.signals {
            let needed = signal.bytes_needed();
            assert_eq!(needed, usize::from((signal.start + signal.width - 1) / 8) + 1, "{}", signal.name);
            assert_eq!(signal.raw(&[0; 64][..needed - 1]), None, "{}", signal.name);
            assert_eq!(signal.raw(&[0; 64][..needed]), Some(0), "{}", signal.name);
        }
    }
}

// Round trips

#[test]
fn every_bit_pattern_of_every_signal_is_a_value_or_an_error() {
    for message in MESSAGES {
        for signal in message.signals {
            let mut data = lowest(message);
            for pattern in 0..1 << signal.width {
                write(signal, &mut data, pattern);
                let raw = read(signal, &data);
                assert_eq!(signal.raw(&data), Some(raw), "{}", signal.name);
                assert_eq!(signal.allows(raw), allowed(signal, raw), "{} {raw}", signal.name);
                match decode(message, &data) {
                    Ok(decoded) => {
                        assert!(allowed(signal, raw), "{} takes {raw}", signal.name);
                        assert_eq!(decoded.encode().data, data, "{} {raw}", signal.name);
                    }
                    Err(DecodeError::Value(error)) => {
                        assert!(!allowed(signal, raw), "{} refuses {raw}", signal.name);
                        assert_eq!((error.message, error.id), (message.name, message.id));
                        assert_eq!((error.signal, error.given, error.def), (signal.name, raw, signal));
                    }
                    Err(other) => panic!("{}: {other}", signal.name),
                }
            }
        }
    }
}

#[test]
fn values_survive_together() {
    let mut numbers = Numbers(0x5EED_0001);
    for message in MESSAGES {
        for _ in 0..2_000 {
            let mut data = [0; 8];
            for signal in message.signals {
                write(signal, &mut data, numbers.value(signal));
            }
            let decoded = decode(message, &data).expect("every value is allowed");
            let frame = decoded.encode();
            assert_eq!(
                (frame.id, frame.len, frame.data),
                (message.id, message.len, data),
                "{}",
                message.name
            );
            assert_eq!(decoded.def(), message);
            assert_eq!(decode(message, frame.data()), Ok(decoded));
        }
    }
}

#[test]
fn any_bytes_are_a_message_or_an_error_that_is_true() {
    let mut numbers = Numbers(0x5EED_0002);
    for message in MESSAGES {
        for _ in 0..5_000 {
            // Each AND clears half of the bits, so that enumerations are often allowed.
            let data = (numbers.next() & numbers.next() & numbers.next()).to_le_bytes();
            match decode(message, &data) {
                Ok(decoded) => {
                    let encoded = decoded.encode().data;
                    let used = used_bits(message);
                    for index in 0..64 {
                        let expected = used.contains(&index) && bit(&data, index);
                        assert_eq!(bit(&encoded, index), expected, "{} bit {index}", message.name);
                    }
                    assert_eq!(decode(message, &encoded), Ok(decoded));
                }
                Err(error) => {
                    let first = message.signals.iter().find(|signal| !allowed(signal, read(signal, &data)));
                    let first = first.expect("some signal must be refused");
                    assert!(error.to_string().contains(first.name), "{error}");
                }
            }
        }
    }
}

// Lengths and unused bits

#[test]
fn data_of_any_length_is_enough_from_the_last_signal_on() {
    let mut numbers = Numbers(0x5EED_0003);
    for message in MESSAGES {
        let mut data = [0xFF; 64];
        for signal in message.signals {
            write(signal, &mut data, numbers.value(signal));
        }
        let needed = message.bytes_needed();
        let whole = decode(message, &data[..8]).expect("every value is allowed");
        for given in 0..=64 {
            let decoded = decode(message, &data[..given]);
            if given >= needed {
                assert_eq!(decoded, Ok(whole), "{} of {given} bytes", message.name);
            } else {
                let first = message.signals.iter().find(|signal| signal.bytes_needed() > given);
                let signal = first.expect("one does not fit").name;
                let expected =
                    DecodeError::TooShort { message: message.name, id: message.id, given, needed, signal };
                assert_eq!(decoded, Err(expected));
            }
        }
    }
}

#[test]
fn unused_bits_are_ignored_when_read_and_zero_when_written() {
    for message in MESSAGES {
        let clean = lowest(message);
        let decoded = decode(message, &clean).expect("every value is allowed");
        assert_eq!(decoded.encode().data, clean, "{}", message.name);
        let used = used_bits(message);
        for index in (0..64).filter(|index| !used.contains(index)) {
            let mut dirty = clean;
            set_bit(&mut dirty, index, true);
            assert_eq!(decode(message, &dirty), Ok(decoded), "{} bit {index}", message.name);
        }
    }
}

// The document, in numbers

fn frame(text: &str) -> Frame {
    let (id, digits) = text.split_once('#').expect("an identifier and data");
    let data: Vec<u8> = (0..digits.len())
        .step_by(2)
        .map(|at| u8::from_str_radix(&digits[at..at + 2], 16).expect("hexadecimal digits"))
        .collect();
    let frame = Frame::new(u16::from_str_radix(id, 16).expect("hexadecimal digits"), &data);
    let frame = frame.expect("at most eight bytes");
    assert_eq!(frame.to_string(), text);
    frame
}

#[track_caller]
fn recorded(text: &str, expected: impl Into<AnyMessage>) {
    let frame = frame(text);
    let expected = expected.into();
    assert_eq!(AnyMessage::decode(frame.id, frame.data()), Ok(expected), "{text}");
    let encoded = expected.encode();
    assert_eq!(encoded.id, frame.id);
    // Some senders leave out the bytes at the end that no signal uses.
    assert!(encoded.data().starts_with(frame.data()), "{encoded} for {text}");
}

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
        Vcu2AiBrake { hyd_press_f: half, hyd_press_f_req: half, hyd_press_r: half, hyd_press_r_req: half },
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

#[test]
fn each_flag_of_the_vcu_status_has_its_own_bit() {
    type Field = fn(&Vcu2AiStatus) -> bool;
    let flags: [(u8, &str, Field); 20] = [
        (0, "HANDSHAKE", |m| m.handshake),
        (8, "SHUTDOWN_REQUEST", |m| m.shutdown_request),
        (9, "AS_SWITCH_STATUS", |m| m.as_switch_status),
        (10, "TS_SWITCH_STATUS", |m| m.ts_switch_status),
        (11, "GO_SIGNAL", |m| m.go_signal),
        (12, "STEERING_STATUS", |m| m.steering_status),
        (24, "FAULT_STATUS", |m| m.fault_status),
        (25, "WARNING_STATUS", |m| m.warning_status),
        (32, "WARN_BATT_TEMP_HIGH", |m| m.warn_batt_temp_high),
        (33, "WARN_BATT_SOC_LOW", |m| m.warn_batt_soc_low),
        (40, "AI_ESTOP_REQUEST", |m| m.ai_estop_request),
        (41, "HVIL_OPEN_FAULT", |m| m.hvil_open_fault),
        (42, "HVIL_SHORT_FAULT", |m| m.hvil_short_fault),
        (43, "EBS_FAULT", |m| m.ebs_fault),
        (44, "OFFBOARD_CHARGER_FAULT", |m| m.offboard_charger_fault),
        (45, "AI_COMMS_LOST", |m| m.ai_comms_lost),
        (46, "AUTONOMOUS_BRAKING_FAULT", |m| m.autonomous_braking_fault),
        (47, "MISSION_STATUS_FAULT", |m| m.mission_status_fault),
        (48, "CHARGE_PROCEDURE_FAULT", |m| m.charge_procedure_fault),
        (49, "BMS_FAULT", |m| m.bms_fault),
    ];
    for (index, name, _) in flags {
        let mut data = Vcu2AiStatus::default().encode().data;
        set_bit(&mut data, index, true);
        let decoded = Vcu2AiStatus::decode(&data).expect("a flag may be set");
        for (_, other, field) in flags {
            assert_eq!(field(&decoded), name == other, "{other} with bit {index}");
            let raw = Vcu2AiStatus::DEF.signal(other).and_then(|signal| signal.raw(&data));
            assert_eq!(raw, Some(i32::from(name == other)), "{other} with bit {index}");
        }
    }
}

#[test]
fn ranges_end_where_the_document_says() {
    let ok = |text: &str| {
        let frame = frame(text);
        AnyMessage::decode(frame.id, frame.data()).is_ok()
    };
    for (within, beyond) in [
        ("511#9E070000", "511#9F070000"),                 // 195 Nm
        ("511#0000A00F", "511#0000A10F"),                 // 4000 rpm
        ("512#9E07A00F", "512#9F07A00F"),                 // 195 Nm
        ("513#F000", "513#F100"),                         // 24 degrees
        ("513#10FF", "513#0FFF"),                         // -24 degrees
        ("514#C8C8", "514#C8C9"),                         // 100 %
        ("521#62F89E079E07", "521#61F89E079E07"),         // -195 Nm
        ("521#9E079E079E07", "521#9E079E079F07"),         // 195 Nm
        ("521#9E079E079E07", "521#9F079E079E07"),         // 195 Nm
        ("522#00009E070000", "522#0000FFFF0000"),         // unsigned, 195 Nm
        ("523#0000F0000000", "523#0000F1000000"),         // 24 degrees
        ("524#C8C8C8C8", "524#C8C9C8C8"),                 // 100 %
        ("525#E204E204E204E204", "525#E204E204E204E304"), // 1250 rpm
        ("500#000080800000009C", "500#000080800000009B"), // -100 %
        ("500#0000000064640064", "500#0000000065640064"), // 100 %
        ("500#0000000064646464", "500#0000000064646465"), // 100 %
        ("510#0070000000000000", "510#0080000000000000"), // no REVERSE
        ("520#0000710000000000", "520#0000810000000000"), // seven missions
        ("520#0000010000000000", "520#0000000000000000"), // AS_STATE 1
        ("520#0000050000000000", "520#0000060000000000"), // to 5
        ("520#0010010000000000", "520#0020010000000000"), // STEERING_STATUS 1
        ("520#000001000000000A", "520#000001000000000B"), // ten causes
        ("502#0D02000000", "502#0E02000000"),             // State_ASSI 5
        ("502#0902000000", "502#0102000000"),             // State_EBS 1
        ("502#0902000000", "502#0900000000"),             // State_service_brake 1
    ] {
        assert!(ok(within), "{within} is in range");
        assert!(!ok(beyond), "{beyond} is out of range");
    }
}

// Quantities and names

#[test]
fn physical_values_are_rounded_to_the_nearest_step() {
    for raw in -240..=240 {
        let angle = SteerAngle::from_raw(raw).expect("in range");
        assert_eq!(SteerAngle::from_deg(f64::from(raw) / 10.0), Ok(angle));
        assert_eq!(SteerAngle::from_deg(f64::from(raw) / 10.0 + 0.04), Ok(angle));
        assert_eq!(SteerAngle::from_deg(f64::from(raw) / 10.0 - 0.04), Ok(angle));
        assert_eq!(SteerAngle::from_deg(angle.to_physical()), Ok(angle));
    }
    for raw in -32768..=32767 {
        let acceleration = Acceleration::from_raw(raw).expect("in range");
        assert_eq!(Acceleration::from_mps2(acceleration.to_physical()), Ok(acceleration));
    }
    assert_eq!(BrakePressure::from_pct(12.25).map(BrakePressure::raw), Ok(25));
}

#[test]
fn quantities_refuse_what_is_out_of_range() {
    assert!(SteerAngle::from_raw(241).is_err() && SteerAngle::from_raw(-241).is_err());
    assert!(SteerAngle::from_raw(i32::MIN).is_err() && SteerAngle::from_raw(65536).is_err());
    for degrees in [24.06, -24.06, 1e300, -1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert!(SteerAngle::from_deg(degrees).is_err(), "{degrees}");
    }
    assert!(AxleTorqueRequest::from_nm(-0.1).is_err());
    assert_eq!(SteerAngle::from_deg(24.04), Ok(SteerAngle::MAX));
    assert_eq!(SteerAngle::from_deg(-24.04), Ok(SteerAngle::MIN));
    assert_eq!(i32::from(LapCounter::MAX), 15);
    assert_eq!(LapCounter::try_from(15), Ok(LapCounter::MAX));
    assert!(LapCounter::try_from(16).is_err());
    assert_eq!(ConesCountAll::MAX.raw(), 131_071);
}

#[test]
fn values_display_with_their_units() {
    let text = |raw| AxleTorque::from_raw(raw).map(|torque| torque.to_string());
    assert_eq!(text(125).as_deref(), Ok("12.5 Nm"));
    assert_eq!(text(-5).as_deref(), Ok("-0.5 Nm"));
    assert_eq!(text(-1950).as_deref(), Ok("-195 Nm"));
    assert_eq!(Acceleration::MIN.to_string(), "-64.00016384 m/s^2");
    assert_eq!(YawRate::MAX.to_string(), "255.9921875 deg/s");
    assert_eq!(LapCounter::default().to_string(), "0");
    assert_eq!(format!("{:>10}|", AsState::Ready), "  AS_READY|");

    let signal = |name| Vcu2AiStatus::DEF.signal(name).expect(name);
    assert_eq!(signal("GO_SIGNAL").display(1).to_string(), "GO");
    assert_eq!(signal("SHUTDOWN_CAUSE").display(10).to_string(), "BMS FAULT");
    assert_eq!(signal("SHUTDOWN_CAUSE").display(11).to_string(), "11");
    assert_eq!(signal("HANDSHAKE").display(1).to_string(), "1");
    let speed = Vcu2LogDynamics1::DEF.signal("Steer_actual_deg").expect("a signal of 500h");
    assert_eq!(speed.display(-128).to_string(), "-64 deg");
    assert!((speed.physical(127) - 63.5).abs() < 1e-9);
}

#[test]
fn enumerations_go_by_the_document_s_numbers_and_names() {
    assert_eq!(AsState::ALL.map(AsState::raw), [1, 2, 3, 4, 5]);
    assert_eq!(
        AsState::ALL.map(AsState::name),
        ["AS_OFF", "AS_READY", "AS_DRIVING", "EMERGENCY_BRAKE", "AS_FINISHED"]
    );
    assert_eq!(EbsState::ALL.map(EbsState::raw), [1, 2, 3]);
    assert_eq!(AmiState::ALL.map(AmiState::raw), [0, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(ServiceBrake::ALL.map(ServiceBrake::raw), [1, 2, 3]);
    assert_eq!(ShutdownCause::ALL.map(ShutdownCause::raw), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    assert_eq!(
        MissionStatus::ALL.map(MissionStatus::name),
        ["NOT SELECTED", "SELECTED", "RUNNING", "FINISHED"]
    );
    assert_eq!(DirectionRequest::ALL.map(DirectionRequest::name), ["NEUTRAL", "FORWARD"]);
    for raw in -1..=256 {
        assert_eq!(
            ShutdownCause::from_raw(raw).map(ShutdownCause::raw),
            (0..=10).contains(&raw).then_some(raw)
        );
    }
}

// Errors and frames

#[test]
fn errors_say_what_was_given_and_what_is_allowed() {
    let error = |text: &str| {
        let frame = frame(text);
        AnyMessage::decode(frame.id, frame.data()).expect_err(text).to_string()
    };
    assert_eq!(error("527#"), "527h is not the identifier of a message of section 2");
    assert_eq!(
        error("520#00000100"),
        "VCU2AI_Status (520h) has 4 bytes, needs 8: WARN_BATT_TEMP_HIGH is the first signal that does not fit",
    );
    assert_eq!(
        error("502#0102000000"),
        "VCU2LOG_Status (502h): State_EBS is 0, allowed: 1 = UNAVAILABLE, 2 = ARMED, 3 = TRIGGERED",
    );
    assert_eq!(
        error("514#C900"),
        "AI2VCU_Brake (514h): HYD_PRESS_F_REQ_pct is 100.5 % (raw 201), allowed: 0 to 100 % (raw 0 to 200)",
    );
    assert_eq!(
        SteerAngle::from_deg(25.0).expect_err("too far").to_string(),
        "SteerAngle cannot be 25 deg, allowed: -24 to 24 deg in steps of 0.1 (raw -240 to 240)",
    );
    assert_eq!(
        LapCounter::from_raw(16).expect_err("too many").to_string(),
        "LapCounter cannot be 16 (raw 16), allowed: 0 to 15 in steps of 1 (raw 0 to 15)",
    );
}

#[test]
fn a_frame_never_shows_more_than_eight_bytes() {
    let frame = Frame { id: 0x7FF, len: 200, data: [0xAB; 8] };
    assert_eq!(frame.data(), [0xAB; 8]);
    assert_eq!(frame.to_string(), "7FF#ABABABABABABABAB");
    assert_eq!(Frame::new(0, &[]).map(|frame| frame.to_string()).as_deref(), Some("000#"));
}

// Features

#[cfg(feature = "serde")]
mod with_serde {
    use super::*;
    use serde::Deserialize;
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, MapDeserializer};

    #[test]
    fn a_quantity_is_read_as_its_raw_value_and_checked() {
        let read = |raw: i32| SteerAngle::deserialize(IntoDeserializer::<Error>::into_deserializer(raw));
        assert_eq!(read(-240), Ok(SteerAngle::MIN));
        assert!(read(241).is_err() && read(-241).is_err() && read(65_536).is_err());
    }

    #[test]
    fn an_enumeration_is_read_by_its_name() {
        let read = |name: &'static str| {
            MissionStatus::deserialize(IntoDeserializer::<Error>::into_deserializer(name))
        };
        for status in MissionStatus::ALL {
            assert_eq!(read(status.name()), Ok(status));
        }
        assert!(read("Running").is_err());
    }

    #[test]
    fn a_message_is_read_by_its_fields() {
        let read = |field: &'static str, raw: i32| {
            Ai2VcuSteer::deserialize(MapDeserializer::<_, Error>::new([(field, raw)].into_iter()))
        };
        assert_eq!(read("steer_request", 240), Ok(Ai2VcuSteer { steer_request: SteerAngle::MAX }));
        assert!(read("steer_request", 241).is_err());
        assert!(read("STEER_REQUEST_deg", 240).is_err());
    }
}

#[cfg(feature = "arbitrary")]
#[test]
fn arbitrary_messages_keep_their_ranges() {
    let mut numbers = Numbers(0x5EED_0004);
    let mut seen = [false; MESSAGES_LEN];
    for _ in 0..5_000 {
        let bytes: Vec<u8> =
            std::iter::repeat_with(|| numbers.next().to_le_bytes()).take(16).flatten().collect();
        let message: AnyMessage = arbitrary::Unstructured::new(&bytes).arbitrary().expect("enough bytes");
        assert_eq!(decode(message.def(), message.encode().data()), Ok(message));
        mark(&mut seen, &message);
    }
    assert_eq!(seen, [true; MESSAGES_LEN]);
}

#[cfg(feature = "proptest")]
#[test]
fn proptest_messages_keep_their_ranges() {
    use proptest::prelude::{Strategy, any};
    use proptest::strategy::ValueTree;

    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut seen = [false; MESSAGES_LEN];
    for _ in 0..5_000 {
        let message = any::<AnyMessage>().new_tree(&mut runner).expect("nothing is filtered").current();
        assert_eq!(decode(message.def(), message.encode().data()), Ok(message));
        mark(&mut seen, &message);
    }
    assert_eq!(seen, [true; MESSAGES_LEN]);
}

#[cfg(any(feature = "arbitrary", feature = "proptest"))]
const MESSAGES_LEN: usize = 15;

#[cfg(any(feature = "arbitrary", feature = "proptest"))]
fn mark(seen: &mut [bool; MESSAGES_LEN], message: &AnyMessage) {
    let place = MESSAGES.iter().position(|def| def.id == message.def().id);
    seen[place.expect("in the table")] = true;
}
