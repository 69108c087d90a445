//! The protocol in an edition: which fields it has there, and which values they have. `request.rs` and `answer.rs` read and write its
//! lines.

use adsdv_spec::messages::ReadAs;
use adsdv_spec::{Bus, Edition, Inputs};

use super::field::{Domain, Value};
use super::inputs::{INPUTS, InputField};
use super::shown::{FIELDS, SHOWN, ShownField};
use super::unsaid::UNSAID;

/// The protocol as an edition has it: reads and writes the lines that say something in it. A line that is parsed or displayed
/// by itself says it of [`UNSAID`].
///
/// Names are written as the edition spells them, and read as that or as [`UNSAID`] does, with a space or an underscore between two
/// words.
///
/// ```
/// use adsdv_conform::protocol::Protocol;
/// use adsdv_spec::Edition;
///
/// let protocol = Protocol::of(&Edition::V3_0);
/// let refused = protocol.request(r#"{"op":"step","dt_ms":10,"steer_request":241}"#).unwrap_err();
/// assert_eq!(refused.to_string(), "\"steer_request\" is 241; expected a whole number from -240 to 240");
///
/// let newer = Protocol::of(&Edition::V4_0);
/// let step = newer.request(r#"{"op":"step","dt_ms":10,"ami":"TRACK_DRIVE","brake_silence_ms":90}"#).unwrap();
/// let line = r#"{"op":"step","dt_ms":10,"ami":"TRACK DRIVE","brake_silence_ms":90}"#;
/// assert_eq!(newer.line(&step).to_string(), line);
/// assert!(protocol.request(line).is_err()); // 3.0 has neither
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Protocol {
    /// Those of [`INPUTS`], in its order; `None` for what the edition does not have.
    inputs: [Option<Domain>; INPUTS.len()],
    /// Those of [`SHOWN`], likewise.
    shown: [Option<Domain>; SHOWN.len()],
    /// What one of their raw values counts as where that is another one.
    read_as: [Option<ReadAs>; SHOWN.len()],
    /// Where the words are from.
    bus: Bus,
}

impl Protocol {
    /// Where nobody says of which edition a program speaks.
    pub(super) const UNSAID: Self = Self::of(UNSAID);

    /// That of an edition.
    pub const fn of(edition: &Edition) -> Self {
        let mut protocol = Self {
            inputs: [None; INPUTS.len()],
            shown: [None; SHOWN.len()],
            read_as: [None; SHOWN.len()],
            bus: edition.bus,
        };
        let mut place = 0;
        while place < INPUTS.len() {
            protocol.inputs[place] = INPUTS[place].domain_in(edition);
            place += 1;
        }
        place = 0;
        while place < SHOWN.len() {
            protocol.shown[place] = SHOWN[place].domain_in(edition);
            protocol.read_as[place] = SHOWN[place].read_as(&edition.bus);
            place += 1;
        }
        protocol
    }

    /// The inputs that the edition has, in the order of [`INPUTS`], each with its values.
    pub fn inputs(&self) -> impl Iterator<Item = (&'static InputField, Domain)> + use<'_> {
        INPUTS.iter().zip(self.inputs).filter_map(|(field, domain)| Some((field, domain?)))
    }

    /// What a step shows in the edition, in the order of [`SHOWN`], each with its values.
    pub fn shown(&self) -> impl Iterator<Item = (&'static ShownField, Domain)> + use<'_> {
        FIELDS.iter().zip(self.shown).filter_map(|(field, domain)| Some((field, domain?)))
    }

    /// The values of a field of [`SHOWN`], by its place there.
    pub(super) fn shown_at(&self, place: usize) -> Option<Domain> {
        *self.shown.get(place)?
    }

    /// The raw value as which one of a field of [`SHOWN`] counts, by its place there: where the interface does not tell two apart, the
    /// one that is written.
    pub(super) fn meaning_at(&self, place: usize, raw: i32) -> i32 {
        let other = self.read_as.get(place).copied().flatten();
        other.filter(|other| other.raw == raw).map_or(raw, |other| other.meaning)
    }

    pub(super) const fn bus(&self) -> &Bus {
        &self.bus
    }

    /// The value of an input, in the words of the edition.
    pub fn input(&self, field: &InputField, inputs: &Inputs) -> Value {
        Value { domain: field.domain_on(&self.bus), raw: Some((field.get)(inputs)) }
    }
}
