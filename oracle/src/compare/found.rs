//! What only one of two recordings was found to do.

use super::Which;
use crate::judge::{Finding, Rule};

/// The findings of a rule about a party that only one recording has, of one severity.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundOnce<'a> {
    /// The recording that has them.
    pub which: Which,
    /// The first of them.
    pub first: &'a Finding,
    /// How many are listed in its report.
    pub count: u64,
}

/// What only one has: the gravest first, and of those as grave what is in the bad one.
pub(super) fn between<'a>(good: &'a [Finding], bad: &'a [Finding]) -> Vec<FoundOnce<'a>> {
    let alike = |one: &Finding, other: &Finding| {
        (one.rule, one.party, one.severity) == (other.rule, other.party, other.severity)
    };
    let mut found: Vec<FoundOnce<'_>> = Vec::new();
    for (which, own, others) in [(Which::Bad, bad, good), (Which::Good, good, bad)] {
        for first in own.iter().filter(|finding| finding.rule != Rule::Repeated) {
            let known = found.iter_mut().find(|known| known.which == which && alike(known.first, first));
            if let Some(known) = known {
                known.count += 1;
            } else if !others.iter().any(|other| alike(other, first)) {
                found.push(FoundOnce { which, first, count: 1 });
            }
        }
    }
    found.sort_by_key(|found| found.first.severity);
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::{Party, Severity};

    #[test]
    fn what_both_have_is_left_out_and_the_gravest_comes_first() {
        let finding = |t_ns, severity, rule| Finding::new(severity, Party::Vcu, "3", rule, t_ns);
        let gap = |t_ns| finding(t_ns, Severity::Note, Rule::Gap);
        let due = |t_ns| finding(t_ns, Severity::Violation, Rule::Due);
        let value = |t_ns| finding(t_ns, Severity::Warning, Rule::Value);
        let (good, bad) = ([gap(0), value(1), value(5)], [gap(2), gap(3), due(4), due(7)]);
        let found = between(&good, &bad);
        let summary: Vec<_> =
            found.iter().map(|found| (found.which, found.first.t_ns, found.count)).collect();
        assert_eq!(summary, [(Which::Bad, 4, 2), (Which::Good, 1, 2)]);
        assert_eq!(between(&bad, &bad), []);
    }
}
