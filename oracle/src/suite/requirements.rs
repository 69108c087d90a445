//! Which requirements a row, a condition and a fault stand for, as `spec/REQUIREMENTS.md` numbers them.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Choice, Fault, Row, Term};

/// The requirements behind a row of Figure 2: the figure's own, and those of the text.
pub(super) fn of_row(row: &Row) -> &'static [&'static str] {
    match row.section {
        "3.1" => &["SM-9", "RDY-5"],
        "3.2" => &["SM-11", "DRV-15"],
        "3.3" => &["SM-14", "FIN-4"],
        "3.4" => &["SM-16", "FTO-1"],
        "3.5" => &["SM-12", "RTE-1"],
        "3.6" => &["SM-10", "RTO-1"],
        "3.7" => &["SM-13"],
        "3.8" => &["SM-15", "FTE-1"],
        "3.9" => &["SM-17", "ETO-2"],
        _ => &[],
    }
}

/// The requirements behind an alternative of a row.
pub(super) fn of_term(row: &Row, term: &Term) -> Vec<&'static str> {
    let own = term.literals().flat_map(|(atom, _)| match (row.section, atom) {
        (_, Atom::AiCommsLost) => &["HS-10"][..],
        (_, Atom::AiEstop) => &["D-9"],
        (_, Atom::GoEdge) => &["DRV-14"],
        ("3.7", Atom::SdcOpen) => &["DTE-1"],
        ("3.7", Atom::GoOn) => &["DTE-2"],
        ("3.7", Atom::Asms) => &["DTE-3"],
        ("3.7", Atom::MissionFinished) => &["DTE-4", "IMP-1", "MSG-61"],
        ("3.7", Atom::DirectionNeutral) => &["DTE-5", "IMP-1", "MSG-60"],
        ("3.7", Atom::MissionFinishedEdge) => &["IMP-3", "MSG-61"],
        ("3.7", Atom::DirectionNeutralEdge) => &["IMP-2", "MSG-60"],
        _ => &[],
    });
    let own: Vec<_> = own.copied().collect();
    // What stands beside the figure is not the figure's.
    let figures = term.section == row.section;
    if figures { of_row(row).iter().copied().chain(own).collect() } else { own }
}

/// The requirements behind one condition of an alternative, where it has some of its own.
pub(super) fn of_condition(row: &Row, term: &Term, atom: Atom) -> Vec<&'static str> {
    let own: &[_] = match (row.section, atom) {
        ("3.1", Atom::Tsms) => &["RDY-1"],
        ("3.1", Atom::Asms) => &["RDY-2"],
        ("3.1", Atom::AmiSelected) => &["RDY-3"],
        ("3.1", Atom::EbsArmed) => &["RDY-4"],
        ("3.1", Atom::MissionSelected) => &["SM-9", "MSG-9"],
        ("3.1", Atom::PowerCycleNeeded) => &["ETO-3"],
        ("3.2", Atom::DwellElapsed) => &["DRV-4"],
        ("3.2", Atom::FrontTorqueZero) => &["DRV-5"],
        ("3.2", Atom::RearTorqueZero) => &["DRV-6"],
        ("3.2", Atom::SteerRequestZero) => &["DRV-7"],
        ("3.2", Atom::DirectionNeutral) => &["DRV-8"],
        ("3.2", Atom::SteerStraight) => &["DRV-9"],
        ("3.2", Atom::GoEdge) => &["DRV-12"],
        ("3.3", Atom::MissionFinished) => &["FIN-4", "MSG-9"],
        ("3.3", _) => &["FIN-4"],
        ("3.9", Atom::EbsTimerComplete) => &["ETO-1"],
        ("3.7", Atom::Moving) => &["IMP-4"],
        ("3.7", Atom::MissionFinished) => &["DTE-4", "MSG-9"],
        _ => return of_term(row, term),
    };
    own.to_vec()
}

/// The requirements behind two rows that hold at once, the earlier one first.
pub(super) fn of_pair(one: &Row, other: &Row) -> Vec<&'static str> {
    let own: &[_] = match (one.section, other.section) {
        ("3.6", "3.2") => &["D-22"],
        _ => &[],
    };
    of_row(one).iter().chain(of_row(other)).chain(own).copied().collect()
}

/// The requirements of section 3 behind what reaches the actuators in a state, and the decisions where it has none.
pub(super) const fn of_actuators(state: AsState) -> &'static [&'static str] {
    match state {
        AsState::Off => &["D-21", "D-42"],
        AsState::Ready => &["DRV-2", "DRV-3", "D-21", "D-41"],
        AsState::Driving => &["MSG-18", "MSG-25", "D-21", "D-41"],
        AsState::Finished => &["FIN-5", "FIN-6", "D-21", "D-41"],
        AsState::EmergencyBrake => &["D-21", "D-43"],
    }
}

/// The requirement behind a fault's flag and number.
pub(super) const fn of_fault(fault: Fault) -> &'static str {
    match fault {
        Fault::AiComputerRequest => "MSG-54",
        Fault::HvilOpenFault => "MSG-55",
        Fault::HvilShortFault => "MSG-56",
        Fault::EbsFault => "MSG-57",
        Fault::OffboardChargerFault => "MSG-58",
        Fault::AiCommsFault => "MSG-59",
        Fault::AutonomousBrakingFault => "MSG-60",
        Fault::MissionStatusFault => "MSG-61",
        Fault::ChargeProcedureFault => "MSG-62",
        Fault::BmsFault => "MSG-63",
    }
}

/// Whether it is only the default answer to a question that the document leaves open.
pub(crate) fn is_of_a_reading(id: &str) -> bool {
    Choice::ALL.iter().any(|&choice| of_choice(choice) == id)
}

/// The decision behind the choice of a reading.
pub(super) const fn of_choice(choice: Choice) -> &'static str {
    use adsdv_spec::Reading;
    match choice.reading() {
        Reading::MissionSelected => "D-1",
        Reading::FaultTrigger => "D-2",
        Reading::ReadyPriority => "D-3",
        Reading::FinishedPriority => "D-4",
        Reading::DrivingPriority => "D-5",
        Reading::GoEdge => "D-6",
        Reading::GoSignal => "D-7",
        Reading::HandshakeActive => "D-8",
        Reading::AiEstop => "D-9",
        Reading::CommsLost => "D-10",
        Reading::PowerCycle => "D-11",
    }
}
