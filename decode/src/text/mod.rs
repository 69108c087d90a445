//! Text as people know it from `cantools decode`: the frame as candump prints it, and behind it what it says.
//!
//! ```text
//! (1795209995.234703) vcan0 523#00001B000000 :: VCU2AI_Steer(ANGLE: 0.0 deg, ANGLE_MAX: 2.7 deg, ANGLE_REQUEST: 0.0 deg)
//! ```
//!
//! What differs from cantools 45:
//!
//! - A fraction is exact: 0.3 where Python multiplies floats to 0.30000000000000004.
//! - Of a frame that is too short the signals are printed that are there, and of one that is too long all; `Wrong data size` stands behind
//!   them, where cantools has nothing else.
//! - A remote frame, an error frame and one of CAN XL is called so.
//! - A line that is no frame is not repeated, but counted.
//! - The frame is printed as `candump -L` would, whatever format the recording has.
//!
//! Everything that does not depend on the frame is made beforehand, once for each signal, and what a frame adds is appended to a buffer:
//! nothing is allocated for a frame.

mod template;

use std::io::Write;

use adsdv_oracle::candump::{Dropped, FrameKind, write_dropped};

use crate::line::{kind_name, put_line};
use crate::out::Out;
use crate::value::put_integer;
use crate::{Catalog, Frame, Sink, SinkError};
use template::Template;

/// How text is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextLayout {
    /// A line for each signal, as cantools does by default.
    #[default]
    Lines,
    /// A line for each frame, as with its `--single-line`.
    SingleLine,
}

/// Writes text.
pub struct Text<'a> {
    out: Out<'a>,
    templates: Vec<Template>,
}

impl<'a> Text<'a> {
    /// Text for the frames of these messages. With `live`, somebody may be waiting for it.
    pub fn new(catalog: &Catalog, writer: impl Write + Send + 'a, layout: TextLayout, live: bool) -> Self {
        let templates = catalog.messages().iter().map(|message| Template::new(message, layout)).collect();
        Self { out: Out::new(writer, live), templates }
    }
}

impl Sink for Text<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let out = &mut self.out.text;
        put_line(out, frame.record);
        out.extend_from_slice(b" ::");
        let message = frame.message.and_then(|(place, message)| Some((self.templates.get(place)?, message)));
        match message {
            Some((template, message)) => template.put(out, message, frame.record.data),
            None => put_unknown(out, frame.record.kind, frame.record.id),
        }
        out.push(b'\n');
        self.out.end_frame()
    }

    fn dropped(&mut self, dropped: &Dropped<'_>) -> Result<(), SinkError> {
        // A name that candump would not print has no such line; the frames are counted all the same.
        let _ = write_dropped(&mut self.out.text, dropped);
        self.out.end_frame()
    }

    fn finish(&mut self, _lines: u64) -> Result<(), SinkError> {
        self.out.finish()
    }
}

#[cold]
fn put_unknown(out: &mut Vec<u8>, kind: FrameKind, id: u32) {
    let name = kind_name(kind);
    if name.is_empty() {
        let kind = if matches!(kind, FrameKind::Fd { .. }) { "CAN FD frame" } else { "frame" };
        // A vector takes everything.
        let _ = write!(out, " Unknown {kind} id {id} (0x{id:x})");
        return;
    }
    let (first, rest) = name.split_at(1);
    out.push(b' ');
    out.extend_from_slice(first.to_ascii_uppercase().as_bytes());
    out.extend_from_slice(rest.as_bytes());
}

/// What cantools says of a frame that is not as long as its message.
#[cold]
fn put_wrong_size(out: &mut Vec<u8>, size: usize, expected: usize) {
    out.extend_from_slice(b" Wrong data size: ");
    put_integer(out, i64::try_from(size).unwrap_or(i64::MAX));
    out.extend_from_slice(b" instead of ");
    put_integer(out, i64::try_from(expected).unwrap_or(i64::MAX));
    out.extend_from_slice(b" bytes");
}
