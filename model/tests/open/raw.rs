//! Beside the exploration, which sees conditions: a long run on raw inputs, with values that no abstraction chose.

use adsdv_model::{Step, Vectors, properties};
use adsdv_spec::messages::{AxleTorqueRequest, SteerAngle, WheelSpeed};
use adsdv_spec::{Atom, Control, Edition, Fault, Inputs, Machine, Observation};

use crate::chance::Random;
use crate::reachable;

fn value(random: &mut Random, from: i32, to: i32) -> i32 {
    from + i32::try_from(random.below(usize::try_from(to - from + 1).unwrap_or(1))).unwrap_or_default()
}

/// Inputs that wander: mostly towards what lets a mission go on, sometimes anywhere.
fn wander(inputs: &mut Inputs, control: &Control, random: &mut Random) {
    let thresholds = &Edition::DEFAULT.rules.thresholds;
    let input_atoms: Vec<Atom> = Observation::SCOPE.iter().filter(|atom| *atom != Atom::SdcOpen).collect();
    if random.one_in(400) {
        let atom = input_atoms[random.below(input_atoms.len())];
        inputs.show(atom, random.one_in(2), thresholds);
    }
    if random.one_in(3000) {
        let faults: Vec<Fault> = Edition::DEFAULT.faults.iter().collect();
        let fault = faults[random.below(faults.len())];
        inputs.show_fault(fault, true);
    } else if random.one_in(20) {
        for fault in Edition::DEFAULT.faults.iter() {
            inputs.show_fault(fault, false);
        }
    }
    // The rest drifts to what the next arrow of a mission needs.
    if random.one_in(20) {
        use adsdv_spec::AsState::{Driving, EmergencyBrake, Finished, Off, Ready};
        let (on, off): (&[Atom], &[Atom]) = match control.state {
            Off => (
                &[Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected, Atom::EbsArmed],
                &[Atom::AiEstop],
            ),
            Ready => (
                &[
                    Atom::FrontTorqueZero,
                    Atom::RearTorqueZero,
                    Atom::SteerRequestZero,
                    Atom::SteerStraight,
                    Atom::DirectionNeutral,
                ],
                &[],
            ),
            Driving if random.one_in(10) => (&[Atom::AtRest, Atom::MissionFinished], &[]),
            Driving => (&[Atom::GoOn], &[]),
            Finished if !random.one_in(20) => (&[], &[]),
            Finished | EmergencyBrake => (&[], &[Atom::Asms]),
        };
        for (atoms, value) in [(on, true), (off, false)] {
            for &atom in atoms {
                inputs.show(atom, value, thresholds);
            }
        }
    }
    if random.one_in(50) && control.state != adsdv_spec::AsState::Driving {
        inputs.go = !inputs.go;
    }
    if random.one_in(100) {
        let ai = &mut inputs.ai;
        let wheels = &mut inputs.vehicle.wheel_speeds;
        match random.below(5) {
            0 => ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(value(random, 0, 1950)),
            1 => ai.steer.steer_request = SteerAngle::clamped(value(random, -240, 240)),
            2 => inputs.vehicle.steer_angle = SteerAngle::clamped(value(random, -60, 60)),
            3 => wheels.fl_wheel_speed = WheelSpeed::clamped(value(random, 5, 15)),
            _ => wheels.rr_wheel_speed = WheelSpeed::clamped(value(random, 0, 1000)),
        }
    }
    // An AI Computer that answers, but for now and then.
    if !random.one_in(300) {
        inputs.ai.status.handshake = control.handshake.bit;
    }
}

#[test]
fn random_raw_inputs_stay_within_what_was_explored() {
    let machine = Machine::REFERENCE;
    let cycle_ms = u32::from(Edition::DEFAULT.rules.timing.cycle_ms);
    let explored = reachable(&machine, Vectors::Read);
    let mut random = Random::with_seed(3);
    let (mut control, mut inputs) = (Control::INITIAL, Inputs::default());
    let mut arrows = vec![0_u32; machine.edition().rules.table.rows().len()];
    for step in 0..4_000_000 {
        wander(&mut inputs, &control, &mut random);
        let seen = inputs.observe(&machine.edition().rules.thresholds);
        let observed = Step::of(&machine, &Edition::DEFAULT.rules.timing, control, seen);
        let (after, outputs) = machine.step(&control, &inputs, cycle_ms);
        assert_eq!(after, *observed.after(), "a step sees its inputs only through their observation");
        for property in properties(Edition::DEFAULT) {
            assert!(property.holds(&machine, &observed), "{} at step {step}: {observed:?}", property.name);
        }
        assert!(explored.contains(&after), "step {step} reaches a state that was not explored: {after:?}");
        if let Some(taken) = outputs.taken {
            arrows[usize::from(taken.row)] += 1;
        }
        control = after;
        let stuck = control.power_cycle_needed && control.state == adsdv_spec::AsState::Off;
        if stuck || random.one_in(100_000) {
            (control, inputs) = (Control::INITIAL, Inputs::default());
        }
    }
    assert!(arrows.iter().all(|&times| times > 5), "some arrow is hardly ever taken: {arrows:?}");
}
