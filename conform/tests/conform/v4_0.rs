//! Version 4.0: its reference conforms, each of its readings is recognised, and what is wrong breaks what asks for it.

use adsdv_conform::{ConformOptions, ConformReport, Failure, Outcome};
use adsdv_spec::{Choice, Edition, Machine, Mutation, Reading, Rules};

use crate::programs::{TIMEOUT, example, machine};

const EDITION: Edition = Edition::V4_0;

fn suite_only() -> ConformOptions {
    ConformOptions { runs: 0, strict: true, ..ConformOptions::of(&EDITION) }
}

/// The requirements that are broken.
fn failed(report: &ConformReport) -> Vec<&str> {
    let failed = report.requirements.iter().filter(|one| one.outcome == Outcome::Fail);
    failed.map(|one| one.id.as_str()).collect()
}

fn mutant(name: &str) -> Machine {
    let mutation = Mutation::all(&EDITION).find(|one| one.to_string() == name).expect(name);
    Machine::new(mutation.apply(&EDITION), EDITION.readings)
}

#[test]
fn the_reference_conforms_and_follows_every_default() {
    let report = machine(&Machine::new(EDITION, EDITION.readings), &ConformOptions::of(&EDITION));
    assert!(report.conforms() && report.failed_tests == 0 && report.failed_runs == 0);
    assert_eq!((report.readings, report.not_shown.len()), (EDITION.readings, 0));
    assert_eq!(report.follows.len(), EDITION.questions().count());
    for follows in &report.follows {
        assert_eq!(follows.possible, [EDITION.readings.choice(follows.reading)]);
        assert!(follows.mixes.is_empty());
    }
    let not_passed = report.requirements.iter().filter(|one| one.outcome != Outcome::Pass);
    assert_eq!(not_passed.map(|one| one.id.as_str()).collect::<Vec<_>>(), [""; 0]);
    for id in ["HS-17", "HS-18", "HS-19", "IMP-8", "DTE-13", "MSG-84", "MSG-85", "D-52", "D-55"] {
        assert!(report.requirements.iter().any(|one| one.id == id), "{id}");
    }
}

#[test]
fn through_the_pipe_it_conforms_too() {
    let options = ConformOptions { runs: 40, strict: true, ..ConformOptions::of(&EDITION) };
    for (name, args) in [("adapter", &[][..]), ("mutant", &["--edition", "4.0"])] {
        let report = example(name, args, &options, TIMEOUT).expect("it answers");
        assert!(report.conforms() && report.not_shown.is_empty(), "{name}: {:?}", report.failures);
    }
    // All combinations at a fixed cycle take minutes.
    let possible = EDITION.readings.choices();
    let fixed = ConformOptions { cycle_ms: Some(10), possible, runs: 5, ..suite_only() };
    let report = example("mutant", &["--edition", "4.0"], &fixed, TIMEOUT).expect("it answers");
    assert!(report.conforms(), "{:?}", report.failures);
}

#[test]
fn each_choice_of_each_reading_is_recognised_by_the_suite_alone() {
    for choice in EDITION.choices.iter() {
        let readings = EDITION.readings.with(choice);
        let report = machine(&Machine::new(EDITION, readings), &suite_only());
        assert!(report.conforms(), "{choice}");
        assert_eq!(report.readings, readings, "{choice}");
        for follows in &report.follows {
            // A handshake that is always performed is watched with all messages.
            let open = choice == Choice::HandshakeAlways && follows.reading == Reading::MessageWatch;
            let answer = [readings.choice(follows.reading)];
            assert_eq!(follows.possible, if open { follows.reading.choices() } else { &answer }, "{choice}");
        }
    }
}

#[test]
fn combinations_of_choices_conform_and_are_recognised() {
    let questions: Vec<_> = EDITION.questions().collect();
    for readings in EDITION.choices.combinations(&questions).step_by(1217) {
        let report = machine(&Machine::new(EDITION, readings), &suite_only());
        assert!(report.conforms(), "{readings}");
        for follows in &report.follows {
            assert!(follows.possible.contains(&readings.choice(follows.reading)), "{readings}: {follows:?}");
        }
    }
}

#[test]
fn what_is_wrong_breaks_the_requirements_that_ask_for_it() {
    let by_default = ConformOptions { possible: EDITION.readings.choices(), ..suite_only() };
    for (mutation, broken, whole) in [
        ("3.7 term 3: dropped", &["DTE-7", "IMP-5", "D-65"][..], &["DTE-8", "HS-18", "IMP-8"][..]),
        ("3.7 term 4: dropped", &["DTE-8", "IMP-6", "D-65"], &["DTE-7", "HS-18", "IMP-8"]),
        ("3.7 term 5: dropped", &["DTE-9", "IMP-8", "D-64"], &["DTE-8", "HS-18", "HS-17"]),
        ("3.7 term 5: fault dropped", &["MSG-84", "MSG-85"], &["DTE-8", "DTE-9", "HS-18"]),
        ("3.7 term 7: dropped", &["DTE-10"], &["DTE-11", "IMP-8", "HS-18"]),
        ("3.7 term 8: dropped", &["DTE-11", "IMP-7"], &["DTE-10", "IMP-8", "HS-17"]),
        ("3.7 term 10: dropped", &["DTE-13"], &["DTE-11", "IMP-8", "HS-18"]),
        ("3.7 term 10: fault dropped", &["D-55", "MSG-57"], &["DTE-13", "IMP-8", "HS-18"]),
        ("handshake -1", &["HS-17"], &["HS-18", "IMP-8"]),
        ("handshake +1", &["HS-17", "HS-19"], &["HS-18", "IMP-8"]),
        ("missed message -1", &["HS-18", "D-52"], &["HS-17", "HS-19", "IMP-8"]),
        ("missed message +1", &["HS-18", "D-52"], &["HS-17", "HS-19", "IMP-8"]),
    ] {
        let report = machine(&mutant(mutation), &by_default);
        let found = failed(&report);
        assert!(broken.iter().all(|id| found.contains(id)), "{mutation}: {found:?}");
        assert!(!whole.iter().any(|id| found.contains(id)), "{mutation}: {found:?}");
        // None is one that only 3.0 has.
        let older = ["HS-9", "HS-13", "HS-16", "DTE-4", "DTE-5", "IMP-1", "D-2", "D-9", "D-10"];
        assert!(!report.requirements.iter().any(|one| older.contains(&one.id.as_str())), "{mutation}");
    }
}

/// A VCU that says it is of 4.0, and does what 3.0 says.
#[test]
fn a_program_that_follows_the_rules_of_3_0_does_not_conform() {
    let Rules { table, timing, thresholds, .. } = Edition::V3_0.rules;
    let older = Edition { rules: Rules { table, timing, thresholds, ..EDITION.rules }, ..EDITION };
    let report = machine(&Machine::new(older, EDITION.readings), &ConformOptions::of(&EDITION));
    let found = failed(&report);
    // Torque and brakes at once are no fault under another reading.
    for id in ["HS-17", "HS-18", "DTE-11", "DTE-13"] {
        assert!(found.contains(&id), "{id}: {found:?}");
    }
    let reported: Vec<String> = report
        .failures
        .iter()
        .flat_map(Failure::timeline)
        .map(|moment| format!("{:?}", moment.changes))
        .collect();
    assert!(reported.iter().any(|changes| changes.contains("silence_ms")), "{reported:?}");
}

/// Names are as 4.0 spells them.
#[test]
fn a_failure_prints_in_the_words_of_its_edition() {
    let options = suite_only();
    let report = example(
        "mutant",
        &["--edition", "4.0", "--mutation", "3.7 term 5: fault dropped"],
        &options,
        TIMEOUT,
    );
    let report = report.expect("it answers");
    let differences =
        report.failures.iter().filter_map(|one| one.found.as_ref()).flat_map(|one| &one.differences);
    let reported: Vec<String> = differences.map(ToString::to_string).collect();
    let cause = "shutdown_cause is NO_SHUTDOWN; expected BRAKE_PLAUSIBILITY_FAULT";
    assert!(reported.iter().any(|one| one == cause), "{reported:?}");
    let changes = report.failures.iter().flat_map(Failure::timeline).flat_map(|moment| moment.changes);
    let missions: Vec<String> =
        changes.filter(|(key, _)| *key == "ami").map(|(_, value)| value.to_string()).collect();
    assert!(!missions.is_empty() && missions.iter().all(|mission| mission == "TRACK DRIVE"), "{missions:?}");
}
