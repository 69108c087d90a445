//! What a diagnosis names: exactly what a program does otherwise, and nothing else.

use std::collections::HashSet;

use adsdv_diagnosis::{Deviation, Diagnosis, Model, Wheels, diagnose};
use adsdv_spec::messages::AsState::{Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::mutation::{Change, TermChange, Threshold, Time};
use adsdv_spec::{Atom, Edition};

fn found(edition: &Edition, deviations: &[Deviation]) -> Diagnosis {
    let mut program = Model::new(edition, deviations).running();
    diagnose(&mut program, edition).expect("a model answers everything")
}

/// The program does these things otherwise: just these are named, in whatever order.
fn names(edition: &Edition, deviations: &[Deviation]) {
    let found = found(edition, deviations);
    let ids = |these: &[Deviation]| these.iter().map(|one| one.id(edition)).collect::<HashSet<String>>();
    assert_eq!(ids(&found.deviations), ids(deviations), "{}", edition.version);
    assert!(found.unexplained.is_empty());
}

#[test]
fn a_program_that_conforms_has_no_deviation() {
    for edition in Edition::ALL {
        let found = found(edition, &[]);
        assert!(found.deviations.is_empty() && found.unexplained.is_empty(), "{found:?}");
        assert!(found.experiments > 1000);
    }
}

#[test]
fn one_deviation_does_not_hide_the_others() {
    let needs = Deviation::Needs { from: Off, to: Ready, key: "ami", raw: 3, is: true };
    let late = Deviation::Late { from: Driving, to: Finished, steps: 2 };
    let comms = Deviation::Changed(Change::Time(Time::Handshake, 450));
    names(&Edition::V4_0, &[needs, late, comms]);
}

#[test]
fn what_a_program_needs_besides_is_told_from_an_arrow_that_it_lacks() {
    let row = |from, to| {
        let rows = Edition::V3_0.rules.table.rows();
        rows.iter().position(|row| (row.from, row.to) == (from, to)).expect("there is such an arrow")
    };
    let dropped = Deviation::Changed(Change::RowDropped(row(EmergencyBrake, Off)));
    let needs = Deviation::Needs { from: EmergencyBrake, to: Off, key: "mission_status", raw: 0, is: true };
    names(&Edition::V3_0, &[dropped]);
    names(&Edition::V3_0, &[needs]);
    let without = Change::Term(row(Ready, Driving), 0, TermChange::LiteralDropped(Atom::SteerStraight));
    names(&Edition::V3_0, &[Deviation::Changed(without), Deviation::Wheels(Wheels::All)]);
}

#[test]
fn times_and_thresholds_are_measured() {
    let dwell = Deviation::Changed(Change::Time(Time::ReadyDwell, -1234));
    let missed = Deviation::Changed(Change::Threshold(Threshold::Missed, 57));
    let speed = Deviation::Changed(Change::Threshold(Threshold::WheelSpeed, 9));
    names(&Edition::V2026, &[dwell, missed, speed]);
}

#[test]
fn each_deviation_has_a_name_of_its_own_words_and_requirements_that_there_are() {
    const REQUIREMENTS: &str = include_str!("../../spec/REQUIREMENTS.md");
    for edition in Edition::ALL {
        let every = Deviation::every(edition);
        let mut ids = HashSet::new();
        for one in &every {
            let (id, text) = (one.id(edition), one.text(edition).to_string());
            assert!(ids.insert(id.clone()), "{id} is the name of two");
            assert!(!id.contains(' ') && text.len() > 15 && !text.contains("  "), "{id}: {text}");
            for requirement in one.requirements(edition) {
                assert!(REQUIREMENTS.contains(&format!("**{requirement}**")), "{id}: {requirement}");
            }
        }
        assert!(every.len() > 1000);
    }
    let text = |one: Deviation| one.text(&Edition::V3_0).to_string();
    assert_eq!(
        text(Deviation::Changed(Change::Time(Time::Handshake, 450))),
        "AI_COMMS_LOST after 500 ms; expected 50 ms"
    );
    assert_eq!(
        text(Deviation::Needs { from: Ready, to: Driving, key: "mission_status", raw: 2, is: true }),
        "AS_READY -> AS_DRIVING also needs mission_status == RUNNING"
    );
    assert_eq!(text(Deviation::Late { from: Off, to: Ready, steps: 1 }), "AS_OFF -> AS_READY one step late");
}
