//! Every threshold and every time: just below, at, and just above.

use adsdv_spec::messages::{AsState, MissionStatus, SteerAngle, WheelSpeed};
use adsdv_spec::{Atom, Inputs, Machine};

use super::{Walk, test, walk_cycle};
use crate::suite::{Kind, Test};

/// The tests of what a machine's interface sets as limits.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let mut tests = wheels(machine);
    tests.extend(steering(machine));
    tests.extend(dwell(machine));
    tests.extend(ebs_timer(machine));
    tests
}

const BESIDE: [i32; 3] = [-1, 0, 1];

/// One wheel of a vehicle.
type Wheel = (&'static str, fn(&mut Inputs) -> &mut WheelSpeed);

const WHEELS: [Wheel; 4] = [
    ("fl", |inputs| &mut inputs.vehicle.wheel_speeds.fl_wheel_speed),
    ("fr", |inputs| &mut inputs.vehicle.wheel_speeds.fr_wheel_speed),
    ("rl", |inputs| &mut inputs.vehicle.wheel_speeds.rl_wheel_speed),
    ("rr", |inputs| &mut inputs.vehicle.wheel_speeds.rr_wheel_speed),
];

/// FINISHED with each single wheel at the limit between moving and at rest.
fn wheels(machine: &Machine) -> Vec<Test> {
    let limit = machine.edition().rules.thresholds.wheel_speed.raw();
    let one = |(name, wheel): Wheel, beside: i32| {
        let rpm = limit + beside;
        let walk = Walk::to(machine, AsState::Driving).step(walk_cycle(machine), |inputs| {
            inputs.ai.status.mission_status = MissionStatus::Finished;
            *wheel(inputs) = WheelSpeed::clamped(rpm);
        });
        let about =
            format!("FINISHED in AS_DRIVING with the {name} wheel at {rpm} rpm and the others at rest");
        test(Kind::Limit, format!("wheel-{name}-{rpm}-rpm"), about, "3.3", walk)
            .checks(["SM-13", "SM-14", "DTE-4", "FIN-4", "IMP-4", "D-24"])
    };
    WHEELS.into_iter().flat_map(|wheel| BESIDE.map(|beside| one(wheel, beside))).collect()
}

/// The edge of "Go" with the wheels at the limit of straight, to either side.
///
/// None where no row asks for straight wheels.
fn steering(machine: &Machine) -> Vec<Test> {
    if !machine.scope().has(Atom::SteerStraight) {
        return Vec::new();
    }
    let limit = machine.edition().rules.thresholds.straight.raw();
    let one = |(side, sign): (&str, i32), beside: i32| {
        let angle = SteerAngle::clamped(sign * (limit + beside));
        let straight = |inputs: &mut Inputs| inputs.vehicle.steer_angle = angle;
        // The wheels are there before "Go" is seen off as well.
        let dwell = machine.edition().rules.timing.ready_dwell_ms;
        let walk = Walk::to(machine, AsState::Ready).set(straight).step(dwell.into(), |_| {});
        let walk = walk.step(walk_cycle(machine), |inputs| inputs.go = true);
        let about = format!("\"Go\" comes on in AS_READY with the wheels at {angle}");
        test(Kind::Limit, format!("steer-angle-{side}-{}", angle.raw().abs()), about, "3.2", walk)
            .checks(["DRV-9", "D-25"])
    };
    [("left", 1), ("right", -1)].into_iter().flat_map(|side| BESIDE.map(|beside| one(side, beside))).collect()
}

/// "Go" seen off when AS_READY has lasted nearly long enough, just long enough, and longer; then it comes on.
fn dwell(machine: &Machine) -> Vec<Test> {
    let limit = i64::from(machine.edition().rules.timing.ready_dwell_ms);
    let one = |beside: i32| {
        let after = limit + i64::from(beside);
        let walk = Walk::to(machine, AsState::Ready).step(u32::try_from(after).unwrap_or(0), |_| {});
        let walk = walk.step(walk_cycle(machine), |inputs| inputs.go = true);
        let about = format!("\"Go\" is seen off {after} ms after AS_READY was entered, and comes on");
        test(Kind::Limit, format!("ready-dwell-{after}-ms"), about, "3.2", walk)
            .checks(["SM-2", "DRV-4", "DRV-11", "D-6"])
    };
    BESIDE.map(one).into()
}

/// ASMS off when EMERGENCY_BRAKE has lasted nearly long enough, just long enough, and longer.
fn ebs_timer(machine: &Machine) -> Vec<Test> {
    let limit = i64::from(machine.edition().rules.timing.ebs_timer_ms);
    let one = |beside: i32| {
        let after = limit + i64::from(beside);
        let walk = Walk::to(machine, AsState::EmergencyBrake)
            .step(u32::try_from(after).unwrap_or(0), |inputs| inputs.asms = false);
        let about = format!("ASMS is off {after} ms after EMERGENCY_BRAKE was entered");
        test(Kind::Limit, format!("ebs-timer-{after}-ms"), about, "3.9", walk)
            .checks(["SM-2", "ETO-1", "ETO-2", "D-23"])
    };
    let switched_off_early = Walk::to(machine, AsState::EmergencyBrake)
        .step(walk_cycle(machine), |inputs| inputs.asms = false)
        .step(u32::try_from(limit).unwrap_or(0), |_| {});
    let early = test(
        Kind::Limit,
        "ebs-timer-asms-off-early",
        "ASMS is turned off while the EBS timer runs, and is still off when it is complete",
        "3.9",
        switched_off_early,
    );
    let mut tests: Vec<Test> = BESIDE.map(one).into();
    tests.push(early.checks(["SM-2", "ETO-2", "D-23"]));
    tests
}
