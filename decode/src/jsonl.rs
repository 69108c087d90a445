//! JSON Lines: an object for each frame, with its signals.
//!
//! ```text
//! {"time_s":1795209995.234358,"interface":"vcan0","id":"523","data":"00001B000000","message":"VCU2AI_Steer","signals":{"ANGLE":{"value":0,"unit":"deg"},...}}
//! {"time_s":1795209996.000000,"interface":"vcan0","id":"18FF50E5","data":"0102FF"}
//! ```
//!
//! A value that has a name has that in `name` as well. A float that is no number is `null`. A frame that nothing knows has neither
//! `message` nor `signals`. A remote frame, an error frame and one of CAN XL has what it is in `kind`.

use std::io::Write;

use crate::line::{kind_name, put_hex, put_id, put_time};
use crate::out::Out;
use crate::{Catalog, Frame, Sink, SinkError};

/// Writes JSON Lines.
pub struct JsonLines<'a> {
    out: Out<'a>,
    messages: Vec<MessageText>,
}

/// What of a message's objects does not depend on the frame.
pub(crate) struct MessageText {
    /// The name, in quotes.
    pub(crate) name: Vec<u8>,
    signals: Vec<SignalText>,
}

struct SignalText {
    /// `"NAME":{"value":`.
    label: Vec<u8>,
    /// `,"unit":"..."`, where there is one.
    unit: Vec<u8>,
}

impl<'a> JsonLines<'a> {
    /// JSON Lines for the frames of these messages. With `live`, somebody may be waiting for them.
    pub fn new(catalog: &Catalog, writer: impl Write + Send + 'a, live: bool) -> Self {
        let messages = catalog.messages().iter().map(|message| MessageText {
            name: quoted(&message.name),
            signals: message.signals.iter().map(SignalText::new).collect(),
        });
        Self { out: Out::new(writer, live), messages: messages.collect() }
    }
}

impl SignalText {
    fn new(signal: &crate::Signal) -> Self {
        let mut label = quoted(&signal.name);
        label.extend_from_slice(b":{\"value\":");
        let mut unit = Vec::new();
        if !signal.unit.is_empty() {
            unit.extend_from_slice(b",\"unit\":");
            put_quoted(&mut unit, &signal.unit);
        }
        Self { label, unit }
    }
}

impl Sink for JsonLines<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let (record, out) = (frame.record, &mut self.out.text);
        out.extend_from_slice(b"{\"time_s\":");
        put_time(out, record.time_ns, 1);
        out.extend_from_slice(b",\"interface\":");
        put_quoted(out, record.interface);
        out.extend_from_slice(b",\"id\":\"");
        put_id(out, record);
        out.extend_from_slice(b"\",\"data\":\"");
        put_hex(out, record.data);
        out.push(b'"');
        let kind = kind_name(record.kind);
        if !kind.is_empty() {
            out.extend_from_slice(b",\"kind\":");
            put_quoted(out, kind);
        }
        if let Some((place, message)) = frame.message
            && let Some(texts) = self.messages.get(place)
        {
            out.extend_from_slice(b",\"message\":");
            out.extend_from_slice(&texts.name);
            out.extend_from_slice(b",\"signals\":{");
            let mut first = true;
            for (signal, text) in message.signals.iter().zip(&texts.signals) {
                let Some(bits) = signal.place.bits(record.data).filter(|_| message.has(signal, record.data))
                else {
                    continue;
                };
                if !first {
                    out.push(b',');
                }
                first = false;
                out.extend_from_slice(&text.label);
                signal.value(bits).put(out, b"null");
                out.extend_from_slice(&text.unit);
                if let Some(name) = signal.value_name(bits) {
                    out.extend_from_slice(b",\"name\":");
                    put_quoted(out, name);
                }
                out.push(b'}');
            }
            out.push(b'}');
        }
        out.extend_from_slice(b"}\n");
        self.out.end_frame()
    }

    fn finish(&mut self, _lines: u64) -> Result<(), SinkError> {
        self.out.finish()
    }
}

/// Text as a string of JSON.
pub(crate) fn quoted(text: &str) -> Vec<u8> {
    let mut out = Vec::new();
    put_quoted(&mut out, text);
    out
}

/// Appends text as a string of JSON.
pub(crate) fn put_quoted(out: &mut Vec<u8>, text: &str) {
    if text.bytes().all(|byte| byte >= b' ' && byte != b'"' && byte != b'\\') {
        out.push(b'"');
        out.extend_from_slice(text.as_bytes());
        out.push(b'"');
        return;
    }
    // Neither a string nor a vector fails.
    let _ = serde_json::to_writer(out, text);
}
