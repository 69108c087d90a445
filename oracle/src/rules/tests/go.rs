//! "Go" in rules: what every reading of `GO_SIGNAL` that is possible agrees on, or the remote control shows, is decided.

use adsdv_spec::messages::{AmiState, DirectionRequest, EbsState, Frame, MissionStatus, SpeedKmh};
use adsdv_spec::{Choice, Choices, Control, Edition, Inputs, Machine};

use super::super::{RuleReport, RuleVerdict};
use crate::judge::{Judge, JudgeOptions};
use crate::remote::{Remote, Switches};

const MS: i64 = 1_000_000;
/// When "Go" goes on, and when 520h shows that; one cycle more is for the step that sees it.
const GO_AT: i64 = 7_000;
/// When the vehicle is fast, and when the recording ends.
const FAST_AT: i64 = 9_000;
const END: i64 = 11_000;

/// What the frames of a run are like.
#[derive(Clone, Copy)]
struct Recorded {
    edition: &'static Edition,
    /// What this VCU's `GO_SIGNAL` is.
    sends: Choice,
    /// Whether the remote control is recorded, where the edition has it on the bus.
    remote: bool,
    /// Whether "Go" is ever switched on.
    goes: bool,
}

/// The frames of a run into AS_DRIVING, in which the AI Computer always answers.
fn frames(recorded: Recorded) -> Vec<(i64, Frame)> {
    let Recorded { edition, sends, remote, goes } = recorded;
    let vcu = Machine::new(*edition, edition.readings.with(sends));
    let (mut control, mut inputs, mut frames) = (Control::INITIAL, Inputs::default(), Vec::new());
    let remote = Remote::of(&edition.bus).filter(|_| remote);
    for t in (0..END).step_by(10) {
        inputs.tsms = t >= 200;
        inputs.asms = t >= 600;
        inputs.go = goes && t >= GO_AT;
        (inputs.ami, inputs.ebs) = (AmiState::TrackDrive, EbsState::Armed);
        let status = &mut inputs.ai.status;
        status.mission_status =
            if t < GO_AT + 500 { MissionStatus::Selected } else { MissionStatus::Running };
        status.direction_request =
            if t < GO_AT + 500 { DirectionRequest::Neutral } else { DirectionRequest::Forward };
        status.veh_speed_actual = SpeedKmh::clamped(if t < FAST_AT { 0 } else { 20 });
        let switches = Switches { go: inputs.go, estop: false };
        let shown = remote.and_then(|remote| remote.frame(switches, 100)).filter(|_| t > 0);
        frames.extend(shown.map(|frame| (t * MS - 2 * MS, frame)));
        let (next, outputs) = vcu.step(&control, &inputs, 10);
        control = next;
        let messages = outputs.messages(&inputs);
        frames.extend(messages.frames(&edition.bus).map(|frame| (t * MS, frame)));
        inputs.ai.status.handshake = messages.status.handshake;
        frames.extend(inputs.ai.frames(&edition.bus).map(|frame| (t * MS + 5 * MS, frame)));
    }
    frames
}

fn judged(recorded: Recorded, pins: &[Choice], rules: &str) -> Vec<RuleReport> {
    let open = JudgeOptions::of(recorded.edition);
    let readings = pins.iter().copied().fold(open.readings, Choices::pin);
    let mut judge = Judge::new(JudgeOptions { readings, ..open });
    judge.follow(&rules.parse().expect(rules)).expect(rules);
    for (t, frame) in frames(recorded) {
        judge.frame(t, frame.id.into(), frame.data());
    }
    judge.finish().rules
}

/// A VCU, and what may be known of its readings.
fn each(edition: &'static Edition) -> impl Iterator<Item = (Recorded, Vec<Choice>)> {
    [Choice::GoAccepted, Choice::GoRaw].into_iter().flat_map(move |sends| {
        let recorded = Recorded { edition, sends, remote: true, goes: true };
        let without = Recorded { remote: false, ..recorded };
        [(recorded, vec![]), (without, vec![]), (without, vec![sends])]
    })
}

const RULES: &str = "\
slow: after Go on, VEH_SPEED_ACTUAL > 5 km/h within 1 s
fast: after Go on, VEH_SPEED_ACTUAL > 5 km/h within 3 s
drives: after Go on, AS_STATE is AS_DRIVING within 100 ms
stays: after Go on, Go on for 2 s
waits: not moving until Go on
";

#[test]
fn that_go_went_on_is_decided_in_every_edition_whatever_its_signal_is() {
    for edition in Edition::ALL {
        for (recorded, pins) in each(edition) {
            let rules = judged(recorded, &pins, RULES);
            let verdicts: Vec<&str> = rules.iter().map(|rule| rule.verdict().name()).collect();
            let how = format!("{} {:?} {} {pins:?}", edition.version, recorded.sends, recorded.remote);
            assert_eq!(verdicts[..4], ["broken", "holds", "holds", "holds"], "{how}: {rules:#?}");
            assert_eq!(rules[0].breaches[0].t_ns / MS, GO_AT + 1_000 + shown_after(recorded), "{how}");
            assert!(rules[..4].iter().all(|rule| rule.held + rule.broken == 1), "{how}: {rules:#?}");
        }
    }
}

/// The remote control is recorded a little before the step that sees it; the time of a judge counts from the first frame, which is of the VCU.
fn shown_after(recorded: Recorded) -> i64 {
    let shows = Remote::of(&recorded.edition.bus).is_some() && recorded.remote;
    if shows { -2 } else { 0 }
}

/// Where it is not known that the signal is the switch, nothing is said of the switch before "Go" is accepted.
#[test]
fn what_the_readings_do_not_agree_on_is_not_decided() {
    let rule = "off: always Go off or AS_STATE is AS_DRIVING";
    for edition in Edition::ALL {
        for sends in [Choice::GoAccepted, Choice::GoRaw] {
            let recorded = Recorded { edition, sends, remote: false, goes: false };
            for (pins, verdict) in [
                (&[][..], RuleVerdict::Undecided),
                (&[Choice::GoAccepted], RuleVerdict::Undecided),
                (&[Choice::GoRaw], RuleVerdict::Holds),
            ] {
                let rules = judged(recorded, pins, rule);
                assert_eq!(rules[0].verdict(), verdict, "{} {pins:?}: {rules:#?}", edition.version);
            }
            let by_remote = judged(Recorded { remote: true, ..recorded }, &[], rule);
            let shown = Remote::of(&edition.bus).is_some();
            assert_eq!(by_remote[0].verdict() == RuleVerdict::Holds, shown, "{by_remote:#?}");
        }
    }
}

#[test]
fn the_report_says_that_go_does_not_show_and_what_to_do() {
    let why = |edition, pins: &[Choice], rule: &str| {
        let recorded = Recorded { edition, sends: Choice::GoAccepted, remote: false, goes: false };
        judged(recorded, pins, rule)[0].why.clone().unwrap_or_default()
    };
    let rule = "a: after Go on, VEH_SPEED_ACTUAL > 5 within 3 s";
    for edition in Edition::ALL {
        let open = why(edition, &[], rule);
        assert!(open.starts_with("only AS_DRIVING shows whether \"Go\" is on, for GO_SIGNAL (520h) may be the switch, or the edge that the VCU accepted; if your VCU sends the switch, say --reading go-signal=raw, and if not, ask for GO_SIGNAL is GO"), "{open}");
        assert_eq!(
            open.contains("or record the remote control ("),
            Remote::of(&edition.bus).is_some(),
            "{open}"
        );
        let accepted = why(edition, &[Choice::GoAccepted], rule);
        assert!(accepted.contains("is the edge that the VCU accepted (go-signal=accepted)"), "{accepted}");
        assert_eq!(why(edition, &[Choice::GoRaw], rule), "what it waits for never came");
        for also in
            ["a: always Go on or moving", "a: after ASMS on, Go off within 1 s", "a: asms off until Go on"]
        {
            assert_eq!(why(edition, &[], also), open, "{also}");
        }
        // It is not for "Go" that these are undecided.
        for (rule, other) in [
            ("a: after Go on and moving, AS_STATE is AS_READY within 3 s", "what it waits for never came"),
            (
                "a: after AS_STATE is AS_READY, AS_STATE is AS_DRIVING or go-on within 1000 s",
                "the recording ends before it is decided",
            ),
            ("a: always Go on or sdc-open", "it was never known whether SDC open (sdc-open)"),
        ] {
            assert_eq!(why(edition, &[], rule), other, "{rule}");
        }
    }
}
