//! What the page does with what is packed, in Rust.

use std::io::Read as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::read::DeflateDecoder;
use serde_json::Value;

/// A frame: when, in microseconds, which, and its data.
pub(crate) type Frame = (i64, u16, Vec<u8>);

pub(crate) fn bytes(packed: &Value) -> Vec<u8> {
    let packed = STANDARD.decode(packed.as_str().expect("text")).expect("base64");
    let mut bytes = Vec::new();
    DeflateDecoder::new(&packed[..]).read_to_end(&mut bytes).expect("deflated");
    bytes
}

struct Bytes(std::vec::IntoIter<u8>);

impl Bytes {
    fn byte(&mut self) -> u8 {
        self.0.next().expect("more bytes")
    }

    fn number(&mut self) -> u64 {
        let (mut number, mut shift) = (0, 0);
        loop {
            let byte = self.byte();
            number |= u64::from(byte & 0x7F) << shift;
            shift += 7;
            if byte < 0x80 {
                return number;
            }
        }
    }

    fn signed(&mut self) -> i64 {
        let number = self.number();
        (number >> 1).cast_signed() ^ -(number & 1).cast_signed()
    }

    fn times(&mut self, count: u64, from: i64) -> Vec<i64> {
        let (mut before, mut step) = (from, 0);
        let time = |_| {
            step += self.signed();
            before += step;
            before
        };
        (0..count).map(time).collect()
    }

    fn differences(&mut self, count: u64) -> Vec<u8> {
        let mut before = 0_u8;
        let byte = |_| {
            before = before.wrapping_add(self.byte());
            before
        };
        (0..count).map(byte).collect()
    }
}

/// All frames, and the answers to the handshake with how long each took, both in microseconds.
pub(crate) fn chunks(chunks: &Value) -> (Vec<Frame>, Vec<(i64, i64)>) {
    let (mut frames, mut answers) = (Vec::new(), Vec::new());
    for chunk in chunks.as_array().expect("chunks") {
        let from = chunk["from"].as_i64().expect("a time");
        let mut bytes = Bytes(bytes(&chunk["packed"]).into_iter());
        for _ in 0..bytes.number() {
            let id = u16::try_from(bytes.number()).expect("an identifier");
            let count = bytes.number();
            let times = bytes.times(count, from);
            let lengths = bytes.differences(count);
            let longest = bytes.number();
            let columns: Vec<Vec<u8>> = (0..longest).map(|_| bytes.differences(count)).collect();
            for (place, (time, len)) in times.into_iter().zip(lengths).enumerate() {
                let data = columns.iter().take(len.into()).map(|column| column[place]).collect();
                frames.push((time, id, data));
            }
        }
        let count = bytes.number();
        let times = bytes.times(count, from);
        answers.extend(times.into_iter().map(|time| (time, bytes.signed())));
        assert_eq!(bytes.0.len(), 0, "nothing is left");
    }
    frames.sort();
    (frames, answers)
}
