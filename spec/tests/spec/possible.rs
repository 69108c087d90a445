//! Which observations some inputs can look like.

use adsdv_spec::{Atom, Atoms, Fault, Faults, Observation};

fn possible(atoms: &[Atom], faults: Faults) -> bool {
    let atoms = atoms.iter().fold(Atoms::NONE, |all, &atom| all.with(atom));
    Observation::new(atoms, faults).is_possible()
}

fn seen(atoms: &[Atom]) -> bool {
    possible(atoms, Faults::NONE)
}

#[test]
fn mission_status_has_one_value_or_another_that_no_arrow_asks_for() {
    use Atom::{MissionFinished, MissionRunning, MissionSelected};
    let missions = [MissionSelected, MissionRunning, MissionFinished];
    assert!(seen(&[]));
    for (index, &one) in missions.iter().enumerate() {
        assert!(seen(&[one]), "{one}");
        for &other in &missions[..index] {
            assert!(!seen(&[one, other]), "{one} and {other}");
        }
    }
    assert!(!seen(&missions));
}

#[test]
fn a_vehicle_is_not_at_rest_and_moving_but_may_be_in_between() {
    assert!(seen(&[Atom::Moving]) && seen(&[Atom::AtRest]) && seen(&[]));
    assert!(!seen(&[Atom::Moving, Atom::AtRest]));
}

//= MSG-62
#[test]
fn charging_is_a_fault_while_a_master_switch_is_on() {
    let charging = Faults::NONE.with(Fault::ChargeProcedureFault);
    assert!(!possible(&[], charging));
    assert!(possible(&[Atom::Asms], charging));
    assert!(possible(&[Atom::Tsms], charging));
    assert!(possible(&[Atom::Asms, Atom::Tsms], charging));
    assert!(possible(&[], Faults::NONE.with(Fault::BmsFault)), "another fault needs no switch");
}
