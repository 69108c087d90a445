//! The AI Computer's conduct in AS_DRIVING and AS_READY.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule, Severity};
use adsdv_spec::messages::{AsState, DirectionRequest, MissionStatus, Node};
use adsdv_spec::{Atom, Choice};
use adsdv_tests::world::{MS, World, judge};

use crate::check::{blames, is_reported, is_silent, pinned};

/// AS_DRIVING at speed, and the AI Computer does something.
fn at_speed(vcu: fn(&mut World), does: fn(&mut World)) -> World {
    let mut world = World::reference();
    world.driving();
    vcu(&mut world);
    does(&mut world);
    world.wait(500);
    world
}

/// The AI Computer does at speed what violates under both readings.
fn violates_at_speed(does: fn(&mut World), rule: Rule) {
    let expected = [(rule, "3.7")];
    let world = at_speed(|_| {}, does);
    is_silent(&world, JudgeOptions::default(), rule.id());
    // A VCU leaves AS_DRIVING at once. Only one that stays shows for sure, under jitter, that it had not left before.
    let stays = at_speed(World::hold_state, does);
    for options in [JudgeOptions::default(), pinned(Choice::FaultLevel), pinned(Choice::FaultEdge)] {
        assert_eq!(blames(&judge(&world.log, options), Party::Ai), expected);
        is_reported(&stays, options, Party::Ai, &expected, rule.id());
    }
}

#[test]
fn finished_at_speed_violates_under_both_readings() {
    violates_at_speed(|world| world.ai.status.mission_status = MissionStatus::Finished, Rule::FinishedMoving);
}

#[test]
fn neutral_at_speed_violates_under_both_readings() {
    let neutral: fn(&mut World) = |world| world.ai.status.direction_request = DirectionRequest::Neutral;
    violates_at_speed(neutral, Rule::NeutralMoving);
}

/// What the AI Computer does counts in the state that the VCU is in then, which may show only later; not after a silence.
#[test]
fn finished_at_speed_while_the_vcu_is_not_seen() {
    for (ms, seen) in [(30, true), (100, true), (300, true), (480, true), (510, false), (800, false)] {
        let mut world = World::reference();
        world.driving();
        world.hold_state();
        let since = world.t;
        world.ai.status.mission_status = MissionStatus::Finished;
        world.wait(1500);
        let away = since..since + ms * MS;
        world.log.retain(|recorded| recorded.sender() == Some(Node::Ai) || !away.contains(&recorded.t));
        let name = format!("FINISHED at speed, VCU not seen for {ms} ms");
        let found = blames(&judge(&world.log, JudgeOptions::default()), Party::Ai);
        let expected = [(Rule::FinishedMoving, "3.7")];
        assert_eq!(found, expected[usize::from(!seen)..], "{name}");
    }
}

/// How much the one finding of a rule weighs; `None` if there is none.
fn weight(world: &World, rule: Rule, options: JudgeOptions) -> Option<Severity> {
    let report = judge(&world.log, options);
    let weights: Vec<Severity> =
        report.findings.iter().filter(|f| f.rule == rule).map(|f| f.severity).collect();
    assert!(weights.len() <= 1, "{:#?}", report.findings);
    weights.first().copied()
}

fn violates_as_a_level_only(world: &World, rule: Rule) {
    assert_eq!(weight(world, rule, JudgeOptions::default()), Some(Severity::Warning));
    assert_eq!(weight(world, rule, pinned(Choice::FaultLevel)), Some(Severity::Violation));
    assert_eq!(weight(world, rule, pinned(Choice::FaultEdge)), None);
}

#[test]
fn finished_that_does_not_follow_on_running() {
    let does: fn(&mut World) = |world| {
        world.ai.status.mission_status = MissionStatus::Selected;
        world.wait(200);
        world.ai.status.mission_status = MissionStatus::Finished;
    };
    let world = at_speed(|_| {}, does);
    violates_as_a_level_only(&world, Rule::FinishedMoving);
    is_silent(&world, JudgeOptions::default(), "FINISHED from SELECTED");
}

#[test]
fn neutral_from_before_the_vehicle_moved() {
    let mut world = World::with_reading(Choice::FaultEdge);
    world.dwelt();
    world.inputs.go = true;
    world.wait(500);
    world.wheels(200);
    world.wait(500);
    assert_eq!(world.control.state, AsState::Driving);
    violates_as_a_level_only(&world, Rule::NeutralMoving);
    is_silent(&world, JudgeOptions::default(), "NEUTRAL all the time");
}

#[test]
fn finished_and_neutral_at_rest_are_fine() {
    let mut world = World::reference();
    world.finished();
    world.ai.status.direction_request = DirectionRequest::Neutral;
    world.wait(500);
    is_reported(&world, JudgeOptions::default(), Party::Ai, &[], "at rest");
}

//= DRV-5 to DRV-8
#[test]
fn requests_that_hold_the_vehicle_in_ready() {
    for atom in [Atom::FrontTorqueZero, Atom::RearTorqueZero, Atom::SteerRequestZero, Atom::DirectionNeutral]
    {
        let mut world = World::reference();
        world.ready();
        world.set(atom, false);
        world.wait(4000);
        assert_eq!(
            weight(&world, Rule::ReadyHeld, JudgeOptions::default()),
            None,
            "not before the dwell is over"
        );
        world.wait(2000);
        assert_eq!(
            weight(&world, Rule::ReadyHeld, JudgeOptions::default()),
            Some(Severity::Warning),
            "{atom}"
        );
        is_silent(&world, JudgeOptions::default(), atom.id());
    }
}

/// For less than the deadline it holds nobody up.
#[test]
fn a_request_for_a_moment_holds_no_vehicle() {
    let mut world = World::reference();
    world.dwelt();
    world.set(Atom::FrontTorqueZero, false);
    world.wait(i64::from(JudgeOptions::default().deadline_ms) - 20);
    world.set(Atom::FrontTorqueZero, true);
    world.wait(500);
    assert_eq!(weight(&world, Rule::ReadyHeld, JudgeOptions::default()), None);
}

#[test]
fn requests_hold_the_vehicle_once_in_each_ready() {
    let mut world = World::reference();
    world.ready();
    for _ in 0..2 {
        world.set(Atom::FrontTorqueZero, false);
        world.wait(6000);
        world.set(Atom::FrontTorqueZero, true);
        world.wait(200);
        world.set(Atom::FrontTorqueZero, false);
        world.wait(500);
        world.inputs.asms = false;
        world.wait(200);
        world.inputs.asms = true;
        world.wait(200);
    }
    is_silent(&world, JudgeOptions::default(), "held in two AS_READY");
    let report = judge(&world.log, JudgeOptions::default());
    let held = report.findings.iter().filter(|finding| finding.rule == Rule::ReadyHeld);
    assert_eq!(held.count(), 2, "{:#?}", report.findings);
}

/// Whether there is no AI Computer, or nobody recorded it, cannot be known.
#[test]
fn an_ai_computer_that_was_never_heard_is_not_blamed() {
    let mut world = World::reference();
    world.ai_sends = false;
    world.wait(500);
    world.inputs.tsms = true;
    world.wait(1000);
    assert!(
        world.control.handshake.is_lost(adsdv_spec::Edition::DEFAULT.rules.timing.handshake_ms),
        "it is missed"
    );
    is_reported(&world, JudgeOptions::default(), Party::Ai, &[], "never heard");
    is_silent(&world, JudgeOptions::default(), "never heard");
    let report = judge(&world.log, JudgeOptions::default());
    assert!(!report.findings.iter().any(|finding| finding.party == Party::Ai), "{:#?}", report.findings);
}
