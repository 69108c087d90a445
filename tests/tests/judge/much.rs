//! What is reported once, and what is only counted because there is too much of it.

use adsdv_oracle::judge::{Finding, Judge, JudgeOptions, Party, Report, Rule, Severity};
use adsdv_spec::messages::{AsState, Vcu2AiStatus};
use adsdv_tests::bus::{BUS, encoded};
use adsdv_tests::world::MS;

fn of(report: &Report, rule: Rule) -> Vec<&Finding> {
    report.findings.iter().filter(|finding| finding.rule == rule).collect()
}

//= ID-1, ID-2
#[test]
fn each_reserved_identifier_is_reported_once_for_each_sender() {
    let reserved: Vec<u16> = (0..0x800).filter(|&id| BUS.is_reserved(id)).take(2).collect();
    let mut judge = Judge::new(JudgeOptions::default());
    for t in 0..3 {
        for &id in &reserved {
            judge.frame(t * MS, id.into(), &[]);
            judge.sent_by_ai(t * MS, id.into());
        }
    }
    let report = judge.finish();
    let reported: Vec<(Severity, Party)> =
        of(&report, Rule::Reserved).iter().map(|finding| (finding.severity, finding.party)).collect();
    let (seen, sent) = ((Severity::Note, Party::Log), (Severity::Violation, Party::Ai));
    assert_eq!(reported, [seen, sent, seen, sent]);
}

#[test]
fn a_message_of_the_vcu_that_the_ai_computer_sends_is_reported_once() {
    let mut judge = Judge::new(JudgeOptions::default());
    for t in 0..3 {
        judge.sent_by_ai(t * MS, Vcu2AiStatus::ID.into());
    }
    let report = judge.finish();
    let [finding] = of(&report, Rule::Sender)[..] else { panic!("{:#?}", report.findings) };
    assert_eq!((finding.party, finding.severity, finding.t_ns), (Party::Ai, Severity::Violation, 0));
}

/// Transitions without end, one with each frame.
fn transitions(count: usize) -> Report {
    let mut judge = Judge::new(JudgeOptions::default());
    for (place, t) in (0..=count).zip(0..) {
        let as_state = if place % 2 == 0 { AsState::Off } else { AsState::Finished };
        let frame = encoded(Vcu2AiStatus { as_state, ..Vcu2AiStatus::default() });
        judge.frame(t * 10 * MS, frame.id.into(), frame.data());
    }
    judge.finish()
}

#[test]
fn transitions_are_listed_to_a_bound() {
    const MOST: usize = 50_000;
    for (count, listed, left_out) in [
        (MOST - 1, MOST - 1, None),
        (MOST, MOST, None),
        (MOST + 3, MOST, Some("3 more transitions, not listed")),
    ] {
        let report = transitions(count);
        assert_eq!(report.transitions.len(), listed);
        let note = report.findings.iter().find(|finding| finding.message().contains("more transitions"));
        assert_eq!(note.map(|note| note.seen.as_str()), left_out);
    }
}

/// Where nobody asks for news, no more of them are kept than there are rules.
#[test]
fn news_that_nobody_asks_for_are_kept_to_a_bound() {
    const LISTED: usize = 200;
    let mut judge = Judge::new(JudgeOptions::default());
    for second in 0..1000 {
        judge.other_frame(second * 1000 * MS);
        judge.found(Finding::violation(Party::Vcu, "2", Rule::Value, second * 1000 * MS).seen("again"));
    }
    let (_, news) = judge.news();
    assert_eq!(news.len(), LISTED + Rule::ALL.len());
    assert!(judge.news().1.is_empty());
    let report = judge.finish();
    let [repeated] = of(&report, Rule::Repeated)[..] else { panic!("{:#?}", report.findings) };
    assert!(repeated.message().starts_with("800 more of "), "{}", repeated.message());
    assert_eq!((of(&report, Rule::Value).len(), repeated.t_ns), (LISTED, 200_000 * MS));
}
