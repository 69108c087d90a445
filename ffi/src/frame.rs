//! A frame on the bus, and writing signals into it.

use core::ffi::c_char;

use adsdv_spec::Edition;
use adsdv_spec::messages::{DecodeError, Frame, MessageDef, SignalDef};

use crate::border::{Plain, answer, load, out, text};
use crate::edition::{self, adsdv_edition};
use crate::error::{Refusal, adsdv_error, adsdv_status};

/// A classic CAN data frame with an 11-bit identifier.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct adsdv_frame {
    /// The identifier.
    pub id: u16,
    /// How many bytes of `data` are sent: 0 to 8.
    pub len: u8,
    /// The data.
    pub data: [u8; 8],
}

// SAFETY: `repr(C)`, integers only.
unsafe impl Plain for adsdv_frame {}

impl From<Frame> for adsdv_frame {
    fn from(Frame { id, len, data }: Frame) -> Self {
        Self { id, len, data }
    }
}

impl adsdv_frame {
    /// The bytes that are sent.
    pub(crate) fn sent(&self) -> Result<&[u8], Refusal<'static>> {
        let (given, most) = (usize::from(self.len), self.data.len());
        self.data.get(..given).ok_or(Refusal::TooMany { what: "frame.len", given, most })
    }
}

/// The message of an edition with this identifier.
pub(crate) fn message(edition: &Edition, id: u16) -> Result<&'static MessageDef, Refusal<'static>> {
    edition.bus.message(id).ok_or(Refusal::Decode(DecodeError::UnknownId { id }))
}

/// The signal of a message with this name, or to which another edition gives it.
pub(crate) fn signal<'a>(message: &MessageDef, name: &'a str) -> Result<&'static SignalDef, Refusal<'a>> {
    message.signal_known_as(name).ok_or(Refusal::NoSignal { given: name, message: message.name })
}

/// This data ends before a signal does.
pub(crate) fn ends(message: &MessageDef, signal: &SignalDef, data: &[u8]) -> Refusal<'static> {
    Refusal::Decode(DecodeError::TooShort {
        message: message.name,
        id: message.id,
        given: data.len(),
        needed: signal.bytes_needed(),
        signal: signal.name,
    })
}

/// Whether the AI Computer must not send frames with this identifier (section 2.3 of the default edition).
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_is_reserved(id: u32) -> bool {
    adsdv_is_reserved_in(edition::DEFAULT, id)
}

/// Whether the AI Computer must not send frames with this identifier in an edition; false if there is no such edition.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_is_reserved_in(edition: adsdv_edition, id: u32) -> bool {
    let reserved = |edition: &Edition| u16::try_from(id).is_ok_and(|id| edition.bus.is_reserved(id));
    edition::numbered(edition).is_some_and(reserved)
}

/// Begins a frame of the message of the default edition with this identifier: every signal is 0, or the first value of its
/// enumeration where that has no 0. adsdv_frame_set sets the others.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_frame_init(
    frame: *mut adsdv_frame,
    id: u16,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_frame_init_in(edition::DEFAULT, frame, id, error) }
}

/// Begins a frame of the message of an edition, likewise, as long as the edition has it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_frame_init_in(
    edition: adsdv_edition,
    frame: *mut adsdv_frame,
    id: u16,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let edition = edition::given(edition, "")?;
        // SAFETY: the caller promises it for the frame.
        let place = unsafe { out(frame, "frame")? };
        let message = message(edition, id)?;
        let data = message.signals.iter().fold([0; 8], |data, signal| {
            let first = signal.values.first().map_or(signal.min, |(value, _)| *value);
            signal.put(data, signal.meaning(if signal.allows(0) { 0 } else { first }))
        });
        place.set(adsdv_frame { id, len: message.len, data });
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// Sets a signal of a frame of the default edition, such as "STEER_REQUEST_deg" of 513h, to a raw value: in steps of the
/// signal, so that -49 is -4.9 degrees. A value that the edition does not allow is an error. All other bits stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_frame_set(
    frame: *mut adsdv_frame,
    signal: *const c_char,
    raw: i32,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_frame_set_in(edition::DEFAULT, frame, signal, raw, error) }
}

/// Sets a signal of a frame of an edition, likewise. A name that another edition has for it is understood.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_frame_set_in(
    edition: adsdv_edition,
    frame: *mut adsdv_frame,
    signal: *const c_char,
    raw: i32,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let edition = edition::given(edition, "")?;
        // SAFETY: the caller promises it for the frame and the text.
        let (given, place, name) =
            unsafe { (load(frame, "frame")?, out(frame, "frame")?, text(signal, "signal")?) };
        let message = message(edition, given.id)?;
        let def = self::signal(message, name)?;
        let data = given.sent()?;
        if data.len() < def.bytes_needed() {
            return Err(ends(message, def, data));
        }
        def.check(raw)?;
        place.set(adsdv_frame { data: def.put(given.data, raw), ..given });
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
