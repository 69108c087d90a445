//! The rows of the signal table, as data.

use core::fmt;

use super::bits::{self, FRAME_BYTES};
use super::content::same;
use super::{Decimal, FieldDef, Node, Scale, SignalValue};

/// One signal of a message: a row of the signal table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SignalDef {
    /// The name, as in the CAN database.
    pub name: &'static str,
    /// The field of the message that carries it, the same in all editions; empty where none does.
    pub field: &'static str,
    /// The lowest bit; bit 0 is the lowest bit of the first byte (little endian).
    pub start: u8,
    /// The number of bits.
    pub width: u8,
    /// Whether the bits are read as two's complement.
    pub signed: bool,
    /// The physical size of one raw step; the offset is zero for every signal.
    pub scale: Scale,
    /// The unit, empty where there is none.
    pub unit: &'static str,
    /// The lowest raw value allowed.
    pub min: i32,
    /// The highest raw value allowed.
    pub max: i32,
    /// The raw values that have names, ascending. Where there are any, no other value is allowed.
    pub values: &'static [(i32, &'static str)],
    /// A raw value that is read as another one: the interface does not tell the two apart.
    pub read_as: Option<ReadAs>,
    /// What the signal says, in one sentence: the comment of the CAN database where there is one.
    pub doc: &'static str,
    /// What asks for its values: the numbers of `REQUIREMENTS.md`, those of all editions. An edition has those of them that
    /// [its own requirements](crate::Edition::requirements) have.
    pub requirements: &'static [&'static str],
}

/// A raw value that is read as another one. It is allowed, and never written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ReadAs {
    /// The value that may be on the bus.
    pub raw: i32,
    /// The value that it counts as.
    pub meaning: i32,
}

impl SignalDef {
    /// A row for a signal that carries a `T`. Only tables call this, when they are compiled.
    pub(crate) const fn of<T: SignalValue>(
        name: &'static str,
        start: u8,
        width: u8,
        doc: &'static str,
    ) -> Self {
        let signal = Self {
            name,
            field: "",
            start,
            width,
            signed: T::SIGNED,
            scale: T::SCALE,
            unit: T::UNIT,
            min: T::MIN,
            max: T::MAX,
            values: T::VALUES,
            read_as: None,
            doc: doc.trim_ascii(),
            requirements: &[],
        };
        assert!(signal.fits_a_frame(), "out of the frame");
        let (lowest, highest) = held_by(width, T::SIGNED);
        let holds = lowest <= T::MIN as i64 && T::MAX as i64 <= highest;
        assert!(holds, "the type has values the bits cannot hold");
        signal
    }

    /// The same row for a flag whose two values have names of their own.
    pub(crate) const fn with_flag_names(self, values: &'static [(i32, &'static str); 2]) -> Self {
        assert!(self.min == 0 && self.max == 1, "only a flag is named value by value");
        Self { values, ..self }
    }

    /// The same row with a number before those of its type, which is read as one of them.
    pub(crate) const fn reading(self, raw: i32, meaning: i32) -> Self {
        assert!(raw < self.min, "the number comes before those of the type");
        assert!(self.allows(meaning), "it is read as a number of the type");
        Self { min: raw, read_as: Some(ReadAs { raw, meaning }), ..self }
    }

    /// The same row with other names for the numbers that its type has, and before them one for that which is read as another.
    pub(crate) const fn with_values(self, values: &'static [(i32, &'static str)]) -> Self {
        let before = match self.read_as {
            Some(ReadAs { raw, .. }) => {
                assert!(
                    !values.is_empty() && values[0].0 == raw,
                    "the first name is of what is read as another"
                );
                1
            }
            None => 0,
        };
        let named = !values.is_empty() && values.len() == self.values.len() + before;
        assert!(named, "one name for each number");
        let mut i = before;
        while i < values.len() {
            assert!(values[i].0 == self.values[i - before].0, "the numbers are those of the type");
            i += 1;
        }
        Self { values, ..self }
    }

    /// The raw value that the interface takes for this one: itself, or what it is [read as](SignalDef::read_as).
    #[inline]
    pub const fn meaning(&self, raw: i32) -> i32 {
        match self.read_as {
            Some(ReadAs { raw: other, meaning }) if raw == other => meaning,
            _ => raw,
        }
    }

    /// The same row of what a field carries.
    pub(crate) const fn carrying(self, field: &'static FieldDef) -> Self {
        Self { field: field.name, requirements: field.requirements, ..self }
    }

    /// Whether it may have every number that its bits hold.
    pub const fn allows_all(&self) -> bool {
        let (lowest, highest) = held_by(self.width, self.signed);
        self.values.is_empty() && self.min as i64 == lowest && self.max as i64 == highest
    }

    /// The same row with a range of its own, inside that of the type, and of the type's named values those in it.
    pub(crate) const fn within(self, min: i32, max: i32) -> Self {
        assert!(self.min <= min && min <= max && max <= self.max, "the type has no such values");
        let (mut first, mut end) = (0, self.values.len());
        while first < end && self.values[first].0 < min {
            first += 1;
        }
        while first < end && self.values[end - 1].0 > max {
            end -= 1;
        }
        let values = self.values.split_at(end).0.split_at(first).1;
        Self { min, max, values, ..self }
    }

    /// The length that data must have to hold this signal: the number of its last byte, from 1.
    pub const fn bytes_needed(&self) -> usize {
        (self.start as usize + self.width as usize).div_ceil(8)
    }

    /// Whether the bits lie in a frame. Those of every table do; a changed copy of a row may not.
    const fn fits_a_frame(&self) -> bool {
        let end = self.start as usize + self.width as usize;
        self.width >= 1 && self.width <= 32 && end <= 8 * FRAME_BYTES
    }

    /// The raw value in `data`, sign extended, whether it is allowed or not; `None` if the data ends
    /// before the signal does.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let steer = Edition::V3_0.bus.message(0x523).expect("VCU2AI_Steer");
    /// let angle = steer.signal("STEER_ANGLE_deg").expect("a signal of 523h");
    /// assert_eq!(angle.raw(&[0xF6, 0xFF]), Some(-10));
    /// assert_eq!(angle.raw(&[0xF6]), None);
    /// ```
    pub const fn raw(&self, data: &[u8]) -> Option<i32> {
        if data.len() < self.bytes_needed() || !self.fits_a_frame() {
            return None;
        }
        Some(bits::extract(bits::load_slice(data), self.start, self.width, self.signed))
    }

    /// The data of a frame with this signal set to a raw value, allowed or not; all other bits stay.
    ///
    /// For writing what the strict [`Layout`](super::Layout) cannot represent.
    #[must_use]
    pub const fn put(&self, data: [u8; bits::FRAME_BYTES], raw: i32) -> [u8; bits::FRAME_BYTES] {
        if !self.fits_a_frame() {
            return data;
        }
        let word = bits::load_slice(&data) & !bits::place(-1, self.start, self.width);
        (word | bits::place(raw, self.start, self.width)).to_le_bytes()
    }

    /// Whether a raw value is allowed: inside the range and, for an enumeration, one of its values.
    pub const fn allows(&self, raw: i32) -> bool {
        if raw < self.min || raw > self.max {
            return false;
        }
        let mut index = 0;
        while index < self.values.len() {
            if self.values[index].0 == raw {
                return true;
            }
            index += 1;
        }
        self.values.is_empty()
    }

    /// A raw value in the signal's unit, for display and plotting.
    pub fn physical(&self, raw: i32) -> f64 {
        self.scale.physical(raw)
    }

    /// The name of a raw value, where it has one.
    pub fn value_name(&self, raw: i32) -> Option<&'static str> {
        self.values.iter().find(|(value, _)| *value == raw).map(|(_, name)| *name)
    }

    /// Displays a raw value: by its name where it has one, otherwise as a number with its unit.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let message = |id| Edition::V3_0.bus.message(id).expect("a message of the VCU");
    /// let state = message(0x520).signal("AS_STATE").expect("a signal of 520h");
    /// assert_eq!(state.display(2).to_string(), "AS_READY");
    /// assert_eq!(state.display(7).to_string(), "7");
    /// let torque = message(0x521).signal("FRONT_AXLE_TRQ_Nm").expect("a signal of 521h");
    /// assert_eq!(torque.display(-125).to_string(), "-12.5 Nm");
    /// ```
    pub const fn display(&self, raw: i32) -> DisplayRaw<'_> {
        DisplayRaw { def: self, raw }
    }
}

/// Displays a raw value of a signal; see [`SignalDef::display`].
#[derive(Clone, Copy, Debug)]
pub struct DisplayRaw<'a> {
    def: &'a SignalDef,
    raw: i32,
}

impl fmt::Display for DisplayRaw<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.def.value_name(self.raw) {
            Some(name) => f.pad(name),
            None => with_unit(f, self.raw, self.def.scale, self.def.unit),
        }
    }
}

/// Writes a raw value as a number with its unit.
pub(super) fn with_unit(f: &mut fmt::Formatter<'_>, raw: i32, scale: Scale, unit: &str) -> fmt::Result {
    write!(f, "{}", Decimal { raw, scale })?;
    if unit.is_empty() { Ok(()) } else { write!(f, " {unit}") }
}

/// One message of the interface, with its signals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct MessageDef {
    /// The name, as in the document and the CAN database.
    pub name: &'static str,
    /// The CAN identifier.
    pub id: u16,
    /// Who sends it.
    pub sender: Node,
    /// The number of data bytes, as in the CAN database.
    pub len: u8,
    /// How often it is sent, in milliseconds.
    pub cycle_ms: u16,
    /// The section of the document that lists it.
    pub section: &'static str,
    /// What asks for the message itself: the numbers of `REQUIREMENTS.md`, those of all editions. An edition has those of
    /// them that [its own requirements](crate::Edition::requirements) have. What asks for its length and its cycle is
    /// of the [bus](crate::Bus).
    pub requirements: &'static [&'static str],
    /// The signals, by ascending start bit.
    pub signals: &'static [SignalDef],
    /// What the message is for, in one sentence.
    pub doc: &'static str,
}

impl MessageDef {
    /// A message made of these signals. Only tables call this, when they are compiled.
    pub(crate) const fn checked(self) -> Self {
        assert!(self.len as usize <= FRAME_BYTES, "longer than a frame");
        assert!(are_in_order(self.signals), "signals overlap, or are not in the order of their bits");
        assert!(self.bytes_needed() <= self.len as usize, "a signal ends after the message does");
        Self { doc: self.doc.trim_ascii(), ..self }
    }

    /// The signal with this name.
    pub fn signal(&self, name: &str) -> Option<&'static SignalDef> {
        self.signals.iter().find(|signal| signal.name == name)
    }

    /// The signal that this field carries.
    pub const fn signal_of(&self, field: &str) -> Option<&'static SignalDef> {
        let mut i = 0;
        while i < self.signals.len() {
            if same(self.signals[i].field.as_bytes(), field.as_bytes()) {
                return Some(&self.signals[i]);
            }
            i += 1;
        }
        None
    }

    /// The length that data must have to hold every signal. It may be less than `len`: some messages
    /// end in unused bytes.
    pub const fn bytes_needed(&self) -> usize {
        match self.signals {
            [.., last] => last.bytes_needed(),
            [] => 0,
        }
    }
}

/// Whether each signal begins behind the end of the one before.
const fn are_in_order(signals: &[SignalDef]) -> bool {
    let (mut end, mut index) = (0, 0);
    while index < signals.len() {
        let signal = &signals[index];
        if signal.start < end {
            return false;
        }
        end = signal.start + signal.width;
        index += 1;
    }
    true
}

/// The lowest and the highest value that so many bits hold, 1 to 32 of them.
const fn held_by(width: u8, signed: bool) -> (i64, i64) {
    if signed { (-1 << (width - 1), (1 << (width - 1)) - 1) } else { (0, (1 << width) - 1) }
}

#[cfg(test)]
mod tests {
    use super::{MessageDef, ReadAs, SignalDef, are_in_order, held_by};
    use crate::editions::V3_0;
    use crate::messages::{AsState, Layout, SteerAngle, Vcu2LogDynamics1};

    /// A message as tables have it.
    const MESSAGE: &MessageDef = <V3_0 as Layout<Vcu2LogDynamics1>>::DEF;

    #[test]
    fn bits_hold_what_the_integers_of_their_width_hold() {
        assert_eq!(held_by(8, false), (u8::MIN.into(), u8::MAX.into()));
        assert_eq!(held_by(8, true), (i8::MIN.into(), i8::MAX.into()));
        assert_eq!(held_by(16, false), (u16::MIN.into(), u16::MAX.into()));
        assert_eq!(held_by(16, true), (i16::MIN.into(), i16::MAX.into()));
        assert_eq!(held_by(32, false), (u32::MIN.into(), u32::MAX.into()));
        assert_eq!(held_by(32, true), (i32::MIN.into(), i32::MAX.into()));
        assert_eq!((held_by(1, false), held_by(1, true)), ((0, 1), (-1, 0)));
    }

    #[test]
    fn a_signal_fits_its_frame_and_its_type() {
        let signal = SignalDef::of::<bool>("flag", 63, 1, " What it says. ");
        assert_eq!((signal.min, signal.max, signal.bytes_needed(), signal.doc), (0, 1, 8, "What it says."));
        let named = signal.with_flag_names(&[(0, "no"), (1, "yes")]);
        assert_eq!((named.values.len(), named.name), (2, "flag"));
    }

    #[test]
    fn a_signal_allows_all_that_its_bits_hold_if_neither_range_nor_names_forbid_it() {
        let all = |signal: SignalDef| signal.allows_all();
        assert!(
            all(SignalDef::of::<u16>("count", 0, 16, "")) && all(SignalDef::of::<bool>("flag", 0, 1, ""))
        );
        assert!(!all(SignalDef::of::<u8>("count", 0, 16, "")) && !all(STATE));
        assert!(!all(SignalDef::of::<u16>("count", 0, 16, "").within(1, 2)));
    }

    #[test]
    #[should_panic(expected = "out of the frame")]
    fn a_signal_behind_its_frame_does_not_compile() {
        let _ = SignalDef::of::<bool>("flag", 64, 1, "");
    }

    #[test]
    #[should_panic(expected = "the bits cannot hold")]
    fn a_signal_too_narrow_for_its_type_does_not_compile() {
        let _ = SignalDef::of::<u16>("count", 0, 15, "");
    }

    #[test]
    #[should_panic(expected = "only a flag")]
    fn a_number_with_the_names_of_a_flag_does_not_compile() {
        let _ = SignalDef::of::<SteerAngle>("angle", 0, 16, "").with_flag_names(&[(0, "no"), (1, "yes")]);
    }

    /// A row whose type has the numbers 1 to 5.
    const STATE: SignalDef = SignalDef::of::<AsState>("state", 16, 4, "");

    #[test]
    fn a_row_may_name_the_numbers_of_its_type_otherwise() {
        let named = STATE.with_values(&[(1, "a"), (2, "b"), (3, "c"), (4, "d"), (5, "e")]);
        assert_eq!((named.min, named.max, named.value_name(4)), (1, 5, Some("d")));
        assert_eq!(named.within(2, 3).values, [(2, "b"), (3, "c")], "and a narrower row keeps its share");
    }

    #[test]
    #[should_panic(expected = "one name for each number")]
    fn a_number_without_a_name_does_not_compile() {
        let _ = STATE.with_values(&[(1, "a"), (2, "b"), (3, "c"), (4, "d")]);
    }

    #[test]
    #[should_panic(expected = "one name for each number")]
    fn a_type_without_names_cannot_be_named() {
        let _ = SignalDef::of::<u8>("count", 0, 8, "").with_values(&[]);
    }

    #[test]
    #[should_panic(expected = "the numbers are those of the type")]
    fn a_name_for_another_number_does_not_compile() {
        let _ = STATE.with_values(&[(1, "a"), (2, "b"), (3, "c"), (4, "d"), (6, "e")]);
    }

    #[test]
    fn a_number_that_the_type_lacks_may_be_read_as_one_that_it_has() {
        let names = &[(0, "init"), (1, "a"), (2, "b"), (3, "c"), (4, "d"), (5, "e")];
        let row = STATE.reading(0, 1).with_values(names);
        assert_eq!((row.min, row.max, row.value_name(0)), (0, 5, Some("init")));
        assert_eq!(row.read_as, Some(ReadAs { raw: 0, meaning: 1 }));
        assert_eq!([-1, 0, 1, 2].map(|raw| row.meaning(raw)), [-1, 1, 1, 2]);
        assert_eq!([-1, 0, 1, 5, 6].map(|raw| row.allows(raw)), [false, true, true, true, false]);
        assert_eq!((STATE.read_as, STATE.meaning(0)), (None, 0));
    }

    #[test]
    #[should_panic(expected = "before those of the type")]
    fn a_number_of_the_type_is_not_read_as_another() {
        let _ = STATE.reading(1, 2);
    }

    #[test]
    #[should_panic(expected = "read as a number of the type")]
    fn a_number_is_not_read_as_one_that_the_type_lacks() {
        let _ = STATE.reading(0, 6);
    }

    #[test]
    #[should_panic(expected = "the first name is of what is read as another")]
    fn a_number_that_is_read_as_another_has_a_name_too() {
        let _ = STATE.reading(0, 1).with_values(&[(1, "a"), (2, "b"), (3, "c"), (4, "d"), (5, "e")]);
    }

    #[test]
    fn a_row_may_allow_less_than_its_type() {
        let angle = SignalDef::of::<SteerAngle>("angle", 0, 16, "");
        let narrow = angle.within(-240, 239);
        assert_eq!((narrow.min, narrow.max), (-240, 239));
        let named = STATE.within(2, 4).values.iter().map(|(raw, _)| *raw);
        assert!(named.eq(2..=4), "and names no more than that");
    }

    #[test]
    #[should_panic(expected = "the type has no such values")]
    fn a_row_that_allows_more_than_its_type_does_not_compile() {
        let _ = SignalDef::of::<SteerAngle>("angle", 0, 16, "").within(0, SteerAngle::MAX.raw() + 1);
    }

    #[test]
    fn a_message_is_checked() {
        let message = MessageDef { doc: " What it is for. ", ..*MESSAGE }.checked();
        assert_eq!((message.doc, message.signals), ("What it is for.", MESSAGE.signals));
        assert_eq!(MessageDef { signals: &[], ..message }.checked().bytes_needed(), 0);
    }

    #[test]
    #[should_panic(expected = "longer than a frame")]
    fn a_message_longer_than_a_frame_does_not_compile() {
        let _ = MessageDef { len: 9, ..*MESSAGE }.checked();
    }

    #[test]
    #[should_panic(expected = "ends after the message")]
    fn a_message_shorter_than_its_signals_does_not_compile() {
        let _ = MessageDef { len: 0, ..*MESSAGE }.checked();
    }

    #[test]
    fn signals_are_in_order_that_neither_overlap_nor_change_places() {
        let MessageDef { signals, .. } = MESSAGE;
        let first = signals[0];
        let at = |start, width| SignalDef { start, width, ..first };
        assert!(are_in_order(&[]) && are_in_order(&[at(3, 2)]));
        assert!(are_in_order(&[at(0, 8), at(8, 4), at(16, 1)]));
        assert!(!are_in_order(&[at(0, 8), at(7, 4)]));
        assert!(!are_in_order(&[at(0, 8), at(8, 4), at(11, 1)]));
        assert!(!are_in_order(&[at(8, 4), at(0, 8)]));
    }
}
