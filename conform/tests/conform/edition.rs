//! A program is judged by the edition that it is asked about, and has to be of it.

use adsdv_conform::suite;
use adsdv_conform::{ConformOptions, InProcess, ProgramError, conform};
use adsdv_spec::{Edition, Machine, Rules, Timing};

use crate::programs::{TIMEOUT, example};

/// An edition of which no program but those of this file is.
const OTHER: Edition = Edition { version: "test", ..Edition::V3_0 };

/// One in which an answer to the handshake may take longer.
const SLOW: Edition = Edition {
    rules: Rules { timing: Timing { handshake_ms: 100, ..OTHER.rules.timing }, ..OTHER.rules },
    ..OTHER
};

fn judged(edition: &Edition, of: &Edition) -> Vec<String> {
    let options = ConformOptions { runs: 40, strict: true, ..ConformOptions::of(of) };
    let mut vcu = InProcess(Machine::new(*edition, edition.readings));
    let report = conform(&mut vcu, &suite::generate(of), &options, &mut |_| {}).expect("a machine");
    report.failures.into_iter().flat_map(|failure| failure.requirements).collect()
}

#[test]
fn a_program_conforms_to_its_own_edition_and_not_to_one_with_other_times() {
    assert_eq!(judged(&SLOW, &SLOW), [""; 0]);
    assert_eq!(judged(&OTHER, &OTHER), [""; 0]);
    for (program, of) in [(&OTHER, &SLOW), (&SLOW, &OTHER)] {
        let broken = judged(program, of);
        assert!(broken.iter().any(|id| id == "HS-9"), "{broken:?}");
    }
}

fn of_other(name: &str, args: &[&str]) -> Result<bool, ProgramError> {
    let options = ConformOptions { runs: 0, strict: true, ..ConformOptions::of(&OTHER) };
    example(name, args, &options, TIMEOUT).map(|report| report.conforms())
}

#[test]
fn a_program_that_says_the_edition_is_judged() {
    let judged = of_other("mutant", &["--hello", r#"{"edition":"test"}"#]);
    assert!(judged.is_ok_and(|conforms| conforms));
}

#[test]
fn a_program_of_another_edition_or_none_gets_no_verdict() {
    for (name, args, said) in [
        ("mutant", &[][..], "does not say that it is of edition test; expected {\"edition\":\"test\"}"),
        ("adapter", &[], "the program is of edition 3.0; expected test"),
        ("mutant", &["--hello", "welcome"], "not the answer to a hello: \"welcome\""),
        ("mutant", &["--exit-at", "1"], "the program ended early (exit status 3)"),
    ] {
        let error = of_other(name, args).expect_err("it is not of the edition");
        let text = error.to_string();
        assert!(text.contains(said), "{name} {args:?}: {text}");
        assert!(text.contains("\n  sent      {\"op\":\"hello\",\"edition\":\"test\"}"), "{text}");
        assert!(!text.contains("\n  in "), "it is in no scenario: {text}");
        assert!(error.hint().contains("--edition"), "{}", error.hint());
    }
}

/// The specification of 3.0 is not asked a single step where 4.0 is asked for, nor the other way round.
#[test]
fn the_report_says_that_a_program_of_3_0_is_not_of_4_0() {
    let options = ConformOptions::of(&Edition::V4_0);
    let error = example("mutant", &["--hello", r#"{"edition":"3.0"}"#], &options, TIMEOUT);
    let error = error.expect_err("it is of 3.0").to_string();
    assert!(error.contains("the program is of edition 3.0; expected 4.0"), "{error}");
    let error = example("mutant", &[], &options, TIMEOUT).expect_err("it knows no hello").to_string();
    assert!(error.contains("does not say that it is of edition 4.0"), "{error}");
    for (program, of) in [(&Edition::V3_0, &Edition::V4_0), (&Edition::V4_0, &Edition::V3_0)] {
        let mut vcu = InProcess(Machine::new(*program, program.readings));
        let error = conform(&mut vcu, &[], &ConformOptions::of(of), &mut |_| {}).expect_err("another");
        let expected = format!("the program is of edition {}; expected {}", program.version, of.version);
        assert_eq!(error.to_string(), expected);
    }
}

#[test]
fn a_machine_of_another_edition_gets_no_verdict() {
    let mut vcu = InProcess(Machine::new(Edition::V3_0, Edition::V3_0.readings));
    let judged = conform(&mut vcu, &[], &ConformOptions::of(&OTHER), &mut |_| {});
    let error = judged.expect_err("it is of 3.0").to_string();
    assert_eq!(error, "the program is of edition 3.0; expected test");
}
