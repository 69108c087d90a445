//! No property holds for the wrong reason: each is broken by some mutant of the table.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{LazyLock, Mutex};
use std::thread;

use adsdv_model::{
    Exploration, Options, SHORT_TIMERS as SHORT, Vectors, explore_quietly, goals, properties, short_timers,
};
use adsdv_spec::mutation::{Change, TermChange, Time};
use adsdv_spec::{Choice, Edition, Machine, Mutation, Readings};

const SHORTENED: Edition = Edition::DEFAULT.with_timing(SHORT);

/// Mutants that no step of the model can show, each with the reason.
const UNSEEN: &[(&str, &str)] = &[
    ("3.1 term 0: in every reading", "what asks for both implies what the other two readings ask for"),
    ("3.7 term 4: in every reading", "under the other reading no change of MISSION_STATUS is recorded"),
    ("3.7 term 6: in every reading", "under the other reading no change of DIRECTION_REQUEST is recorded"),
    ("ready dwell -1", "the model steps every 10 ms"),
    ("EBS timer -1", "the model steps every 10 ms"),
    ("wheel speed -1", "the model sees whether a wheel is moving, not how fast"),
    ("wheel speed +1", "the model sees whether a wheel is moving, not how fast"),
    ("straight -1", "the model sees whether the wheels are straight, not their angle"),
    ("straight +1", "the model sees whether the wheels are straight, not their angle"),
];

/// With a look at the parts of the table.
fn explore(edition: &Edition, readings: Readings) -> Exploration {
    let options = Options { vectors: Vectors::Read, threads: 1, document: SHORT, ..Options::default() };
    let exploration = adsdv_model::explore(Machine::new(*edition, readings), options, |_| {});
    assert!(exploration.complete);
    exploration
}

/// The names of what does not hold or is not reached.
fn failed(edition: &Edition, readings: Readings) -> BTreeSet<&'static str> {
    let document = short_timers(Edition::find(edition.version).unwrap_or(Edition::DEFAULT));
    let options = Options { vectors: Vectors::Read, threads: 1, document, ..Options::default() };
    let exploration = explore_quietly(&Machine::new(*edition, readings), &options);
    assert!(exploration.complete);
    let broken = exploration.broken.iter().map(|property| property.name);
    broken.chain(exploration.missed.iter().map(|goal| goal.name)).collect()
}

/// A mutant, with what fails under the readings under which it can matter.
struct Explored {
    name: String,
    readings: Readings,
    failed: BTreeSet<&'static str>,
}

/// Every mutant, explored once for all tests, as many at a time as there are cores.
static EXPLORED: LazyLock<Vec<Explored>> = LazyLock::new(|| {
    let (queue, explored) = (Mutex::new(mutants()), Mutex::new(Vec::new()));
    let workers = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap().next();
                    let Some((name, edition, readings)) = next else { break };
                    let failed = failed(&edition, readings);
                    explored.lock().unwrap().push(Explored { name, readings, failed });
                }
            });
        }
    });
    explored.into_inner().unwrap()
});

/// Every mutant, with the readings under which it can matter.
fn mutants() -> impl Iterator<Item = (String, Edition, Readings)> {
    let by_one = Mutation::all(&SHORTENED).map(|mutation| {
        let readings = match mutation.change {
            Change::Term(row, term, change) => {
                // A term that is there whatever the readings are is only seen where it would not be.
                let everywhere = change == TermChange::InEveryReading;
                let choices = SHORTENED.rules.table.rows()[row].terms()[term].readings.iter();
                let choices = choices.map(|choice| if everywhere { other(choice) } else { choice });
                choices.fold(Readings::DEFAULT, Readings::with)
            }
            _ => Readings::DEFAULT,
        };
        (mutation.to_string(), mutation.apply(&SHORTENED), readings)
    });
    let cycle = i16::try_from(SHORT.cycle_ms).unwrap();
    let by_a_cycle = [Time::ReadyDwell, Time::EbsTimer, Time::Handshake].into_iter().flat_map(move |time| {
        [-cycle, cycle]
            .map(|by| (format!("{time} {by:+}"), Change::Time(time, by).apply(&SHORTENED), Readings::DEFAULT))
    });
    by_one.chain(by_a_cycle)
}

/// Another answer to the same question.
fn other(choice: Choice) -> Choice {
    let mut choices = choice.reading().choices().iter().copied();
    choices.find(|&other| other != choice).unwrap_or(choice)
}

#[test]
fn every_property_and_goal_is_failed_by_a_mutant_and_every_mutant_fails_something() {
    let mut fails: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let mut unseen = Vec::new();
    let mut usual: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for Explored { name, readings, failed: failing } in &*EXPLORED {
        let usual = usual.entry(readings.to_string()).or_insert_with(|| failed(&SHORTENED, *readings));
        if failing == usual {
            unseen.push(name);
        } else if *readings == Readings::DEFAULT {
            for property in failing {
                fails.entry(property).or_default().push(name.clone());
            }
        }
    }
    let names = properties(Edition::DEFAULT)
        .map(|property| property.name)
        .chain(goals(Edition::DEFAULT).iter().map(|goal| goal.name));
    for name in names {
        let mutants = fails.get(name).map_or(&[][..], Vec::as_slice);
        assert!(!mutants.is_empty(), "no mutant fails {name}: it may hold for the wrong reason");
    }
    let expected: Vec<&str> = UNSEEN.iter().map(|(name, _)| *name).collect();
    let (unseen, expected): (BTreeSet<_>, BTreeSet<_>) =
        (unseen.iter().map(|name| name.as_str()).collect(), expected.into_iter().collect());
    assert_eq!(unseen, expected, "left: the mutants that fail nothing; right: those that are known to");
}

/// The kinds of mistakes that are easiest to make, and the property that each was written for.
#[test]
fn a_mutant_fails_the_property_that_was_written_for_it() {
    let cases = [
        ("3.7 term 0: dropped", "driving-sdc"),
        ("3.7 term 1: dropped", "driving-go-off"),
        ("3.7 term 2: asms flipped", "driving-asms"),
        ("3.7 term 3: moving flipped", "driving-finished"),
        ("3.7 term 5: dropped", "driving-neutral"),
        ("3.7 term 5: moving dropped", "brake-founded"),
        ("3.7 term 7: dropped", "driving-comms"),
        ("3.7 term 8: dropped", "driving-estop"),
        ("3.2 term 0: steer-straight dropped", "driving-requests"),
        ("3.2 term 0: go-edge dropped", "driving-go"),
        ("3.6: one place earlier", "ready-sdc"),
        ("3.4: one place earlier", "finished-sdc"),
        ("3.3: one place earlier", "driving-sdc"),
        ("3.9 term 0: asms dropped", "brake-asms"),
        ("3.1 term 0: power-cycle-needed dropped", "power-cycle"),
        ("3.7 term 1: fault dropped", "shutdown-cause"),
        ("ready dwell -10", "driving-go"),
        ("3.2 term 0: dwell-elapsed dropped", "driving-dwell"),
        ("ready dwell +10", "driving-go"),
        ("EBS timer -10", "brake-time"),
        ("EBS timer +10", "brake-due"),
        ("handshake -10", "brake-founded"),
        ("handshake +10", "driving-comms"),
        ("3.6: leads to AS_FINISHED", "figure-2-arrows"),
    ];
    for (mutant, property) in cases {
        let Some(explored) = EXPLORED.iter().find(|explored| explored.name == mutant) else {
            panic!("there is no mutant {mutant}");
        };
        assert_eq!(explored.readings, Readings::DEFAULT, "{mutant}");
        let failed = &explored.failed;
        assert!(failed.contains(property), "{mutant} should fail {property}, and fails {failed:?}");
    }
}

/// Each alternative of the way from AS_DRIVING into EMERGENCY_BRAKE of version 4.0, and the time of its handshake. How long a message is
/// missed is decided outside of the states that are explored, by `silence.rs` of `spec`, and a theorem's.
#[test]
fn a_mutant_of_a_later_edition_fails_the_property_that_was_written_for_it() {
    let edition = Edition::find("4.0").expect("it has these alternatives");
    let short = edition.with_timing(short_timers(edition));
    let cases = [
        ("3.7 term 0: dropped", "driving-sdc", None),
        ("3.7 term 1: dropped", "driving-asms", None),
        ("3.7 term 2: dropped", "driving-go-off", None),
        ("3.7 term 3: dropped", "driving-finished", None),
        ("3.7 term 4: dropped", "driving-neutral", None),
        ("3.7 term 7: dropped", "driving-estop", None),
        ("3.7 term 8: dropped", "driving-comms", None),
        ("handshake +1", "driving-comms", None),
        ("3.7 term 5: dropped", "driving-front-brake", None),
        ("3.7 term 6: dropped", "driving-rear-brake", None),
        ("3.7 term 9: dropped", "driving-bms", Some(Choice::BmsDriving)),
        ("3.7 term 10: dropped", "driving-ebs", None),
    ];
    let by_default = failed(&short, edition.readings);
    for (name, property, choice) in cases {
        let readings = choice.into_iter().fold(edition.readings, Readings::with);
        let mutation = Mutation::all(&short).find(|mutation| mutation.to_string() == name);
        let mutant = mutation.unwrap_or_else(|| panic!("there is no mutant {name}")).apply(&short);
        let usual = if choice.is_some() { failed(&short, readings) } else { by_default.clone() };
        let failed = failed(&mutant, readings);
        assert!(!usual.contains(property) && failed.contains(property), "{name}: {usual:?}, {failed:?}");
    }
    let lacking = properties(Edition::DEFAULT).map(|property| property.name).collect::<BTreeSet<_>>();
    let added = properties(edition).map(|property| property.name).filter(|name| !lacking.contains(name));
    let tried = |name: &&str| cases.iter().any(|(_, property, _)| property == name);
    assert_eq!(added.filter(|name| !tried(name)).collect::<Vec<_>>(), Vec::<&str>::new());
}

/// A part of the table that decides nothing is reported: a term that stands there twice, and one that cannot hold.
#[test]
fn dead_parts_are_found() {
    use adsdv_spec::{Atom, Row, Table, Term};
    let dead = |edition: &Edition| {
        let report = explore(edition, Readings::DEFAULT);
        report
            .parts
            .iter()
            .filter(|(_, decides)| !decides)
            .map(|(part, _)| part.to_string())
            .collect::<Vec<_>>()
    };
    assert_eq!(dead(&SHORTENED), Vec::<String>::new());
    let mut rows = SHORTENED.rules.table.rows().to_vec();
    let finished = rows.iter().position(|row| row.section == "3.3").unwrap();
    let row = rows[finished];
    let mut terms = row.terms().to_vec();
    terms.push(Term::on("3.3", &[Atom::MissionFinished, Atom::EbsTimerComplete]));
    rows[finished] = Row::new(row.from, row.to, row.section, &terms);
    let dead = dead(&SHORTENED.with_table(Table::new(&rows)));
    assert!(
        dead.contains(
            &"AS_DRIVING -> AS_FINISHED (3.3): EBS timer complete and MISSION_STATUS == FINISHED".to_owned()
        ),
        "{dead:?}"
    );
}

/// Also of the alternatives that only other readings have, none is dead, nor any of its conditions.
#[test]
fn every_alternative_decides_under_the_reading_that_has_it() {
    for row in SHORTENED.rules.table.rows() {
        for term in row.terms() {
            let readings = term.readings.iter().fold(Readings::DEFAULT, Readings::with);
            let parts = explore(&SHORTENED, readings).parts;
            let of_term = parts.iter().filter(|(part, _)| part.row == *row && part.term == Some(*term));
            let dead: Vec<_> =
                of_term.clone().filter(|(_, decides)| !decides).map(|(part, _)| part).collect();
            assert!(dead.is_empty(), "{readings}: {dead:?}");
            assert_eq!(of_term.count(), 1 + term.literals().count(), "{readings}: {term:?}");
        }
    }
}

/// Under the other reading, nothing but the latch needs the power cycle.
#[test]
fn a_condition_that_a_reading_makes_moot_is_dead_under_it() {
    let report = explore(&SHORTENED, Readings::DEFAULT.with(Choice::PowerCycleNotLatched));
    let dead: Vec<_> =
        report.parts.iter().filter(|(_, decides)| !decides).map(|(part, _)| part.to_string()).collect();
    assert_eq!(dead, ["AS_OFF -> AS_READY (3.1): no power cycle needed in the alternative of 3.1"]);
}
