//! The requirements that no test of the suite is for, each with the reason.

use std::collections::HashSet;
use std::fmt;
use std::ops::RangeInclusive;

use adsdv_oracle::requirements::is_of_a_reading;
use adsdv_spec::Edition;

/// Why no test is for a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// It binds the AI Computer or a person.
    AnotherParty,
    /// It binds those who read or write frames.
    Codec,
    /// It is about the VCU's frames on the bus: their identifiers, their layout, or a message other than 520h.
    Frames,
    /// It is about something of the VCU that no output of the protocol tells.
    NotShown,
    /// It allows the VCU something, and nothing that a program shows could break it.
    Permission,
}

impl Reason {
    /// In words.
    pub const fn text(self) -> &'static str {
        match self {
            Self::AnotherParty => "binds the AI Computer or a person, not the VCU",
            Self::Codec => "binds those who read or write frames, and a program under test does neither",
            Self::Frames => "is about frames on the bus, and a program under test sends and receives none",
            Self::NotShown => "is about something that no output tells",
            Self::Permission => "allows something, and nothing that is shown could break it",
        }
    }

    /// Whether the requirement is about what a VCU does.
    pub const fn is_about_the_vcu(self) -> bool {
        match self {
            Self::Frames | Self::NotShown | Self::Permission => true,
            Self::AnotherParty | Self::Codec => false,
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.text())
    }
}

/// A requirement that no test is for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Untested {
    /// As `spec/REQUIREMENTS.md` numbers it, such as `MSG-29`.
    pub id: String,
    /// Why there is no test.
    pub reason: Reason,
}

/// All of them, by prefix and number, whichever edition asks for them.
const UNTESTED: &[(Reason, &str, RangeInclusive<u32>)] = {
    use Reason::{AnotherParty, Codec, Frames, NotShown, Permission};
    &[
        (AnotherParty, "MSG", 1..=8),
        (AnotherParty, "MSG", 10..=17),
        (AnotherParty, "MSG", 19..=24),
        (AnotherParty, "MSG", 26..=28),
        (Frames, "MSG", 29..=41),
        (Frames, "MSG", 65..=83),
        (Frames, "MSG", 86..=96),
        (Codec, "MSG", 97..=97),
        (AnotherParty, "MSG", 98..=99),
        (Frames, "MSG", 100..=101),
        (AnotherParty, "MSG", 102..=102),
        (Codec, "MSG", 103..=103),
        (AnotherParty, "MSG", 105..=105),
        // AS_INIT, which is read as AS_OFF.
        (NotShown, "MSG", 109..=109),
        (Frames, "MSG", 110..=112),
        (Codec, "MSG", 113..=115),
        (Frames, "MSG", 116..=116),
        (AnotherParty, "ID", 1..=20),
        (AnotherParty, "HS", 2..=2),
        (Frames, "HS", 3..=3),
        (AnotherParty, "HS", 5..=5),
        (AnotherParty, "HS", 11..=11),
        (Permission, "HS", 14..=14),
        // The status light.
        (NotShown, "SM", 4..=8),
        (AnotherParty, "RDY", 7..=8),
        // What the powertrain is ready for.
        (NotShown, "DRV", 1..=1),
        (AnotherParty, "DRV", 10..=10),
        (AnotherParty, "DRV", 13..=13),
        (AnotherParty, "FIN", 1..=3),
        (AnotherParty, "ETO", 4..=4),
        (Codec, "D", 19..=19),
        (Frames, "D", 20..=20),
        (Frames, "D", 28..=29),
        (Codec, "D", 30..=31),
        (AnotherParty, "D", 32..=32),
        (Codec, "D", 33..=34),
        (Frames, "D", 35..=35),
        (Frames, "D", 46..=50),
        (Frames, "D", 56..=61),
        (Codec, "D", 66..=66),
        (Codec, "D", 68..=70),
    ]
};

/// The requirements of an edition that no test of [`generate`](super::generate) is for. Every other one is named by a test.
///
/// ```
/// use adsdv_conform::suite::{self, Reason};
/// use adsdv_spec::Edition;
/// let light = suite::untested(Edition::DEFAULT).find(|untested| untested.id == "SM-5").map(|untested| untested.reason);
/// assert_eq!(light, Some(Reason::NotShown)); // the ASSI is yellow in AS_READY
/// ```
pub fn untested(edition: &Edition) -> impl Iterator<Item = Untested> {
    let requirements = edition.requirements;
    let all = UNTESTED.iter().flat_map(|(reason, prefix, numbers)| {
        numbers.clone().map(move |number| Untested { id: format!("{prefix}-{number}"), reason: *reason })
    });
    all.filter(|untested| requirements.has(&untested.id))
}

/// The requirements about what a VCU does: those that tests name, and those that none is for though they are.
///
/// What is only the default answer to an open question is none: a program may follow another one.
pub fn about_the_vcu(edition: &Edition) -> HashSet<String> {
    let tested = super::generate(edition).into_iter().flat_map(|test| test.requirements);
    let others =
        untested(edition).filter(|untested| untested.reason.is_about_the_vcu()).map(|untested| untested.id);
    tested.filter(|id| !is_of_a_reading(edition, id)).chain(others).collect()
}
