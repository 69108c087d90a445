//! The database of 2026: frames worked out by hand from it, and what it changes of version 4.0.

use adsdv_spec::messages::{EbsStage, OpState, SpeedKmh, TsState, Vcu2LogDynamics1, VcuStatus};

use super::*;

const V2026: Bus = Edition::V2026.bus;

#[track_caller]
fn worked(text: &str, expected: impl Into<AnyMessage>) {
    let frame = frame(text);
    let expected = expected.into();
    assert_eq!(V2026.decode(frame.id, frame.data()), Ok(expected), "{text}");
    assert_eq!(V2026.encode(expected).map(|frame| frame.to_string()).as_deref(), Some(text));
    assert!(V2026.holds(expected), "{text}");
}

//= MSG-105 to MSG-108, MSG-110, MSG-113
#[test]
fn worked_frames() -> Result<(), QuantityError> {
    worked("513#2C01", Ai2VcuSteer { steer_request: SteerAngle::from_deg(30.0)? });
    worked("513#D4FE", Ai2VcuSteer { steer_request: SteerAngle::from_deg(-30.0)? });
    worked(
        "523#D4FE2C012C01",
        Vcu2AiSteer {
            steer_angle: SteerAngle::from_deg(-30.0)?,
            steer_angle_max: SteerAngleMax::from_deg(30.0)?,
            steer_angle_request: SteerAngle::from_deg(30.0)?,
        },
    );
    worked(
        "520#210642302000010A",
        Vcu2AiStatus {
            handshake: true,
            op_state: OpState::Auto,
            as_switch_status: true,
            ts_switch_status: true,
            as_state: AsState::Ready,
            ami_state: AmiState::TrackDrive,
            ts_state: TsState::Running,
            ebs_state: EbsStage::Armed,
            shutdown_cause: ShutdownCause::BmsFault,
            charge_procedure_fault: true,
            ..Vcu2AiStatus::default()
        },
    );
    Ok(())
}

//= MSG-106 to MSG-108, D-68
#[test]
fn a_fault_of_op_ts_and_ebs_state_is_the_highest_number_that_four_bits_hold() {
    worked(
        "520#F00001F0F0000000",
        Vcu2AiStatus {
            op_state: OpState::Fault,
            ts_state: TsState::Fault,
            ebs_state: EbsStage::Fault,
            ..Vcu2AiStatus::default()
        },
    );
    let status = V2026.message(0x520).expect("VCU2AI_Status");
    for (name, numbers) in [("OP_STATE", 0..=3), ("TS_STATE", 0..=4), ("EBS_STATE", 0..=4)] {
        let signal = status.signal(name).expect(name);
        for raw in 0..=15 {
            assert_eq!(signal.allows(raw), numbers.contains(&raw) || raw == 15, "{name} {raw}");
        }
    }
}

//= MSG-109, D-69
#[test]
fn as_init_is_read_as_as_off_and_never_written() {
    let init = [0; 8];
    let status: Vcu2AiStatus = V2026.decode_as(&init).expect("AS_INIT is a state of 2026");
    assert_eq!(status.as_state, AsState::Off);
    assert_eq!(V2026.encode(status).map(|frame| frame.data[2]), Some(1));
    let state = V2026.message(0x520).and_then(|message| message.signal("AS_STATE")).expect("of 520h");
    assert_eq!((state.value_name(0), state.raw(&init)), (Some("AS_INIT"), Some(0)));
    assert!(Edition::V4_0.bus.decode(0x520, &init).is_err(), "4.0 has no such state");
    assert!((1..=5).all(|raw| {
        let status: Result<Vcu2AiStatus, _> = V2026.decode_as(&state.put(init, raw));
        status.is_ok_and(|status| status.as_state.raw() == raw)
    }));
}

//= MSG-105, MSG-110
#[test]
fn the_wheels_turn_up_to_30_degrees() {
    assert!(V2026.decode(0x513, &[0x2D, 0x01]).is_err() && V2026.decode(0x513, &[0xD3, 0xFE]).is_err());
    assert!(V2026.decode(0x523, &[0x2D, 0x01, 0, 0, 0, 0]).is_err());
    assert!(V2026.decode(0x523, &[0, 0, 0x2D, 0x01, 0, 0]).is_err());
    assert!(V2026.decode(0x523, &[0, 0, 0, 0, 0xD3, 0xFE]).is_err());
}

//= MSG-111 to MSG-114, MSG-116
#[test]
fn the_rest_is_as_in_4_0() {
    let old = Edition::V4_0.bus;
    assert_eq!((V2026.message(0x120), V2026.encode(VcuStatus::default())), (None, None));
    assert!(V2026.decode(0x120, &[0; 8]).is_err() && !V2026.holds(VcuStatus::default()));
    for message in V2026.messages {
        let was = old.message(message.id).expect("nothing is new but the messages of the devices");
        assert_eq!((message.name, message.len, message.section), (was.name, was.len, was.section));
        let slower = matches!(message.id, 0x500 | 0x502);
        assert_eq!(message.cycle_ms, if slower { 100 } else { 10 }, "{}", message.name);
        for signal in was.signals {
            let renamed =
                if message.id == 0x522 { format!("{}_Nm", signal.name) } else { signal.name.into() };
            let now = message.signal(&renamed).expect(&renamed);
            assert_eq!((now.start, now.width, now.scale), (signal.start, signal.width, signal.scale));
        }
    }
    let slow = Vcu2LogDynamics1 { speed_actual: SpeedKmh::clamped(7), ..Vcu2LogDynamics1::default() };
    assert_eq!(V2026.encode(slow), old.encode(slow));
}
