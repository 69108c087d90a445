//! The row of Figure 2 behind a wrong answer.

use std::fmt;

use adsdv_oracle::requirements::is_decision;
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Atom, Control, Fault, Faults, Inputs, Machine, Outputs, Taken, Term};

use super::about::own;
use super::vcu::Reply;
use crate::protocol::{Difference, Shown};
use crate::suite::Scenario;

/// The first wrong answer of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Break {
    /// Whose answer is wrong, from 0.
    pub step: usize,
    /// The step whose outputs it should have been, from 0: earlier than that if the program is late.
    pub about: usize,
    /// The fields that are wrong.
    pub differences: Vec<Difference>,
    /// What that has to do with Figure 2.
    pub why: Why,
}

/// What a wrong answer has to do with Figure 2.
#[derive(Clone, Debug, PartialEq)]
pub enum Why {
    /// This row had to be taken, and was not.
    NotTaken(Row),
    /// This row was taken, and its guard does not hold: the conditions that it lacks, as they were.
    Taken(Row, Vec<String>),
    /// The figure has no row from the one state to the other.
    NoRow(AsState, AsState),
    /// This row was taken, as it had to be, and what is shown with it is wrong.
    ShownWith(Row),
    /// The state is right, no row had to be taken, and what is shown is wrong.
    Shown(AsState),
}

/// A row of Figure 2, with one alternative of its guard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its place in the table.
    pub place: usize,
    /// Where it begins.
    pub from: AsState,
    /// Where it leads.
    pub to: AsState,
    /// The section of the document.
    pub section: &'static str,
    /// The conditions of the alternative, in words.
    pub guard: Vec<String>,
}

impl Row {
    fn of(machine: &Machine, taken: Taken) -> Option<Self> {
        let rules = &machine.edition().rules;
        let (row, term) = (taken.row(&rules.table)?, taken.term(&rules.table)?);
        let guard = term.literals().map(|(atom, value)| rules.text(atom, value).to_string()).collect();
        Some(Self { place: taken.row.into(), from: row.from, to: row.to, section: term.section, guard })
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} -> {} (section {}: {})", self.from, self.to, self.section, self.guard.join(", "))
    }
}

impl Why {
    /// The row of Figure 2.
    pub fn row(&self) -> Option<&Row> {
        match self {
            Self::NotTaken(row) | Self::Taken(row, _) | Self::ShownWith(row) => Some(row),
            Self::NoRow(..) | Self::Shown(_) => None,
        }
    }
}

/// In one sentence.
impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotTaken(row) => write!(f, "not taken: {row}"),
            Self::Taken(row, lacking) => write!(f, "taken, though {}: {row}", lacking.join(", ")),
            Self::NoRow(from, to) => write!(f, "Figure 2 has no arrow {from} -> {to}"),
            Self::ShownWith(row) => write!(f, "taken, and not shown as it should be: {row}"),
            Self::Shown(state) => write!(f, "no arrow: what is shown in {state} is wrong"),
        }
    }
}

impl Break {
    /// The first answer that is wrong where this machine is what is expected, `late` steps late; `None` if all are right.
    ///
    /// One that is only otherwise than we decided does not hide one that is against the document, which comes later.
    pub(super) fn find(
        machine: &Machine,
        scenario: &Scenario,
        replies: &[Reply],
        late: usize,
    ) -> Option<Self> {
        for (step, reply) in replies.iter().take(late).enumerate() {
            if !reply.is_initial() {
                let (_, outputs) = machine.step(&Control::INITIAL, &Inputs::default(), 0);
                let differences =
                    differences(reply, &Shown::of(machine.edition(), &outputs, &Inputs::default()));
                let differences = differences.into_iter().filter(|found| found.key == "as_state").collect();
                return Some(Self { step, about: 0, differences, why: Why::Shown(AsState::Off) });
            }
        }
        let shown = scenario.run(machine).zip(&scenario.steps).enumerate();
        let mut decided = None;
        for ((about, ((_, outputs), step)), reply) in shown.zip(replies.iter().skip(late)) {
            let expected = Shown::of(machine.edition(), &outputs, &step.inputs);
            if reply.agrees(&expected) {
                continue;
            }
            let differences = differences(reply, &expected);
            let only_decided = differences.iter().all(|one| is_decision(own(one.key, outputs.state)));
            if only_decided && decided.is_some() {
                continue;
            }
            let why = why(machine, &outputs, reply);
            let found = Self { step: about + late, about, differences, why };
            if !only_decided || *reply == Reply::Nothing {
                return Some(found);
            }
            decided = Some(found);
        }
        decided
    }

    /// Whether it is the same thing that is wrong: the same alternative of a row that was not taken, or that was; or the
    /// same fields that were not shown as they should be.
    pub(super) fn is_like(&self, that: &Self) -> bool {
        let keys = |found: &Self| found.differences.iter().map(|one| one.key).collect::<Vec<_>>();
        match (&self.why, &that.why) {
            (Why::NotTaken(row), Why::NotTaken(other)) | (Why::Taken(row, _), Why::Taken(other, _)) => {
                row == other
            }
            (Why::ShownWith(row), Why::ShownWith(other)) => {
                row.place == other.place && keys(self) == keys(that)
            }
            (Why::NoRow(from, to), Why::NoRow(other_from, other_to)) => (from, to) == (other_from, other_to),
            (Why::Shown(_), Why::Shown(_)) => self.key() == that.key(),
            _ => false,
        }
    }

    /// Where it stands among others: rows as in the table, then what is no row's.
    pub(super) fn order(&self) -> (usize, &'static str) {
        match self.why.row() {
            Some(row) => (row.place, ""),
            None => (usize::MAX, self.key()),
        }
    }

    fn key(&self) -> &'static str {
        self.differences.first().map_or("", |found| found.key)
    }
}

fn differences(reply: &Reply, expected: &Shown) -> Vec<Difference> {
    match reply {
        Reply::Answer(answer) => answer.differences(expected).collect(),
        Reply::Nothing => Vec::new(),
    }
}

/// The row that a scenario takes in its last step.
pub(super) fn last_row(machine: &Machine, scenario: &Scenario) -> Option<Row> {
    scenario.run(machine).last().and_then(|(_, outputs)| Row::of(machine, outputs.taken?))
}

/// What a wrong answer to a step with these outputs has to do with Figure 2.
pub(super) fn why(machine: &Machine, outputs: &Outputs, reply: &Reply) -> Why {
    let due = outputs.taken.and_then(|taken| Row::of(machine, taken));
    let state = reply.state().unwrap_or(outputs.state);
    match due {
        Some(row) if state != outputs.state => Why::NotTaken(row),
        Some(row) => Why::ShownWith(row),
        None if state == outputs.state => Why::Shown(state),
        None => match nearest(machine, outputs, state, reply.cause()) {
            Some((row, lacking)) => Why::Taken(row, lacking),
            None => Why::NoRow(outputs.from, state),
        },
    }
}

/// The alternative from the state before a step to another one that was taken, as far as the answer shows it, and the conditions
/// that it lacks: of those with the fault that the program tells as its cause, the one that lacks the fewest.
fn nearest(
    machine: &Machine,
    outputs: &Outputs,
    to: AsState,
    cause: Option<ShutdownCause>,
) -> Option<(Row, Vec<String>)> {
    let rules = &machine.edition().rules;
    let table = &rules.table;
    let lacking = |term: &Term| -> Vec<String> {
        let as_it_was = |(atom, value): (Atom, bool)| {
            (outputs.atoms.has(atom) != value).then(|| rules.text(atom, !value).to_string())
        };
        term.literals().filter_map(as_it_was).collect()
    };
    let tells_another = |term: &Term| match (cause.and_then(Fault::of_cause), term.fault) {
        (Some(shown), Some(fault)) => shown != fault,
        (Some(shown), None) => !Faults::OPENING.has(shown),
        (None, _) => false,
    };
    let leading =
        machine.arrows(outputs.from).filter(|taken| taken.row(table).is_some_and(|row| row.to == to));
    let rows = leading.filter_map(|taken| {
        let term = taken.term(table)?;
        Some((tells_another(term), Row::of(machine, taken)?, lacking(term)))
    });
    let nearest = rows.min_by_key(|(another, _, lacking)| (*another, lacking.len()));
    nearest.map(|(_, row, lacking)| (row, lacking))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Before a late program has seen the first step it may show what it likes, but for the state.
    #[test]
    fn only_the_state_can_be_wrong_before_the_first_step_is_due() {
        let reply = |line: &str| Reply::Answer(line.parse().expect("an answer"));
        let ready = [reply("{\"as_state\":\"AS_READY\",\"handshake\":true}")];
        let scenario = Scenario::default();
        let find = |late| Break::find(&Machine::REFERENCE, &scenario, &ready, late);
        let found = find(1).expect("AS_READY comes too early");
        assert_eq!((found.step, found.about, &found.why), (0, 0, &Why::Shown(AsState::Off)));
        let keys: Vec<&str> = found.differences.iter().map(|one| one.key).collect();
        assert_eq!(keys, ["as_state"]);
        assert_eq!(find(0), None, "the scenario has no step");
        let off = [reply("{\"as_state\":\"AS_OFF\",\"handshake\":true}")];
        assert_eq!(Break::find(&Machine::REFERENCE, &scenario, &off, 1), None);
    }
}
