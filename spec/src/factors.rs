//! Tests of the factors of a step that others take it apart by: what opens the shutdown circuit, what is heard, what is kept.

use crate::messages::AsState;
use crate::{
    Atom, Atoms, Choice, Control, Edition, Fault, Faults, Handshake, Inputs, Machine, Observation, Readings,
};

fn machine(edition: &Edition, choice: Choice) -> Machine {
    Machine::new(*edition, edition.readings.with(choice))
}

//= D-54
#[test]
fn a_fault_of_the_bms_opens_the_shutdown_circuit_unless_it_acts_in_as_driving_only() {
    assert_eq!(Machine::REFERENCE.opening(), Faults::OPENING);
    let driving = machine(&Edition::V4_0, Choice::BmsDriving).opening();
    assert_eq!(driving, Faults::OPENING.without(Fault::BmsFault));
    let seen = Observation::new(Atoms::of(&[Atom::SdcOpen]), Faults::NONE.with(Fault::BmsFault));
    for (choice, opens) in [(Choice::BmsDriving, false), (Choice::BmsSdc, true)] {
        assert_eq!(machine(&Edition::V4_0, choice).atoms_of(seen).has(Atom::SdcOpen), opens, "{choice:?}");
    }
}

//= HS-1, HS-9
#[test]
fn what_is_heard_is_the_handshake_of_the_step() {
    let vcu = Machine::REFERENCE;
    let inputs = Atoms::of(&[Atom::Tsms]);
    let waiting = Handshake { active: true, bit: true, unanswered_ms: 40 };
    let (handshake, lost) = vcu.hear(waiting, inputs, 10);
    assert_eq!((handshake, lost), (Handshake { unanswered_ms: 50, ..waiting }, true));
    let before = Control { handshake: waiting, ..Control::INITIAL };
    let (after, outputs) = vcu.step(&before, &Inputs { tsms: true, ..Inputs::default() }, 10);
    assert_eq!((after.handshake, outputs.faults.has(Fault::AiCommsFault)), (handshake, lost));
}

#[test]
fn what_is_kept_goes_by_the_state_that_a_step_leads_to() {
    let kept = |machine: &Machine, to: AsState| {
        let kept = machine.kept(to);
        [kept.go_seen_low, kept.was_running, kept.was_forward].map(|literals| literals.is_some())
    };
    let edges = Machine::new(Edition::V3_0, Readings::DEFAULT.with(Choice::FaultEdge));
    for to in AsState::ALL {
        let ready = to == AsState::Ready;
        assert_eq!(kept(&Machine::REFERENCE, to), [ready, false, false], "{to}");
        let driving = to == AsState::Driving;
        assert_eq!(kept(&edges, to), [ready, driving, driving], "{to}");
    }
    // Where an edge is enough, nothing but the switch is asked.
    let enough = machine(&Edition::V3_0, Choice::GoEdgeEnough).kept(AsState::Ready).go_seen_low;
    assert!(enough.is_some_and(|low| low.on.is_empty() && low.off == Atoms::of(&[Atom::GoOn])));
}
