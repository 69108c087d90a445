//! Random paths: the raw inputs do what the observations did, and no log blames a VCU that is right.

use std::collections::BTreeSet;

use adsdv_model::{Action, Run};
use adsdv_proofs::seed::seed;
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Control, Edition, Faults, Machine, Observation, Readings};

use crate::chance::Random;
use crate::path::{CYCLE_MS, blamed, judged};

/// What keeps a vehicle on its way to AS_DRIVING, with some conditions turned round; or anything at all.
fn observation(random: &mut Random, control: &Control, rate: u64) -> Observation {
    let mut atoms = Atoms::of(&[
        Atom::Asms,
        Atom::Tsms,
        Atom::AmiSelected,
        Atom::MissionSelected,
        Atom::EbsArmed,
        Atom::FrontTorqueZero,
        Atom::RearTorqueZero,
        Atom::SteerRequestZero,
        Atom::SteerStraight,
        Atom::DirectionNeutral,
        Atom::AtRest,
    ]);
    if control.state == AsState::Driving || control.go_seen_low {
        atoms = atoms.with(Atom::GoOn);
    }
    if control.state == AsState::Driving {
        let mission = if random.one_in(50) { Atom::MissionFinished } else { Atom::MissionRunning };
        atoms = atoms.without(Atom::MissionSelected).without(Atom::DirectionNeutral).with(mission);
    }
    if control.handshake.bit != random.one_in(rate) {
        atoms = atoms.with(Atom::AiHandshake);
    }
    let mut faults = Faults::NONE;
    if random.one_in(4) {
        for &atom in Atom::ALL {
            if random.one_in(rate) {
                atoms = if atoms.has(atom) { atoms.without(atom) } else { atoms.with(atom) };
            }
        }
        for fault in Edition::DEFAULT.faults.iter() {
            if random.one_in(rate * 10) {
                faults = faults.with(fault);
            }
        }
    }
    if control.state == AsState::EmergencyBrake && random.one_in(3) {
        atoms = atoms.without(Atom::Asms);
    }
    // What is read of an observation that inputs cannot show may still be shown; here it is just drawn again.
    let seen = Observation::new(atoms, faults);
    if seen.is_possible() { seen } else { observation(random, control, rate) }
}

/// How rarely things go wrong: paths that are calm, lively and wild take turns.
const RATES: [u64; 3] = [500, 20, 3];

fn path(random: &mut Random, machine: &Machine, rate: u64, steps: u32) -> Vec<Action> {
    let mut control = Control::INITIAL;
    (0..steps)
        .map(|_| {
            let stuck = control.state == AsState::Off && control.power_cycle_needed;
            if control != Control::INITIAL && random.one_in(if stuck { 10 } else { 1000 }) {
                control = Control::INITIAL;
                return Action::PowerCycle;
            }
            let seen = observation(random, &control, rate);
            control = machine.react(&control, seen, CYCLE_MS).control;
            Action::Step(seen)
        })
        .collect()
}

/// The default readings, and each other choice alone.
fn machines() -> impl Iterator<Item = Machine> {
    let others = Edition::DEFAULT.alternatives().iter();
    let readings = others.map(|choice| Readings::DEFAULT.with(choice));
    std::iter::once(Readings::DEFAULT)
        .chain(readings)
        .map(|readings| Machine::new(*Edition::DEFAULT, readings))
}

/// The chance of one machine: other chance for each, and for each seed.
fn chance(place: u64) -> Random {
    Random::with_seed(seed().wrapping_mul(1 << 32).wrapping_add(place))
}

#[test]
fn raw_inputs_lead_where_the_observations_led() {
    for (place, machine) in (0..).zip(machines()) {
        let mut random = chance(place);
        let mut states = BTreeSet::new();
        for rate in [RATES, RATES].concat() {
            let path = path(&mut random, &machine, rate, 3000);
            let run = Run::new(&machine, path.iter().copied());
            let mut steps = run.steps();
            let mut control = Control::INITIAL;
            for action in path {
                let Action::Step(seen) = action else {
                    control = Control::INITIAL;
                    continue;
                };
                let step = steps.next().expect("each step of the path is in the run");
                assert_eq!(step.before, control);
                let reaction = machine.react(&control, seen, CYCLE_MS);
                let (done, expected) = ((step.after, step.outputs.taken), (reaction.control, reaction.taken));
                assert_eq!(done, expected, "seed {}: {seen:?}", seed());
                control = reaction.control;
                states.insert(control.state);
            }
            assert_eq!(steps.next(), None);
        }
        assert_eq!(states.len(), AsState::ALL.len(), "{}: only {states:?}", machine.readings());
    }
}

#[test]
fn no_log_of_a_right_vcu_is_a_violation_of_the_vcu() {
    for (place, machine) in (100..).zip(machines()) {
        let mut random = chance(place);
        for (number, rate) in RATES.into_iter().cycle().take(21).enumerate() {
            let path = path(&mut random, &machine, rate, 1200);
            let run = Run::new(&machine, path).persisting(Run::AFTERMATH_MS);
            let report = judged(&run, machine.readings());
            assert!(
                blamed(&report).is_empty(),
                "seed {}, readings {}, path {number}: {:#?}",
                seed(),
                machine.readings(),
                blamed(&report)
            );
        }
    }
}
