//! Series in little room: numbers as they change, deflated, in letters that stand in a page.
//!
//! What the page reads back is in `page/src/packed.ts`; a test has both read the same.

use std::io::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;

/// Bytes that are being put together.
#[derive(Debug, Default)]
pub(crate) struct Packer {
    bytes: Vec<u8>,
}

impl Packer {
    /// A number in as few bytes as it takes, seven bits each.
    pub(crate) fn number(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.bytes.push((number & 0x7F) as u8 | 0x80);
            number >>= 7;
        }
        self.bytes.push((number & 0x7F) as u8);
    }

    /// A number that may be negative.
    pub(crate) fn signed(&mut self, number: i64) {
        self.number(((number << 1) ^ (number >> 63)).cast_unsigned());
    }

    /// A byte as it is.
    pub(crate) fn byte(&mut self, byte: u8) {
        self.bytes.push(byte);
    }

    /// A number with the precision of a plot.
    pub(crate) fn float(&mut self, number: f32) {
        self.bytes.extend(number.to_le_bytes());
    }

    /// All of it, deflated and in base64.
    pub(crate) fn pack(self) -> String {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::new(9));
        // Writing to memory does not fail.
        let _ = encoder.write_all(&self.bytes);
        STANDARD.encode(encoder.finish().unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use flate2::read::DeflateDecoder;

    use super::*;

    fn unpack(text: &str) -> Vec<u8> {
        let mut bytes = Vec::new();
        let packed = STANDARD.decode(text).expect("base64");
        DeflateDecoder::new(&packed[..]).read_to_end(&mut bytes).expect("deflated");
        bytes
    }

    #[test]
    fn numbers_take_as_few_bytes_as_they_need() {
        let mut packer = Packer::default();
        for number in [0, 127, 128, 300, u64::MAX] {
            packer.number(number);
        }
        for number in [0, -1, 1, i64::MIN] {
            packer.signed(number);
        }
        let mut expected = vec![0, 127, 0x80, 1, 0xAC, 2];
        expected.extend([0xFF; 9].iter().chain(&[1]));
        expected.extend([0, 1, 2]);
        expected.extend([0xFF; 9].iter().chain(&[1]));
        assert_eq!(unpack(&packer.pack()), expected);
    }
}
