//! What leads out of each state, under every reading that is still possible.
//!
//! Readings change which terms a row has and which row comes first. Most combinations of readings make no difference to a given
//! state, so each state keeps the few machines that differ in it. What may be taken when not everything is known, and what must be,
//! is for [`Machine::outcomes`] to say, which is proven.

use adsdv_spec::{AsState, Atoms, Choice, Choices, Edition, Fault, Knowledge, Machine, Reading, Row, Taken};
use adsdv_spec::{Term, Truth};

/// A way out of a state: one alternative of an arrow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WayOut {
    pub(crate) to: AsState,
    pub(crate) section: &'static str,
    pub(crate) term: Term,
}

/// What leads out of one state.
#[derive(Debug, Default)]
struct Leaving {
    machines: Vec<Machine>,
    /// Every way under some reading, each once.
    ways: Vec<WayOut>,
}

/// What leads out of every state.
#[derive(Debug)]
pub(crate) struct Readings([Leaving; AsState::ALL.len()]);

impl Readings {
    pub(crate) fn new(edition: &Edition, readings: Choices) -> Self {
        let mut all = AsState::ALL.map(|_| Leaving::default());
        for answer in readings.combinations(&table_readings(edition)) {
            let machine = Machine::new(*edition, answer);
            for (state, leaving) in AsState::ALL.into_iter().zip(&mut all) {
                if leaving.machines.iter().any(|other| other.arrows(state).eq(machine.arrows(state))) {
                    continue;
                }
                for way in ways(&machine, state) {
                    if !leaving.ways.contains(&way) {
                        leaving.ways.push(way);
                    }
                }
                leaving.machines.push(machine);
            }
        }
        Self(all)
    }

    /// The machines that differ in what leads out of a state.
    pub(crate) fn of(&self, state: AsState) -> &[Machine] {
        self.0.get(state as usize - 1).map_or(&[], |leaving| &leaving.machines)
    }

    /// Every way out of a state under some reading.
    pub(crate) fn ways(&self, state: AsState) -> &[WayOut] {
        self.0.get(state as usize - 1).map_or(&[], |leaving| &leaving.ways)
    }

    /// Every alternative of an arrow under some reading.
    pub(crate) fn terms(&self, from: AsState, to: AsState) -> impl Iterator<Item = &Term> {
        self.ways(from).iter().filter(move |way| way.to == to).map(|way| &way.term)
    }

    /// Every alternative, of any arrow, that tells of this fault.
    pub(crate) fn terms_of(&self, fault: Fault) -> impl Iterator<Item = &Term> {
        let ways = self.0.iter().flat_map(|leaving| &leaving.ways).map(|way| &way.term);
        ways.filter(move |term| term.fault == Some(fault))
    }

    /// The atoms that decide which way a state is left.
    pub(crate) fn deciding(&self, state: AsState) -> Atoms {
        of_terms(self.ways(state).iter().map(|way| &way.term))
    }

    /// The way that is certainly open: under every reading the state is left. Tells that of the first.
    pub(crate) fn due(&self, state: AsState, known: Knowledge) -> Option<WayOut> {
        if !self.ways(state).iter().any(|way| way.term.truth(known) == Truth::True) {
            return None;
        }
        let mut ways = self.of(state).iter().map(|machine| forced(machine, state, known));
        let first = ways.next()??;
        ways.all(|way| way.is_some()).then_some(first)
    }
}

/// The atoms of these terms.
pub(crate) fn of_terms<'a>(terms: impl Iterator<Item = &'a Term>) -> Atoms {
    terms.fold(Atoms::NONE, |all, term| all.union(term.on).union(term.off))
}

/// The row of an arrow.
pub(crate) fn row_of(edition: &Edition, from: AsState, to: AsState) -> Option<&Row> {
    edition.rules.table.rows().iter().find(|row| (row.from, row.to) == (from, to))
}

/// The section in which an edition has a fault of `AS_DRIVING`: 3.7, where its readings meet, if they stand in different ones.
pub(crate) fn section_of(edition: &Edition, fault: Fault) -> &'static str {
    let rows = edition.rules.table.rows().iter().filter(|row| row.from == AsState::Driving);
    let mut sections =
        rows.flat_map(Row::terms).filter(|term| term.fault == Some(fault)).map(|term| term.section);
    let first = sections.next();
    first.filter(|first| sections.all(|section| section == *first)).unwrap_or("3.7")
}

/// What is taken for certain: what is taken if nothing is that only may be, unless the state may stay.
pub(crate) fn forced(machine: &Machine, from: AsState, known: Knowledge) -> Option<WayOut> {
    way(machine, machine.outcomes(from, known).last()?.taken?.0)
}

/// The first alternative of an arrow that may be taken.
pub(crate) fn possible(
    machine: &Machine,
    (from, to): (AsState, AsState),
    known: Knowledge,
) -> Option<WayOut> {
    let taken = machine.outcomes(from, known).filter_map(|outcome| outcome.taken);
    way(machine, { taken }.find(|(_, leads)| *leads == to)?.0)
}

/// The alternatives of an arrow under the readings of a machine.
pub(crate) fn guard(machine: &Machine, from: AsState, to: AsState) -> Vec<WayOut> {
    ways(machine, from).filter(|way| way.to == to).collect()
}

/// The ways out of a state under the readings of a machine, in the order of evaluation.
pub(crate) fn ways(machine: &Machine, from: AsState) -> impl Iterator<Item = WayOut> {
    machine.arrows(from).filter_map(|taken| way(machine, taken))
}

fn way(machine: &Machine, taken: Taken) -> Option<WayOut> {
    let table = &machine.edition().rules.table;
    let Row { to, section, .. } = *taken.row(table)?;
    Some(WayOut { to, section, term: *taken.term(table)? })
}

/// The readings that change the table, rather than what an atom means.
fn table_readings(edition: &Edition) -> Vec<Reading> {
    let rules = &edition.rules;
    let in_terms = rules.table.rows().iter().flat_map(Row::terms).flat_map(|term| term.readings.iter());
    let in_order = rules.priorities.iter().map(|priority| priority.choice);
    let changing: Vec<Reading> = in_terms.chain(in_order).map(Choice::reading).collect();
    edition.questions().filter(|reading| changing.contains(reading)).collect()
}
