//! The "Go" edge of section 3.2, item 3.

use adsdv_oracle::judge::{Judge, JudgeOptions, Party, Rule, Severity};
use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{AsState, AxleTorqueRequest};
use adsdv_spec::{Atom, Choice, Edition, Truth};
use adsdv_tests::world::{MS, World, judge};

use crate::check::{by, is_reported, is_reported_if_seen, is_silent, only, pinned, section_of};

/// AS_READY with the dwell over, "Go" having been on since before; `GO_SIGNAL` is the switch.
fn go_since_before() -> World {
    let mut world = World::with_reading(Choice::GoRaw);
    world.prepare();
    world.inputs.go = true;
    world.wait(200);
    world.inputs.asms = true;
    world.wait(6000);
    assert_eq!(world.control.state, AsState::Ready);
    world
}

/// The dwell of AS_READY is put off while nothing is recorded; that settles nothing else.
#[test]
fn a_silence_of_the_recorder_says_nothing_of_go() {
    let mut world = World::reference();
    world.ready();
    world.wait(1000);
    let (mut judge, first) = (Judge::new(JudgeOptions::default()), world.log[0].t);
    for recorded in &world.log {
        judge.frame(recorded.t - first, recorded.frame.id.into(), recorded.frame.data());
    }
    for ms in [0, 1000, 20_000] {
        judge.time_passes(world.t - first + ms * MS);
        assert_eq!(judge.known().of(Atom::GoEdge), Truth::Unknown, "after {ms} ms");
    }
}

/// The frame that shows AS_DRIVING shows "Go" as well.
//= DRV-14
#[test]
fn driving_is_not_entered_with_go_signal_at_0() {
    for edition in Edition::ALL.iter().filter(|edition| Remote::of(&edition.bus).is_none()) {
        let mut world = World::of(edition);
        world.dwelt();
        world.inputs.go = true;
        let conforming = world.clone();
        world.shows = |status| status.go_signal = false;
        world.wait(30);
        let report = world.judge(JudgeOptions::of(edition));
        let said = "AS_READY -> AS_DRIVING with GO_SIGNAL 0; expected 1, for \"Go\" leads there";
        assert_eq!(only(&report).message(), said, "{}", edition.version);
        let mut world = conforming;
        world.wait(30);
        is_silent(&world, JudgeOptions::of(edition), "it shows that it was switched on");
    }
}

//= DRV-12
#[test]
fn driving_needs_a_new_edge() {
    let mut world = go_since_before();
    is_silent(&world, JudgeOptions::default(), "the reference waits for an edge");
    world.force(AsState::Driving);
    world.wait(300);
    let report = world.judge(JudgeOptions::default());
    assert!(only(&report).message().contains("no accepted"), "it names the edge");
    // The whole stay in AS_READY must be without a gap, lest there was an edge in it.
    is_reported_if_seen(
        &world,
        JudgeOptions::default(),
        Party::Vcu,
        &[(Rule::Unjustified, "3.2")],
        "no edge",
    );
}

/// AS_READY with all conditions, then an edge of "Go".
fn edge(vcu: impl Fn(&mut World)) -> World {
    let mut world = World::with_reading(Choice::GoRaw);
    world.dwelt();
    vcu(&mut world);
    world.inputs.go = true;
    world.wait(500);
    world
}

//= DRV-15
#[test]
fn an_edge_that_the_vcu_loses_is_reported() {
    let world = edge(World::hold_state);
    is_reported_if_seen(
        &world,
        JudgeOptions::default(),
        Party::Vcu,
        &[(Rule::Due, "3.2")],
        "the edge is lost",
    );
    let world = edge(|_| {});
    assert_eq!(world.control.state, AsState::Driving);
    is_silent(&world, JudgeOptions::default(), "the edge is taken");
}

/// The VCU may have seen "Go" before the request that comes just ahead of it.
//= DRV-15
#[test]
fn an_edge_just_behind_a_request_that_forbids_it_may_count() {
    for (ms, sections) in [(10, vec![]), (200, vec!["3.2"])] {
        let mut world = World::with_reading(Choice::GoRaw);
        world.dwelt();
        world.hold_state();
        world.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(50);
        world.wait(ms);
        world.inputs.go = true;
        world.cycle();
        world.force(AsState::Driving);
        world.wait(300);
        let report = world.judge(pinned(Choice::GoRaw));
        let found: Vec<&str> = by(&report, Party::Vcu).iter().map(|finding| section_of(finding)).collect();
        assert_eq!(found, sections, "{ms} ms: {:#?}", report.findings);
    }
}

//= DRV-11, D-6, SM-2
#[test]
fn an_edge_before_the_dwell_is_over_does_not_count() {
    let mut world = World::with_reading(Choice::GoRaw);
    world.ready();
    world.inputs.go = true;
    world.wait(6000);
    assert_eq!(world.control.state, AsState::Ready);
    is_silent(&world, JudgeOptions::default(), "the edge came early");
    world.force(AsState::Driving);
    world.wait(300);
    is_reported_if_seen(
        &world,
        JudgeOptions::default(),
        Party::Vcu,
        &[(Rule::Unjustified, "3.2")],
        "the edge came early",
    );
}

//= DTE-2
#[test]
fn driving_ends_with_go() {
    let mut world = World::reference();
    world.driving();
    world.hold_state();
    world.inputs.go = false;
    world.wait(500);
    is_reported(&world, JudgeOptions::default(), Party::Vcu, &[(Rule::Due, "3.7")], "Go is off");
}

/// By then the VCU has seen "Go" without it.
#[test]
fn what_comes_long_behind_go_does_not_excuse_that_it_was_passed_over() {
    for edition in Edition::ALL.iter().filter(|edition| Remote::of(&edition.bus).is_some()) {
        let mut world = World::of(edition);
        world.dwelt();
        world.hold_state();
        world.inputs.go = true;
        world.wait(100);
        world.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(50);
        world.wait(900);
        let warned = |seed: &u64| {
            let report = judge(&world.disturbed(*seed, 20 * MS, 0), JudgeOptions::of(edition));
            report.findings.iter().any(|one| one.rule == Rule::Due && one.severity == Severity::Warning)
        };
        let warned = (1..=20).filter(warned).count();
        assert!(warned > 10, "{}: {warned} of 20", edition.version);
    }
}

/// The VCU shows "Go" before it acts on it: that it shows more in between takes nothing back.
#[test]
fn an_edge_may_be_taken_late() {
    for (ms, sections) in [(20, vec![]), (40, vec![]), (200, vec!["3.2"])] {
        let mut world = World::with_reading(Choice::GoRaw);
        world.dwelt();
        world.hold_state();
        world.inputs.go = true;
        world.wait(ms);
        world.force(AsState::Driving);
        world.wait(300);
        let report = world.judge(pinned(Choice::GoRaw));
        let found: Vec<&str> = by(&report, Party::Vcu).iter().map(|finding| section_of(finding)).collect();
        assert_eq!(found, sections, "{ms} ms: {:#?}", report.findings);
    }
}
