//! Quantities, their units, and the names of values.

use super::*;

#[test]
fn physical_values_are_rounded_to_the_nearest_step() {
    for raw in -300..=300 {
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
    assert!(SteerAngle::from_raw(301).is_err() && SteerAngle::from_raw(-301).is_err());
    assert!(SteerAngle::from_raw(i32::MIN).is_err() && SteerAngle::from_raw(65536).is_err());
    for degrees in [30.06, -30.06, 1e300, -1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert!(SteerAngle::from_deg(degrees).is_err(), "{degrees}");
    }
    assert!(AxleTorqueRequest::from_nm(-0.1).is_err());
    assert_eq!(SteerAngle::from_deg(30.04), Ok(SteerAngle::MAX));
    assert_eq!(SteerAngle::from_deg(-30.04), Ok(SteerAngle::MIN));
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

    let signal = |name| <V3_0 as Layout<Vcu2AiStatus>>::DEF.signal(name).expect(name);
    assert_eq!(signal("GO_SIGNAL").display(1).to_string(), "GO");
    assert_eq!(signal("SHUTDOWN_CAUSE").display(10).to_string(), "BMS FAULT");
    assert_eq!(signal("SHUTDOWN_CAUSE").display(11).to_string(), "11");
    assert_eq!(signal("HANDSHAKE").display(1).to_string(), "1");
    let speed = <V3_0 as Layout<Vcu2LogDynamics1>>::DEF.signal("Steer_actual_deg").expect("a signal of 500h");
    assert_eq!(speed.display(-128).to_string(), "-64 deg");
    assert!((speed.physical(127) - 63.5).abs() < 1e-9);
}

//= MSG-8, MSG-10, MSG-35 to MSG-37, MSG-39, MSG-48, MSG-49, MSG-64, MSG-85
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
    assert_eq!(ShutdownCause::ALL.map(ShutdownCause::raw), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
    assert_eq!(
        MissionStatus::ALL.map(MissionStatus::name),
        ["NOT SELECTED", "SELECTED", "RUNNING", "FINISHED"]
    );
    assert_eq!(DirectionRequest::ALL.map(DirectionRequest::name), ["NEUTRAL", "FORWARD"]);
    for raw in -1..=256 {
        assert_eq!(
            ShutdownCause::from_raw(raw).map(ShutdownCause::raw),
            (0..=11).contains(&raw).then_some(raw)
        );
    }
}
