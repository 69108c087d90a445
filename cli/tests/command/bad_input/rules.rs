//! `--rules`: files that are no rules, and rules that the edition cannot be asked.

use std::io::Write as _;

use super::{adsdv, fed, folder_with, refused, rubbish, run, text};
use crate::run::MISSION;

/// `check` and `watch` with this file of rules. No log is there, and no interface: the rules are read before.
#[track_caller]
fn is_refused(name: &str, content: &[u8], error: &str) -> String {
    let file = folder_with(name, "team.rules", content).join("team.rules");
    let mut stderr = String::new();
    for command in ["check", "watch"] {
        let outcome = run(&[command, "--edition", "4.0", "--rules", text(&file), "not-there"]);
        refused(&outcome, error, "");
        stderr = outcome.stderr;
    }
    stderr
}

#[test]
pub(super) fn rules_that_are_wrong() {
    let cases: [(&str, &[u8], &str, &str); 7] = [
        (
            "a",
            b"# ours\nsafe: never sped > 5\n",
            ":2:13: found \"sped\", which is no signal",
            " 2 | safe: never sped > 5\n   |             ^^^^\n",
        ),
        (
            "b",
            b"safe: never ANGLE > 5 km/h",
            ":1:23: found \"km/h\"; expected deg, as ANGLE is",
            "   |                       ^^^^\n",
        ),
        ("c", b"safe: nver Go on", ":1:12: found \"Go\"; expected until", "   |            ^^\n"),
        ("d", b"", ":1:1: found no rule; expected a line such as ", "   | ^\n"),
        (
            "e",
            b"ok: always Go on\n\tx\xff",
            ":2:3: found bytes that are no text in UTF-8",
            " 2 |  x\n   |   ^\n",
        ),
        (
            "f",
            b"a: never AS_STATE is AS_INIT",
            ":1:22: found \"AS_INIT\", and edition 4.0 has no such word of AS_STATE; ",
            "has this: 2026\n",
        ),
        (
            "g",
            b"a: never\x1b[31m Go on",
            ":1:9: found '\\u{1b}'; expected a word",
            " 1 | a: never [31m Go on\n   |         ^\n",
        ),
    ];
    for (name, content, error, shown) in cases {
        let stderr = is_refused(&format!("rules-wrong-{name}"), content, error);
        assert!(stderr.contains(shown), "{shown:?} is not in {stderr}");
    }
    let several = "# ours\nsafe: never sped > 5\n\nturn: always abs(ANGLE) < 15 rpm or\n\nlost: never ASMSS on or ANGLE > 5 rpm\n";
    let stderr = is_refused("rules-several", several.as_bytes(), "team.rules:2:13: found \"sped\"");
    let places = [
        ":4:36: found the end of the line; ",
        ":6:13: found \"ASMSS\"",
        ":6:35: found \"rpm\"; expected deg",
    ];
    let shown: Vec<&str> = stderr.lines().filter(|line| line.contains("team.rules:")).collect();
    assert!(
        shown.len() == 4 && shown.iter().skip(1).zip(places).all(|(line, place)| line.contains(place)),
        "{stderr}"
    );
    assert!(
        stderr.contains("\n 6 | lost: never ASMSS on or ANGLE > 5 rpm\n   |             ^^^^^\n"),
        "{stderr}"
    );
    let many: Vec<String> = (0..23).map(|line| format!("a{line:02}: > 3\n")).collect();
    let many = many.concat();
    let stderr = is_refused("rules-many", many.as_bytes(), "team.rules:1:6: found \">\"");
    assert!(stderr.contains("\nand 3 more mistakes\nhint: "), "{stderr}");
    is_refused("rules-rubbish", &rubbish(), "team.rules:2:118: found bytes that are no text");
    is_refused(
        "rules-long",
        &b"a: always Go on\n".repeat(1 << 17),
        "is longer than 1 MiB; expected a file of rules",
    );
}

#[test]
pub(super) fn rules_that_are_not_there() {
    let folder = folder_with("rules-missing", "x", b"");
    for (file, error) in [(folder.join("team.rules"), "No such file"), (folder, "Is a directory")] {
        refused(&run(&["check", "--rules", text(&file), MISSION]), error, "");
    }
}

/// The log is read up to where it tells which edition it speaks, and no further.
#[test]
pub(super) fn rules_of_another_edition_than_the_log_speaks() {
    let file = folder_with("rules-edition", "team.rules", b"a: never AS_STATE is AS_INIT").join("team.rules");
    let outcome = run(&["check", "--rules", text(&file), MISSION]);
    refused(&outcome, ":1:22: found \"AS_INIT\", and edition 4.0 has no such word", "--edition");
    let endless = fed(&mut adsdv(&["check", "--rules", text(&file), "-"]), |stdin| {
        stdin.write_all(&super::lines(10_000))?;
        // More than any pipe holds.
        (0..1000).try_for_each(|_| stdin.write_all(&[b'\n'; 4096]))
    });
    refused(&endless, "edition 4.0 has no such word", "--edition");
}
