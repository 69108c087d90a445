//! The report names which readings a program follows, and which it mixes.

use adsdv_conform::{ConformOptions, ConformReport, Follows, Outcome};
use adsdv_spec::{Choice, Choices, Edition, Machine, Mutation, Reading, Readings};

use crate::programs::{machine, suite_only};

fn with(choices: &[Choice]) -> Machine {
    Machine::new(*Edition::DEFAULT, choices.iter().copied().fold(Readings::DEFAULT, Readings::with))
}

/// A machine with a mutation of the table, under some readings.
fn mutant(mutation: &str, choices: &[Choice]) -> Machine {
    let named = Mutation::all(Edition::DEFAULT).find(|one| one.to_string() == mutation);
    Machine::new(named.expect(mutation).apply(Edition::DEFAULT), with(choices).readings())
}

/// The answers to the questions that an edition leaves open.
fn open_choices(edition: &Edition) -> impl Iterator<Item = Choice> {
    let choices = edition.choices;
    edition.questions().flat_map(move |reading| choices.of_reading(reading).collect::<Vec<_>>())
}

fn of(report: &ConformReport, reading: Reading) -> &Follows {
    report.follows.iter().find(|follows| follows.reading == reading).expect("the report has every reading")
}

#[test]
fn the_reference_conforms_and_follows_every_default() {
    let report = machine(&Machine::REFERENCE, &ConformOptions::default());
    assert!(report.conforms() && report.failed_tests == 0 && report.failed_runs == 0);
    assert_eq!(report.follows.len(), Edition::DEFAULT.questions().count());
    for Follows { reading, possible, mixes } in &report.follows {
        assert_eq!((possible.as_slice(), mixes.len()), (&reading.choices()[..1], 0), "{reading}");
    }
    assert!(report.not_shown.is_empty());
    assert!(report.requirements.iter().all(|requirement| requirement.outcome == Outcome::Pass));
    assert!(report.requirements.len() > 60, "{:?}", report.requirements.len());
}

#[test]
fn each_choice_of_each_reading_is_recognised_by_the_suite_alone() {
    for choice in open_choices(Edition::DEFAULT) {
        let report = machine(&with(&[choice]), &suite_only());
        assert!(report.conforms(), "{choice}");
        assert_eq!(of(&report, choice.reading()).possible, [choice]);
        assert_eq!(report.readings, Readings::DEFAULT.with(choice), "{choice}");
    }
}

#[test]
fn combinations_of_choices_conform_and_are_recognised() {
    let questions: Vec<Reading> = Edition::DEFAULT.questions().collect();
    let combinations = Edition::DEFAULT.choices.combinations(&questions);
    for (place, readings) in combinations.enumerate().step_by(173) {
        let report = machine(&Machine::new(*Edition::DEFAULT, readings), &suite_only());
        assert!(report.conforms(), "{place}: {readings}");
        for &reading in &questions {
            let possible = &of(&report, reading).possible;
            assert!(possible.contains(&readings.choice(reading)), "{readings}: {reading} {possible:?}");
        }
    }
}

#[test]
fn readings_that_a_program_cannot_show_stay_open() {
    // Nothing but the state tells nothing of GO_SIGNAL.
    let report =
        crate::programs::example("mutant", &["--only", "as_state"], &suite_only(), crate::programs::TIMEOUT);
    let report = report.expect("it answers");
    assert!(report.conforms());
    assert_eq!(of(&report, Reading::GoSignal).possible, Reading::GoSignal.choices());
    assert_eq!(of(&report, Reading::FaultTrigger).possible, [Choice::FaultLevel]);
    assert!(report.not_shown.contains(&"go_signal") && !report.not_shown.contains(&"as_state"));
    let outcome = |id: &str| report.requirements.iter().find(|one| one.id == id).map(|one| one.outcome);
    assert_eq!(outcome("MSG-59"), Some(Outcome::NotChecked));
    assert_eq!(outcome("RTO-1"), Some(Outcome::Pass));

    // The fault of the handshake tells nothing of its bit.
    let args = ["--only", "as_state,ai_comms_lost"];
    let report = crate::programs::example("mutant", &args, &suite_only(), crate::programs::TIMEOUT);
    let report = report.expect("it answers");
    let outcome = |id: &str| report.requirements.iter().find(|one| one.id == id).map(|one| one.outcome);
    assert_eq!((outcome("HS-4"), outcome("HS-9")), (Some(Outcome::NotChecked), Some(Outcome::Pass)));
}

#[test]
fn mixed_readings_are_named() {
    // FINISHED as a level, and NEUTRAL not at all: what is wrong with the one is no reason to trust the other.
    let report = machine(&mutant("3.7 term 5: dropped", &[]), &suite_only());
    assert!(!report.conforms());
    let sides: Vec<Choice> =
        of(&report, Reading::FaultTrigger).mixes.iter().map(|side| side.choice).collect();
    assert!(sides.contains(&Choice::FaultLevel), "{sides:?}");
    let about = |ids: &[&str]| {
        let guards =
            report.failures.iter().filter_map(|one| Some(one.found.as_ref()?.why.row()?.guard.join(" ")));
        guards.filter(|guard| ids.iter().all(|id| guard.contains(id))).count()
    };
    assert!(about(&["DIRECTION_REQUEST"]) > 0, "the fault itself is reported: {:?}", report.failures);

    for (mutation, choice, needed) in [
        // FINISHED as a level, NEUTRAL as a change.
        ("3.7 term 3: in every reading", Choice::FaultEdge, Choice::FaultLevel),
        // NEUTRAL as a level, FINISHED as a change.
        ("3.7 term 5: in every reading", Choice::FaultEdge, Choice::FaultLevel),
        // ESTOP_REQUEST in AS_READY and AS_DRIVING, and not in AS_FINISHED.
        ("3.5 term 2: in every reading", Choice::EstopDriving, Choice::EstopEveryState),
        // AI_COMMS_LOST leads from AS_READY to EMERGENCY_BRAKE, and from no other state.
        ("3.5 term 1: in every reading", Choice::CommsNoArrow, Choice::CommsEveryState),
    ] {
        let report = machine(&mutant(mutation, &[choice]), &suite_only());
        assert!(!report.conforms(), "{mutation}");
        let mixed: Vec<Reading> = report
            .follows
            .iter()
            .filter(|follows| !follows.mixes.is_empty())
            .map(|follows| follows.reading)
            .collect();
        assert_eq!(mixed, [choice.reading()], "{mutation}");
        let sides: Vec<Choice> = of(&report, choice.reading()).mixes.iter().map(|side| side.choice).collect();
        assert!(sides.contains(&choice) && sides.contains(&needed), "{mutation}: {sides:?}");
        assert!(of(&report, choice.reading()).mixes.iter().all(|side| !side.tests.is_empty()), "{mutation}");
        // What fails under the one choice is right under another.
        assert!(report.failures.iter().any(|failure| !failure.explained_by.is_empty()), "{mutation}");
    }
}

#[test]
fn a_pinned_reading_is_the_only_one() {
    let pinned = |choice| ConformOptions { possible: Choices::ALL.pin(choice), ..suite_only() };
    assert!(machine(&with(&[Choice::FaultEdge]), &pinned(Choice::FaultEdge)).conforms());
    let report = machine(&with(&[Choice::FaultEdge]), &pinned(Choice::FaultLevel));
    assert!(!report.conforms());
    assert!(report.readings.is(Choice::FaultLevel));
    let rows: Vec<_> = report.failures.iter().filter_map(|one| one.found.as_ref()?.why.row()).collect();
    assert!(!rows.is_empty() && rows.iter().all(|row| row.section == "3.7"), "{rows:?}");
}

/// A row of which an alternative is missing is not another reading, though one test of it looks as if it were.
#[test]
fn what_is_wrong_whatever_the_readings_is_no_mixture() {
    let report = machine(&mutant("3.7 term 1: dropped", &[]), &suite_only());
    assert!(!report.conforms());
    assert!(report.follows.iter().all(|follows| follows.mixes.is_empty()), "{:?}", report.follows);
    assert!(report.failures.iter().all(|failure| failure.explained_by.is_empty()));
}
