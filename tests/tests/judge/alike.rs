//! Reasons of an emergency that the VCU reports alike, so that a log cannot tell which it was (D-13).

use adsdv_oracle::judge::{JudgeOptions, Transition};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Truth};
use adsdv_tests::world::World;

/// What brings the vehicle to EMERGENCY_BRAKE.
type Trigger = fn(&mut World);

/// The arrow to EMERGENCY_BRAKE in a world that was driving, when this has happened.
fn brake(happens: Trigger) -> Transition {
    let mut world = World::reference();
    world.driving();
    happens(&mut world);
    world.wait(500);
    let report = world.judge(JudgeOptions::default());
    let to_brake = |transition: &Transition| transition.to == AsState::EmergencyBrake;
    report.transitions.into_iter().find(to_brake).expect("it brakes")
}

fn alternatives(transition: &Transition) -> Vec<Atom> {
    let decided = transition.decided.iter().chain(&transition.or);
    decided.flat_map(|(term, _)| term.literals()).map(|(atom, _)| atom).collect()
}

#[test]
fn go_off_and_an_open_circuit_are_reported_together() {
    let cases: [(Trigger, Atom); 3] = [
        (|world| world.inputs.go = false, Atom::GoOn),
        (|world| world.inputs.asms = false, Atom::Asms),
        (|world| world.inputs.sdc.remote_estop = true, Atom::SdcOpen),
    ];
    for (happens, reason) in cases {
        let transition = brake(happens);
        assert_eq!(transition.justified, Truth::True);
        assert!(alternatives(&transition).contains(&reason), "{reason}: {transition:#?}");
    }
}

#[test]
fn what_has_a_cause_of_its_own_is_reported_alone() {
    let transition = brake(|world| world.inputs.sdc.bms_fault = true);
    assert_eq!(alternatives(&transition), [Atom::SdcOpen]);
    assert!(transition.or.is_empty());
}
