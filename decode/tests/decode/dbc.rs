//! Databases of the user's own: what they add, and what is refused.

use std::fmt::Write as _;

use adsdv_decode::{Catalog, Database};
use adsdv_spec::Edition;

use crate::frames::{Format, decode};

fn refused(text: &[u8]) -> String {
    Database::read("team.dbc", text).expect_err("it is refused").to_string()
}

#[test]
fn an_identifier_that_the_edition_has_is_the_editions() {
    let database = Database::read("team.dbc", include_bytes!("team.dbc")).expect("a database");
    let catalog = Catalog::with(&Edition::V2026, &[database.clone(), database]);
    let ours = "team.dbc: these identifiers are of the edition 2026, which counts: 520";
    let twice = "team.dbc: these identifiers are of another database, or stand there twice, which counts: 18FF50E5, 7A0, 7A1, 7A2";
    assert_eq!(catalog.notes(), [ours, ours, twice]);
}

#[test]
fn extended_and_multiplexed_signals_stand_beside_the_documents() {
    let database = Database::read("team.dbc", include_bytes!("team.dbc")).expect("a database");
    let catalog = Catalog::with(&Edition::V2026, &[database]);
    let log = "(1.0) can0 18FF50E5#00280A0000000005\n(1.0) can0 7A0#0034120000000007\n(1.0) can0 7A0#01FFFE0000000007\n(1.0) can0 513#0A00\n";
    let (text, summary, _) = decode(log, &catalog, Format::SingleLine);
    assert_eq!(summary.unknown, 0);
    let decoded: Vec<_> =
        text.lines().filter_map(|line| line.split_once(" :: ")).map(|(_, decoded)| decoded).collect();
    assert_eq!(
        decoded,
        [
            "Inverter(Speed: 0.0 rpm, Voltage: 1.0 V, Mode: OFF, Temperature: -40.0 °C, Counter: 16)",
            "Modes(Selector: 0, Low: 4660, Always: 7 %)",
            "Modes(Selector: 1, High: -4, Always: 7 %)",
            "AI2VCU_Steer(STEER_REQUEST: 1.0 deg)",
        ]
    );
}

#[test]
fn what_is_no_database_is_refused_with_its_line() {
    let message = "BO_ 1 M: 8 X\n";
    let with = |signal: &str| refused(format!("{message} SG_ S{signal} \"\" X\n").as_bytes());
    assert_eq!(refused(b"(1.0) can0 520#00\n"), "it has no message: no line begins with BO_");
    assert_eq!(refused(b""), "it has no message: no line begins with BO_");
    assert_eq!(refused(b"BO_ 1 M 8 X\n"), "line 1: column 1: cannot read on at \"BO_ 1 M 8 X\"");
    assert_eq!(
        with(" : 60|8@1+ (1,0) [0|0]"),
        "line 2: S has 8 bits from bit 60 on, and M has 8 bytes; a float has 32 bits or 64"
    );
    assert_eq!(
        with(" m1 : 0|8@1+ (1,0) [0|0]"),
        "line 2: S is multiplexed, and the message has no multiplexer (M)"
    );
    assert_eq!(
        refused(b"\nBO_ 66848 M: 8 X\n"),
        "line 2: M has the identifier 66848, and no frame has that; an extended one has 2147483648 added"
    );
    assert_eq!(refused(b"BO_ 1 M: 65 X\n"), "line 1: M has 65 bytes, and a frame has at most 64");
}

/// Sizes and starts at the ends of their types, and text that goes on and on: an error, and no panic.
#[test]
fn a_hostile_database_is_refused_or_read() {
    for size in ["0", "65", "18446744073709551615"] {
        for start in ["0", "511", "4294967295", "18446744073709551615", "99999999999999999999"] {
            for order in ["@0", "@1"] {
                let text =
                    format!("BO_ 1 M: 64 X\n SG_ S : {start}|{size}{order}- (1e308,-1e308) [0|0] \"\" X\n");
                assert!(Database::read("hostile.dbc", text.as_bytes()).is_err(), "{text}");
            }
        }
    }
    let deep = format!("BO_ 1 M: 8 X\n{}", "(".repeat(100_000));
    assert!(Database::read("hostile.dbc", deep.as_bytes()).is_err());
    let mut many = String::new();
    for id in 0..30_000 {
        let _ = writeln!(many, "BO_ {id} M{id}: 8 X");
    }
    assert_eq!(refused(many.as_bytes()), "it has more than 20000 messages");
    assert_eq!(refused(&vec![b'\n'; 17 * 1024 * 1024]), "it is longer than 16 MiB");
}
