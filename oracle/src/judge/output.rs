//! What the judge has said, in bounded memory.

use std::collections::HashSet;

use super::finding::{Finding, Party, Rule};
use super::report::{Report, Transition};
use super::response::ResponseTimes;

/// Findings of one rule beyond this many are counted, not listed.
const MAX_FINDINGS: usize = 200;
/// So long after a finding that is counted and not listed, another of its rule is news.
const NEWS_NS: i64 = 1_000_000_000;
/// Transitions beyond this many are counted, not listed.
const MAX_TRANSITIONS: usize = 50_000;

/// Transitions, findings and times, and what was left out of them.
#[derive(Debug)]
pub(super) struct Output {
    transitions: Vec<Transition>,
    findings: Vec<Finding>,
    listed: Vec<usize>,
    left_out: Vec<Option<LeftOut>>,
    /// Findings that are news, and not listed: no more than there are rules.
    unlisted: Vec<Finding>,
    transitions_left_out: u64,
    /// How many transitions and findings have been handed out as news.
    handed_out: (usize, usize),
    /// Identifiers that have been reported, once for nobody and once for the AI Computer.
    reported_ids: [HashSet<u32>; 2],
    pub(super) responses: ResponseTimes,
}

/// Findings of one rule that are counted, not listed.
#[derive(Clone, Debug)]
struct LeftOut {
    count: u64,
    first: Finding,
    /// When the next one is news.
    news_at: i64,
}

impl Default for Output {
    fn default() -> Self {
        Self {
            transitions: Vec::new(),
            findings: Vec::new(),
            listed: vec![0; Rule::ALL.len()],
            left_out: vec![None; Rule::ALL.len()],
            unlisted: Vec::new(),
            transitions_left_out: 0,
            handed_out: (0, 0),
            reported_ids: [HashSet::new(), HashSet::new()],
            responses: ResponseTimes::default(),
        }
    }
}

impl Output {
    pub(super) fn finding(&mut self, finding: Finding) {
        let rule = finding.rule as usize;
        match (self.listed.get_mut(rule), self.left_out.get_mut(rule)) {
            (Some(listed), _) if *listed < MAX_FINDINGS => {
                *listed += 1;
                self.findings.push(finding);
            }
            (_, Some(Some(left_out))) => {
                left_out.count += 1;
                if finding.t_ns >= left_out.news_at && self.unlisted.len() < Rule::ALL.len() {
                    left_out.news_at = finding.t_ns.saturating_add(NEWS_NS);
                    self.unlisted.push(finding);
                }
            }
            (_, Some(none)) => {
                let news_at = finding.t_ns.saturating_add(NEWS_NS);
                *none = Some(LeftOut { count: 1, first: finding.clone(), news_at });
                let seen = format!(
                    "further findings of {} are counted, and no longer listed; one in a second is reported",
                    finding.rule.id()
                );
                self.unlisted.push(repeated(&finding, seen));
            }
            _ => {}
        }
    }

    pub(super) fn transition(&mut self, transition: Transition) {
        if self.transitions.len() < MAX_TRANSITIONS {
            self.transitions.push(transition);
        } else {
            self.transitions_left_out += 1;
        }
    }

    /// Whether this reserved identifier comes up for the first time. There are few, so the set stays small.
    pub(super) fn first_of_id(&mut self, id: u32) -> bool {
        self.reported_ids[0].insert(id)
    }

    /// Whether it comes up for the first time as one that the AI Computer sent.
    pub(super) fn first_by_ai(&mut self, id: u32) -> bool {
        self.reported_ids[1].insert(id)
    }

    /// What is new since this was last asked.
    pub(super) fn news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        let handed_out =
            std::mem::replace(&mut self.handed_out, (self.transitions.len(), self.findings.len()));
        let mut findings = self.findings.get(handed_out.1..).unwrap_or_default().to_vec();
        findings.append(&mut self.unlisted);
        findings.sort_by_key(|finding| finding.t_ns);
        let mut transitions = self.transitions.get(handed_out.0..).unwrap_or_default().to_vec();
        transitions.sort_by_key(|transition| transition.t_ns);
        (transitions, findings)
    }

    pub(super) fn take(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.listed.fill(0);
        self.handed_out = (0, 0);
        self.unlisted.clear();
        (std::mem::take(&mut self.transitions), std::mem::take(&mut self.findings))
    }

    pub(super) fn report(mut self, frames: u64, duration_ns: i64) -> Report {
        for LeftOut { count, first, .. } in std::mem::take(&mut self.left_out).into_iter().flatten() {
            let seen = format!("{count} more of {} from here on, not listed", first.rule.id());
            self.findings.push(repeated(&first, seen));
        }
        if self.transitions_left_out > 0 {
            let seen = format!("{} more transitions, not listed", self.transitions_left_out);
            self.findings.push(Finding::note(Party::Log, "3", Rule::Repeated, duration_ns).seen(seen));
        }
        self.findings.sort_by_key(|finding| finding.t_ns);
        self.transitions.sort_by_key(|transition| transition.t_ns);
        // A frame that was on its way while `time_passes` was called is judged when it comes, which is later than it was sent.
        let finding = self.findings.last().map(|finding| finding.t_ns);
        let transition = self.transitions.last().map(|transition| transition.t_ns);
        let latest = finding.max(transition).unwrap_or(duration_ns);
        Report {
            frames,
            duration_ns: duration_ns.max(latest),
            transitions: self.transitions,
            findings: self.findings,
            responses: self.responses,
            stays: Vec::new(),
            go_presses: Vec::new(),
            margins: Vec::new(),
            exercised: super::Exercised::default(),
            rules: Vec::new(),
        }
    }
}

/// What is said of findings of one rule that are not listed.
fn repeated(first: &Finding, seen: String) -> Finding {
    Finding::new(first.severity, first.party, first.section, Rule::Repeated, first.t_ns).seen(seen)
}
