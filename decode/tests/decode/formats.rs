//! Each format, of a recording that has one of everything.

use std::fmt::Write as _;

use adsdv_spec::Edition;
use expect_test::expect_file;
use vcd::{Command, Parser, ScopeItem, Value};

use crate::frames::{Format, catalog, decode};

/// A steer angle, a message that is too short and one that is too long, what nothing knows, and every other kind of line.
pub(crate) const EVERYTHING: &str = "\
(1795209995.234703) vcan0 523#00001B000300
(1795209995.234712) vcan0 524#0102
(1795209995.234735) vcan0 513#F6FF00 T
(1795209995.240000) vcan0 520#0000090000000000
(1795209995.250000001) vcan1 18FF50E5#0102FF
DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 7)
(1795209995.260000) vcan0 7FF#R4
(1795209995.260000) vcan0 20000004#000C000000000000
rubbish
(1795209995.270000) vcan0 523##100001B000000
(1795209995.280000) vcan0 621#0000C07F0000803F
(1795209995.290000) vcan0 524#
";

fn everything(format: Format) -> String {
    let (text, summary, _) = decode(EVERYTHING, &catalog(&Edition::V2026), format);
    assert_eq!((summary.frames, summary.unknown, summary.broken, summary.dropped), (10, 4, 1, 3));
    text
}

#[test]
fn text_is_that_of_the_golden_files() {
    expect_file!["golden/lines.txt"].assert_eq(&everything(Format::Lines));
    expect_file!["golden/single-line.txt"].assert_eq(&everything(Format::SingleLine));
}

#[test]
fn csv_is_that_of_the_golden_file_and_has_eight_columns() {
    let csv = everything(Format::Csv);
    expect_file!["golden/everything.csv"].assert_eq(&csv);
    assert!(csv.lines().all(|line| line.matches(',').count() == 7), "{csv}");
}

#[test]
fn every_line_of_json_lines_is_an_object() {
    let text = everything(Format::JsonLines);
    expect_file!["golden/everything.jsonl"].assert_eq(&text);
    for line in text.lines() {
        assert!(
            serde_json::from_str::<serde_json::Value>(line).is_ok_and(|value| value.is_object()),
            "{line}"
        );
    }
    assert_eq!(text.lines().count(), 10);
}

/// The bits that a wave has at the end.
fn last(vcd: &str, scopes: &[&str], name: &str) -> Option<String> {
    let mut parser = Parser::new(vcd.as_bytes());
    let header = parser.parse_header().expect("a header");
    let mut items = &header.items;
    for scope in scopes {
        items = items.iter().find_map(|item| match item {
            ScopeItem::Scope(found) if found.identifier == *scope => Some(&found.items),
            _ => None,
        })?;
    }
    let code = items.iter().find_map(|item| match item {
        ScopeItem::Var(var) if var.reference == name => Some(var.code),
        _ => None,
    })?;
    let (mut last, mut before) = (None, 0);
    for command in parser {
        match command.expect("a command") {
            Command::Timestamp(now) => {
                assert!(now >= before, "time goes on");
                before = now;
            }
            Command::ChangeScalar(id, value) if id == code => last = Some(value.to_string()),
            Command::ChangeVector(id, value) if id == code => {
                last = Some(value.iter().map(|bit: Value| bit.to_string()).collect());
            }
            Command::ChangeReal(id, value) if id == code => last = Some(value.to_string()),
            Command::ChangeString(id, value) if id == code => last = Some(value),
            _ => {}
        }
    }
    last
}

#[test]
fn a_vcd_has_every_signal_as_a_wave() {
    let vcd = everything(Format::Vcd);
    let last = |message, signal| last(&vcd, &[message], signal);
    assert_eq!(last("VCU2AI_Steer", "ANGLE_MAX").as_deref(), Some("2.7"));
    assert_eq!(last("AI2VCU_Steer", "STEER_REQUEST").as_deref(), Some("-1"));
    assert_eq!(last("VCU2AI_Status", "AS_STATE").as_deref(), Some("1001"));
    assert_eq!(last("VCU2AI_Status", "HANDSHAKE").as_deref(), Some("0"));
    assert_eq!(last("VCU2AI_Wheel_counts", "FL_PULSE_COUNT").as_deref(), Some("xxxxxxxxxxxxxxxx"));
}

#[test]
fn a_vcd_shows_the_state_and_what_blocks_its_arrows() {
    let mut log = String::new();
    for frame in 0..50 {
        let _ = writeln!(log, "(1.{:03}000) can0 520#0000010000000000", frame * 10);
    }
    let (vcd, _, notes) = decode(&log, &catalog(&Edition::V2026), Format::Vcd);
    assert_eq!(notes, Vec::<String>::new());
    assert_eq!(last(&vcd, &["state"], "AS_STATE").as_deref(), Some("AS_OFF"));
    let ready = |name| last(&vcd, &["blocked", "AS_OFF_to_AS_READY"], name);
    assert_eq!((ready("blocked").as_deref(), ready("asms").as_deref()), (Some("1"), Some("0")));
    assert_eq!(ready("ebs_armed").as_deref(), Some("x"), "no 524h shows it");
    assert_eq!(last(&vcd, &["blocked", "AS_READY_to_AS_DRIVING"], "blocked").as_deref(), Some("x"));
}

#[test]
fn what_a_wave_cannot_show_is_counted() {
    let log = "(2.0) can0 513#0000\n(1.0) can0 513#0A00\n(3.0) can1 513#0000\n(3.0) can0 7FF#00\n";
    let (vcd, _, notes) = decode(log, &catalog(&Edition::V2026), Format::Vcd);
    let counted = [
        "1 frames that nothing knows are not in the file: no wave shows bytes",
        "1 frames of other interfaces are not in the file; --interface names another",
        "1 frames came with an earlier time than one before them; they stand at that one's",
    ];
    assert_eq!(notes, counted);
    assert_eq!(last(&vcd, &["AI2VCU_Steer"], "STEER_REQUEST").as_deref(), Some("1"));
}
