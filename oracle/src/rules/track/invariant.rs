//! `always P` and `never P`.

use adsdv_spec::Truth;

use super::RuleOutcome;

/// Something that is to be so all the time.
#[derive(Clone, Debug)]
pub(in crate::rules) struct Invariant {
    /// What it is to be.
    wanted: Truth,
    /// What was known of it last, but for unknown.
    last: Truth,
}

impl Invariant {
    pub(super) const fn new(wanted: Truth) -> Self {
        Self { wanted, last: Truth::Unknown }
    }

    pub(super) fn step(&mut self, t: i64, now: Truth, out: &mut impl FnMut(RuleOutcome)) {
        if now == Truth::Unknown || now == self.last {
            return;
        }
        self.last = now;
        out(if now == self.wanted { RuleOutcome::Held } else { RuleOutcome::Broken(t) });
    }
}
