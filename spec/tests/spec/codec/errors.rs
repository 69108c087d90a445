//! What errors say, and what frames show.

use super::*;

#[test]
fn errors_print_what_was_given_and_what_is_allowed() {
    let error = |text: &str| {
        let frame = frame(text);
        BUS.decode(frame.id, frame.data()).expect_err(text).to_string()
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
        SteerAngle::from_deg(31.0).expect_err("too far").to_string(),
        "SteerAngle cannot be 31 deg, allowed: -30 to 30 deg in steps of 0.1 (raw -300 to 300)",
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
