//! CSV: a row for each signal of each frame.
//!
//! ```text
//! time_s,interface,id,message,signal,value,unit,name
//! 1795209995.234703,vcan0,523,VCU2AI_Steer,ANGLE_MAX,2.7,deg,
//! 1795209995.234358,vcan0,520,VCU2AI_Status,AS_STATE,1,,AS_OFF
//! 1795209996.000000,vcan0,18FF50E5,,,,,0102FF
//! ```
//!
//! `value` has numbers and nothing else, so that its column is one of numbers wherever it is read. A frame that nothing knows has a row
//! without message and signal, with its bytes in `name`; so has one that is too short for every signal of its message, with that. A remote
//! frame, an error frame and one of CAN XL has what it is in `message`.

use std::io::Write;

use crate::line::{kind_name, put_hex, put_id, put_time};
use crate::out::Out;
use crate::{Catalog, Frame, Sink, SinkError};

const HEADER: &[u8] = b"time_s,interface,id,message,signal,value,unit,name\n";

/// Writes CSV.
pub struct Csv<'a> {
    out: Out<'a>,
    messages: Vec<CsvMessage>,
    /// The columns up to the identifier, of the frame at hand.
    frame: Vec<u8>,
}

/// What of a message's rows does not depend on the frame.
struct CsvMessage {
    name: Vec<u8>,
    /// `,signal,` and `,unit,` of each signal.
    signals: Vec<(Vec<u8>, Vec<u8>)>,
}

impl<'a> Csv<'a> {
    /// CSV for the frames of these messages. With `live`, somebody may be waiting for it.
    pub fn new(catalog: &Catalog, writer: impl Write + Send + 'a, live: bool) -> Self {
        let cell = |before: &str, text: &str, after: &str| {
            let mut cell = before.as_bytes().to_vec();
            put_cell(&mut cell, text);
            cell.extend_from_slice(after.as_bytes());
            cell
        };
        let messages = catalog.messages().iter().map(|message| CsvMessage {
            name: cell(",", &message.name, ""),
            signals: message
                .signals
                .iter()
                .map(|signal| (cell(",", &signal.name, ","), cell(",", &signal.unit, ",")))
                .collect(),
        });
        let mut out = Out::new(writer, live);
        out.text.extend_from_slice(HEADER);
        Self { out, messages: messages.collect(), frame: Vec::new() }
    }
}

impl Sink for Csv<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let record = frame.record;
        self.frame.clear();
        put_time(&mut self.frame, record.time_ns, 1);
        self.frame.push(b',');
        put_cell(&mut self.frame, record.interface);
        self.frame.push(b',');
        put_id(&mut self.frame, record);
        let out = &mut self.out.text;
        let mut empty = true;
        if let Some((place, message)) = frame.message
            && let Some(texts) = self.messages.get(place)
        {
            for (signal, (name, unit)) in message.signals.iter().zip(&texts.signals) {
                let Some(bits) = signal.place.bits(record.data).filter(|_| message.has(signal, record.data))
                else {
                    continue;
                };
                empty = false;
                out.extend_from_slice(&self.frame);
                out.extend_from_slice(&texts.name);
                out.extend_from_slice(name);
                signal.value(bits).put(out, b"NaN");
                out.extend_from_slice(unit);
                if let Some(name) = signal.value_name(bits) {
                    put_cell(out, name);
                }
                out.push(b'\n');
            }
        }
        if empty {
            out.extend_from_slice(&self.frame);
            out.push(b',');
            let message = frame.message.map_or(kind_name(record.kind), |(_, message)| &*message.name);
            put_cell(out, message);
            out.extend_from_slice(b",,,,");
            put_hex(out, record.data);
            out.push(b'\n');
        }
        self.out.end_frame()
    }

    fn finish(&mut self, _lines: u64) -> Result<(), SinkError> {
        self.out.finish()
    }
}

/// Appends text as a cell: in quotes where a comma, a quote or a line end is in it.
fn put_cell(out: &mut Vec<u8>, text: &str) {
    if !text.bytes().any(|byte| matches!(byte, b',' | b'"' | b'\n' | b'\r')) {
        return out.extend_from_slice(text.as_bytes());
    }
    out.push(b'"');
    for byte in text.bytes() {
        if byte == b'"' {
            out.push(b'"');
        }
        out.push(byte);
    }
    out.push(b'"');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_in_quotes_where_it_has_to_be() {
        let cell = |text| {
            let mut out = Vec::new();
            put_cell(&mut out, text);
            String::from_utf8(out).expect("text")
        };
        assert_eq!(
            ["AS OFF", "a,b", "a\"b", "a\nb", ""].map(cell),
            ["AS OFF", "\"a,b\"", "\"a\"\"b\"", "\"a\nb\"", ""]
        );
    }
}
