//! `never P for T` and `P for at most T`.

use adsdv_spec::Truth;

use super::RuleOutcome;

/// Something that must not last longer than a time.
#[derive(Clone, Debug)]
pub(in crate::rules) struct Lasting {
    most: i64,
    before: Truth,
    /// Up to when it was known to be false.
    false_until: Option<i64>,
    /// Since when it has been true without an interruption.
    since: Option<i64>,
    /// Whether it has been true since it was known to be false.
    began: bool,
    /// Whether it was reported that it lasted too long.
    reported: bool,
}

impl Lasting {
    pub(super) const fn new(most: i64) -> Self {
        Self { most, before: Truth::Unknown, false_until: None, since: None, began: false, reported: false }
    }

    pub(super) fn pass(&mut self, t: i64, out: &mut impl FnMut(RuleOutcome)) {
        let over = self.since.map(|since| since.saturating_add(self.most)).filter(|over| *over < t);
        if let Some(over) = over.filter(|_| !self.reported) {
            self.reported = true;
            out(RuleOutcome::Broken(over));
        }
    }

    pub(super) fn step(&mut self, t: i64, now: Truth, out: &mut impl FnMut(RuleOutcome)) {
        if self.before == Truth::False {
            self.false_until = Some(t);
        }
        match now {
            Truth::True => {
                self.since = self.since.or(Some(t));
                self.began = true;
            }
            Truth::Unknown => self.since = None,
            Truth::False => {
                if self.began && !self.reported {
                    // It may have begun as soon as it was not known to be false any more.
                    let in_time = self.false_until.is_some_and(|began| t.saturating_sub(began) <= self.most);
                    out(if in_time { RuleOutcome::Held } else { RuleOutcome::Unknown });
                }
                (self.since, self.began, self.reported) = (None, false, false);
            }
        }
        self.before = now;
    }

    pub(super) fn end(&mut self, out: &mut impl FnMut(RuleOutcome)) {
        if self.began && !self.reported {
            out(RuleOutcome::Ended);
        }
    }
}
