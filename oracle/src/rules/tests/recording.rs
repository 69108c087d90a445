//! Rules on frames: what a message says counts as long as the judge lets it.

use adsdv_spec::messages::Frame;
use adsdv_spec::messages::{Vcu2AiWheelSpeeds, WheelSpeed};
use adsdv_spec::{Control, Edition, Inputs, Machine, Vehicle};

use super::super::{RuleReport, RuleVerdict};
use crate::candump::{FrameKind, Reader, Record};
use crate::judge::{JudgeOptions, Party, Report, Rule, Section, Severity};
use crate::log::{LogError, LogJudge, LogOptions, judge_log, judge_recognised};

const MS: i64 = 1_000_000;

fn options(edition: &'static Edition, rules: &str) -> LogOptions {
    let rules = Some(rules.parse().expect(rules));
    LogOptions { judge: JudgeOptions::of(edition), rules, ..LogOptions::default() }
}

fn record(time_ns: i64, frame: &Frame) -> Record<'_> {
    Record {
        line: 0,
        time_ns,
        interface: "can0",
        kind: FrameKind::Standard,
        id: frame.id.into(),
        data: frame.data(),
        direction: None,
        terminated: true,
    }
}

/// The frames of a second of a car that is switched on, every 10 ms: `ASMS` goes on at 500 ms, and a wheel turns every other time.
fn frames() -> Vec<(i64, Frame)> {
    let vcu = Machine::REFERENCE;
    let mut control = Control::INITIAL;
    let mut frames = Vec::new();
    for cycle in 0..100 {
        let fl_wheel_speed = WheelSpeed::clamped(8 * (cycle % 2));
        let wheel_speeds = Vcu2AiWheelSpeeds { fl_wheel_speed, ..Vcu2AiWheelSpeeds::default() };
        let vehicle = Vehicle { wheel_speeds, ..Vehicle::default() };
        let inputs = Inputs { asms: cycle >= 50, vehicle, ..Inputs::default() };
        let (next, outputs) = vcu.step(&control, &inputs, 10);
        control = next;
        let sent = outputs.messages(&inputs).frames(&vcu.edition().bus).collect::<Vec<_>>();
        frames.extend(sent.into_iter().map(|frame| (i64::from(cycle) * 10 * MS, frame)));
    }
    frames
}

fn judged(rules: &str, frames: &[(i64, Frame)]) -> Report {
    judged_by(options(Edition::DEFAULT, rules), frames)
}

fn judged_by(options: LogOptions, frames: &[(i64, Frame)]) -> Report {
    let mut judge = LogJudge::new(options);
    for (t, frame) in frames {
        judge.frame(&record(*t, frame));
    }
    judge.finish(0).expect("frames came")
}

fn only(report: &Report) -> &RuleReport {
    let [rule] = &report.rules[..] else { panic!("{:?}", report.rules) };
    rule
}

#[test]
fn a_broken_rule_is_a_violation_of_the_users_own() {
    let report = judged("\nno-asms: never ASMS on or as_switch_status is ON \"we push it\"", &frames());
    let rule = only(&report);
    assert_eq!((rule.name.as_str(), rule.line, rule.held, rule.broken), ("no-asms", 2, 1, 1));
    assert_eq!(rule.breaches[0].t_ns, 500 * MS);
    let found: Vec<_> = report.findings.iter().filter(|finding| finding.rule == Rule::Custom).collect();
    let [finding] = found[..] else { panic!("{found:?}") };
    assert_eq!((finding.t_ns, finding.severity, finding.party), (500 * MS, Severity::Violation, Party::Own));
    assert_eq!(finding.section, Section::Line(2));
    let message = "no-asms (we push it): AS master switch ON, AS_SWITCH_STATUS is ON; expected never ASMS on or as_switch_status is ON";
    assert_eq!(finding.message(), message);
}

/// The message that is named is gone for a while: what it would have said is unknown then.
#[test]
fn a_message_that_is_late_makes_its_signals_unknown() {
    let rules = "a: always as_switch_status is OFF or go_signal is GO\nb: after ASMS on, go_signal is GO within 200 ms";
    let all = frames();
    let whole = judged(rules, &all);
    let verdicts = |report: &Report| report.rules.iter().map(RuleReport::verdict).collect::<Vec<_>>();
    assert_eq!(verdicts(&whole), [RuleVerdict::Broken, RuleVerdict::Broken]);
    let is_status = |frame: &Frame| frame.id == 0x520;
    let gone = |from: i64, to: i64| -> Vec<(i64, Frame)> {
        let gone = |t: i64, frame: &Frame| is_status(frame) && (from * MS..to * MS).contains(&t);
        all.iter().filter(|(t, frame)| !gone(*t, frame)).copied().collect()
    };
    let late = judged(rules, &gone(600, 640));
    assert_eq!(verdicts(&late), [RuleVerdict::Broken, RuleVerdict::Undecided]);
    let why =
        "something that it goes by was unknown each time: a frame may be missing; if none is, say --complete";
    assert_eq!(late.rules[1].why.as_deref(), Some(why));
    // Who vouches for the recording has it decided.
    let complete = JudgeOptions { complete: true, ..JudgeOptions::of(Edition::DEFAULT) };
    let vouched =
        judged_by(LogOptions { judge: complete, ..options(Edition::DEFAULT, rules) }, &gone(600, 640));
    assert_eq!(verdicts(&vouched), [RuleVerdict::Broken; 2]);
    let never = judged(rules, &gone(0, 1000));
    assert_eq!(verdicts(&never), [RuleVerdict::Undecided; 2]);
    assert_eq!(never.rules[0].why.as_deref(), Some("VCU2AI_Status (520h) never showed AS_SWITCH_STATUS"));
    assert_eq!(never.rules[1].why.as_deref(), Some("it was never known whether AS master switch ON (asms)"));
    let ends = judged(rules, &gone(690, 1000));
    assert_eq!(ends.rules[1].verdict(), RuleVerdict::Undecided);
}

/// What became unknown and known again between two frames was unknown.
#[test]
fn a_gap_in_which_no_frame_comes_is_seen() {
    let rules = "a: after as_switch_status is ON, go_signal is GO within 200 ms\nb: after ASMS on, TSMS on within 200 ms";
    let status: Vec<_> = frames().into_iter().filter(|(_, frame)| frame.id == 0x520).collect();
    let verdicts = |frames: &[(i64, Frame)]| {
        judged(rules, frames).rules.iter().map(RuleReport::verdict).collect::<Vec<_>>()
    };
    assert_eq!(verdicts(&status), [RuleVerdict::Broken; 2]);
    let gap: Vec<_> = status.iter().filter(|(t, _)| *t != 600 * MS).copied().collect();
    assert_eq!(verdicts(&gap), [RuleVerdict::Undecided; 2]);
}

#[test]
fn nothing_is_known_across_frames_that_were_lost() {
    let rules = "b: after ASMS on, go_signal is GO within 200 ms";
    let mut judge = LogJudge::new(options(Edition::DEFAULT, rules));
    // With nothing else on the bus, the frame behind the loss tells all again.
    for (t, frame) in frames().into_iter().filter(|(_, frame)| frame.id == 0x520) {
        if t == 600 * MS {
            judge.lost(1);
        }
        judge.frame(&record(t, &frame));
    }
    let report = judge.finish(0).expect("frames came");
    assert_eq!(only(&report).verdict(), RuleVerdict::Undecided, "{:?}", report.rules);
}

/// Frames that are lost at random never break a rule that was kept, nor the other way.
#[test]
fn frames_that_are_lost_turn_no_verdict_to_its_opposite() {
    let rules = "\
answered: after ASMS on, AS_SWITCH_STATUS is ON within 100 ms
unanswered: after ASMS on, go_signal is GO within 100 ms
stays: after AS_SWITCH_STATUS is ON, ASMS on for 100 ms
goes: after AS_SWITCH_STATUS is ON, ASMS off for 100 ms
short: never FL_WHEEL_SPEED > 5 rpm for 25 ms
ends: ASMS off until AS_SWITCH_STATUS is ON
";
    let all = frames();
    let whole = judged(rules, &all);
    let expected = ["holds", "broken", "holds", "broken", "holds", "holds"];
    assert!(whole.rules.iter().map(|rule| rule.verdict().name()).eq(expected), "{:#?}", whole.rules);
    let mut random = super::parse::numbers(3);
    let mut decided = 0;
    for _ in 0..200 {
        let one_in = 5 + random(60);
        // How often the messages come is learnt from the first frames.
        let some: Vec<_> = all.iter().filter(|(t, _)| *t < 200 * MS || random(one_in) > 0).copied().collect();
        for (rule, expected) in judged(rules, &some).rules.iter().zip(expected) {
            let verdict = rule.verdict();
            assert!(verdict == RuleVerdict::Undecided || verdict.name() == expected, "{rule:#?}");
            decided += usize::from(verdict != RuleVerdict::Undecided);
        }
    }
    assert!(decided > 600, "{decided} of 1200 are decided");
}

#[test]
fn time_that_passes_without_a_frame_ends_a_bound() {
    let begun = |rules, complete| {
        let mut options = options(Edition::DEFAULT, rules);
        options.judge.complete = complete;
        let mut judge = LogJudge::new(options);
        let until = 510 * MS;
        for (t, frame) in frames().iter().filter(|(t, _)| *t <= until) {
            judge.frame(&record(*t, frame));
        }
        judge
    };
    let broken = |judge: &mut LogJudge| {
        let findings = judge.news().1;
        findings.iter().filter(|one| one.rule == Rule::Custom).map(|one| one.t_ns).collect::<Vec<_>>()
    };
    let mut judge = begun("a: after ASMS on, TSMS on within 12 ms", false);
    assert_eq!(broken(&mut judge), [0; 0]);
    judge.time_passes(600 * MS);
    assert_eq!(broken(&mut judge), [512 * MS]);
    let mut judge = begun("a: never ASMS on for 400 ms", true);
    judge.time_passes(2000 * MS);
    assert_eq!(broken(&mut judge), [900 * MS], "what was shown last counts for half a second");
}

#[test]
fn breaches_beyond_twenty_are_counted() {
    let report = judged("a: never FL_WHEEL_SPEED >= 8", &frames());
    let rule = only(&report);
    assert!(rule.broken > 20 && rule.breaches.len() == 20, "{rule:?}");
    let listed = report.findings.iter().filter(|finding| finding.rule == Rule::Custom).count();
    assert_eq!(listed, 20);
}

#[test]
fn a_rule_that_nothing_decides_says_why() {
    let cases = [
        ("after go_signal is GO, ASMS on within 1 s", "what it waits for never came"),
        ("after ASMS on, TSMS on within 3 s", "the recording ends before it is decided"),
        (
            "after not TSMS on, GO_SIGNAL is GO within 3 s",
            "what it waits for was so from the beginning, and never became so",
        ),
        ("TSMS on for at most 1 s", "what must not last never began"),
        ("always sdc-open", "it was never known whether SDC open (sdc-open)"),
        ("always 510h.HANDSHAKE on", "AI2VCU_Status (510h) never showed HANDSHAKE"),
        ("always TSMS on or sdc-open", "it was never known whether SDC open (sdc-open)"),
    ];
    for (rule, why) in cases {
        let report = judged(&format!("a: {rule}"), &frames());
        assert_eq!(only(&report).why.as_deref(), Some(why), "{rule}: {:?}", report.rules);
        assert_eq!(only(&report).verdict(), RuleVerdict::Undecided);
    }
}

/// As long as the frames may speak any edition, so may the rules; then they have to be of that one.
#[test]
fn rules_are_of_the_edition_that_is_recognised() {
    let line = |n| format!("({}.{:02}) can0 524#0000000011\n", n / 100, n % 100);
    let log = (0..400).map(line).collect::<Vec<_>>().concat();
    let rules = "a: never STATUS_EBS is ARMED";
    let judged = judge_recognised(Reader::new(log.as_bytes()), &options(&Edition::V3_0, rules), |_| {})
        .expect("possible");
    assert!(judged.recognised.edition.version != "3.0" && only(&judged.report).broken == 0);
    let endless = std::io::Read::chain(log.as_bytes(), std::io::repeat(b'\n'));
    let error = judge_log(endless, &options(&Edition::V3_0, rules), |_| {}).expect_err("not in 3.0");
    assert!(matches!(&error, LogError::Rules(error) if error.first().column == 10), "{error}");
}
