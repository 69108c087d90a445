//! What was seen of each requirement so far.

use std::collections::BTreeMap;

use adsdv_spec::{Actuation, AsState, Edition};

use super::cited::{self, ALTERNATES, ANSWERS, BEGINS, HOLDS};
use super::standing::{RequirementStanding, Standing};
use crate::judge::finding::Severity;

/// Marks of requirements. There are no more than are cited anywhere, so that they stay few.
#[derive(Debug, Default)]
pub(in crate::judge) struct Tally {
    /// By the identifiers that are cited, which an edition may have others for.
    marks: BTreeMap<&'static str, Standing>,
    /// The AS states that were shown, by number.
    states: [bool; AsState::ALL.len()],
    /// Whether the VCU changed its bit, from 0 and from 1, once it was answered.
    turned: [bool; 2],
    /// Whether messages of the AI Computer and of the VCU came, of those that are forgotten.
    pub(super) heard: (bool, bool),
}

impl Tally {
    /// These stand so; what weighs more than what was marked before counts.
    pub(super) fn mark<'a>(&mut self, ids: impl IntoIterator<Item = &'a &'static str>, standing: Standing) {
        for id in ids {
            let mark = self.marks.entry(id).or_insert(standing);
            *mark = standing.max(*mark);
        }
    }

    /// Something was found that is against these.
    pub(in crate::judge) fn found(&mut self, severity: Severity, ids: &[&'static str]) {
        self.mark(
            ids,
            if severity == Severity::Violation { Standing::Violated } else { Standing::NotCertain },
        );
    }

    /// 520h shows another state.
    pub(in crate::judge) fn shows(&mut self, state: AsState) {
        if let Some(shown) = self.states.get_mut(state as usize - 1) {
            *shown = true;
        }
    }

    /// The VCU shows its handshake bit. `before` is what it showed before, and `answered` tells whether that was answered.
    #[inline]
    pub(in crate::judge) fn handshake(&mut self, before: Option<bool>, bit: bool, answered: bool) {
        if let Some(before) = before.filter(|&before| answered && before != bit) {
            self.turned[usize::from(before)] = true;
        }
    }

    /// The handshake began with an edge that the AI Computer can answer with one.
    pub(in crate::judge) fn begins(&mut self) {
        self.mark(&[BEGINS], Standing::Held);
    }

    /// The states that were shown.
    pub(super) fn states(&self) -> Vec<AsState> {
        let shown = AsState::ALL.iter().zip(self.states).filter(|(_, shown)| *shown);
        shown.map(|(&state, _)| state).collect()
    }

    /// How each requirement of an edition stands.
    pub(super) fn requirements(mut self, edition: &Edition, answers: bool) -> Vec<RequirementStanding> {
        for (id, _) in HOLDS.iter().zip(self.turned).filter(|(_, turned)| *turned) {
            self.mark(&[*id, ALTERNATES], Standing::Held);
        }
        if answers {
            self.mark(&[ANSWERS], Standing::Held);
        }
        for state in self.states() {
            self.mark(Actuation::requirements(state), Standing::NotCertain);
        }
        let mut standing: BTreeMap<&str, Standing> = BTreeMap::new();
        for (id, mark) in &self.marks {
            for id in cited::of_edition(edition, &[*id]) {
                let one = standing.entry(id).or_insert(*mark);
                *one = (*one).max(*mark);
            }
        }
        let of = |id| standing.get(id).copied().unwrap_or(Standing::NotExercised);
        cited::all(edition).into_iter().map(|id| RequirementStanding { id, standing: of(id) }).collect()
    }
}
