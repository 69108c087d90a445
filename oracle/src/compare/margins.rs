//! How close each of two recordings came to its limits: what got worse.

use std::cmp::Ordering;

use crate::judge::{Basis, Margin, Measure};

/// From this share of the limit on a margin is another.
const SHARE: f64 = 0.1;
/// A cycle is no limit, and recorders shift frames: from so many cycles on.
const CYCLES: f64 = 1.0;

/// One measure in both recordings; there is none of it where it never came up, but in one there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarginDiffers<'a> {
    /// In the good one.
    pub good: Option<&'a Margin>,
    /// In the bad one.
    pub bad: Option<&'a Margin>,
}

impl<'a> MarginDiffers<'a> {
    /// The margin of one of them, the bad one if both have it.
    pub const fn either(&self) -> Option<&'a Margin> {
        match self.bad {
            Some(bad) => Some(bad),
            None => self.good,
        }
    }

    /// By which share of the limit less was left in the bad recording, negative if more was; `None` if only one has it.
    pub fn worse_by(&self) -> Option<f64> {
        Some(self.good?.left() - self.bad?.left())
    }

    /// Whether the bad recording came closer to the limit, or went further past it, by so much that it matters: a tenth of the limit,
    /// a whole cycle where there is no limit, or where only one is past the limit.
    pub fn got_worse(&self) -> bool {
        self.worse_by().is_some_and(|by| self.matters(by))
    }

    /// The same of the good recording.
    pub fn got_better(&self) -> bool {
        self.worse_by().is_some_and(|by| self.matters(-by))
    }

    fn matters(&self, by: f64) -> bool {
        let sides = [self.good, self.bad].map(|margin| margin.map(|margin| margin.left() < 0.0));
        let is_cycle = self.either().is_some_and(|margin| margin.basis == Basis::Cycle);
        by >= if is_cycle { CYCLES } else { SHARE } || by > 0.0 && sides[0] != sides[1] && !is_cycle
    }

    /// What got worse first, the most of all before the others; what only one has last.
    fn order(&self, other: &Self) -> Ordering {
        let by = |one: &Self| one.worse_by().unwrap_or(f64::NEG_INFINITY);
        other.got_worse().cmp(&self.got_worse()).then(by(other).total_cmp(&by(self)))
    }
}

/// All measures that one of two reports has, what got notably worse first.
pub(super) fn between<'a>(good: &'a [Margin], bad: &'a [Margin]) -> Vec<MarginDiffers<'a>> {
    let of = |margin: &Margin| -> (Measure, Option<u16>) { (margin.what, margin.message) };
    let find = |all: &'a [Margin], one: &Margin| all.iter().find(|other| of(other) == of(one));
    let in_good = good.iter().map(|one| MarginDiffers { good: Some(one), bad: find(bad, one) });
    let only_bad = bad.iter().filter(|one| find(good, one).is_none());
    let only_bad = only_bad.map(|one| MarginDiffers { good: None, bad: Some(one) });
    let mut margins: Vec<_> = in_good.chain(only_bad).collect();
    margins.sort_by(MarginDiffers::order);
    margins
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::Party;

    fn margin(what: Measure, message: Option<u16>, value: f64, limit: f64) -> Margin {
        let basis = if message == Some(0x520) { Basis::Cycle } else { Basis::Document };
        let (section, requirements, unit) = ("2.4", Vec::new(), "ms");
        Margin { what, message, party: Party::Ai, section, requirements, value, limit, unit, basis, t_ns: 0 }
    }

    #[test]
    fn what_got_notably_worse_comes_first_and_what_only_one_has_last() {
        let gap = Measure::MessageGap;
        let both = |good, bad| {
            [
                margin(Measure::HandshakeAnswer, None, [17.0, 45.0][bad], 50.0),
                margin(gap, Some(0x510), [20.0, 29.0][bad], 100.0),
                margin(gap, Some(0x511), [98.0, 101.0][bad], 100.0),
                margin(gap, Some(0x520), [18.0, 27.0][bad], 10.0),
                margin(Measure::ReadyDwell, None, [7000.0, 5200.0][bad], 5000.0),
                margin(Measure::SteerAtGo, None, [4.0, 1.0][bad], 5.0),
                margin([Measure::FinishedSpeed, Measure::NeutralSpeed][good], None, 1.0, 10.0),
            ]
        };
        let (good, bad) = (both(0, 0), both(1, 1));
        let margins = between(&good, &bad);
        let order: Vec<_> =
            margins.iter().map(|one| one.either().map(|one| (one.what.id(), one.message))).collect();
        let ids =
            ["handshake-answer", "ready-dwell", "message-gap", "message-gap", "message-gap", "steer-at-go"];
        assert!(order.iter().take(6).map(|one| one.map(|one| one.0)).eq(ids.map(Some)), "{order:?}");
        assert!(
            margins
                .iter()
                .map(MarginDiffers::got_worse)
                .eq([true, true, true, false, false, false, false, false]),
            "{margins:#?}"
        );
        assert!(
            margins
                .iter()
                .map(MarginDiffers::got_better)
                .eq([false, false, false, false, false, true, false, false]),
            "{margins:#?}"
        );
        assert_eq!(margins[2].bad.and_then(|bad| bad.message), Some(0x511), "past the limit in one of them");
        assert!(margins[6..].iter().all(|one| one.worse_by().is_none()));
    }
}
