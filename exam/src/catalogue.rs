//! The requirements that an AI Computer is examined on, what exercises each, and which of them a finding of the judge is against.

use adsdv_oracle::judge::{Finding, Rule};
use adsdv_spec::messages::{Frame, SignalDef};
use adsdv_spec::{AiMessages, Atom, Atoms, Edition};

use crate::about::About::{self, Byte, Cycle, Cycles, Field, Missed, Reserved, Sends, Values, Words};
use crate::tally::Tally;

/// A requirement of the exam.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    /// As `REQUIREMENTS.md` names it.
    pub(crate) id: &'static str,
    /// What it asks for, in a few words.
    about: About,
    by: By,
    /// What says the same of an edition that has it, so that this one adds nothing there.
    unless: &'static [&'static str],
}

/// What exercises a requirement.
#[derive(Clone, Copy, Debug)]
enum By {
    /// An expectation, or the judge, has looked at it.
    Expectation,
    /// A value of this field that is not 0.
    Field(&'static str),
    /// A frame of any message.
    Sending,
    /// The vehicle has moved in AS_DRIVING.
    Moving,
    /// Nothing: why.
    Nothing(&'static str),
}

const ANY: &str = "any value is allowed, and nobody here knows which one is true";

const fn entry(id: &'static str, about: About, by: By) -> Entry {
    Entry { id, about, by, unless: &[] }
}

/// The identifiers of the messages.
const STATUS: u16 = AiMessages::IDS[0];
const DRIVE_F: u16 = AiMessages::IDS[1];
const DRIVE_R: u16 = AiMessages::IDS[2];
const STEER: u16 = AiMessages::IDS[3];
const BRAKE: u16 = AiMessages::IDS[4];
const DYNAMICS: u16 = crate::look::SENT[5];

/// All of them, in the order of the document.
const ENTRIES: &[Entry] = &[
    entry("MSG-1", Sends(DYNAMICS), By::Expectation),
    entry("MSG-2", Field(DYNAMICS, "accel_longitudinal"), By::Nothing(ANY)),
    entry("MSG-3", Field(DYNAMICS, "accel_lateral"), By::Nothing(ANY)),
    entry("MSG-4", Field(DYNAMICS, "yaw_rate"), By::Nothing(ANY)),
    entry("MSG-5", Sends(STATUS), By::Expectation),
    entry("MSG-6", Values(STATUS, "handshake"), By::Field("handshake")),
    entry("MSG-7", Values(STATUS, "estop_request"), By::Field("estop_request")),
    entry("MSG-8", Values(STATUS, "mission_status"), By::Field("mission_status")),
    entry("MSG-10", Values(STATUS, "direction_request"), By::Field("direction_request")),
    entry("MSG-11", Field(STATUS, "lap_counter"), By::Nothing(ANY)),
    entry("MSG-12", Field(STATUS, "cones_count_actual"), By::Nothing(ANY)),
    entry("MSG-13", Field(STATUS, "cones_count_all"), By::Nothing(ANY)),
    entry("MSG-14", Field(STATUS, "veh_speed_actual"), By::Nothing(ANY)),
    entry("MSG-15", Field(STATUS, "veh_speed_demand"), By::Nothing(ANY)),
    entry("MSG-16", Sends(DRIVE_F), By::Expectation),
    entry("MSG-17", Values(DRIVE_F, "front_axle_trq_request"), By::Field("front_axle_trq_request")),
    entry("MSG-19", Values(DRIVE_F, "front_motor_speed_max"), By::Field("front_motor_speed_max")),
    entry("MSG-20", Sends(DRIVE_R), By::Expectation),
    entry("MSG-21", Values(DRIVE_R, "rear_axle_trq_request"), By::Field("rear_axle_trq_request")),
    entry("MSG-22", Values(DRIVE_R, "rear_motor_speed_max"), By::Field("rear_motor_speed_max")),
    entry("MSG-23", Sends(STEER), By::Expectation),
    entry("MSG-24", Values(STEER, "steer_request"), By::Field("steer_request")),
    entry("MSG-26", Sends(BRAKE), By::Expectation),
    entry("MSG-27", Values(BRAKE, "hyd_press_f_req"), By::Field("hyd_press_f_req")),
    entry("MSG-28", Values(BRAKE, "hyd_press_r_req"), By::Field("hyd_press_r_req")),
    entry("MSG-97", Words("its messages are as long as they should be"), By::Sending),
    entry("MSG-98", Cycle(STATUS, BRAKE), By::Expectation),
    entry("MSG-99", Values(STEER, "steer_request"), By::Field("steer_request")),
    entry("MSG-102", Cycle(DYNAMICS, DYNAMICS), By::Expectation),
    entry("MSG-105", Values(STEER, "steer_request"), By::Field("steer_request")),
    entry("MSG-113", Words("its messages are as long as they should be"), By::Sending),
    entry("ID-1", Reserved, By::Sending),
    entry("ID-2", Reserved, By::Sending),
    entry("ID-3", Reserved, By::Sending),
    entry("ID-4", Reserved, By::Sending),
    entry("ID-5", Reserved, By::Sending),
    entry("ID-6", Reserved, By::Sending),
    entry("ID-7", Reserved, By::Sending),
    entry("ID-8", Reserved, By::Sending),
    entry("ID-9", Reserved, By::Sending),
    entry("ID-10", Reserved, By::Sending),
    entry("ID-11", Reserved, By::Sending),
    entry("ID-12", Reserved, By::Sending),
    entry("ID-13", Reserved, By::Sending),
    entry("ID-14", Reserved, By::Sending),
    entry("ID-15", Reserved, By::Sending),
    entry("ID-16", Reserved, By::Sending),
    entry("ID-18", Reserved, By::Sending),
    entry("ID-19", Reserved, By::Sending),
    entry("ID-17", Reserved, By::Sending),
    entry("ID-20", Words("does not send what is the VCU's or its devices'"), By::Sending),
    entry("HS-2", Byte(STATUS, "handshake"), By::Field("handshake")),
    entry("HS-5", Words("answers the HANDSHAKE bit of the VCU"), By::Expectation),
    entry("HS-13", Cycles(2), By::Nothing("it is a permission")),
    entry("HS-18", Missed, By::Sending),
    entry("RDY-7", Words("confirms the mission that is selected"), By::Expectation),
    entry("DRV-5", Words("requests no front torque in AS_READY"), By::Expectation),
    entry("DRV-6", Words("requests no rear torque in AS_READY"), By::Expectation),
    entry("DRV-7", Words("requests no steer angle in AS_READY"), By::Expectation),
    entry("DRV-8", Words("requests NEUTRAL in AS_READY"), By::Expectation),
    entry("DRV-10", Words("requests FORWARD in AS_DRIVING"), By::Expectation),
    entry("FIN-1", Words("tells that the mission is completed"), By::Expectation),
    entry("FIN-2", Words("stops with the service brake"), By::Expectation),
    entry("FIN-3", Words("tells FINISHED once the vehicle has stopped"), By::Expectation),
    entry("DTE-5", Words("does not request NEUTRAL while moving"), By::Moving),
    entry("IMP-6", Words("does not request NEUTRAL while moving"), By::Moving),
    entry("IMP-8", Words("does not drive and brake at once"), By::Moving),
    Entry {
        unless: &["MSG-97", "MSG-113"],
        ..entry("D-30", Words("its messages are as long as they should be"), By::Sending)
    },
    entry("D-32", Words("does not send REVERSE"), By::Field("direction_request")),
];

/// Those that an edition has.
pub(crate) fn of_edition(edition: &Edition) -> Vec<Entry> {
    let has = |id: &str| edition.requirements.has(id);
    let holds = |entry: &&Entry| has(entry.id) && !entry.unless.iter().any(|id| has(id));
    ENTRIES.iter().filter(holds).copied().collect()
}

/// A requirement on which an AI Computer is examined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// As `REQUIREMENTS.md` names it.
    pub id: &'static str,
    /// The section of the document that asks for it.
    pub section: &'static str,
    /// What it asks for, in a few words.
    pub about: String,
}

/// Those of an edition, in the order of the document: those of every report of an exam.
///
/// ```
/// use adsdv_exam::requirements;
/// use adsdv_spec::Edition;
///
/// let ready = requirements(Edition::DEFAULT).into_iter().find(|one| one.id == "RDY-7").expect("it is there");
/// assert_eq!((ready.section, ready.about.as_str()), ("3.1", "confirms the mission that is selected"));
/// ```
pub fn requirements(edition: &Edition) -> Vec<Requirement> {
    let one =
        |entry: &Entry| Requirement { id: entry.id, section: entry.section(), about: entry.about(edition) };
    of_edition(edition).iter().map(one).collect()
}

impl Entry {
    /// What it asks for, in a few words.
    pub(crate) fn about(&self, edition: &Edition) -> String {
        self.about.text(edition, reserved(edition).iter().position(|id| *id == self.id))
    }

    /// The section of the document that asks for it.
    pub(crate) fn section(&self) -> &'static str {
        match self.id.split_once('-').unwrap_or((self.id, "")) {
            ("ID", "20") => "2.2",
            ("ID", _) => "2.3",
            ("HS", "13") => "Figure 1",
            ("HS", _) => "2.4",
            ("RDY", _) => "3.1",
            ("DRV", _) => "3.2",
            ("FIN", _) => "3.3",
            ("DTE", _) => "3.7",
            ("IMP", _) => "4",
            _ => "2.1",
        }
    }

    /// Whether there is anything that exercises it.
    pub(crate) const fn can_be_exercised(&self) -> bool {
        !matches!(self.by, By::Nothing(_))
    }

    /// Why it was not exercised, by what was sent; `None` if it was.
    pub(crate) fn lacks(&self, tally: &Tally, is_expected: bool) -> Option<String> {
        match self.by {
            By::Expectation if is_expected => None,
            By::Expectation => Some("no scenario came so far".to_owned()),
            By::Field(field) if tally.fields.contains(field) => None,
            By::Field(_) => Some("it was always 0, or never sent".to_owned()),
            By::Sending if !tally.ids.is_empty() => None,
            By::Sending => Some("it sent nothing".to_owned()),
            By::Moving if tally.moved => None,
            By::Moving => Some("the vehicle never moved in AS_DRIVING".to_owned()),
            By::Nothing(why) => Some(why.to_owned()),
        }
    }
}

/// The requirement that a field of a message of the AI Computer keeps its range; in the order of the editions where they differ.
const RANGES: &[(&str, &[&str])] = &[
    ("handshake", &["MSG-6"]),
    ("estop_request", &["MSG-7"]),
    ("mission_status", &["MSG-8"]),
    ("direction_request", &["MSG-10", "D-32"]),
    ("front_axle_trq_request", &["MSG-17"]),
    ("front_motor_speed_max", &["MSG-19"]),
    ("rear_axle_trq_request", &["MSG-21"]),
    ("rear_motor_speed_max", &["MSG-22"]),
    ("steer_request", &["MSG-24", "MSG-99", "MSG-105"]),
    ("hyd_press_f_req", &["MSG-27"]),
    ("hyd_press_r_req", &["MSG-28"]),
];

/// The requirement that a message comes.
const MESSAGES: [(u16, &str); 6] = [
    (STATUS, "MSG-5"),
    (DRIVE_F, "MSG-16"),
    (DRIVE_R, "MSG-20"),
    (STEER, "MSG-23"),
    (BRAKE, "MSG-26"),
    (DYNAMICS, "MSG-1"),
];

/// The requirements that a finding about the AI Computer is against: those that the judge names, or those of its rule. `frame` is
/// the one that the finding is about, where it is about one.
pub(crate) fn against(edition: &Edition, finding: &Finding, frame: Option<&Frame>) -> Vec<&'static str> {
    let ids: Vec<&'static str> = if finding.requirements.is_empty() {
        of_rule(edition, finding.rule, frame)
    } else {
        finding.requirements.clone()
    };
    held_by(edition, ids)
}

/// Those of these that the edition has.
pub(crate) fn held_by(edition: &Edition, ids: Vec<&'static str>) -> Vec<&'static str> {
    let entries = of_edition(edition);
    ids.into_iter().filter(|id| entries.iter().any(|entry| entry.id == *id)).collect()
}

fn of_rule(edition: &Edition, rule: Rule, frame: Option<&Frame>) -> Vec<&'static str> {
    match rule {
        Rule::Value => frame.map(|frame| of_values(edition, frame)).unwrap_or_default(),
        Rule::TooShort => frame.map(|frame| of_message(frame.id)).unwrap_or_default(),
        Rule::Length => vec!["MSG-97", "MSG-113", "D-30"],
        Rule::Reserved => frame.map(|frame| of_reserved(edition, frame.id)).unwrap_or_default(),
        Rule::Sender => vec!["ID-20"],
        Rule::NeutralMoving => vec!["DTE-5", "IMP-6"],
        Rule::BrakeAndTorque => vec!["IMP-8"],
        Rule::MessageMissed => vec!["HS-18", "MSG-98"],
        _ => Vec::new(),
    }
}

fn of_message(id: u16) -> Vec<&'static str> {
    MESSAGES.iter().filter(|(sent, _)| *sent == id).map(|(_, requirement)| *requirement).collect()
}

fn of_values(edition: &Edition, frame: &Frame) -> Vec<&'static str> {
    let bad = |signal: &&SignalDef| signal.raw(frame.data()).is_some_and(|raw| !signal.allows(raw));
    let signals = edition.bus.message(frame.id).map(|def| def.signals).unwrap_or_default();
    let fields = signals.iter().filter(bad).map(|signal| signal.field);
    fields
        .flat_map(|field| RANGES.iter().filter(move |(range, _)| *range == field))
        .flat_map(|(_, ids)| ids.iter().copied())
        .collect()
}

/// The ranges of reserved identifiers stand in the document in the order of the list: each is one requirement, of which these are
/// those of an edition, in that order.
fn reserved(edition: &Edition) -> Vec<&'static str> {
    let entries = of_edition(edition).into_iter();
    entries.filter(|entry| matches!(entry.about, Reserved)).map(|entry| entry.id).collect()
}

fn of_reserved(edition: &Edition, id: u16) -> Vec<&'static str> {
    let place = edition.bus.reserved.iter().position(|range| range.contains(&id));
    place.and_then(|place| reserved(edition).get(place).copied()).into_iter().collect()
}

/// What holds the car in AS_READY.
pub(crate) fn of_requests(requests: Atoms) -> Vec<&'static str> {
    let needed = [
        (Atom::FrontTorqueZero, "DRV-5"),
        (Atom::RearTorqueZero, "DRV-6"),
        (Atom::SteerRequestZero, "DRV-7"),
        (Atom::DirectionNeutral, "DRV-8"),
    ];
    needed.into_iter().filter(|(atom, _)| !requests.has(*atom)).map(|(_, id)| id).collect()
}

#[cfg(test)]
mod tests {
    use adsdv_oracle::suite::{Reason, untested};

    use super::*;

    /// What binds a person.
    const OTHERS: [&str; 4] = ["HS-11", "RDY-8", "DRV-13", "ETO-4"];

    #[test]
    fn every_requirement_that_binds_the_ai_computer_is_examined() {
        for edition in Edition::ALL {
            let entries = of_edition(edition);
            let binds = untested(edition).filter(|one| one.reason == Reason::AnotherParty);
            for untested in binds.filter(|one| !OTHERS.contains(&one.id.as_str())) {
                let count = entries.iter().filter(|entry| entry.id == untested.id).count();
                assert_eq!(count, 1, "{} in {}", untested.id, edition.version);
            }
        }
    }

    /// The numbers in a text, such as 195, 24 and 510h.
    fn numbers(text: &str) -> Vec<&str> {
        let words = text.split(|c: char| !c.is_ascii_alphanumeric());
        words.filter(|word| word.starts_with(|c: char| c.is_ascii_digit())).collect()
    }

    /// The edition's tables say what the requirement says.
    #[test]
    fn each_number_of_an_edition_stands_in_its_requirement() {
        let document = include_str!("../../spec/REQUIREMENTS.md");
        let mut some = 0;
        for edition in Edition::ALL {
            for entry in of_edition(edition) {
                let line = document.lines().find(|line| line.starts_with(&format!("- **{}** ", entry.id)));
                let line = line.expect("a line");
                let about = entry.about(edition);
                assert!(!about.contains("them") && !about.contains("right byte"), "{}: {about}", entry.id);
                // Ten messages in a row are missed in 100 ms.
                for number in numbers(&about).into_iter().filter(|_| entry.id != "HS-18") {
                    some += 1;
                    assert!(
                        numbers(line).contains(&number),
                        "{} in {}: {about}: {number}",
                        entry.id,
                        edition.version
                    );
                }
            }
        }
        assert!(some > 150, "{some}");
    }

    #[test]
    fn the_section_of_each_is_one_where_the_document_has_it() {
        let document = include_str!("../../spec/REQUIREMENTS.md");
        for entry in ENTRIES {
            let line = document.lines().find(|line| line.starts_with(&format!("- **{}** ", entry.id)));
            let (_, places) = line.and_then(|line| line.rsplit_once('(')).expect("a line with its places");
            let mut places = places.split([',', ';', ':', ')']).map(str::trim);
            assert!(places.any(|place| place == entry.section()), "{}: {}", entry.id, entry.section());
        }
    }

    #[test]
    fn each_range_of_reserved_identifiers_has_its_requirement() {
        for edition in Edition::ALL {
            for range in edition.bus.reserved {
                for id in range.clone() {
                    let found = of_reserved(edition, id);
                    let [found] = found[..] else { panic!("{id:03X} in {}", edition.version) };
                    let entry = ENTRIES.iter().find(|entry| entry.id == found).expect("an entry");
                    let from = format!("{:03X}h", range.start());
                    let to = format!("{:03X}h", range.end());
                    let about = entry.about(edition);
                    assert!(about.contains(&from) && about.contains(&to), "{id:03X}: {found} {about}");
                }
            }
        }
    }

    #[test]
    fn each_range_of_a_signal_is_a_requirement_of_each_edition() {
        for edition in Edition::ALL {
            for (field, ids) in RANGES {
                assert!(edition.bus.signal_of(field).is_some(), "{field}");
                let held = held_by(edition, ids.to_vec());
                assert!(!held.is_empty() && held.len() <= 2, "{field} in {}: {held:?}", edition.version);
            }
        }
    }
}
