use adsdv_spec::messages::SignalDef;

use super::super::limits::DIGITS;
use super::super::number;
use super::*;

fn is_possible(edition: &Edition, text: &str) {
    let file: RuleFile = text.parse().expect(text);
    if let Err(error) = file.check(edition) {
        panic!("{text}: {error}");
    }
}

#[test]
fn a_signal_is_known_by_its_name_its_field_and_what_other_editions_call_it() {
    for edition in Edition::ALL {
        for name in
            ["as_state", "AS_STATE", "520h.as_state", "VCU2AI_Status.AS_STATE", "vcu2ai_status.As_State"]
        {
            is_possible(edition, &format!("a: always {name} is AS_READY"));
        }
        for name in ["ANGLE", "steer_angle", "STEER_ANGLE_deg", "523h.ANGLE"] {
            is_possible(edition, &format!("a: always abs({name}) < 10 deg"));
        }
        for word in ["TRACK_DRIVE", "track_drive", "\"TRACK DRIVE\""] {
            is_possible(edition, &format!("a: never 520h.AMI_STATE == {word}"));
        }
        is_possible(
            edition,
            "a: always Go on and go-on and go and not ebs-armed off and AI_COMMS_LOST is TRUE",
        );
        is_possible(edition, "a: always AI_COMMS_LOST and AI_COMMS_LOST off and AI_COMMS_LOST == 0");
        is_possible(edition, "a: never AS_STATE == 3 or MISSION_STATUS is not FINISHED");
        is_possible(
            edition,
            "a: never VCU2AI_Wheel_speeds.FL_WHEEL_SPEED > 10 rpm or 525h.fl_wheel_speed > 10",
        );
    }
}

#[test]
fn what_an_edition_lacks_is_reported_with_those_that_have_it() {
    let error = impossible(&Edition::V3_0, "a: always Go\nb: after SM_AS == 3, Go within 1 s");
    assert_eq!((error.line, error.column, error.width), (2, 10, 5));
    assert!(error.why.ends_with("the edition that has this: 4.0"), "{error}");
    let error = impossible(&Edition::V2026, "a: always 120h.SM_AS == 3");
    assert!(error.why.ends_with("the edition that has this: 4.0"), "{error}");
    let error = impossible(&Edition::V4_0, "a: never AS_STATE == AS_INIT");
    assert_eq!((error.column, error.width), (22, 7));
    assert!(error.why.ends_with("the edition that has this: 2026"), "{error}");
}

#[test]
fn what_is_no_name_is_reported_with_the_nearest() {
    let cases = [
        ("a: never speed > 5", 10, 5, "Speed_actual, Speed_target, FL_WHEEL_SPEED, "),
        ("a: never as_stat is AS_OFF", 10, 7, "expected AS_STATE, "),
        ("a: never ASMSS on", 10, 5, "expected asms"),
        (
            "a: never 510h.ANGLE > 5",
            10,
            10,
            "is no signal and no condition of edition 4.0; expected HANDSHAKE",
        ),
        (
            "a: never VCU2AI_Stats.AS_STATE == AS_OFF",
            10,
            21,
            "is no message of edition 4.0; expected VCU2AI_Status",
        ),
        ("a: never 99Ah.ANGLE > 5", 10, 10, "\"99Ah\", which is no message of edition 4.0"),
        ("a: never 520h.asms on", 10, 9, "\"asms\", which is no signal"),
        ("a: never HANDSHAKE on", 10, 9, "expected one of AI2VCU_Status.HANDSHAKE, VCU2AI_Status.HANDSHAKE"),
        ("a: never AS_STATE is READY", 22, 5, "no word of AS_STATE; expected AS_OFF, AS_READY, AS_DRIVING, "),
        ("a: never AS_STATE", 10, 8, "AS_STATE has words; expected == or is, and AS_OFF, "),
        ("a: never AS_STATE > 2", 21, 1, "AS_STATE has words"),
        ("a: never AS_STATE == 9", 22, 1, "AS_STATE has words"),
        ("a: never AS_STATE == 3 s", 22, 1, "AS_STATE has words"),
        ("a: never ANGLE", 10, 5, "ANGLE is a number; expected a comparison behind it, such as > 5"),
        ("a: never ANGLE is LEFT", 19, 4, "found \"LEFT\", and ANGLE is a number; expected one in deg"),
        ("a: never ANGLE is on", 19, 2, "found \"on\", and ANGLE is a number; expected one in deg"),
        ("a: never ANGLE > 5 rpm", 20, 3, "found \"rpm\"; expected deg, as ANGLE is"),
        ("a: never LAP_COUNTER > 5 laps", 10, 11, "expected one of VCU2LOG_Status.Lap_counter, AI2VCU_"),
        ("a: never 510h.LAP_COUNTER > 5 laps", 31, 4, "found \"laps\"; expected no unit, as LAP_COUNTER is"),
        ("a: never Speed_actual > 5 mph", 27, 3, "found \"mph\"; expected km/h or m/s, as Speed_actual is"),
        ("a: never asms == 3", 18, 1, "\"asms\" is a condition; expected on or off behind it"),
        ("a: never asms is AS_OFF", 18, 6, "\"asms\" is a condition; expected on or off behind it"),
        ("a: never AI_COMMS_LOST is LOST", 27, 4, "no word of AI_COMMS_LOST; expected FALSE or TRUE"),
        ("a: never ANGLE > 1234567890.123", 18, 14, "found 13 digits; expected at most 12"),
    ];
    for (text, column, width, why) in cases {
        let error = impossible(&Edition::V4_0, text);
        assert_eq!((error.column, error.width), (column, width), "{text}: {error}");
        assert!(error.why.contains(why), "{text}: {error}");
    }
}

#[test]
fn numbers_and_units_are_exact() {
    let whole = |mantissa, power| Ok(number::Decimal { mantissa, power });
    assert_eq!(number::decimal("-0.25"), whole(-25, 100));
    assert_eq!(number::decimal("17"), whole(17, 1));
    assert!(number::decimal(&"9".repeat(DIGITS)).is_ok());
    assert!(number::decimal(&"9".repeat(DIGITS + 1)).is_err());
    let signal = |field: &str| -> &SignalDef { Edition::V4_0.bus.signal_of(field).expect(field) };
    for (unit, field) in [
        ("kmh", "veh_speed_actual"),
        ("KM/H", "veh_speed_actual"),
        ("degrees", "steer_angle"),
        ("°", "steer_angle"),
        ("percent", "hyd_press_f"),
        ("nm", "front_axle_trq"),
        ("RPM", "fl_wheel_speed"),
    ] {
        assert_eq!(number::factor(unit, signal(field)), Ok((1, 1)), "{unit}");
    }
    assert_eq!(number::factor("m/s", signal("veh_speed_actual")), Ok((18, 5)));
    assert!(number::factor("m/s", signal("fl_wheel_speed")).is_err());
}

/// Every signal of every edition can be named, and no unit of theirs is unknown.
#[test]
fn every_signal_can_be_named_with_its_unit_and_its_words() {
    for edition in Edition::ALL {
        for message in edition.bus.messages {
            for signal in message.signals {
                let name = format!("{}.{}", message.name, signal.name);
                let what = match signal.values {
                    [] => format!("> 1 {}", signal.unit),
                    words => words
                        .iter()
                        .map(|(_, word)| format!("is \"{word}\""))
                        .collect::<Vec<_>>()
                        .join(&format!(" or {name} ")),
                };
                is_possible(edition, &format!("a: never {name} {what}"));
            }
        }
    }
}
