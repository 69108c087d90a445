//! Version 4.0: frames worked out by hand from its database, its lengths and its ranges.

use super::*;

const V4: Bus = Edition::V4_0.bus;

#[track_caller]
fn worked(text: &str, expected: impl Into<AnyMessage>) {
    let frame = frame(text);
    let expected = expected.into();
    assert_eq!(V4.decode(frame.id, frame.data()), Ok(expected), "{text}");
    assert_eq!(V4.encode(expected).map(|frame| frame.to_string()).as_deref(), Some(text));
    assert!(V4.holds(expected), "{text}");
}

//= MSG-84 to MSG-91, MSG-97
#[test]
fn worked_frames() -> Result<(), QuantityError> {
    worked(
        "511#C300A00F",
        Ai2VcuDriveF {
            front_axle_trq_request: AxleTorqueRequest::from_nm(19.5)?,
            front_motor_speed_max: MotorSpeedMax::from_rpm(4000.0)?,
        },
    );
    worked(
        "520#000E44010000040B",
        Vcu2AiStatus {
            as_switch_status: true,
            ts_switch_status: true,
            go_signal: true,
            as_state: AsState::EmergencyBrake,
            ami_state: AmiState::TrackDrive,
            fault_status: true,
            brake_plausibility_fault: true,
            shutdown_cause: ShutdownCause::BrakePlausibilityFault,
            ..Vcu2AiStatus::default()
        },
    );
    worked(
        "523#2EFFD200D200",
        Vcu2AiSteer {
            steer_angle: SteerAngle::from_deg(-21.0)?,
            steer_angle_max: SteerAngleMax::from_deg(21.0)?,
            steer_angle_request: SteerAngle::from_deg(21.0)?,
        },
    );
    let half = BrakePressure::from_pct(50.0)?;
    worked(
        "524#6464000021",
        Vcu2AiBrake {
            hyd_press_f: half,
            hyd_press_f_req: half,
            status_brk: StatusBrk::Ready,
            status_ebs: EbsState::Armed,
            ..Vcu2AiBrake::default()
        },
    );
    Ok(())
}

//= MSG-88 to MSG-94
#[test]
fn worked_frames_of_the_vehicle_s_state() {
    let driving = VcuStatus {
        sm_sys: SmSys::DriveAutonomous,
        sm_as: SmAs::Driving,
        sys_action_state: SysActionState::DriveAuto,
        ..VcuStatus::default()
    };
    worked("120#0430000000000200", driving);
    let braking =
        VcuStatus { sm_as: SmAs::EmergencyBrake, drive_f_timeout: true, warn_ai_comms_lost: true, ..driving };
    worked("120#0440000040000220", braking);
}

//= MSG-92 to MSG-94
#[test]
fn each_flag_of_the_vehicle_s_state_has_its_own_bit() {
    type Field = fn(&VcuStatus) -> bool;
    let flags: [(u8, Field); 12] = [
        (32, |m| m.status_timeout),
        (38, |m| m.drive_f_timeout),
        (39, |m| m.drive_r_timeout),
        (45, |m| m.handshake_timeout),
        (46, |m| m.steer_timeout),
        (47, |m| m.brake_timeout),
        (58, |m| m.warn_brake_plausibility),
        (59, |m| m.warn_kl15_under_v),
        (60, |m| m.warn_ai_estop_req),
        (61, |m| m.warn_ai_comms_lost),
        (62, |m| m.warn_auto_braking),
        (63, |m| m.warn_mission_status),
    ];
    for (index, _) in flags {
        let mut data = encode(&V4, VcuStatus::default()).data;
        set_bit(&mut data, index, true);
        let decoded = V4.decode_as::<VcuStatus>(&data).expect("a flag may be set");
        for (other, field) in flags {
            assert_eq!(field(&decoded), other == index, "bit {other} with bit {index}");
        }
    }
}

//= MSG-85 to MSG-87, MSG-89 to MSG-91, MSG-99, MSG-100
#[test]
fn ranges_end_where_version_4_0_says() {
    let ok = |text: &str| {
        let frame = frame(text);
        V4.decode(frame.id, frame.data()).is_ok()
    };
    for (within, beyond) in [
        ("513#D200", "513#D300"),                         // 21 degrees
        ("513#2EFF", "513#2DFF"),                         // -21 degrees
        ("523#D20000000000", "523#D30000000000"),         // 21 degrees
        ("523#2EFF00000000", "523#2DFF00000000"),         // -21 degrees
        ("523#000000002EFF", "523#000000002DFF"),         // -21 degrees
        ("523#0000D2000000", "523#0000D3000000"),         // 21 degrees
        ("523#00000000D200", "523#00000000D300"),         // 21 degrees
        ("520#000001000000000B", "520#000001000000000C"), // eleven causes
        ("524#0000000014", "524#0000000015"),             // STATUS_BRK 4
        ("524#0000000011", "524#0000000001"),             // STATUS_EBS 1
        ("524#0000000031", "524#0000000041"),             // to 3
        ("502#E902000000", "502#0002000000"),             // seven missions, and State_EBS 1
        ("120#0910000000000000", "120#0A10000000000000"), // SM_SYS 9
        ("120#0010000000000000", "120#0000000000000000"), // SM_AS 1
        ("120#0060000000000000", "120#0070000000000000"), // to 6
        ("120#0010000000000400", "120#0010000000000500"), // SYS_ACTION_STATE 4
    ] {
        assert!(ok(within), "{within} is in range");
        assert!(!ok(beyond), "{beyond} is out of range");
    }
}

//= MSG-97
#[test]
fn messages_end_with_their_signals() {
    for message in V4.messages {
        assert_eq!(usize::from(message.len), message.bytes_needed(), "{}", message.name);
    }
}

//= MSG-95, MSG-96, MSG-98, MSG-102
#[test]
fn messages_are_sent_every_10_ms_and_502h_every_100() {
    for message in V4.messages {
        let cycle = if message.id == 0x502 { 100 } else { 10 };
        assert_eq!(message.cycle_ms, cycle, "{}", message.name);
    }
}

#[test]
fn version_3_0_has_the_same_messages_without_120h() {
    let ids = |bus: Bus| bus.messages.iter().map(|message| message.id).collect::<Vec<_>>();
    assert_eq!(ids(V4)[0], 0x120);
    assert_eq!(ids(V4)[1..], ids(BUS));
    assert_eq!((BUS.encode(VcuStatus::default()), BUS.holds(VcuStatus::default())), (None, false));
}

/// Senders of version 3.0 fill up to eight bytes; a frame that ends before its signals is refused.
//= D-66
#[test]
fn frames_of_version_3_0_are_read_where_their_values_are_in_range() {
    let mut numbers = Random::with_seed(0x5EED_0006);
    for message in BUS.messages.iter().filter(|message| message.id != 0x524) {
        let mut data = lowest(message);
        for signal in message.signals.iter().filter(|signal| signal.unit != "deg") {
            write(signal, &mut data, numbers.value(signal));
        }
        for signal in message.signals.iter().filter(|signal| signal.unit == "deg") {
            write(signal, &mut data, signal.min.max(-210));
        }
        let read = V4.decode(message.id, &data);
        assert_eq!(read, BUS.decode(message.id, &data), "{}", message.name);
        assert!(read.is_ok(), "{}", message.name);
    }
    for message in V4.messages {
        let short = vec![0; message.bytes_needed() - 1];
        assert!(
            matches!(V4.decode(message.id, &short), Err(DecodeError::TooShort { .. })),
            "{}",
            message.name
        );
    }
    let refused = V4.decode(0x524, &[0; 8]).expect_err("no EBS of that number").to_string();
    assert_eq!(
        refused,
        "VCU2AI_Brake (524h): STATUS_EBS is 0, allowed: 1 = UNAVAILABLE, 2 = ARMED, 3 = TRIGGERED"
    );
}

//= MSG-86, MSG-89 to MSG-91
#[test]
fn the_new_enumerations_go_by_the_document_s_numbers_and_names() {
    assert_eq!(StatusBrk::ALL.map(StatusBrk::raw), [0, 1, 2, 3, 4]);
    assert_eq!(
        StatusBrk::ALL.map(StatusBrk::name),
        ["INITIALISING", "READY", "SHUTTING_DOWN", "SHUTDOWN_COMPLETE", "FAULT"]
    );
    assert_eq!(SmSys::ALL.map(SmSys::raw), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
    assert_eq!(SmAs::ALL.map(SmAs::raw), [1, 2, 3, 4, 5, 6]);
    assert_eq!(SysActionState::ALL.map(SysActionState::raw), [0, 1, 2, 3, 4]);
}

//= MSG-37, MSG-49, MSG-85
#[test]
fn values_have_the_names_of_the_edition() {
    let name = |bus: &Bus, field: &str, raw| bus.signal_of(field).and_then(|signal| signal.value_name(raw));
    assert_eq!(name(&V4, "shutdown_cause", 6), Some("AI_COMMS_FAULT"));
    assert_eq!(name(&BUS, "shutdown_cause", 6), Some("AI COMMS FAULT"));
    assert_eq!(name(&V4, "shutdown_cause", 11), Some("BRAKE_PLAUSIBILITY_FAULT"));
    assert_eq!(name(&BUS, "shutdown_cause", 11), None);
    for field in ["ami_state", "state_ami"] {
        assert_eq!((name(&V4, field, 4), name(&BUS, field, 4)), (Some("TRACK DRIVE"), Some("TRACK_DRIVE")));
    }
    for message in V4.messages {
        for signal in message.signals {
            let same = |old: &&SignalDef| {
                let spelt = |name: &str| name.replace([' ', '_'], "");
                let pairs = || signal.values.iter().zip(old.values);
                pairs().all(|(ours, theirs)| ours.0 == theirs.0 && spelt(ours.1) == spelt(theirs.1))
            };
            let old = BUS.message(message.id).and_then(|old| old.signal_of(signal.field));
            assert!(old.as_ref().is_none_or(same), "{}: only the spelling differs", signal.name);
        }
    }
}
