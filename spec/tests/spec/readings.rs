//! The readings: how they are printed, and all answers that can be given.

use std::collections::HashSet;

use adsdv_spec::{Choice, Choices, Reading, Readings};

#[test]
fn readings_print_what_is_not_the_default() {
    assert_eq!(Readings::DEFAULT.to_string(), "");
    let readings = Readings::DEFAULT.with(Choice::FaultEdge).with(Choice::GoEdgeEnough);
    let printed = readings.to_string();
    let mut parts: Vec<_> = printed.split(' ').collect();
    parts.sort_unstable();
    assert_eq!(parts, ["fault-trigger=edge", "go-edge=edge"]);
    let read =
        parts.iter().map(|part| part.parse().expect("a choice")).fold(Readings::DEFAULT, Readings::with);
    assert_eq!(read, readings);
}

#[test]
fn every_question_has_the_answer_that_was_given() {
    for &choice in Choice::ALL {
        let readings = Readings::DEFAULT.with(choice);
        for &reading in Reading::ALL {
            let expected =
                if reading == choice.reading() { choice } else { Readings::DEFAULT.choice(reading) };
            assert_eq!(readings.choice(reading), expected, "{choice}");
        }
    }
}

#[test]
fn combinations_are_all_answers_once() {
    let asked = [Reading::MissionSelected, Reading::FaultTrigger, Reading::GoEdge];
    let answers: Vec<_> = Choices::ALL.combinations(&asked).collect();
    let count: usize = asked.iter().map(|reading| reading.choices().len()).product();
    assert_eq!(answers.len(), count);
    let different: HashSet<_> =
        answers.iter().map(|answer| asked.map(|reading| answer.choice(reading))).collect();
    assert_eq!(different.len(), count);
    for answer in &answers {
        for &other in Reading::ALL.iter().filter(|reading| !asked.contains(reading)) {
            assert_eq!(answer.choice(other), other.choices()[0], "the first that is possible");
        }
    }
    assert_eq!(Choices::ALL.combinations(&[]).count(), 1);
}

#[test]
fn combinations_are_of_what_is_possible() {
    let pinned = Choices::ALL.pin(Choice::FaultEdge);
    let asked = [Reading::FaultTrigger, Reading::MissionSelected];
    let answers: Vec<_> = pinned.combinations(&asked).collect();
    assert_eq!(answers.len(), Reading::MissionSelected.choices().len());
    assert!(answers.iter().all(|answer| answer.is(Choice::FaultEdge)));
    assert!(pinned.combinations(&[]).all(|answer| answer.is(Choice::FaultEdge)), "though nothing is varied");
    assert_eq!(Choices::NONE.combinations(&asked).collect::<Vec<_>>(), [Readings::DEFAULT]);
}
