//! The thresholds: wheel speeds, steer angle, torque and steer requests, each just below, at and just above.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::messages::{
    AsState, AxleTorqueRequest, MissionStatus, SteerAngle, Vcu2AiWheelSpeeds, WheelSpeed,
};
use adsdv_spec::{Atom, Choice, Edition, Fault, Row, Term};
use adsdv_tests::world::World;

use crate::check::{Blame, is_reported, is_silent, pinned_in};

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

/// The section that makes FINISHED while moving a fault.
fn finished_moving(edition: &Edition) -> &'static str {
    let terms = edition.rules.table.rows().iter().flat_map(Row::terms);
    let fault =
        |term: &&Term| term.fault == Some(Fault::MissionStatusFault) && term.on.has(Atom::MissionFinished);
    terms.filter(fault).map(|term| term.section).next().expect("it is a fault")
}

/// AS_DRIVING with one wheel turning, then FINISHED.
fn finished_with(edition: &Edition, wheel: usize, rpm: i32, vcu: impl Fn(&mut World)) -> World {
    let mut world = World::of(edition);
    world.stopped();
    world.inputs.vehicle.wheel_speeds = one_wheel(wheel, rpm);
    world.wait(300);
    world.ai.status.mission_status = MissionStatus::Finished;
    vcu(&mut world);
    world.wait(700);
    world
}

/// The edition of a case of a wheel: each wheel and each case come in every edition, but not every case of every wheel.
fn edition_of(wheel: usize, case: usize) -> &'static Edition {
    Edition::ALL[(wheel + case) % Edition::ALL.len()]
}

//= IMP-4, D-24
#[test]
fn each_wheel_alone_decides_whether_the_vehicle_moves() {
    let cases: [(i32, AsState, &[Blame]); 3] = [
        (9, AsState::Finished, &[(Rule::Due, "3.3")]),
        (10, AsState::Driving, &[]),
        (11, AsState::EmergencyBrake, &[(Rule::Due, "3.7")]),
    ];
    for wheel in 0..4 {
        for (case, (rpm, state, vcu)) in cases.into_iter().enumerate() {
            let edition = edition_of(wheel, case);
            let options = pinned_in(edition, &[Choice::FaultLevel]);
            let name = format!("{}: wheel {wheel} at {rpm} rpm", edition.version);
            let world = finished_with(edition, wheel, rpm, |_| {});
            assert_eq!(world.control.state, state, "{name}");
            is_silent(&world, options, &name);
            let world = finished_with(edition, wheel, rpm, World::hold_state);
            is_reported(&world, options, Party::Vcu, vcu, &name);
            let moving = (Rule::FinishedMoving, finished_moving(edition));
            let ai = if rpm > 10 { std::slice::from_ref(&moving) } else { &[] };
            is_reported(&world, options, Party::Ai, ai, &name);
        }
    }
}

#[test]
fn finished_is_wrong_unless_every_wheel_is_slow() {
    let wrong: &[Blame] = &[(Rule::Unjustified, "3.3")];
    for wheel in 0..4 {
        for (case, (rpm, blames)) in [(9, &[][..]), (10, wrong), (11, wrong)].into_iter().enumerate() {
            let edition = edition_of(wheel, case);
            let mut world = finished_with(edition, wheel, rpm, |world| {
                world.hold_state();
                world.wait(30);
                world.force(AsState::Finished);
            });
            world.wait(100);
            let name = format!("{}: wheel {wheel} at {rpm} rpm", edition.version);
            is_reported(&world, JudgeOptions::of(edition), Party::Vcu, blames, &name);
        }
    }
}

/// AS_READY with everything there but what `change` does, then "Go"; the VCU goes to AS_DRIVING.
fn driven_off(edition: &Edition, change: impl Fn(&mut World)) -> World {
    let mut world = World::of(edition);
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
    for &edition in Edition::ALL {
        let matters = edition.scope().has(Atom::SteerStraight);
        for (tenths, straight) in [(49, true), (50, !matters), (51, !matters)] {
            for angle in [tenths, -tenths].map(SteerAngle::clamped) {
                let world = driven_off(edition, |world| world.inputs.vehicle.steer_angle = angle);
                let expected: &[Blame] = if straight { &[] } else { &[(Rule::Unjustified, "3.2")] };
                is_reported(
                    &world,
                    JudgeOptions::of(edition),
                    Party::Vcu,
                    expected,
                    &format!("{}: {angle:?}", edition.version),
                );

                let mut world = World::of(edition);
                world.dwelt();
                world.inputs.vehicle.steer_angle = angle;
                world.wait(300);
                world.inputs.go = true;
                world.wait(300);
                assert_eq!(
                    world.control.state == AsState::Driving,
                    straight,
                    "{}: {angle:?}",
                    edition.version
                );
                is_silent(&world, JudgeOptions::of(edition), &format!("{}: {angle:?}", edition.version));
            }
        }
    }
}

//= DRV-5 to DRV-7
#[test]
fn the_least_request_is_not_zero() {
    for &edition in Edition::ALL {
        const LEAST: AxleTorqueRequest = AxleTorqueRequest::clamped(1);
        let changes: [(&str, Change); 4] = [
            ("front torque of 0.1 Nm", |world| world.ai.drive_f.front_axle_trq_request = LEAST),
            ("rear torque of 0.1 Nm", |world| world.ai.drive_r.rear_axle_trq_request = LEAST),
            ("steer request of 0.1 degrees", |world| world.ai.steer.steer_request = SteerAngle::clamped(1)),
            ("steer request of -0.1 degrees", |world| world.ai.steer.steer_request = SteerAngle::clamped(-1)),
        ];
        for (name, change) in changes {
            let world = driven_off(edition, change);
            let name = format!("{}: {name}", edition.version);
            is_reported(&world, JudgeOptions::of(edition), Party::Vcu, &[(Rule::Unjustified, "3.2")], &name);
        }
        is_silent(&driven_off(edition, |_| {}), JudgeOptions::of(edition), "no request");
    }
}
