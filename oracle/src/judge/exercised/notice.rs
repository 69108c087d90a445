//! Where the judge tells what was exercised.

use adsdv_spec::messages::Node;
use adsdv_spec::{AsState, Fault, Faults, Knowledge, Term, Truth};

use super::cited::{FINISHES_AT_REST, MISSED, ONLY_ARROWS, UNANSWERED};
use super::standing::{Exercised, Standing};
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::readings::row_of;
use crate::requirements::of_term;

impl Book {
    /// A change of state was judged. `decided` are the alternatives that decided, or may have; `window` is what is known of the
    /// time in which they had to hold.
    pub(in crate::judge) fn exercise_arrow(
        &mut self,
        est: &Estimator,
        (from, to): (AsState, AsState),
        justified: Truth,
        decided: &[(Term, Knowledge)],
        window: Knowledge,
    ) {
        let Some(row) = row_of(&est.edition, from, to).copied() else {
            return self.tally.mark(&[ONLY_ARROWS], Standing::NotCertain);
        };
        self.tally.mark(&[ONLY_ARROWS], Standing::Held);
        let standing = match justified {
            Truth::True => Standing::Held,
            Truth::Unknown => Standing::NotCertain,
            // What it broke stands in the finding.
            Truth::False => return,
        };
        for (term, known) in decided {
            self.tally.mark(&of_term(&row, term), standing);
            for (atom, needed) in term.literals() {
                // What was known of a single condition does not depend on the others.
                let holds = known.of(atom) == Truth::from(needed) || window.of(atom) == Truth::from(needed);
                let standing = if holds { Standing::Held } else { Standing::NotCertain };
                self.tally.mark(term.requirements_of(atom).unwrap_or_default(), standing);
            }
        }
    }

    /// Flags of faults were raised. Whether rightly, is judged later, if the bus shows the reason at all.
    pub(in crate::judge) fn exercise_flags(&mut self, raised: Faults) {
        for fault in raised.iter() {
            self.tally.mark(&[fault.requirement()], Standing::NotCertain);
        }
    }

    /// AI_COMMS_LOST was raised. It is at its time where the log shows for as long, but for a cycle, that the AI Computer does not
    /// answer, or that a message is missing while others come.
    pub(in crate::judge) fn exercise_lost(&mut self, est: &Estimator, t: i64, reported: bool) {
        let limit = est.handshake_limit();
        let waited = est.handshake.unanswered(t).unwrap_or_default();
        let edge = match waited {
            _ if waited < limit - est.window => None,
            _ if waited >= limit - est.cycle() && est.handshake.ai_is_wrong() => Some(Standing::Held),
            _ => Some(Standing::NotCertain),
        };
        let missed = match est.edition.rules.thresholds.missed_ms {
            Some(_) if reported => Some(Standing::Held),
            Some(_) if est.silences.silent != Truth::False => Some(Standing::NotCertain),
            _ => None,
        };
        if let Some(standing) = edge {
            self.tally.mark(UNANSWERED, standing);
        }
        if let Some(standing) = missed {
            self.tally.mark(&[MISSED], standing);
        }
        if let Some(standing) = edge.max(missed) {
            self.tally.mark(&[Fault::AiCommsFault.requirement()], standing);
        }
    }

    /// A flag was raised: could its reason have been there?
    pub(in crate::judge) fn exercise_flag(&mut self, fault: Fault, reason: Truth) {
        let standing = match reason {
            Truth::True => Standing::Held,
            // Which is a finding.
            _ => Standing::NotCertain,
        };
        self.tally.mark(&[fault.requirement()], standing);
    }

    /// The AI Computer declared FINISHED in AS_DRIVING, at rest as far as is known.
    pub(in crate::judge) fn exercise_finished(&mut self) {
        self.tally.mark(&[FINISHES_AT_REST], Standing::Held);
    }

    /// What is known of the messages is forgotten; that they came is not.
    pub(in crate::judge) fn exercise_forgotten(&mut self, est: &Estimator) {
        let (ai, vcu) = self.tally.heard;
        self.tally.heard = (ai || est.sampler.heard(Node::Ai), vcu || est.sampler.heard(Node::Vcu));
    }

    /// What the recording exercised.
    pub(in crate::judge) fn exercised(&mut self, est: &Estimator) -> Exercised {
        self.exercise_forgotten(est);
        let tally = std::mem::take(&mut self.tally);
        let (ai, vcu) = tally.heard;
        let answers = self.out.responses.count() > 0;
        Exercised { ai, vcu, states: tally.states(), requirements: tally.requirements(&est.edition, answers) }
    }
}

/// What an arrow is against that was taken and should not have been.
pub(in crate::judge) fn broken_by(
    est: &Estimator,
    from: AsState,
    to: AsState,
    decided: &[(Term, Knowledge)],
    window: Knowledge,
) -> Vec<&'static str> {
    let rows = est.edition.rules.table.rows();
    let overtaking = rows.iter().filter(|other| other.from == from && other.to != to).find_map(|other| {
        let (term, _) = decided.iter().find(|(term, _)| other.terms().contains(term))?;
        Some(of_term(other, term))
    });
    if let Some(broken) = overtaking {
        return broken;
    }
    let mut broken = row_of(&est.edition, from, to).map_or(Vec::new(), |row| row.cites.requirements.to_vec());
    let terms: Vec<Term> = est.readings.terms(from, to).copied().collect();
    for term in &terms {
        for (atom, needed) in term.literals() {
            let necessary = terms.iter().all(|other| other.on.has(atom) || other.off.has(atom));
            if necessary && window.of(atom) == Truth::from(!needed) {
                broken.extend(term.requirements_of(atom).unwrap_or_default());
            }
        }
    }
    let mut seen = std::collections::HashSet::new();
    broken.retain(|id| seen.insert(*id));
    broken
}
