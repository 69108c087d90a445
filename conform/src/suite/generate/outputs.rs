//! What is shown in each state, and for each value: what reaches the actuators, and what 520h tells of switches, "Go",
//! mission and steering.

use adsdv_spec::messages::{
    Ai2VcuBrake, AmiState, AsState, AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState,
    MissionStatus, MotorSpeedMax, SteerAngle,
};
use adsdv_spec::{Actuation, Bus, Fault, Inputs, Machine};

use super::{Walk, test, walk_cycle};
use crate::protocol::ShownField;
use crate::suite::{Kind, Test};

/// The tests of what a program shows beside its state, its handshake and its faults.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let mut tests: Vec<Test> = AsState::ALL.map(|state| requests(machine, state)).into();
    tests.push(every_state(machine));
    tests.push(switches(machine));
    tests.push(missions(machine));
    tests.extend(reported(machine));
    tests
}

/// Every request of the AI Computer, in the step in which a state is entered, where its arrow allows that, and in the next
/// one the other way round.
fn requests(machine: &Machine, state: AsState) -> Test {
    let (cycle, bus) = (walk_cycle(machine), &machine.edition().bus);
    // Where torque and brakes exclude each other while driving, they are requested one after the other.
    let apart = machine.edition().faults.has(Fault::BrakePlausibilityFault);
    let torque = |inputs: &mut Inputs, most: Axle| {
        request(inputs, bus, most);
        if apart {
            inputs.ai.brake = Ai2VcuBrake::default();
        }
    };
    let brakes = |inputs: &mut Inputs, most: Axle| {
        request(inputs, bus, most);
        inputs.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::MIN;
        inputs.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::MIN;
    };
    let start = Walk::new(machine).set(|inputs| request(inputs, bus, Axle::Front));
    let walk = match state {
        AsState::Off => start.cycle(),
        AsState::Ready => start.into_ready(),
        // Its arrow asks for zero.
        AsState::Driving => {
            let walk = Walk::to(machine, state);
            let walk = if apart {
                walk.step(cycle, |inputs| brakes(inputs, Axle::Front))
                    .step(cycle, |inputs| brakes(inputs, Axle::Rear))
            } else {
                walk
            };
            walk.step(cycle, |inputs| torque(inputs, Axle::Front))
        }
        AsState::Finished => Walk::to(machine, AsState::Driving).step(cycle, |inputs| {
            inputs.ai.status.mission_status = MissionStatus::Finished;
            torque(inputs, Axle::Front);
        }),
        AsState::EmergencyBrake => start.into_ready().step(cycle, |inputs| inputs.sdc.vehicle_estop = true),
    };
    let walk = walk.step(cycle, |inputs| match state {
        AsState::Driving => torque(inputs, Axle::Rear),
        _ => request(inputs, bus, Axle::Rear),
    });
    let about = format!("which requests of the AI Computer reach the actuators in {state}");
    test(Kind::Output, format!("requests-in-{state}"), about, "2.1", walk)
        .checks(Actuation::requirements(state).iter().copied())
}

/// An axle of the vehicle.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Axle {
    Front,
    Rear,
}

/// Requests the most of one axle and the least of the other that is not nothing; with the front axle, FORWARD and a turn to
/// the left, with the rear axle NEUTRAL and a turn to the right.
fn request(inputs: &mut Inputs, bus: &Bus, most: Axle) {
    let forward = most == Axle::Front;
    let of = |axle: Axle, all: i32| if axle == most { all } else { 1 };
    let ai = &mut inputs.ai;
    let (torque, speed) = (AxleTorqueRequest::MAX.raw(), MotorSpeedMax::MAX.raw());
    let pressure = BrakePressure::MAX.raw();
    ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(of(Axle::Front, torque));
    ai.drive_f.front_motor_speed_max = MotorSpeedMax::clamped(of(Axle::Front, speed));
    ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(of(Axle::Rear, torque));
    ai.drive_r.rear_motor_speed_max = MotorSpeedMax::clamped(of(Axle::Rear, speed));
    ai.brake.hyd_press_f_req = BrakePressure::clamped(of(Axle::Front, pressure));
    ai.brake.hyd_press_r_req = BrakePressure::clamped(of(Axle::Rear, pressure));
    let steer = bus.signal_of("steer_request").map_or((0, 0), |signal| (signal.min, signal.max));
    ai.steer.steer_request = SteerAngle::clamped(if forward { steer.1 } else { steer.0 });
    ai.status.direction_request = if forward { DirectionRequest::Forward } else { DirectionRequest::Neutral };
}

/// Through all states, with "Go" on in each of them.
fn every_state(machine: &Machine) -> Test {
    let cycle = walk_cycle(machine);
    let dwell = machine.edition().rules.timing.ready_dwell_ms;
    let walk = Walk::new(machine)
        .cycle()
        .set(|inputs| inputs.go = true)
        .cycle()
        .into_ready()
        .step(dwell.into(), |inputs| inputs.go = false)
        .step(cycle, |inputs| inputs.go = true)
        .step(cycle, |inputs| inputs.ai.status.mission_status = MissionStatus::Finished)
        .step(cycle, |inputs| inputs.sdc.vehicle_estop = true);
    let about = "each state as 520h tells it, with \"Go\" on";
    // Everything of 520h but the fault flags, each of which has tests of its own.
    let status = (42..=53).chain([64]).map(|number| format!("MSG-{number}"));
    let ids: Vec<String> = status.chain(["SM-3", "D-37", "D-38"].map(str::to_owned)).collect();
    let of_vehicle = of_vehicle(machine).flat_map(|field| field.requirements).copied();
    test(Kind::Output, "every-state", about, "2.2", walk)
        .checks(ids.iter().map(String::as_str).chain(of_vehicle))
}

/// What 520h tells of the vehicle beside its AS: what it is operated for, its tractive system and its EBS.
fn of_vehicle(machine: &Machine) -> impl Iterator<Item = &'static ShownField> {
    const OF_VEHICLE: [&ShownField; 3] =
        [ShownField::of("op_state"), ShownField::of("ts_state"), ShownField::of("ebs_state")];
    OF_VEHICLE.into_iter().filter(|field| field.is_in(machine.edition()))
}

/// What these go by: the charger, TSMS, and the EBS; none where the edition tells none of them.
fn reported(machine: &Machine) -> Option<Test> {
    let mut fields = of_vehicle(machine).peekable();
    fields.peek()?;
    let cycle = walk_cycle(machine);
    let walk = [EbsState::Unavailable, EbsState::Armed, EbsState::Triggered]
        .into_iter()
        .fold(Walk::new(machine), |walk, ebs| walk.step(cycle, |inputs| inputs.ebs = ebs))
        .step(cycle, |inputs| inputs.reports.charging = true)
        .step(cycle, |inputs| inputs.tsms = true)
        .step(cycle, |inputs| inputs.reports.charging = false)
        .step(cycle, |inputs| inputs.tsms = false);
    let about = "the charger, TSMS and the EBS, as 520h tells what the vehicle is operated for";
    Some(
        test(Kind::Output, "vehicle-states", about, "2.2", walk)
            .checks(fields.flat_map(|field| field.requirements).copied()),
    )
}

/// Each master switch without the other, and both.
fn switches(machine: &Machine) -> Test {
    let cycle = walk_cycle(machine);
    let walk = [(true, false), (false, true), (true, true)]
        .into_iter()
        .fold(Walk::new(machine), |walk, on| walk.step(cycle, |inputs| (inputs.asms, inputs.tsms) = on));
    test(Kind::Output, "switches", "each master switch on its own, and both", "2.2", walk)
        .checks(["MSG-44", "MSG-45"])
}

/// Every mission that can be selected, and none.
fn missions(machine: &Machine) -> Test {
    let cycle = walk_cycle(machine);
    let walk = AmiState::ALL
        .into_iter()
        .fold(Walk::new(machine), |walk, ami| walk.step(cycle, |inputs| inputs.ami = ami));
    test(Kind::Output, "missions", "each mission that is selected on the AMI", "2.2", walk)
        .checks(["MSG-49", "RDY-6"])
}
