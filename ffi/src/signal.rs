//! What the messages and their signals are, and what a frame says.

use core::ffi::c_char;

use adsdv_spec::messages::{MessageDef, Node, SignalDef};
use adsdv_spec::{Choice, Edition};

use crate::border::{Plain, answer, fill, load, out, text};
use crate::edition::{self, adsdv_edition};
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::frame::{adsdv_frame, ends, message, signal};
use crate::text::{array, short};

/// How many messages the default edition has; adsdv_message_count has those of others.
pub const ADSDV_MESSAGES: usize = 15;
/// Room for the signals of any message of any edition.
pub const ADSDV_MOST_SIGNALS: usize = 32;
/// Room for the name of a signal and its NUL: that of its field.
const SIGNAL_NAME: usize = {
    const fn room<const N: usize>(_: fn(&adsdv_signal) -> &[c_char; N]) -> usize {
        N
    }
    room(|signal| &signal.name)
};
/// How many choices the default edition leaves, of all readings together; adsdv_reading_count has those of others.
pub const ADSDV_CHOICES: usize = 26;

const _: () = assert!(ADSDV_MESSAGES == edition::EDITION.bus.messages.len());
const _: () = assert!(ADSDV_CHOICES == edition::EDITION.choices.len());
const _: () = {
    let mut number = 0;
    while number < edition::COUNT {
        let messages = Edition::ALL[number].bus.messages;
        let mut i = 0;
        while i < messages.len() {
            let signals = messages[i].signals;
            assert!(signals.len() <= ADSDV_MOST_SIGNALS, "a place for each signal");
            let mut signal = 0;
            while signal < signals.len() {
                assert!(signals[signal].name.len() < SIGNAL_NAME, "room for each name and its NUL");
                signal += 1;
            }
            i += 1;
        }
        number += 1;
    }
};

/// A message of the interface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_message {
    /// Its name, such as "VCU2AI_Status".
    pub name: [c_char; 32],
    /// The section of the document that lists it.
    pub section: [c_char; 8],
    /// Its identifier.
    pub id: u16,
    /// How many bytes it has.
    pub len: u8,
    /// Who sends it: 1 for the VCU, 0 for the AI Computer.
    pub from_vcu: u8,
    /// How many signals it has.
    pub signals: u8,
}

/// A signal, and what a frame says of it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_signal {
    /// Its name, such as "STEER_ANGLE_deg".
    pub name: [c_char; 48],
    /// Its unit, such as "deg"; "" where there is none.
    pub unit: [c_char; 8],
    /// The value in words: by its name, or as a number with its unit, such as "AS_READY" or "-4.9 deg".
    pub text: [c_char; 32],
    /// The value in its unit, for display and plotting.
    pub physical: f64,
    /// The value in steps of the signal: what is compared, and what is on the bus.
    pub raw: i32,
    /// The lowest raw value that is allowed.
    pub min: i32,
    /// The highest raw value that is allowed. An enumeration need not have all between.
    pub max: i32,
    /// A step of the signal is `scale_num` / `scale_den` of its unit.
    pub scale_num: u32,
    /// See `scale_num`; never 0.
    pub scale_den: u32,
    /// The lowest bit of the signal; bit 0 is the lowest of the first byte.
    pub start: u8,
    /// How many bits it has.
    pub width: u8,
    /// Whether the frame is long enough for the signal. If not, `raw` and `physical` are 0 and `text` is empty.
    pub present: u8,
    /// Whether it is there and the document allows its value.
    pub allowed: u8,
}

/// A choice: one answer to a question that the document leaves open.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_reading {
    /// As adsdv_machine_init_in reads it, such as "fault-trigger=edge".
    pub name: [c_char; 48],
    /// The answer in words.
    pub text: [c_char; 48],
    /// The question in words.
    pub question: [c_char; 128],
    /// The sections that raise it.
    pub section: [c_char; 16],
    /// Whether it is what is read where nothing else is said.
    pub is_default: u8,
}

// SAFETY: `repr(C)`; integers and arrays of `char`.
unsafe impl Plain for adsdv_message {}
// SAFETY: `repr(C)`; numbers and arrays of `char`, and every pattern of bits is a `double`.
unsafe impl Plain for adsdv_signal {}
// SAFETY: `repr(C)`; an integer and arrays of `char`.
unsafe impl Plain for adsdv_reading {}

impl adsdv_message {
    fn of(message: &MessageDef) -> Self {
        Self {
            name: short(message.name),
            section: short(message.section),
            id: message.id,
            len: message.len,
            from_vcu: u8::from(message.sender == Node::Vcu),
            // `ADSDV_MOST_SIGNALS` is far less.
            signals: u8::try_from(message.signals.len()).unwrap_or(u8::MAX),
        }
    }
}

impl adsdv_signal {
    fn of(def: &SignalDef, data: &[u8]) -> Self {
        let raw = def.raw(data);
        Self {
            name: short(def.name),
            unit: short(def.unit),
            text: raw.map_or([0; 32], |raw| array(format_args!("{}", def.display(raw)))),
            physical: raw.map_or(0.0, |raw| def.physical(raw)),
            raw: raw.unwrap_or(0),
            min: def.min,
            max: def.max,
            scale_num: def.scale.num(),
            scale_den: def.scale.den(),
            start: def.start,
            width: def.width,
            present: u8::from(raw.is_some()),
            allowed: u8::from(raw.is_some_and(|raw| def.allows(raw))),
        }
    }
}

impl adsdv_reading {
    fn of(edition: &Edition, choice: Choice) -> Self {
        let reading = choice.reading();
        Self {
            name: array(format_args!("{choice}")),
            text: short(choice.text()),
            question: short(reading.question()),
            section: short(reading.section()),
            is_default: u8::from(edition.readings.is(choice)),
        }
    }
}

/// The messages of the default edition, by ascending identifier: `index` is less than ADSDV_MESSAGES.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_message_at(
    index: usize,
    message: *mut adsdv_message,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_message_at_in(edition::DEFAULT, index, message, error) }
}

/// How many messages an edition has; 0 if there is no such edition.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_message_count(edition: adsdv_edition) -> usize {
    edition::numbered(edition).map_or(0, |edition| edition.bus.messages.len())
}

/// The messages of an edition, by ascending identifier: `index` is less than adsdv_message_count says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_message_at_in(
    edition: adsdv_edition,
    index: usize,
    message: *mut adsdv_message,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let messages = edition::given(edition, "")?.bus.messages;
        // SAFETY: the caller promises it for the message.
        let place = unsafe { out(message, "message")? };
        let def = messages.get(index).ok_or(Refusal::NoIndex { index, count: messages.len() })?;
        place.set(adsdv_message::of(def));
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// The choices that the default edition leaves, reading by reading: `index` is less than ADSDV_CHOICES.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_reading_at(
    index: usize,
    reading: *mut adsdv_reading,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_reading_at_in(edition::DEFAULT, index, reading, error) }
}

/// How many choices an edition leaves, of all readings together; 0 if there is no such edition. A reading with a single one is
/// settled.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_reading_count(edition: adsdv_edition) -> usize {
    edition::numbered(edition).map_or(0, |edition| edition.choices.iter().count())
}

/// The choices that an edition leaves, reading by reading: `index` is less than adsdv_reading_count says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_reading_at_in(
    edition: adsdv_edition,
    index: usize,
    reading: *mut adsdv_reading,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let edition = edition::given(edition, "")?;
        // SAFETY: the caller promises it for the reading.
        let place = unsafe { out(reading, "reading")? };
        let mut choices = edition.choices.iter();
        let count = choices.clone().count();
        let choice = choices.nth(index).ok_or(Refusal::NoIndex { index, count })?;
        place.set(adsdv_reading::of(edition, choice));
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// Reads a frame of any message of the default edition: every signal of it, by ascending bits, into `signals`, which has
/// `room` places (ADSDV_MOST_SIGNALS are always enough), and their number into `count`.
///
/// A frame with too few bytes or a value that is not allowed is an error (ADSDV_TOO_SHORT, ADSDV_BAD_VALUE) that names
/// the first such signal; the signals are written all the same, each with its `present` and `allowed`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_decode(
    frame: *const adsdv_frame,
    signals: *mut adsdv_signal,
    room: usize,
    count: *mut usize,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_decode_in(edition::DEFAULT, frame, signals, room, count, error) }
}

/// Reads a frame of any message of an edition, likewise.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_decode_in(
    edition: adsdv_edition,
    frame: *const adsdv_frame,
    signals: *mut adsdv_signal,
    room: usize,
    count: *mut usize,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let edition = edition::given(edition, "")?;
        // SAFETY: the caller promises it for the frame and the count.
        let (frame, count) = unsafe { (load(frame, "frame")?, out(count, "count")?) };
        let (message, data) = (message(edition, frame.id)?, frame.sent()?);
        let values = message.signals.iter().map(|def| adsdv_signal::of(def, data));
        // SAFETY: the caller promises `room` places.
        unsafe { fill(signals, room, "signals", values)? };
        count.set(message.signals.len());
        edition.bus.decode(frame.id, data)?;
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// Reads one signal of a frame of the default edition by its name, such as "STEER_ANGLE_deg" of 523h. A frame that ends before
/// the signal does, or a value that is not allowed, is an error; the signal is written all the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_decode_signal(
    frame: *const adsdv_frame,
    name: *const c_char,
    value: *mut adsdv_signal,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_decode_signal_in(edition::DEFAULT, frame, name, value, error) }
}

/// Reads one signal of a frame of an edition, likewise. A name that another edition has for it is understood.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_decode_signal_in(
    edition: adsdv_edition,
    frame: *const adsdv_frame,
    name: *const c_char,
    value: *mut adsdv_signal,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let edition = edition::given(edition, "")?;
        // SAFETY: the caller promises it for the frame, the text and the value.
        let (frame, name, place) =
            unsafe { (load(frame, "frame")?, text(name, "name")?, out(value, "value")?) };
        let (message, data) = (message(edition, frame.id)?, frame.sent()?);
        let def = signal(message, name)?;
        place.set(adsdv_signal::of(def, data));
        def.check(def.raw(data).ok_or_else(|| ends(message, def, data))?)?;
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
