//! Steps that are not seen whole, one by one.

use adsdv_spec::belief::{Belief, Glimpse, KnownFaults, Look, Memory, Outlook, Span};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{
    AsState, Atom, Atoms, Choice, Control, Edition, Fault, Faults, Handshake, Knowledge, Machine,
    Observation, Truth,
};

/// All is as a vehicle that drives wants it, and these conditions are unknown.
fn driving_but_for(unknown: &[Atom]) -> Glimpse {
    let on = Atoms::of(&[Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::GoOn, Atom::MissionRunning])
        .with(Atom::BrakeRequestZero);
    let seen = Observation::new(on, Faults::NONE);
    let atoms = Knowledge::exact(seen.atoms()).forget(Atoms::of(unknown));
    let unseen = |atom, faults| if unknown.contains(&atom) { faults } else { Faults::NONE };
    let unseen = unseen(Atom::SdcOpen, Faults::OPENING).union(unseen(Atom::BmsFault, bms()));
    Glimpse::new(atoms, KnownFaults::new(Faults::NONE, Faults::ALL.difference(unseen)))
}

fn bms() -> Faults {
    Faults::NONE.with(Fault::BmsFault)
}

/// A vehicle that drives, and has just been answered.
const DRIVING: Control = Control {
    state: AsState::Driving,
    handshake: Handshake { active: true, bit: true, unanswered_ms: 0 },
    ..Control::INITIAL
};

fn drives(machine: &Machine, unknown: &[Atom]) -> Outlook {
    machine.outlook(&Belief::exact(&DRIVING), &driving_but_for(unknown), 10..=10)
}

fn states(outlook: &Outlook) -> Vec<AsState> {
    outlook.belief().states().collect()
}

#[test]
fn a_time_that_is_empty_leads_nowhere() {
    let (later, earlier) = (12, 8);
    let belief = Belief::anything(&Edition::V3_0.rules.timing);
    assert!(Machine::REFERENCE.react_known(&belief, &Glimpse::NOTHING, later..=earlier).is_empty());
    assert!(Machine::REFERENCE.react_known(&Belief::NONE, &Glimpse::NOTHING, earlier..=later).is_empty());
}

/// A circuit that may be open: if the vehicle brakes, one of the faults that open it is the cause.
#[test]
fn what_is_taken_tells_what_was_so() {
    let outlook = drives(&Machine::REFERENCE, &[Atom::SdcOpen, Atom::BmsFault]);
    assert_eq!(states(&outlook), [AsState::Driving, AsState::EmergencyBrake]);
    let brakes = outlook.state(AsState::EmergencyBrake).expect("it may brake");
    assert!(!brakes.memory.shutdown_cause.none);
    assert_eq!(brakes.memory.shutdown_cause.faults, Faults::OPENING);
    assert_eq!(brakes.memory.power_cycle_needed, Truth::True);
    assert_eq!(brakes.faults.of(Fault::AiCommsFault), Truth::False);
    let drives = outlook.state(AsState::Driving).expect("it may go on");
    assert!(drives.memory.shutdown_cause.none && drives.memory.shutdown_cause.faults.is_empty());
}

/// Of two alternatives of a row that may both hold, each may be the reason of it.
#[test]
fn every_alternative_that_may_hold_may_be_the_reason() {
    let outlook = drives(&Machine::REFERENCE, &[Atom::Asms, Atom::GoOn, Atom::AiEstop]);
    let brakes = outlook.state(AsState::EmergencyBrake).expect("it may brake");
    assert_eq!(brakes.memory.shutdown_cause.faults, Faults::NONE.with(Fault::HvilOpenFault));
    assert_eq!(brakes.faults.of(Fault::HvilOpenFault), Truth::True);

    let outlook = drives(&Machine::REFERENCE, &[Atom::GoOn, Atom::Moving, Atom::DirectionNeutral]);
    let brakes = outlook.state(AsState::EmergencyBrake).expect("it may brake");
    let expected = Faults::of(&[Fault::HvilOpenFault, Fault::AutonomousBrakingFault]);
    assert_eq!(brakes.memory.shutdown_cause.faults, expected);
    assert!(!brakes.memory.shutdown_cause.none);
    assert_eq!(brakes.faults.of(Fault::HvilOpenFault), Truth::Unknown);
}

/// 49 ms unanswered or 50: in the one case it drives on, in the other it brakes.
#[test]
fn a_handshake_that_may_be_lost_is_taken_case_by_case() {
    let mut memory = Memory::exact(&DRIVING);
    memory.handshake.high = Some(Span::between(30, 45));
    let belief = Belief::NONE.with(AsState::Driving, memory);
    let outlook = Machine::REFERENCE.outlook(&belief, &driving_but_for(&[]), 10..=10);
    assert_eq!(states(&outlook), [AsState::Driving, AsState::EmergencyBrake]);
    let high = |state| outlook.state(state).and_then(|possible| possible.memory.handshake.high);
    assert_eq!(high(AsState::Driving), Some(Span::between(40, 49)));
    assert_eq!(high(AsState::EmergencyBrake), Some(Span::exact(50)));
    let comms =
        outlook.state(AsState::EmergencyBrake).map(|possible| possible.faults.of(Fault::AiCommsFault));
    assert_eq!(comms, Some(Truth::True));
}

/// A message that may be missed may be the end of it, where it is watched.
//= D-51
#[test]
fn a_message_that_may_be_missed_is_taken_case_by_case() {
    let reading = |choice| Machine::new(Edition::V4_0, Edition::V4_0.readings.with(choice));
    let machine = Machine::new(Edition::V4_0, Edition::V4_0.readings);
    let both = [AsState::Driving, AsState::EmergencyBrake];
    assert_eq!(states(&drives(&machine, &[Atom::AiMessagesMissed])), both);
    assert_eq!(states(&drives(&machine, &[])), [AsState::Driving]);

    // With TSMS off the handshake rests, and nothing is watched but under the reading.
    let missed =
        driving_but_for(&[]).atoms().set(Atom::AiMessagesMissed, Truth::True).set(Atom::Tsms, Truth::False);
    let seen = Glimpse::new(missed, KnownFaults::exact(Faults::NONE));
    let comes_to = |machine: &Machine| states(&machine.outlook(&Belief::exact(&DRIVING), &seen, 10..=10));
    assert_eq!(comes_to(&machine), [AsState::Driving]);
    assert_eq!(comes_to(&reading(Choice::WatchAlways)), [AsState::EmergencyBrake]);
    assert_eq!(comes_to(&reading(Choice::HandshakeAlways)), [AsState::EmergencyBrake]);
}

/// The time of a state that may have come: in either case what is remembered fits.
#[test]
fn a_time_that_may_have_come_is_taken_case_by_case() {
    let machine = Machine::REFERENCE;
    let limit = machine.edition().rules.timing.ebs_timer_ms;
    let control = Control {
        state: AsState::EmergencyBrake,
        power_cycle_needed: true,
        shutdown_cause: ShutdownCause::EbsFault,
        ..Control::INITIAL
    };
    let mut memory = Memory::exact(&control);
    memory.in_state = Span::between(limit - 20, limit - 1);
    let belief = Belief::NONE.with(control.state, memory);
    let seen = Glimpse::exact(Observation::default());
    let outlook = machine.outlook(&belief, &seen, 10..=10);
    assert_eq!(states(&outlook), [AsState::Off, AsState::EmergencyBrake]);
    let in_state = |state| outlook.state(state).map(|possible| possible.memory.in_state);
    assert_eq!(in_state(AsState::EmergencyBrake), Some(Span::between(limit - 10, limit - 1)));
    assert_eq!(in_state(AsState::Off), Some(Span::exact(0)));
}

/// "Go" that is known to be on arms no edge; and under the reading the switch alone arms it.
#[test]
fn the_go_edge_is_armed_as_far_as_is_known() {
    let ready = Control { state: AsState::Ready, ..Control::INITIAL };
    let armed = |machine: &Machine, seen: Knowledge| {
        let seen = Glimpse::new(seen, KnownFaults::exact(Faults::NONE));
        let after = machine.react_known(&Belief::exact(&ready), &seen, 10..=10);
        after.memory(AsState::Ready).map(|memory| memory.go_seen_low)
    };
    let asms = Atoms::of(&[Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected, Atom::EbsArmed]);
    let off = Knowledge::exact(asms);
    let unknown = off.set(Atom::GoOn, Truth::Unknown);
    let enough = Machine::new(Edition::V3_0, Edition::V3_0.readings.with(Choice::GoEdgeEnough));
    assert_eq!(armed(&enough, off), Some(Truth::True));
    assert_eq!(armed(&enough, unknown), Some(Truth::Unknown));
    assert_eq!(armed(&enough, off.set(Atom::GoOn, Truth::True)), Some(Truth::False));
    // The dwell has not elapsed.
    assert_eq!(armed(&Machine::REFERENCE, unknown), Some(Truth::False));
    // Nothing leads to AS_DRIVING, so there is no edge.
    let nowhere = Machine::new(Edition::V3_0.with_table(adsdv_spec::Table::new(&[])), Edition::V3_0.readings);
    assert_eq!(armed(&nowhere, off), Some(Truth::False));
}

/// Where one condition alone of an arrow is unknown, that is what fails when it is not taken; of two, nobody knows.
#[test]
fn an_arrow_that_is_passed_over_tells_what_fails() {
    let machine = Machine::REFERENCE;
    let moving = Atoms::of(&[Atom::MissionFinished, Atom::Moving]);
    let known = Knowledge::exact(Atoms::of(&[Atom::Asms, Atom::GoOn]));
    let place = |known: Knowledge| {
        (0..20).find_map(|place| match machine.look(AsState::Driving, place, known) {
            Look { outcome: Some(outcome), rest } => Some((outcome, rest)),
            Look { outcome: None, .. } => None,
        })
    };
    let (outcome, rest) = place(known.forget(moving)).expect("it may be taken");
    assert_eq!(outcome.known, known.learn(moving, moving));
    assert_eq!(rest, Some(known.forget(moving)), "one of two fails");
    let one = Atoms::of(&[Atom::Moving]);
    let finished = known.learn(moving, Atoms::of(&[Atom::MissionFinished]));
    let (outcome, rest) = place(finished.forget(one)).expect("it may be taken");
    assert_eq!(outcome.known, finished.learn(one, one));
    assert_eq!(rest, Some(finished), "that one fails");
    let (_, rest) = place(finished.learn(one, one)).expect("it is taken");
    assert_eq!(rest, None);
    let outcomes: Vec<_> = machine.outcomes(AsState::Driving, finished).collect();
    assert_eq!(outcomes.len(), 1);
    assert_eq!((outcomes[0].taken, outcomes[0].known), (None, finished), "the state stays");
}

/// Changes count under the reading, as far as they are known.
#[test]
fn what_was_is_remembered_while_changes_count() {
    let machine = Machine::new(Edition::V3_0, Edition::V3_0.readings.with(Choice::FaultEdge));
    let memory = |unknown: &[Atom]| {
        let outlook = drives(&machine, unknown);
        let memory = outlook.state(AsState::Driving).map(|possible| possible.memory);
        memory.map(|memory| (memory.was_running, memory.was_forward))
    };
    assert_eq!(memory(&[]), Some((Truth::True, Truth::True)));
    assert_eq!(memory(&[Atom::MissionRunning]), Some((Truth::Unknown, Truth::True)));
    assert_eq!(memory(&[Atom::DirectionNeutral]), Some((Truth::True, Truth::Unknown)));
    let outlook = drives(&Machine::REFERENCE, &[Atom::MissionRunning, Atom::DirectionNeutral]);
    let level = outlook.state(AsState::Driving).map(|possible| possible.memory);
    assert_eq!(
        level.map(|memory| (memory.was_running, memory.was_forward)),
        Some((Truth::False, Truth::False))
    );
}
