//! The guards of each state under every reading that is still possible.
//!
//! Readings change which terms a row has and which row comes first. Most combinations of readings make no
//! difference to a given state, so each state keeps the few variants that do.

use adsdv_spec::{AsState, Atoms, Choices, Edition, Fault, Knowledge, Machine, Reading, Taken, Term, Truth};

/// The readings that change the table, rather than what an atom means.
fn table_readings(edition: &Edition) -> Vec<Reading> {
    let rules = &edition.rules;
    let terms = rules.table.rows().iter().flat_map(adsdv_spec::Row::terms);
    let in_terms = terms.flat_map(|term| term.readings.iter());
    let in_order = rules.priorities.iter().map(|priority| priority.choice);
    let changing: Vec<Reading> = in_terms.chain(in_order).map(adsdv_spec::Choice::reading).collect();
    edition.questions().filter(|reading| changing.contains(reading)).collect()
}

/// One row under one set of readings.
#[derive(Clone, Debug)]
pub(super) struct Guard {
    pub(super) to: AsState,
    pub(super) section: &'static str,
    pub(super) terms: Vec<Term>,
}

impl Guard {
    pub(super) fn truth(&self, known: Knowledge) -> Truth {
        self.terms.iter().fold(Truth::False, |any, term| any.or(term.truth(known)))
    }

    /// The conditions of its terms.
    pub(super) fn atoms(&self) -> Atoms {
        self.terms.iter().fold(Atoms::NONE, |all, term| all.union(term.on).union(term.off))
    }

    /// The first term that has this truth.
    pub(super) fn first(&self, known: Knowledge, truth: Truth) -> Option<Term> {
        self.terms.iter().copied().find(|term| term.truth(known) == truth)
    }
}

/// A way out of a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) to: AsState,
    pub(super) section: &'static str,
    pub(super) term: Term,
}

/// The rows of a state, in the order of evaluation, under one set of readings.
pub(super) type Variant = Vec<Guard>;

/// The variants of every state.
#[derive(Debug)]
pub(super) struct Variants {
    by_state: Vec<Vec<Variant>>,
    terms: Vec<Vec<Term>>,
}

impl Variants {
    pub(super) fn new(edition: &Edition, readings: Choices) -> Self {
        let machines: Vec<Machine> = readings
            .combinations(&table_readings(edition))
            .map(|answer| Machine::new(*edition, answer))
            .collect();
        let by_state: Vec<Vec<Variant>> = AsState::ALL
            .iter()
            .map(|&state| {
                let mut seen: Vec<Vec<Taken>> = Vec::new();
                machines
                    .iter()
                    .filter_map(|machine| {
                        let arrows: Vec<Taken> = machine.arrows(state).collect();
                        if seen.contains(&arrows) {
                            return None;
                        }
                        let variant = guards(edition, &arrows);
                        seen.push(arrows);
                        Some(variant)
                    })
                    .collect()
            })
            .collect();
        let terms = by_state
            .iter()
            .map(|variants| {
                let mut terms: Vec<Term> = Vec::new();
                for term in variants.iter().flatten().flat_map(|guard| &guard.terms) {
                    if !terms.contains(term) {
                        terms.push(*term);
                    }
                }
                terms
            })
            .collect();
        Self { by_state, terms }
    }

    /// The variants of a state.
    pub(super) fn of(&self, state: AsState) -> &[Variant] {
        self.by_state.get(state as usize - 1).map_or(&[], Vec::as_slice)
    }

    /// Every term that leads out of a state under some reading.
    pub(super) fn terms(&self, state: AsState) -> &[Term] {
        self.terms.get(state as usize - 1).map_or(&[], Vec::as_slice)
    }

    /// Every term that leads out of any state and tells of this fault.
    pub(super) fn terms_of(&self, fault: Fault) -> impl Iterator<Item = &Term> {
        self.terms.iter().flatten().filter(move |term| term.fault == Some(fault))
    }

    /// The atoms that any guard of an arrow names.
    pub(super) fn atoms(&self, from: AsState, to: AsState) -> Atoms {
        let guards = self.of(from).iter().flatten().filter(|guard| guard.to == to);
        guards.fold(Atoms::NONE, |all, guard| all.union(guard.atoms()))
    }

    /// Whether there is an arrow at all.
    pub(super) fn has_arrow(&self, from: AsState, to: AsState) -> bool {
        self.of(from).iter().flatten().any(|guard| guard.to == to)
    }

    /// The way out that is certainly open: under every variant some guard is true. Tells that of the first variant.
    pub(super) fn due(&self, state: AsState, known: Knowledge) -> Option<Way> {
        if !self.terms(state).iter().any(|term| term.truth(known) == Truth::True) {
            return None;
        }
        let true_guard = |variant: &'_ Variant| variant.iter().position(|g| g.truth(known) == Truth::True);
        if !self.of(state).iter().all(|variant| true_guard(variant).is_some()) {
            return None;
        }
        let variant = self.of(state).first()?;
        let guard = variant.get(true_guard(variant)?)?;
        Some(Way { to: guard.to, section: guard.section, term: guard.first(known, Truth::True)? })
    }
}

/// Groups alternatives into rows, which stand together in the order of evaluation.
fn guards(edition: &Edition, arrows: &[Taken]) -> Variant {
    let mut rows: Vec<(u8, Guard)> = Vec::new();
    for taken in arrows {
        let (Some(row), Some(term)) = (taken.row(&edition.rules.table), taken.term(&edition.rules.table))
        else {
            continue;
        };
        match rows.last_mut() {
            Some((last, guard)) if *last == taken.row => guard.terms.push(*term),
            _ => rows.push((taken.row, Guard { to: row.to, section: row.section, terms: vec![*term] })),
        }
    }
    rows.into_iter().map(|(_, guard)| guard).collect()
}
