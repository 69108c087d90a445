//! The tests, generated: one file for each thing that they are about.
//!
//! What a test has to be is read off the table and the interface: a row, a term, a condition, a time, a threshold. How the
//! machine gets to where the test begins is a [`Walk`].

mod braking;
mod ebs;
mod faults;
mod handshake;
mod limits;
mod missed;
mod no_arrow;
mod outputs;
mod pairs;
mod readings;
mod rows;

use adsdv_oracle::requirements::of_edition;
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Choice, Edition, Machine, Row, Term};

use super::walk::{Walk, walk_cycle};
use super::{Kind, Test};

/// Every test of a version of the interface, each scenario once.
pub(super) fn all(edition: &Edition) -> Vec<Test> {
    let machine = Machine::new(*edition, edition.readings);
    let mut tests = rows::tests(&machine);
    tests.extend(limits::tests(&machine));
    tests.extend(pairs::tests(&machine));
    tests.extend(no_arrow::tests(&machine));
    tests.extend(handshake::tests(&machine));
    tests.extend(missed::tests(&machine));
    tests.extend(faults::tests(&machine));
    tests.extend(braking::tests(&machine));
    tests.extend(ebs::tests(&machine));
    tests.extend(outputs::tests(&machine));
    tests.extend(readings::tests(&machine));
    each_once(tests.into_iter().map(|test| test.of(edition)).collect())
}

/// A test without its requirements and its reading.
fn test(
    kind: Kind,
    name: impl Into<String>,
    about: impl Into<String>,
    section: &str,
    walk: Walk<'_>,
) -> Test {
    Test {
        name: name.into(),
        kind,
        about: about.into(),
        section: section.to_owned(),
        requirements: Vec::new(),
        reading: None,
        scenario: walk.scenario(),
    }
}

impl Test {
    /// With the requirements that it checks.
    fn checks<'a>(mut self, requirements: impl IntoIterator<Item = &'a str>) -> Self {
        for id in requirements {
            if !self.requirements.iter().any(|known| known == id) {
                self.requirements.push(id.to_owned());
            }
        }
        self
    }

    /// With the requirements that an edition has in the place of those of the first one.
    fn of(mut self, edition: &Edition) -> Self {
        let first = std::mem::take(&mut self.requirements);
        self.checks(first.iter().flat_map(|id| of_edition(edition, id)))
    }
}

/// The rows of a machine with the terms that its readings have.
fn terms(machine: &Machine) -> impl Iterator<Item = (&Row, &Term)> {
    let choices = machine.readings().choices();
    let rows = machine.edition().rules.table.rows().iter();
    rows.flat_map(|row| row.terms().iter().map(move |term| (row, term)))
        .filter(move |(_, term)| term.readings.is_subset(choices))
}

/// The alternatives of the way from AS_DRIVING into EMERGENCY_BRAKE that an atom decides, alone or with others.
fn braking_by(machine: &Machine, atom: Atom) -> impl Iterator<Item = &Term> {
    let brakes = |(row, _): &(&Row, &Term)| (row.from, row.to) == (AsState::Driving, AsState::EmergencyBrake);
    let by = move |term: &&Term| term.on.has(atom) || term.off.has(atom);
    terms(machine).filter(brakes).map(|(_, term)| term).filter(by)
}

/// The walk to where a term can be tried: in the state that its row leaves, with all that its memory conditions need.
fn before<'a>(machine: &'a Machine, row: &Row, term: &Term) -> Walk<'a> {
    if term.on.has(Atom::GoEdge) {
        Walk::armed(machine)
    } else if term.on.has(Atom::MissionFinishedEdge) || term.on.has(Atom::DirectionNeutralEdge) {
        // One step in which the value from which it changes is seen.
        Walk::to(machine, row.from).cycle()
    } else {
        Walk::to(machine, row.from)
    }
}

/// The step in which a term holds, but for one of its conditions if one is given.
fn attempt<'a>(machine: &'a Machine, walk: Walk<'a>, term: &Term, but: Option<Atom>) -> Walk<'a> {
    let timing = &machine.edition().rules.timing;
    let mut walk = walk;
    let mut dt_ms = walk_cycle(machine);
    for (atom, value) in term.literals() {
        let value = value != (but == Some(atom));
        let input = atom.input().unwrap_or(atom);
        match atom {
            Atom::EbsTimerComplete => dt_ms = u32::from(timing.ebs_timer_ms) - u32::from(!value),
            Atom::AiCommsLost => {
                walk = walk.answering(false);
                dt_ms = u32::from(timing.handshake_ms) - u32::from(!value);
            }
            _ => walk = walk.show(input, value),
        }
    }
    walk.step(dt_ms, |_| {})
}

/// A condition in the words of the table.
fn words(machine: &Machine, atom: Atom, value: bool) -> String {
    machine.edition().rules.text(atom, value).to_string()
}

/// A term in the words of the table.
fn term_words(machine: &Machine, term: &Term) -> String {
    let conditions: Vec<String> = term.literals().map(|(atom, value)| words(machine, atom, value)).collect();
    conditions.join(" and ")
}

/// The machine under another choice.
fn under(machine: &Machine, choice: Choice) -> Machine {
    Machine::new(*machine.edition(), machine.edition().readings.with(choice))
}

/// The tests, each scenario once: what two tests with the same steps check, one checks.
fn each_once(tests: Vec<Test>) -> Vec<Test> {
    let mut kept: Vec<Test> = Vec::new();
    for test in tests {
        if let Some(same) = kept.iter_mut().find(|same| same.scenario == test.scenario) {
            same.join(&test);
        } else {
            kept.push(test);
        }
    }
    kept
}

impl Test {
    /// Lets this test check what another one with the same steps does. Of the two the one of a row gives the name: each row
    /// has a test that is called after it.
    fn join(&mut self, same: &Self) {
        if same.kind == Kind::Row && self.kind != Kind::Row {
            self.kind = same.kind;
            (self.name, self.about, self.section) =
                (same.name.clone(), same.about.clone(), same.section.clone());
        }
        self.reading = self.reading.or(same.reading);
        for id in &same.requirements {
            if !self.requirements.contains(id) {
                self.requirements.push(id.clone());
            }
        }
    }
}
