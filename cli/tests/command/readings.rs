//! `--reading ID=CHOICE`, and the list of what may be given.

use adsdv_spec::{Choice, Edition, Reading};

use crate::run::{MISSION, run};

#[test]
fn a_pinned_reading_stands_in_the_report() {
    let pinned = run(&["check", "--edition", "3.0", "--reading", "fault-trigger=edge", MISSION]);
    assert!(pinned.stdout.contains("\nreading fault-trigger=edge: the change counts\n"), "{}", pinned.stdout);
    let twice = run(&[
        "check",
        "--edition",
        "3.0",
        "--reading",
        "fault-trigger=edge",
        "--reading",
        "fault-trigger=edge",
        MISSION,
    ]);
    assert_eq!(twice.status, pinned.status, "{}", twice.stderr);
}

/// Version 4.0, which the log speaks, has settled the question.
#[test]
fn a_pin_that_the_recognised_edition_does_not_have_is_refused() {
    let outcome = run(&["check", "--reading", "fault-trigger=edge", MISSION]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
    let expected = "adsdv: --reading fault-trigger=edge: is no answer in edition 4.0; expected fault-trigger=level\nhint: ";
    assert!(outcome.stderr.contains(expected), "{}", outcome.stderr);
    let of_4_0 = run(&["check", "--reading", "torque-control=never", MISSION]);
    assert_eq!(of_4_0.status, Some(0), "{}", of_4_0.stderr);
}

#[test]
fn an_unknown_reading_lists_the_known_ones() {
    for command in [&["check", MISSION][..], &["diagram"]] {
        for given in ["no-such=edge", "=edge", "fault-trigger", ""] {
            let outcome = run(&[command, &["--reading", given]].concat());
            assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{given}");
            for reading in Reading::ALL {
                assert!(outcome.stderr.contains(reading.id()), "{given}: {}", outcome.stderr);
            }
        }
    }
}

#[test]
fn an_unknown_choice_lists_the_known_ones() {
    for reading in Reading::ALL {
        let outcome = run(&["check", "--reading", &format!("{}=no-such", reading.id()), MISSION]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
        let choices: Vec<_> = reading.choices().iter().map(|choice| choice.id()).collect();
        let expected = format!("expected one of {}\n", choices.join(", "));
        assert!(outcome.stderr.contains(&expected), "{}", outcome.stderr);
    }
}

#[test]
fn a_reading_cannot_be_pinned_to_two_choices() {
    for command in [&["check", MISSION][..], &["diagram"]] {
        let pins =
            ["--reading", "go-edge=edge", "--reading", "ai-estop=driving", "--reading", "go-edge=seen-low"];
        let outcome = run(&[command, &pins].concat());
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
        let expected = "adsdv: --reading go-edge=seen-low: go-edge is already pinned to edge\nhint: ";
        assert!(outcome.stderr.starts_with(expected), "{}", outcome.stderr);
    }
}

#[test]
fn the_list_has_every_choice_of_the_edition_and_marks_the_defaults() {
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    for edition in Edition::ALL {
        let list = run(&["readings", "--edition", edition.version]).stdout;
        let listed = |choice: Choice| {
            let mark = if edition.readings.is(choice) { "* " } else { "" };
            let expected = words(&format!("{mark}{} {}", choice.id(), choice.text()));
            list.lines().any(|line| words(line) == expected)
        };
        for choice in edition.questions().flat_map(|reading| edition.choices.of_reading(reading)) {
            assert!(listed(choice), "{choice} is missing: {list}");
        }
        assert!(list.lines().all(|line| line.chars().count() <= 100), "{list}");
    }
}

#[test]
fn the_list_for_programs_has_the_same_readings() {
    for edition in Edition::ALL {
        let list = run(&["readings", "--json", "--edition", edition.version]).stdout;
        let list: serde_json::Value = serde_json::from_str(&list).expect("JSON");
        let list = list["readings"].as_array().expect("an array");
        assert_eq!(list.len(), edition.questions().count());
        for (json, reading) in list.iter().zip(edition.questions()) {
            assert_eq!(json["id"], reading.id());
            assert_eq!(json["question"], reading.question());
            let choices = json["choices"].as_array().expect("an array");
            assert_eq!(choices.len(), edition.choices.of_reading(reading).count());
            for (json, choice) in choices.iter().zip(edition.choices.of_reading(reading)) {
                assert_eq!(Choice::find(reading.id(), json["id"].as_str().expect("text")), Some(choice));
                assert_eq!(json["default"], edition.readings.is(choice));
            }
        }
    }
}
