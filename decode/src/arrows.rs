//! The arrows of Figure 2 over time, for the formats that show what blocks them.

use adsdv_oracle::why::{Blocked, Condition, Stay, Untaken};
use adsdv_spec::{AsState, Atom, Edition, Term};

/// An arrow of Figure 2, with the conditions of its guard.
#[derive(Debug)]
pub(crate) struct GuardedArrow {
    pub(crate) from: AsState,
    pub(crate) to: AsState,
    /// Each condition, with what it has to be; in the order of the atoms.
    pub(crate) conditions: Vec<(Atom, bool)>,
}

/// What is known of an arrow now.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ArrowNow<'a> {
    /// Whether its guard fails; `None` while the VCU is in another state than where it begins, or in none that is known.
    pub(crate) blocked: Option<bool>,
    /// What makes it fail.
    pub(crate) by: Option<&'a Blocked>,
}

impl GuardedArrow {
    /// Those of an edition.
    pub(crate) fn all(edition: &Edition) -> Vec<Self> {
        let rows = edition.rules.table.rows().iter();
        rows.map(|row| {
            let mut conditions: Vec<_> = row.terms().iter().flat_map(Term::literals).collect();
            conditions.sort_unstable();
            conditions.dedup();
            Self { from: row.from, to: row.to, conditions }
        })
        .collect()
    }

    /// Such as `AS_OFF_to_AS_READY`.
    pub(crate) fn name(&self) -> String {
        format!("{}_to_{}", self.from.name(), self.to.name())
    }

    /// What is known of it, by the state that lasts.
    pub(crate) fn now<'a>(&self, stay: Option<&'a Stay>) -> ArrowNow<'a> {
        let stay = stay.filter(|stay| stay.state == self.from);
        let untaken = stay.and_then(|stay| stay.arrows.iter().find(|untaken| untaken.to == self.to));
        let by = untaken.and_then(now);
        ArrowNow { blocked: untaken.map(|_| by.is_some()), by }
    }

    /// Whether a condition of it is as the arrow needs it; `None` if the bus does not tell, or another alternative of the guard is
    /// nearer.
    pub(crate) fn holds(&self, (atom, needed): (Atom, bool), now: ArrowNow<'_>) -> Option<bool> {
        let by = now.by?;
        let is_this = |one: &Condition| (one.atom, one.needed) == (atom, needed);
        if by.failed.iter().any(is_this) {
            return Some(false);
        }
        // What holds is named without what it has to be, which counts where the guard asks for both.
        let is_both = self.conditions.iter().filter(|(other, _)| *other == atom).count() > 1;
        (by.holding.has(atom) && !is_both).then_some(true)
    }
}

/// A condition as an identifier of other tools: `asms`, `not_ebs_armed`.
pub(crate) fn condition_name((atom, needed): (Atom, bool)) -> String {
    let not = if needed { "" } else { "not_" };
    format!("{not}{}", atom.id().replace('-', "_"))
}

/// What blocks an arrow now; `None` where its guard holds.
pub(crate) fn now(arrow: &Untaken) -> Option<&Blocked> {
    arrow.blocked.last().filter(|blocked| blocked.until_ns == i64::MAX)
}
