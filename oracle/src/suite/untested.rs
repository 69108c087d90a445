//! The requirements that no test of the suite is for, each with the reason.

use std::collections::HashSet;
use std::fmt;
use std::ops::RangeInclusive;

use adsdv_spec::Edition;

use super::requirements::is_of_a_reading;

/// Why no test is for a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// It binds the AI Computer or a person.
    AnotherParty,
    /// It binds whoever reads or writes frames.
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
            Self::Codec => "binds whoever reads or writes frames, and a program under test does neither",
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

/// All of them, by prefix and number, with the editions that ask for them; no edition stands for all.
const UNTESTED: &[(Reason, &str, RangeInclusive<u32>, &[&str])] = {
    use Reason::{AnotherParty, Codec, Frames, NotShown, Permission};
    const ALL: &[&str] = &[];
    const IN_3_0: &[&str] = &["3.0"];
    const IN_4_0: &[&str] = &["4.0"];
    const SINCE_4_0: &[&str] = &["4.0", "2026"];
    const IN_2026: &[&str] = &["2026"];
    &[
        (AnotherParty, "MSG", 1..=8, ALL),
        (AnotherParty, "MSG", 10..=17, ALL),
        (AnotherParty, "MSG", 19..=23, ALL),
        (AnotherParty, "MSG", 24..=24, IN_3_0),
        (AnotherParty, "MSG", 26..=28, ALL),
        (Frames, "MSG", 29..=41, ALL),
        (Frames, "MSG", 65..=73, ALL),
        (Frames, "MSG", 74..=74, IN_3_0),
        (Frames, "MSG", 75..=79, ALL),
        (Frames, "MSG", 80..=80, IN_3_0),
        (Frames, "MSG", 81..=83, ALL),
        (Frames, "MSG", 86..=87, SINCE_4_0),
        (Frames, "MSG", 88..=95, IN_4_0),
        (Frames, "MSG", 96..=96, SINCE_4_0),
        (Codec, "MSG", 97..=97, IN_4_0),
        (AnotherParty, "MSG", 98..=98, SINCE_4_0),
        (AnotherParty, "MSG", 99..=99, IN_4_0),
        (Frames, "MSG", 100..=100, IN_4_0),
        (Frames, "MSG", 101..=101, SINCE_4_0),
        (AnotherParty, "MSG", 102..=102, IN_4_0),
        (Codec, "MSG", 103..=103, IN_4_0),
        (AnotherParty, "MSG", 105..=105, IN_2026),
        // AS_INIT, which is read as AS_OFF.
        (NotShown, "MSG", 109..=109, IN_2026),
        (Frames, "MSG", 110..=112, IN_2026),
        (Codec, "MSG", 113..=115, IN_2026),
        (Frames, "MSG", 116..=116, IN_2026),
        (AnotherParty, "ID", 1..=2, ALL),
        (AnotherParty, "ID", 3..=3, IN_3_0),
        (AnotherParty, "ID", 4..=5, ALL),
        (AnotherParty, "ID", 6..=6, IN_3_0),
        (AnotherParty, "ID", 7..=14, ALL),
        (AnotherParty, "ID", 15..=16, IN_3_0),
        (AnotherParty, "ID", 17..=17, ALL),
        (AnotherParty, "ID", 18..=19, SINCE_4_0),
        (AnotherParty, "ID", 20..=20, IN_2026),
        (AnotherParty, "HS", 2..=2, ALL),
        (Frames, "HS", 3..=3, ALL),
        (AnotherParty, "HS", 5..=5, ALL),
        (AnotherParty, "HS", 11..=11, ALL),
        (Permission, "HS", 14..=14, IN_3_0),
        // The status light.
        (NotShown, "SM", 4..=8, ALL),
        (AnotherParty, "RDY", 7..=8, ALL),
        // What the powertrain is ready for.
        (NotShown, "DRV", 1..=1, ALL),
        (AnotherParty, "DRV", 10..=10, ALL),
        (AnotherParty, "DRV", 13..=13, ALL),
        (AnotherParty, "FIN", 1..=3, ALL),
        (AnotherParty, "ETO", 4..=4, ALL),
        (Codec, "D", 19..=19, ALL),
        (Frames, "D", 20..=20, ALL),
        (Frames, "D", 28..=29, ALL),
        (Codec, "D", 30..=31, ALL),
        (AnotherParty, "D", 32..=32, ALL),
        (Codec, "D", 33..=33, IN_3_0),
        (Codec, "D", 34..=34, ALL),
        (Frames, "D", 35..=35, ALL),
        (Frames, "D", 46..=50, ALL),
        (Frames, "D", 56..=59, IN_4_0),
        (Frames, "D", 60..=61, SINCE_4_0),
        (Codec, "D", 66..=66, SINCE_4_0),
        (Codec, "D", 68..=70, IN_2026),
    ]
};

/// The requirements of an edition that no test of [`generate`](super::generate) is for. Every other one is named by a test.
///
/// ```
/// use adsdv_oracle::suite::{self, Reason};
/// use adsdv_spec::Edition;
/// let light = suite::untested(Edition::DEFAULT).find(|untested| untested.id == "SM-5").map(|untested| untested.reason);
/// assert_eq!(light, Some(Reason::NotShown)); // the ASSI is yellow in AS_READY
/// ```
pub fn untested(edition: &Edition) -> impl Iterator<Item = Untested> {
    let version = edition.version;
    let of_edition =
        UNTESTED.iter().filter(move |(.., editions)| editions.is_empty() || editions.contains(&version));
    of_edition.flat_map(|(reason, prefix, numbers, _)| {
        numbers.clone().map(move |number| Untested { id: format!("{prefix}-{number}"), reason: *reason })
    })
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
