//! The judge while the bus goes on: what it knows, what it shows, and what it makes of silence and of losses.

use adsdv_oracle::judge::{Finding, Judge, JudgeOptions, Party, Rule, Severity};
use adsdv_spec::messages::{AsState, Vcu2AiStatus};
use adsdv_spec::{Atom, Knowledge, Truth};
use adsdv_tests::bus::def_of;
use adsdv_tests::world::{MS, World};

/// A judge of a run into `AS_DRIVING`, and the time of its last frame.
fn driving() -> (Judge, i64, World) {
    let mut world = World::reference();
    world.driving();
    let mut judge = Judge::new(JudgeOptions::default());
    let origin = world.log[0].t;
    let mut last = 0;
    for recorded in &world.log {
        last = recorded.t - origin;
        judge.frame(last, recorded.frame.id.into(), recorded.frame.data());
    }
    (judge, last, world)
}

/// Goes on with the run of the judge, later by so much.
fn go_on(judge: &mut Judge, world: &mut World, later: i64) -> i64 {
    let (before, origin) = (world.log.len(), world.log[0].t);
    world.wait(1000);
    let mut last = 0;
    for recorded in &world.log[before..] {
        last = recorded.t - origin + later;
        judge.frame(last, recorded.frame.id.into(), recorded.frame.data());
    }
    last
}

fn gaps(findings: &[Finding]) -> Vec<(i64, Severity, Party, &str)> {
    let gaps = findings.iter().filter(|finding| finding.rule == Rule::Gap);
    gaps.map(|gap| (gap.t_ns, gap.severity, gap.party, gap.seen.as_str())).collect()
}

#[test]
fn a_silent_vcu_is_known_no_more() {
    let (mut judge, last, _) = driving();
    assert_eq!(judge.state(), Some(AsState::Driving));
    assert_eq!(judge.known().of(Atom::Asms), Truth::True);
    // For as long as the window it may be late.
    let silent = (0..=1000).find(|ms| {
        judge.time_passes(last + ms * MS);
        judge.state().is_none()
    });
    assert_eq!(silent, Some(i64::from(JudgeOptions::default().window_ms) + 1));
    assert_eq!(judge.known().of(Atom::Asms), Truth::Unknown);
    judge.time_passes(last);
    let report = judge.finish();
    assert_eq!(report.duration_ns, last, "the log ends with its last frame");
}

#[test]
fn a_state_that_cannot_be_read_is_not_known() {
    let (mut judge, last, world) = driving();
    let status = world.log.iter().rev().find(|recorded| recorded.frame.id == Vcu2AiStatus::ID);
    let mut frame = status.expect("the VCU has sent its status").frame;
    let signal = def_of::<Vcu2AiStatus>().signal("AS_STATE").expect("a signal of 520h");
    let readable = frame;
    frame.data = signal.put(frame.data, signal.max + 1);
    judge.frame(last + 5 * MS, frame.id.into(), frame.data());
    assert_eq!(judge.state(), None);
    judge.frame(last + 15 * MS, readable.id.into(), readable.data());
    assert_eq!(judge.state(), Some(AsState::Driving));
}

#[test]
fn a_status_that_is_too_short_shows_no_state() {
    let (mut judge, last, _) = driving();
    judge.frame(last + 5 * MS, Vcu2AiStatus::ID.into(), &[0; 3]);
    assert_eq!(judge.state(), None);
}

#[test]
fn passing_time_changes_nothing_while_frames_come() {
    let mut world = World::reference();
    world.finished();
    let plain = world.judge(JudgeOptions::default());
    let mut judge = Judge::new(JudgeOptions::default());
    let origin = world.log[0].t;
    for recorded in &world.log {
        let t = recorded.t - origin;
        judge.frame(t, recorded.frame.id.into(), recorded.frame.data());
        judge.time_passes(t + MS / 10);
    }
    let reported = judge.finish();
    assert_eq!((reported.frames, reported.duration_ns), (plain.frames, plain.duration_ns));
    assert_eq!((reported.transitions, reported.findings), (plain.transitions, plain.findings));
}

#[test]
fn a_frame_that_is_not_judged_counts_and_takes_its_time() {
    let (mut judge, last, world) = driving();
    assert_eq!(judge.other_frame(last + 3 * MS), last + 3 * MS);
    assert_eq!(judge.state(), Some(AsState::Driving));
    let report = judge.finish();
    assert_eq!((report.frames, report.duration_ns), (world.log.len() as u64 + 1, last + 3 * MS));

    let mut first = Judge::new(JudgeOptions::default());
    assert_eq!(first.other_frame(7 * MS), 0, "the first frame is where time begins");
    assert_eq!(first.other_frame(9 * MS), 2 * MS);
}

#[test]
fn what_is_taken_is_not_in_the_report() {
    let (mut judge, ..) = driving();
    let responses = judge.responses().clone();
    assert_eq!((responses.count() > 500, responses.max_ms()), (true, Some(5.0)));
    let (transitions, findings) = judge.take_news();
    let states: Vec<AsState> = transitions.iter().map(|transition| transition.to).collect();
    assert_eq!((states, findings), (vec![AsState::Ready, AsState::Driving], vec![]));
    assert_eq!(judge.take_news(), (vec![], vec![]));
    let report = judge.finish();
    assert_eq!((report.transitions, report.responses.count()), (vec![], responses.count()));
}

#[test]
fn losses_are_reported_and_nothing_is_known_behind_them() {
    let (mut judge, last, mut world) = driving();
    judge.lost(0);
    assert_eq!(judge.known().of(Atom::Asms), Truth::True);
    judge.lost(5);
    judge.lost(2);
    let status = world.log.iter().rev().find(|recorded| recorded.frame.id == Vcu2AiStatus::ID);
    let frame = status.expect("the VCU has sent its status").frame;
    judge.other_frame(last + 10 * MS);
    assert_eq!((judge.state(), judge.known()), (None, Knowledge::NOTHING));
    judge.frame(last + 10 * MS, frame.id.into(), frame.data());
    assert_eq!(judge.state(), Some(AsState::Driving));
    go_on(&mut judge, &mut world, 10 * MS);
    let report = judge.finish();
    let text =
        "7 frames lost here, because nobody took what came in time; judged as a new recording from here on";
    assert_eq!(gaps(&report.findings), [(last, Severity::Warning, Party::Log, text)]);
    assert_eq!(report.count(Severity::Violation), 0, "{:#?}", report.findings);
}

#[test]
fn losses_one_after_the_other_are_reported_as_one() {
    let (mut judge, last, mut world) = driving();
    for place in 1..=3 {
        judge.lost(1);
        judge.other_frame(last + place * 10 * MS);
    }
    let end = go_on(&mut judge, &mut world, 30 * MS);
    judge.lost(1);
    let report = judge.finish();
    let several = "3 frames lost from here on, 3 times in 0.030 s, because nobody took what came in time; judged as a new \
                   recording each time";
    let one =
        "1 frame lost here, because nobody took what came in time; judged as a new recording from here on";
    let expected = [(last, several), (end, one)].map(|(t, text)| (t, Severity::Warning, Party::Log, text));
    assert_eq!(gaps(&report.findings), expected);
}

/// What is wrong behind a loss is reported again, once for all losses that follow one another.
#[test]
fn what_is_still_wrong_behind_losses_is_reported_again_once() {
    let mut world = World::reference();
    world.wait(1000);
    let signal = def_of::<Vcu2AiStatus>().signal("SHUTDOWN_CAUSE").expect("a signal of 520h");
    let mut judge = Judge::new(JudgeOptions::default());
    for (place, recorded) in world.log.iter_mut().enumerate() {
        if recorded.frame.id == Vcu2AiStatus::ID {
            recorded.frame.data = signal.put(recorded.frame.data, signal.max + 1);
        }
        judge.lost(u64::from([400, 420, 440].contains(&place)));
        judge.frame(recorded.t, recorded.frame.id.into(), recorded.frame.data());
    }
    let report = judge.finish();
    let wrong = report.findings.iter().filter(|finding| finding.rule == Rule::Value);
    assert_eq!((wrong.count(), gaps(&report.findings).len()), (2, 1), "{:#?}", report.findings);
}

/// Time is that of the first frame, whatever the clock of the recorder says.
#[test]
fn time_begins_with_the_first_frame() {
    let later = 7000 * MS;
    let mut world = World::reference();
    world.wait(1000);
    let mut judge = Judge::new(JudgeOptions::default());
    judge.time_passes(500 * MS);
    let mut last = 0;
    for recorded in &world.log {
        last = recorded.t + later;
        judge.frame(last, recorded.frame.id.into(), recorded.frame.data());
    }
    let window = i64::from(JudgeOptions::default().window_ms) * MS;
    judge.time_passes(last + window - MS);
    assert_eq!(judge.state(), Some(AsState::Off));
    judge.time_passes(last + window + 5 * MS);
    assert_eq!(judge.state(), None);
    assert_eq!(judge.finish().duration_ns, last - later);
}

#[test]
fn losses_without_end_are_reported_every_ten_seconds() {
    let (mut judge, last, _) = driving();
    for place in 1..=2500 {
        judge.lost(1);
        judge.other_frame(last + place * 10 * MS);
    }
    let reported: Vec<i64> = gaps(&judge.finish().findings).iter().map(|gap| (gap.0 - last) / MS).collect();
    assert_eq!(reported, [0, 10_000, 20_000]);
}

/// A frame that was on its way while `time_passes` was called: what is said of it when it comes is said of a time in the report.
#[test]
fn what_is_reported_late_is_no_later_than_the_report() {
    let (mut judge, last, world) = driving();
    judge.time_passes(last + 500 * MS);
    let frame = &world.log[world.log.len() - 1].frame;
    judge.frame(last - MS, frame.id.into(), frame.data());
    let report = judge.finish();
    let back =
        report.findings.iter().find(|finding| finding.rule == Rule::TimeBackwards).expect("it is reported");
    assert_eq!((back.t_ns, report.duration_ns), (last + 500 * MS, last + 500 * MS));
}
