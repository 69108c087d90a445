//! The thresholds: wheel speeds, steer angle, torque and steer requests, each just below, at and just above.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::Choice;
use adsdv_spec::messages::{
    AsState, AxleTorqueRequest, MissionStatus, SteerAngle, Vcu2AiWheelSpeeds, WheelSpeed,
};
use adsdv_tests::world::World;

use crate::check::{Blame, is_reported, is_silent, pinned};

/// Something that somebody does.
type Change = fn(&mut World);

/// One wheel turns, the others stand still.
fn one_wheel(wheel: usize, rpm: i32) -> Vcu2AiWheelSpeeds {
    let mut speeds = Vcu2AiWheelSpeeds::default();
    let wheels = [
        &mut speeds.fl_wheel_speed,
        &mut speeds.fr_wheel_speed,
        &mut speeds.rl_wheel_speed,
        &mut speeds.rr_wheel_speed,
    ];
    for (place, speed) in wheels.into_iter().enumerate() {
        *speed = WheelSpeed::clamped(if place == wheel { rpm } else { 0 });
    }
    speeds
}

/// AS_DRIVING with one wheel turning, then FINISHED.
fn finished_with(wheel: usize, rpm: i32, vcu: impl Fn(&mut World)) -> World {
    let mut world = World::reference();
    world.stopped();
    world.inputs.vehicle.wheel_speeds = one_wheel(wheel, rpm);
    world.wait(300);
    world.ai.status.mission_status = MissionStatus::Finished;
    vcu(&mut world);
    world.wait(700);
    world
}

//= IMP-4, D-24
#[test]
fn each_wheel_alone_decides_whether_the_vehicle_moves() {
    let cases: [(i32, AsState, &[Blame], &[Blame]); 3] = [
        (9, AsState::Finished, &[(Rule::Due, "3.3")], &[]),
        (10, AsState::Driving, &[], &[]),
        (11, AsState::EmergencyBrake, &[(Rule::Due, "3.7")], &[(Rule::FinishedMoving, "3.7")]),
    ];
    let options = pinned(Choice::FaultLevel);
    for wheel in 0..4 {
        for (rpm, state, vcu, ai) in cases {
            let name = format!("wheel {wheel} at {rpm} rpm");
            let world = finished_with(wheel, rpm, |_| {});
            assert_eq!(world.control.state, state, "{name}");
            is_silent(&world, options, &name);
            let world = finished_with(wheel, rpm, World::hold_state);
            is_reported(&world, options, Party::Vcu, vcu, &name);
            is_reported(&world, options, Party::Ai, ai, &name);
        }
    }
}

#[test]
fn finished_is_wrong_unless_every_wheel_is_slow() {
    for wheel in 0..4 {
        for (rpm, blames) in
            [(9, &[][..]), (10, &[(Rule::Unjustified, "3.3")]), (11, &[(Rule::Unjustified, "3.3")])]
        {
            let mut world = finished_with(wheel, rpm, |world| {
                world.hold_state();
                world.wait(30);
                world.force(AsState::Finished);
            });
            world.wait(100);
            is_reported(
                &world,
                JudgeOptions::default(),
                Party::Vcu,
                blames,
                &format!("wheel {wheel} at {rpm} rpm"),
            );
        }
    }
}

/// AS_READY with everything there but what `change` does, then "Go"; the VCU goes to AS_DRIVING.
fn driven_off(change: impl Fn(&mut World)) -> World {
    let mut world = World::reference();
    world.dwelt();
    change(&mut world);
    world.wait(300);
    world.inputs.go = true;
    world.force(AsState::Driving);
    world.wait(300);
    world
}

//= DRV-9, D-25
#[test]
fn the_wheels_are_straight_below_five_degrees() {
    for (tenths, straight) in [(49, true), (50, false), (51, false)] {
        for angle in [tenths, -tenths].map(SteerAngle::clamped) {
            let world = driven_off(|world| world.inputs.vehicle.steer_angle = angle);
            let expected: &[Blame] = if straight { &[] } else { &[(Rule::Unjustified, "3.2")] };
            is_reported(&world, JudgeOptions::default(), Party::Vcu, expected, &format!("{angle:?}"));

            let mut world = World::reference();
            world.dwelt();
            world.inputs.vehicle.steer_angle = angle;
            world.wait(300);
            world.inputs.go = true;
            world.wait(300);
            assert_eq!(world.control.state == AsState::Driving, straight, "{angle:?}");
            is_silent(&world, JudgeOptions::default(), &format!("{angle:?}"));
        }
    }
}

//= DRV-5 to DRV-7
#[test]
fn the_least_request_is_not_zero() {
    const LEAST: AxleTorqueRequest = AxleTorqueRequest::clamped(1);
    let changes: [(&str, Change); 4] = [
        ("front torque of 0.1 Nm", |world| world.ai.drive_f.front_axle_trq_request = LEAST),
        ("rear torque of 0.1 Nm", |world| world.ai.drive_r.rear_axle_trq_request = LEAST),
        ("steer request of 0.1 degrees", |world| world.ai.steer.steer_request = SteerAngle::clamped(1)),
        ("steer request of -0.1 degrees", |world| world.ai.steer.steer_request = SteerAngle::clamped(-1)),
    ];
    for (name, change) in changes {
        let world = driven_off(change);
        is_reported(&world, JudgeOptions::default(), Party::Vcu, &[(Rule::Unjustified, "3.2")], name);
    }
    is_silent(&driven_off(|_| {}), JudgeOptions::default(), "no request");
}
