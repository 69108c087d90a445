//! What an edition is asked: its questions, its answers, its bus, and what stands behind its table.

use adsdv_spec::editions::V3_0;
use adsdv_spec::export::Dot;
use adsdv_spec::messages::{
    Ai2VcuDriveF, Ai2VcuSteer, AnyMessage, AsState, DecodeError, Layout, Message, Node, SteerAngle,
    SteerAngleMax, Vcu2AiSteer,
};
use adsdv_spec::table::Cites;
use adsdv_spec::{
    Actuation, AiMessages, Atom, Bus, Choice, Edition, Fault, Inputs, Machine, Reading, Readings, Row, Table,
    Term,
};

const EDITION: Edition = Edition::V3_0;
const BUS: Bus = EDITION.bus;

#[test]
fn an_edition_is_found_by_its_version() {
    for edition in Edition::ALL {
        assert_eq!(Edition::find(edition.version), Some(*edition));
    }
    assert_eq!(Edition::find(""), None);
    assert_eq!(Edition::default(), *Edition::DEFAULT);
}

#[test]
fn an_edition_answers_each_of_its_questions_by_default_and_has_others() {
    for edition in Edition::ALL {
        for reading in Reading::ALL {
            assert!(edition.choices.has(edition.readings.choice(*reading)), "{reading}");
        }
        let others = edition.alternatives();
        assert_eq!(others.union(edition.readings.choices()), edition.choices);
        for reading in edition.questions() {
            assert!(others.of_reading(reading).count() > 0, "{reading}");
        }
    }
    let later = [Reading::MessageWatch, Reading::TorqueControl, Reading::BmsFault];
    let of_3_0 = Reading::ALL.iter().copied().filter(|reading| !later.contains(reading));
    assert!(EDITION.questions().eq(of_3_0));
    let of_4_0 = Reading::ALL.iter().copied().filter(|reading| *reading != Reading::FaultTrigger);
    assert!(Edition::V4_0.questions().eq(of_4_0), "4.0 settles one");
}

#[test]
fn an_answer_that_the_document_does_not_leave_is_not_followed() {
    let settled = Edition { choices: EDITION.choices.without(Choice::FaultEdge), ..EDITION };
    assert!(settled.questions().all(|reading| reading != Reading::FaultTrigger));
    let wanted = Readings::DEFAULT.with(Choice::FaultEdge).with(Choice::GoRaw);
    let admitted = Readings::DEFAULT.with(Choice::GoRaw);
    assert_eq!((settled.admit(wanted), EDITION.admit(wanted)), (admitted, wanted));
    assert_eq!(Machine::new(settled, wanted).readings(), admitted);
}

#[test]
fn a_bus_reads_and_writes_what_the_layouts_do() {
    let steer = Ai2VcuSteer { steer_request: SteerAngle::clamped(-7) };
    let frame = BUS.encode(steer).expect("513h");
    assert_eq!(frame, V3_0::encode(&steer));
    assert_eq!(BUS.decode_as(frame.data()), Ok(steer));
    assert_eq!(BUS.decode_as::<Ai2VcuSteer>(&[]), <V3_0 as Layout<Ai2VcuSteer>>::decode(&[]));
    assert!(BUS.holds(steer) && !BUS.holds(Ai2VcuSteer { steer_request: SteerAngle::MAX }));
    let other = Bus { read: |id, _| Err(DecodeError::UnknownId { id }), write: |_| None, ..BUS };
    assert_eq!(other.encode(steer), None, "an edition may have no such message");
    let wrong = Bus { read: |_, _| Ok(Ai2VcuDriveF::default().into()), ..BUS };
    assert_eq!(wrong.decode_as::<Ai2VcuSteer>(&[]), Err(DecodeError::UnknownId { id: 0x513 }));
}

#[test]
fn buses_are_the_same_if_their_messages_and_reserved_identifiers_are() {
    assert_eq!(BUS, Bus { write: |_| None, ..BUS });
    assert_ne!(BUS, Bus { reserved: &[], ..BUS });
    assert_ne!(BUS, Bus { messages: &[], ..BUS });
    let printed = format!("{BUS:?}");
    assert!(printed.contains("\"AI2VCU_Steer\"") && printed.contains("reserved"), "{printed}");
}

#[test]
fn a_message_knows_its_identifier_its_sender_and_its_fields() {
    for id in AnyMessage::IDS {
        let def = Edition::V4_0.bus.message(id).expect("version 4.0 has them all");
        let message = Edition::V4_0.bus.decode(
            id,
            &def.signals
                .iter()
                .fold([0; 8], |data, signal| signal.put(data, if signal.allows(0) { 0 } else { signal.min })),
        );
        let message = message.expect("every value is allowed");
        assert_eq!((message.id(), message.sender()), (def.id, def.sender));
    }
    assert_eq!((Ai2VcuSteer::SENDER, Vcu2AiSteer::SENDER), (Node::Ai, Node::Vcu));
    assert_eq!(Ai2VcuSteer::of(Ai2VcuDriveF::default().into()), None);
    let fields = Ai2VcuSteer::FIELDS.iter().map(|field| (field.name, field.doc));
    assert!(fields.eq([("steer_request", "Requested steer angle.")]));
    let steer = BUS.message(0x523).expect("523h");
    assert_eq!(steer.signal_of("steer_angle_max").map(|signal| signal.start), Some(16));
    assert_eq!(steer.signal_of("STEER_ANGLE_MAX_deg"), None);
    assert_eq!((BUS.signal_of("steer_angle_request").map(|s| s.start), BUS.signal_of("")), (Some(32), None));
}

#[test]
fn only_messages_of_the_ai_computer_are_taken() {
    let mut ai = AiMessages::default();
    for message in AnyMessage::IDS.map(|id| BUS.message(id)).into_iter().flatten() {
        let sent = AiMessages::default().all().into_iter().find(|sent| sent.id() == message.id);
        assert_eq!(sent.is_some(), sent.is_some_and(|sent| ai.take(sent)), "{}", message.name);
    }
    assert!(!ai.take(Vcu2AiSteer::default().into()));
}

#[test]
fn inputs_are_held_within_the_ranges_of_an_edition() {
    let mut inputs = Inputs::default();
    inputs.ai.steer.steer_request = SteerAngle::MIN;
    inputs.vehicle.steer_angle = SteerAngle::MAX;
    inputs.vehicle.steer_angle_max = SteerAngleMax::MAX;
    let held = inputs.held_by(&BUS);
    let raw = (held.ai.steer.steer_request.raw(), held.vehicle.steer_angle.raw());
    assert_eq!((raw, held.vehicle.steer_angle_max.raw()), ((-240, 240), 240));
    assert_eq!(inputs.held_by(&Bus { messages: &[], ..BUS }), inputs);
    for edition in Edition::ALL {
        let most = |field| edition.bus.signal_of(field).expect("each edition steers").max;
        let held = Inputs {
            ai: AiMessages { steer: Ai2VcuSteer { steer_request: SteerAngle::MAX }, ..inputs.ai },
            ..inputs
        }
        .held_by(&edition.bus);
        assert_eq!(held.ai.steer.steer_request.raw(), most("steer_request"), "{}", edition.version);
        assert_eq!(held.vehicle.steer_angle.raw(), most("steer_angle"), "{}", edition.version);
        assert_eq!(held.vehicle.steer_angle_max.raw(), most("steer_angle_max"), "{}", edition.version);
    }
}

#[test]
fn a_diagram_names_the_answers_that_are_not_the_default() {
    let title = |readings| Dot(&Machine::new(EDITION, readings)).to_string();
    assert!(
        title(Readings::DEFAULT)
            .starts_with("// Figure 2 of the ADS-DV Software Interface Specification 3.0\n")
    );
    let other = Readings::DEFAULT.with(Choice::FaultEdge).with(Choice::GoRaw);
    assert!(title(other).contains("Specification 3.0, read with fault-trigger=edge go-signal=raw\n"));
}

#[test]
fn rows_and_terms_are_given_what_they_cite() {
    const CITES: &Cites = &Cites { order: &["D-22"], ..Cites::NONE };
    let term = Term::on("3", &[Atom::Asms]).cites(CITES);
    let row = Row::of(AsState::Off, AsState::Ready, "3", &[term]).cites(CITES);
    assert_eq!((row.cites, row.terms()[0].cites), (CITES, CITES));
    assert_eq!(Table::of(&[row]).rows(), [row]);
}

/// Every row, every term beside the figure, every fault, question and state cites something.
#[test]
fn what_the_table_is_made_of_cites_its_requirements() {
    for row in Edition::ALL.iter().flat_map(|edition| edition.rules.table.rows()) {
        assert!(row.cites.requirements.iter().any(|id| id.starts_with("SM-")), "{}", row.section);
        for term in row.terms() {
            let own = term.literals().any(|(atom, _)| term.requirements_of(atom).is_some());
            let whole = !term.cites.requirements.is_empty() || term.section == row.section;
            assert!(own || whole, "{term:?}");
        }
    }
    let go =
        EDITION.rules.table.rows().iter().find(|row| row.section == "3.2").expect("the way to AS_DRIVING");
    assert_eq!(go.terms()[0].requirements_of(Atom::DwellElapsed), Some(&["DRV-4"][..]));
    assert_eq!(go.terms()[0].requirements_of(Atom::Asms), None);
    let faults: Vec<_> = Fault::ALL.iter().map(|fault| fault.requirement()).collect();
    assert_eq!((faults.first(), faults.last()), (Some(&"MSG-54"), Some(&"MSG-84")));
    let decisions: Vec<_> = Reading::ALL.iter().map(|reading| reading.decision()).collect();
    assert_eq!((decisions.first(), decisions.last()), (Some(&"D-1"), Some(&"D-54")));
    for state in AsState::ALL {
        assert!(Actuation::requirements(state).contains(&"D-21"), "{state}");
    }
}

/// Each message has what asks for its cycle in the place that it has in the list.
#[test]
fn what_a_bus_asks_for_is_asked_for_by_its_edition() {
    for edition in Edition::ALL {
        let bus = &edition.bus;
        assert_eq!(bus.cycles.len(), bus.messages.len(), "{}", edition.version);
        let of_ranges = bus.reserved.iter().flat_map(|reserved| reserved.requirements);
        let cited = bus.lengths.iter().chain(bus.senders).chain(of_ranges);
        for id in cited.chain(bus.messages.iter().flat_map(|def| bus.cycle_requirements(def.id))) {
            assert!(edition.requirements.has(id), "{id} in {}", edition.version);
        }
        for reserved in bus.reserved {
            assert_eq!(bus.reserved_of(*reserved.ids.end()), Some(reserved));
            assert_eq!(bus.reserved_of(*reserved.ids.start()), Some(reserved));
        }
        assert!(bus.cycle_requirements(0x7FF).is_empty() && bus.reserved_of(0x510).is_none());
    }
    assert_eq!(Edition::V2026.bus.cycle_requirements(0x500), ["MSG-112"]);
    assert_eq!(Edition::V4_0.bus.cycle_requirements(0x502), ["MSG-96"]);
}
