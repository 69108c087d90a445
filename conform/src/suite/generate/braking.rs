//! Torque and hydraulic braking at once: which requests exclude each other, where, and which cause the VCU shows.

use adsdv_spec::messages::{AsState, AxleTorqueRequest, BrakePressure};
use adsdv_spec::{Atom, Fault, Inputs, Machine};

use super::{Walk, braking_by, test, walk_cycle};
use crate::suite::{Kind, Test};

/// The fault that the tests are about.
const FAULT: Fault = Fault::BrakePlausibilityFault;

/// Which of two requests are made.
const WHICH: [(&str, bool, bool); 3] = [("front", true, false), ("rear", false, true), ("both", true, true)];

/// The tests of brake plausibility; none where the edition has no such fault.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    if !machine.edition().faults.has(FAULT) {
        return Vec::new();
    }
    let mut tests: Vec<Test> =
        WHICH.iter().flat_map(|torque| WHICH.map(|brake| at_once(machine, *torque, brake))).collect();
    tests.push(apart(machine));
    tests.push(with_a_lower_cause(machine));
    let elsewhere = AsState::ALL.into_iter().filter(|&state| state != AsState::Driving);
    tests.extend(elsewhere.map(|state| outside(machine, state)));
    tests
}

/// The least torque that is one.
fn torque(inputs: &mut Inputs, (_, front, rear): (&str, bool, bool)) {
    inputs.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(front.into());
    inputs.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(rear.into());
}

/// The least pressure that is one.
fn brake(inputs: &mut Inputs, (_, front, rear): (&str, bool, bool)) {
    inputs.ai.brake.hyd_press_f_req = BrakePressure::clamped(front.into());
    inputs.ai.brake.hyd_press_r_req = BrakePressure::clamped(rear.into());
}

const NONE: (&str, bool, bool) = ("none", false, false);

/// The requirements of the rows, and of what the VCU shows.
fn requirements(machine: &Machine) -> impl Iterator<Item = &'static str> {
    let rows = braking_by(machine, Atom::BrakeRequestZero).flat_map(|term| term.cites.requirements).copied();
    rows.chain([FAULT.requirement(), "MSG-85", "D-64"])
}

/// Torque in AS_DRIVING, and one step later a brake as well; the cause stays when both have gone.
fn at_once(machine: &Machine, driven: (&str, bool, bool), braked: (&str, bool, bool)) -> Test {
    let cycle = walk_cycle(machine);
    let walk = Walk::to(machine, AsState::Driving)
        .step(cycle, |inputs| torque(inputs, driven))
        .step(cycle, |inputs| brake(inputs, braked))
        .step(cycle, |inputs| {
            torque(inputs, NONE);
            brake(inputs, NONE);
        });
    let (torque, brake) = (driven.0, braked.0);
    let about =
        format!("the least torque ({torque}) and the least brake pressure ({brake}) at once in AS_DRIVING");
    test(Kind::Fault, format!("braking-{brake}-with-torque-{torque}"), about, "4", walk)
        .checks(requirements(machine).chain(["D-15", "D-17"]))
}

/// Torque without brakes and brakes without torque, one step after the other.
fn apart(machine: &Machine) -> Test {
    let cycle = walk_cycle(machine);
    let mut walk = Walk::to(machine, AsState::Driving);
    for which in WHICH {
        walk = walk
            .step(cycle, |inputs| {
                torque(inputs, which);
                brake(inputs, NONE);
            })
            .step(cycle, |inputs| {
                torque(inputs, NONE);
                brake(inputs, which);
            });
    }
    let about = "torque without brakes and brakes without torque are no fault in AS_DRIVING";
    test(Kind::Fault, "braking-without-torque", about, "4", walk).checks(requirements(machine))
}

/// A fault of a lower number comes at the same step.
fn with_a_lower_cause(machine: &Machine) -> Test {
    let walk = Walk::to(machine, AsState::Driving).step(walk_cycle(machine), |inputs| {
        torque(inputs, WHICH[2]);
        brake(inputs, WHICH[2]);
        inputs.show_fault(Fault::BmsFault, true);
    });
    let about = format!("{} and {FAULT} at once: the lower number is the cause", Fault::BmsFault);
    test(Kind::Fault, "braking-with-a-lower-cause", about, "2.2", walk).checks([
        "MSG-64",
        "D-16",
        FAULT.requirement(),
    ])
}

/// Torque and a brake at once where nobody drives.
fn outside(machine: &Machine, state: AsState) -> Test {
    let walk = Walk::to(machine, state).step(walk_cycle(machine), |inputs| {
        torque(inputs, WHICH[2]);
        brake(inputs, WHICH[2]);
    });
    let about = format!("torque and brakes at once are no fault in {state}");
    test(Kind::NoArrow, format!("braking-in-{state}"), about, "4", walk).checks(["D-27", FAULT.requirement()])
}
