//! Small functions that the tables use when they are compiled, or that only other crates call: what they do at run time.

use adsdv_spec::editions::{V3_0, V4_0};
use adsdv_spec::messages::{
    AmiState, AsState, DecodeError, EbsState, Layout, Node, ShutdownCause, SteerAngle, Vcu2AiStatus,
    Vcu2LogStatus,
};
use adsdv_spec::{
    Atom, Atoms, Choice, Choices, Edition, Fault, Faults, Knowledge, Machine, Reading, Readings, Row, Table,
    Term, Timing, Truth,
};

#[test]
fn a_table_is_what_it_is_written_down_with() {
    let terms = [Term::on("4", &[Atom::Moving]).fault(Fault::MissionStatusFault).reading(Choice::FaultLevel)];
    assert_eq!(
        (terms[0].fault, terms[0].on),
        (Some(Fault::MissionStatusFault), Atoms::NONE.with(Atom::Moving))
    );
    assert_eq!(terms[0].readings, Choices::NONE.with(Choice::FaultLevel));
    let row = Row::of(AsState::Driving, AsState::EmergencyBrake, "3.7", &terms);
    assert_eq!((row.terms(), row.section), (&terms[..], "3.7"));
    let table = Table::of(&[row]);
    assert_eq!(table.rows(), [row]);
    assert_eq!(table, Table::new(&[row]));
}

#[test]
fn an_edition_with_one_thing_changed_has_the_rest_as_it_was() {
    let table = Table::new(&[]);
    let timing = Timing { cycle_ms: 1, ..Edition::V3_0.rules.timing };
    let other = Edition::V3_0.with_table(table).with_timing(timing);
    assert_eq!((other.rules.table, other.rules.timing), (table, timing));
    let restored = other.with_table(Edition::V3_0.rules.table).with_timing(Edition::V3_0.rules.timing);
    assert_eq!(restored, Edition::V3_0);
}

#[test]
fn what_is_usual_is_the_document_as_it_is() {
    assert_eq!(Edition::default(), Edition::V3_0);
    assert_eq!(Readings::default(), Readings::DEFAULT);
    let machine = Machine::default();
    assert_eq!((machine.edition(), machine.readings()), (&Edition::V3_0, Readings::DEFAULT));
}

#[test]
fn every_reading_has_a_question_and_answers_in_words() {
    for &reading in Reading::ALL {
        assert!(reading.question().ends_with('?'), "{reading}: {}", reading.question());
        assert!(
            reading.section().starts_with(|c: char| c.is_ascii_digit()),
            "{reading}: {}",
            reading.section()
        );
        let mut answers: Vec<&str> = reading.choices().iter().map(|choice| choice.text()).collect();
        answers.sort_unstable();
        answers.dedup();
        assert_eq!(answers.len(), reading.choices().len(), "{reading}: each answer is another");
    }
}

#[test]
fn a_cause_names_its_fault_and_a_flag_shows_it() {
    assert_eq!(Fault::of_cause(ShutdownCause::NoShutdown), None);
    for cause in ShutdownCause::ALL.into_iter().filter(|&cause| cause != ShutdownCause::NoShutdown) {
        let fault = Fault::of_cause(cause).expect("a fault");
        assert_eq!(Faults::NONE.with(fault).cause(), cause);
        if !Edition::V3_0.faults.has(fault) {
            continue;
        }
        let mut status = Vcu2AiStatus::default();
        assert!(Faults::shown_by(&status).is_empty());
        let flag = <V4_0 as Layout<Vcu2AiStatus>>::DEF.signal(fault.flag()).expect("a signal of 520h");
        status = V4_0::decode(&flag.put(V4_0::encode(&status).data, 1)).expect("a flag is 0 or 1");
        assert_eq!(Faults::shown_by(&status), Faults::NONE.with(fault));
    }
}

#[test]
fn what_is_known_can_be_forgotten_and_met() {
    let both = Atoms::NONE.with(Atom::Asms).with(Atom::Tsms);
    let known = Knowledge::NOTHING.learn(both, Atoms::NONE.with(Atom::Asms));
    assert_eq!((known.of(Atom::Asms), known.of(Atom::Tsms)), (Truth::True, Truth::False));
    let forgotten = known.forget(Atoms::NONE.with(Atom::Tsms));
    assert_eq!((forgotten.of(Atom::Asms), forgotten.of(Atom::Tsms)), (Truth::True, Truth::Unknown));
    assert_eq!(known.set(Atom::Tsms, Truth::Unknown), forgotten);
    let other = Knowledge::NOTHING.learn(both, both);
    assert_eq!(known.meet(other), forgotten);
}

#[test]
fn a_status_shows_atoms() {
    let status =
        Vcu2AiStatus { as_switch_status: true, ami_state: AmiState::Skidpad, ..Vcu2AiStatus::default() };
    assert_eq!(status.atoms(), Atoms::NONE.with(Atom::Asms).with(Atom::AmiSelected));
    let log = Vcu2LogStatus { state_ebs: EbsState::Armed, ..Vcu2LogStatus::default() };
    assert_eq!(log.atoms(), Atoms::NONE.with(Atom::EbsArmed));
}

#[test]
fn a_set_is_made_of_the_bits_of_its_elements_alone() {
    assert_eq!(Atoms::from_bits(1), Some(Atoms::NONE.with(Atom::ALL[0])));
    assert_eq!((Atoms::from_bits(u32::MAX), Faults::from_bits(u16::MAX)), (None, None));
    assert_eq!(u32::from(Atoms::ALL), Atoms::ALL.bits());
    assert_eq!(
        (Atoms::try_from(0), Choices::try_from(Choices::ALL.bits())),
        (Ok(Atoms::NONE), Ok(Choices::ALL))
    );
    assert!(Faults::try_from(u16::MAX).is_err_and(|error| error.contains("no fault")));
}

#[test]
fn a_value_that_is_not_allowed_is_refused() {
    let signal = <V3_0 as Layout<Vcu2AiStatus>>::DEF.signal("SHUTDOWN_CAUSE").expect("a signal of 520h");
    let data = signal.put(V3_0::encode(&Vcu2AiStatus::default()).data, signal.max + 1);
    let error = <V3_0 as Layout<Vcu2AiStatus>>::decode(&data).expect_err("no such cause");
    let DecodeError::Value(value) = error else { panic!("{error}") };
    assert_eq!(DecodeError::from(value), error);
}

#[test]
fn a_number_is_held_within_its_range() {
    let clamped = [i32::MIN, -1, 0, 1, i32::MAX].map(|raw| SteerAngle::clamped(raw).raw());
    assert_eq!(clamped, [SteerAngle::MIN.raw(), -1, 0, 1, SteerAngle::MAX.raw()]);
}

/// The VCU may send what is nobody's, also where it is reserved; the AI Computer may not.
#[test]
fn identifiers_of_no_message_are_for_those_who_may_send_them() {
    let bus = Edition::V3_0.bus;
    assert!(bus.may_send(Node::Vcu, 0x7FF) && bus.may_send(Node::Vcu, 0x181));
    assert!(bus.may_send(Node::Ai, 0x7FF) && !bus.may_send(Node::Ai, 0x181));
}
