//! Flags and ranges, in the numbers of the document.

use super::*;

//= MSG-42 to MSG-47, MSG-50 to MSG-63
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
        let mut data = encode(&BUS, Vcu2AiStatus::default()).data;
        set_bit(&mut data, index, true);
        let decoded = BUS.decode_as::<Vcu2AiStatus>(&data).expect("a flag may be set");
        for (_, other, field) in flags {
            assert_eq!(field(&decoded), name == other, "{other} with bit {index}");
            let raw = <V3_0 as Layout<Vcu2AiStatus>>::DEF.signal(other).and_then(|signal| signal.raw(&data));
            assert_eq!(raw, Some(i32::from(name == other)), "{other} with bit {index}");
        }
    }
}

//= MSG-17, MSG-19, MSG-21, MSG-22, MSG-24, MSG-27, MSG-28, MSG-66 to MSG-78, D-31, D-32
#[test]
fn ranges_end_where_the_document_says() {
    let ok = |text: &str| {
        let frame = frame(text);
        BUS.decode(frame.id, frame.data()).is_ok()
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
