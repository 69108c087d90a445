//! The requirements that an AI Computer is examined on, and what exercises each: what it may send, by the edition's tables, and
//! how it behaves, as is written here.

use adsdv_oracle::requirements::order;
use adsdv_spec::messages::{MessageDef, Node, SignalDef};
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

/// Why nothing is known of how it drives.
pub(crate) const NEVER_MOVED: &str = "the vehicle never moved in AS_DRIVING";

const ANY: &str = "any value is allowed, and nobody here knows which one is true";

const fn entry(id: &'static str, about: About, by: By) -> Entry {
    Entry { id, about, by }
}

/// How it behaves. What it may send is in the edition's tables.
const BEHAVIOUR: &[Entry] = &[
    entry("HS-2", Byte(AiMessages::IDS[0], "handshake"), By::Field("handshake")),
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
    entry("D-32", Words("does not send REVERSE"), By::Field("direction_request")),
];

/// Those of an edition, in the order of the document.
pub(crate) fn of_edition(edition: &Edition) -> Vec<Entry> {
    let bus = &edition.bus;
    let sent = || bus.messages.iter().filter(|def| def.sender == Node::Ai);
    let mut all = BEHAVIOUR.to_vec();
    let mut add = |ids: &[&'static str], about: About, by: By| {
        for &id in ids {
            // What is written above says more; one that is behind several rows is of the first to the last of them.
            match all.iter_mut().find(|entry| entry.id == id) {
                Some(Entry { about: Cycle(_, last), .. }) => *last = about.message().unwrap_or(*last),
                Some(_) => {}
                None => all.push(entry(id, about, by)),
            }
        }
    };
    for def in sent() {
        add(def.requirements, Sends(def.id), By::Expectation);
        for signal in def.signals {
            let (about, by) = of_signal(def, signal);
            add(signal.requirements, about, by);
        }
    }
    // The messages that the VCU watches stand before those for the data logger.
    let (watched, logged): (Vec<_>, Vec<&MessageDef>) =
        sent().partition(|def| AiMessages::IDS.contains(&def.id));
    for def in watched.into_iter().chain(logged) {
        add(bus.cycle_requirements(def.id), Cycle(def.id, def.id), By::Expectation);
    }
    add(bus.lengths, Words("its messages are as long as they should be"), By::Sending);
    for reserved in bus.reserved {
        add(reserved.requirements, Reserved(*reserved.ids.start(), *reserved.ids.end()), By::Sending);
    }
    add(bus.senders, Words("does not send what is the VCU's or its devices'"), By::Sending);
    all.retain(|entry| edition.requirements.has(entry.id));
    all.sort_by_key(|entry| order(entry.id));
    all
}

/// What is asked of a signal of the AI Computer, and what exercises it.
fn of_signal(def: &MessageDef, signal: &SignalDef) -> (About, By) {
    if signal.width > 1 && signal.allows_all() {
        (Field(def.id, signal.field), By::Nothing(ANY))
    } else {
        (Values(def.id, signal.field), By::Field(signal.field))
    }
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
        self.about.text(edition)
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
            By::Moving => Some(NEVER_MOVED.to_owned()),
            By::Nothing(why) => Some(why.to_owned()),
        }
    }
}

/// Those of these that the edition has.
pub(crate) fn held_by(edition: &Edition, ids: Vec<&'static str>) -> Vec<&'static str> {
    let entries = of_edition(edition);
    ids.into_iter().filter(|id| entries.iter().any(|entry| entry.id == *id)).collect()
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
    use adsdv_conform::suite::{Reason, untested};

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
        for entry in Edition::ALL.iter().flat_map(|edition| of_edition(edition)) {
            let line = document.lines().find(|line| line.starts_with(&format!("- **{}** ", entry.id)));
            let (_, places) = line.and_then(|line| line.rsplit_once('(')).expect("a line with its places");
            let mut places = places.split([',', ';', ':', ')']).map(str::trim);
            assert!(places.any(|place| place == entry.section()), "{}: {}", entry.id, entry.section());
        }
    }

    /// Who writes a stack reads there what it is to do.
    #[test]
    fn the_page_about_the_interface_tells_each_thing_that_an_ai_computer_is_to_do() {
        let page = include_str!("../../docs/interface.md");
        let (_, told) = page.split_once("## What the AI Computer does\n").expect("that part of it");
        let (told, _) = told.split_once("\n## ").expect("its end");
        for entry in BEHAVIOUR.iter().filter(|entry| entry.can_be_exercised()) {
            let mut words = told.split(|c: char| !c.is_ascii_alphanumeric() && c != '-');
            assert!(words.any(|word| word == entry.id), "{} is not told", entry.id);
        }
    }

    #[test]
    fn each_range_of_reserved_identifiers_has_its_requirement() {
        for edition in Edition::ALL {
            let entries = of_edition(edition);
            for reserved in edition.bus.reserved {
                let [id] = reserved.requirements else { panic!("{reserved:?}") };
                let entry = entries.iter().find(|entry| entry.id == *id).expect("an entry");
                let [from, to] = [reserved.ids.start(), reserved.ids.end()].map(|id| format!("{id:03X}h"));
                let about = entry.about(edition);
                assert!(about.contains(&from) && about.contains(&to), "{id}: {about}");
            }
        }
    }

    #[test]
    fn each_signal_of_the_ai_computer_has_one_requirement_or_two_in_each_edition() {
        for edition in Edition::ALL {
            for def in edition.bus.messages.iter().filter(|def| def.sender == Node::Ai) {
                assert_eq!(held_by(edition, def.requirements.to_vec()).len(), 1, "{}", def.name);
                for signal in def.signals {
                    let held = held_by(edition, signal.requirements.to_vec());
                    let (name, edition) = (signal.name, edition.version);
                    let cited = signal.requirements;
                    assert!(
                        matches!(held.len(), 1 | 2),
                        "{name} in {edition}: of what its row cites, {cited:?}, the exam has {held:?}; expected one or two"
                    );
                }
            }
        }
    }
}
