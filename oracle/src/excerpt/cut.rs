//! Cuts an excerpt, and judges it.

use std::collections::BTreeSet;

use super::Cut;
use super::recent::{LogLine, Recent};
use crate::judge::{Finding, Party};
use crate::log::{LogOptions, judge_readable};

/// How much before a finding, and behind it, is tried one after the other, in milliseconds.
const WIDTHS_MS: [(i64, i64); 4] = [(200, 200), (1000, 1000), (5000, 2000), (20_000, 5000)];
/// What may follow a finding.
pub(super) const AFTER_NS: i64 = WIDTHS_MS[3].1 * MS;
/// A finding of an excerpt that is further away than this from that of the log is another one.
const SAME_NS: i64 = 100 * MS;
/// So many identifiers are tried: a bus has fewer.
const IDS: usize = 64;
const MS: i64 = 1_000_000;

/// The frames around a finding: as few as show it, or the most that are tried.
pub(super) fn cut(recent: &Recent, finding: Finding, options: &LogOptions) -> Cut {
    // Another message that is missing is another finding; but words may depend on what came before.
    for same in [has_the_words, is_alike] {
        for (before, after) in WIDTHS_MS.map(|(before, after)| (before * MS, after * MS)) {
            let lines = recent.between(finding.t_ns - before, finding.t_ns + after);
            let shows = |lines: &[LogLine]| shows(lines, &finding, options, same);
            if shows(&lines) {
                let lines = thinned(lines, shows);
                return of(finding, &lines, before, true);
            }
        }
    }
    let [.., (before, after)] = WIDTHS_MS;
    let widest = recent.between(finding.t_ns - before * MS, finding.t_ns + after * MS);
    of(finding, &widest, before * MS, false)
}

/// Whether two findings are of the same rule, party, section and severity.
fn is_alike(one: &Finding, other: &Finding) -> bool {
    (one.rule, one.party, one.section, one.severity)
        == (other.rule, other.party, other.section, other.severity)
}

/// Whether they also say the same, but for numbers. What is said of a log names its lines.
fn has_the_words(one: &Finding, other: &Finding) -> bool {
    let words = |finding: &Finding| finding.message().replace(|c: char| c.is_ascii_digit(), "");
    is_alike(one, other) && (one.party == Party::Log || words(one) == words(other))
}

fn of(finding: Finding, lines: &[LogLine], before_ns: i64, shows: bool) -> Cut {
    Cut { finding, log: text(lines), frames: lines.len(), before_ns, shows }
}

fn text(lines: &[LogLine]) -> Vec<u8> {
    lines.iter().flat_map(|line| line.text.iter().copied()).collect()
}

/// Whether these lines alone give the finding, or one that is the same, at that time.
fn shows(
    lines: &[LogLine],
    finding: &Finding,
    options: &LogOptions,
    same: fn(&Finding, &Finding) -> bool,
) -> bool {
    let Some(begin) = lines.iter().find(|line| line.id.is_some()).map(|line| line.t_ns) else { return false };
    let Ok((report, _)) = judge_readable(text(lines).as_slice(), options, |_| {}) else { return false };
    let at = |found: &Finding| begin + found.t_ns;
    report.findings.iter().any(|found| same(found, finding) && (at(found) - finding.t_ns).abs() <= SAME_NS)
}

/// The same without the identifiers that the finding does not need.
fn thinned(mut lines: Vec<LogLine>, shows: impl Fn(&[LogLine]) -> bool) -> Vec<LogLine> {
    let ids: BTreeSet<Option<u32>> = lines.iter().map(|line| line.id).collect();
    for id in ids.into_iter().take(IDS) {
        let fewer: Vec<LogLine> = lines.iter().filter(|line| line.id != id).cloned().collect();
        if shows(&fewer) {
            lines = fewer;
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::Rule;

    #[test]
    fn numbers_may_differ_and_words_may_not() {
        let finding =
            |party, message: &str| Finding::violation(party, "2", Rule::MessageMissed, 0).seen(message);
        let (drive, steer) =
            ("Drive (511h) has not come for 1036 ms", "Steer (513h) has not come for 1036 ms");
        let later = finding(Party::Ai, &drive.replace("1036", "1021"));
        assert!(has_the_words(&finding(Party::Ai, drive), &later));
        assert!(!has_the_words(&finding(Party::Ai, drive), &finding(Party::Ai, steer)));
        assert!(is_alike(&finding(Party::Ai, drive), &finding(Party::Ai, steer)));
        assert!(has_the_words(&finding(Party::Log, drive), &finding(Party::Log, steer)));
        assert!(!is_alike(&finding(Party::Vcu, drive), &later));
    }
}
