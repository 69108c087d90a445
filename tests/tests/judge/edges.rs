//! Changes, where the change counts and not the value: what is only so at the change is never due later.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule, Severity};
use adsdv_spec::messages::{Ai2VcuStatus, AsState, DirectionRequest, MissionStatus, Node, SteerAngle};
use adsdv_spec::{Choice, Readings};
use adsdv_tests::bus::encoded;
use adsdv_tests::world::{MS, Recorded, World, judge};

use crate::check::{all_pinned, by, is_reported, is_silent, pinned};

/// What the AI Computer changes to, of which section 4 says that the change counts.
const CHANGES: [fn(&mut World); 2] = [
    |world| world.ai.status.mission_status = MissionStatus::Finished,
    |world| world.ai.status.direction_request = DirectionRequest::Neutral,
];

/// AS_DRIVING at speed, with a VCU for which the change counts.
fn driving() -> World {
    let mut world = World::with_reading(Choice::FaultEdge);
    world.driving();
    world
}

/// The wheels turn again, and nothing is said against the VCU, which stays in AS_DRIVING.
fn moves_on(mut world: World, name: &str) {
    world.wheels(200);
    world.wait(500);
    assert_eq!(world.control.state, AsState::Driving, "{name}");
    for options in
        [JudgeOptions::default(), pinned(Choice::FaultEdge), all_pinned(world.vcu.readings().choices())]
    {
        is_silent(&world, options, name);
    }
    let report = judge(&world.log, pinned(Choice::FaultEdge));
    let of_ai = report.findings.iter().filter(|f| f.party == Party::Ai && f.severity != Severity::Note);
    assert_eq!(of_ai.count(), 0, "{name}: {:#?}", report.findings);
}

#[test]
fn neutral_just_before_the_wheels_stop() {
    for after_ms in [0, 10, 20, 100, 1000] {
        let mut world = driving();
        // On the bus before the 525h that shows the stop; the VCU sees both in one step.
        world.ai.status.direction_request = DirectionRequest::Neutral;
        world.cycle();
        world.wheels(0);
        world.cycle();
        world.wait(after_ms);
        moves_on(world, "NEUTRAL, and the wheels stop");
    }
}

#[test]
fn finished_just_before_the_wheels_stop() {
    // FINISHED at rest leads to AS_FINISHED, unless the wheels turn too fast for rest and too slowly for moving.
    for after_ms in [0, 10, 20, 100, 1000] {
        let mut world = driving();
        world.ai.status.mission_status = MissionStatus::Finished;
        world.cycle();
        world.wheels(NEITHER_RPM);
        world.cycle();
        world.wait(after_ms);
        moves_on(world, "FINISHED, and the wheels nearly stop");
    }
}

/// Neither at rest nor moving.
const NEITHER_RPM: i32 = 10;

#[test]
fn a_change_at_rest_does_not_count_at_speed() {
    for change in CHANGES {
        for after_ms in [0, 10, 20, 1000] {
            let mut world = driving();
            world.wheels(NEITHER_RPM);
            world.wait(500);
            change(&mut world);
            world.cycle();
            // The VCU sees it in the next step.
            world.cycle();
            world.wait(after_ms);
            moves_on(world, "a change at rest");
        }
    }
}

#[test]
fn neutral_without_forward_before_it() {
    let mut world = World::with_reading(Choice::FaultEdge);
    world.dwelt();
    world.inputs.go = true;
    world.wait(500);
    moves_on(world, "NEUTRAL all the time");
}

/// The VCU stays in AS_DRIVING, and nothing is said against it.
fn goes_on_driving(mut world: World, name: &str) {
    world.wait(500);
    assert_eq!(world.control.state, AsState::Driving);
    is_silent(&world, pinned(Choice::FaultEdge), name);
    is_silent(&world, JudgeOptions::default(), name);
}

#[test]
fn a_value_that_lasts_for_less_than_a_cycle_is_no_change_to_the_vcu() {
    let mut world = driving();
    world.wheels(NEITHER_RPM);
    world.wait(500);
    world.ai.status.direction_request = DirectionRequest::Neutral;
    world.wait(500);
    world.wheels(200);
    world.wait(500);
    // FORWARD is on the bus between two frames with NEUTRAL, and the VCU reads the last one only.
    let neutral = world.log.iter().rev().find(|recorded| recorded.frame.id == Ai2VcuStatus::ID).copied();
    let neutral = neutral.expect("510h is in the log");
    let status = Ai2VcuStatus { direction_request: DirectionRequest::Forward, ..world.ai.status };
    world.log.push(Recorded { t: world.t - 4 * MS, frame: encoded(status) });
    world.log.push(Recorded { t: world.t - MS, ..neutral });
    goes_on_driving(world, "FORWARD for a moment");
}

#[test]
fn running_for_less_than_a_cycle_is_no_change_to_the_vcu_either() {
    let mut world = driving();
    world.ai.status.mission_status = MissionStatus::Selected;
    world.wait(500);
    world.ai.status.mission_status = MissionStatus::Finished;
    world.cycle();
    // RUNNING is on the bus just before FINISHED.
    let place = world.log.iter().rposition(|recorded| recorded.frame.id == Ai2VcuStatus::ID);
    let place = place.expect("510h is in the log");
    let status = Ai2VcuStatus { mission_status: MissionStatus::Running, ..world.ai.status };
    world.log.insert(place, Recorded { t: world.log[place].t - MS, frame: encoded(status) });
    goes_on_driving(world, "RUNNING for a moment");
}

/// The AI Computer goes on: that it sends more does not take back what the VCU has yet to see.
#[test]
fn a_change_may_be_seen_late() {
    for change in CHANGES {
        let mut world = driving();
        let since = world.t - 500 * MS;
        change(&mut world);
        world.wait(500);
        assert_eq!(world.control.state, AsState::EmergencyBrake);
        let later = world
            .log
            .iter_mut()
            .filter(|recorded| recorded.t >= since && recorded.sender() == Some(Node::Vcu));
        later.for_each(|recorded| recorded.t += 50 * MS);
        world.log.sort_by_key(|recorded| recorded.t);
        let report = judge(&world.log, pinned(Choice::FaultEdge));
        assert!(by(&report, Party::Vcu).is_empty(), "{:#?}", report.findings);
    }
}

//= IMP-2, IMP-3
#[test]
fn a_change_at_speed_that_is_passed_over_is_reported_also_after_a_stop() {
    for change in CHANGES {
        let mut world = driving();
        world.hold_state();
        change(&mut world);
        world.wait(60);
        world.wheels(NEITHER_RPM);
        world.wait(500);
        is_reported(&world, pinned(Choice::FaultEdge), Party::Vcu, &[(Rule::Due, "3.7")], "passed over");
        is_reported(&world, JudgeOptions::default(), Party::Vcu, &[(Rule::Due, "3.7")], "passed over");
    }
}

#[test]
fn go_while_a_condition_fails_is_not_due_when_it_holds_again() {
    let readings = Readings::DEFAULT.with(Choice::GoRaw);
    let mut world = World::with_reading(Choice::GoRaw);
    world.dwelt();
    // 520h shows "Go" before the steering angle of the same step is on the bus.
    world.inputs.go = true;
    world.inputs.vehicle.steer_angle = SteerAngle::clamped(100);
    world.wait(200);
    world.inputs.vehicle.steer_angle = SteerAngle::clamped(0);
    world.wait(500);
    assert_eq!(world.control.state, AsState::Ready);
    for options in [JudgeOptions::default(), pinned(Choice::GoRaw), all_pinned(readings.choices())] {
        is_silent(&world, options, "Go with the wheels turned");
    }
}
