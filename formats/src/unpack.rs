//! Compression around anything: gzip (RFC 1952) and Zstandard (RFC 8878), of several members or frames as of one.
//!
//! It is unpacked as it is read, in memory that does not depend on what a file claims of itself: a few bytes that stand for gigabytes take
//! time, and no more.

use std::io::{self, BufReader, Read};

use flate2::read::MultiGzDecoder;
use ruzstd::decoding::errors::{FrameDecoderError, ReadFrameHeaderError};
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};

use crate::Source;
use crate::ahead::ahead;
use crate::head::look;
use crate::utf16;
use crate::watch::Watch;

/// So often a file may be compressed one over the other.
const DEPTH: usize = 4;
/// The largest window of Zstandard, which is what it needs of memory: that of `zstd --long=27`, which `zstdcat` takes as well.
const WINDOW: u64 = 1 << 27;

const GZIP: &[u8] = b"\x1f\x8b";
const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";
/// A frame to be skipped has any number from 0x184D2A50 to 0x184D2A5F before it.
const ZSTD_SKIPPED: &[u8] = b"\x2a\x4d\x18";

/// A source without its compression, text of it in UTF-8, and its beginning. The watch is asked while what unpacks it gives nothing.
pub(crate) fn unpack(source: Source, watch: Option<&Watch>) -> io::Result<(Vec<u8>, Source)> {
    let (mut head, mut source) = look(source)?;
    for _ in 0..DEPTH {
        source = if head.starts_with(GZIP) {
            ahead(Box::new(MultiGzDecoder::new(source)), watch)
        } else if is_zstd(&head) {
            ahead(Box::new(Zstd::new(BufReader::new(source))), watch)
        } else {
            break;
        };
        (head, source) = look(source)?;
    }
    match utf16::narrow(&head, source) {
        Ok(narrow) => look(narrow),
        Err(source) => Ok((head, source)),
    }
}

fn is_zstd(head: &[u8]) -> bool {
    let skipped = matches!(head, [0x50..=0x5f, rest @ ..] if rest.starts_with(ZSTD_SKIPPED));
    head.starts_with(ZSTD) || skipped
}

/// Frames of Zstandard, one behind the other.
pub(crate) struct Zstd<R> {
    source: R,
    decoder: Box<FrameDecoder>,
    /// A frame has begun, and has not ended.
    inside: bool,
}

impl<R: Read> Zstd<R> {
    pub(crate) fn new(source: R) -> Self {
        let mut decoder = FrameDecoder::new();
        decoder.set_max_window_size(WINDOW);
        Self { source, decoder: Box::new(decoder), inside: false }
    }

    /// The same with what another has left: to fetch that memory anew for each chunk takes a tenth of the time.
    #[cfg(feature = "mcap")]
    pub(crate) fn with(source: R, decoder: Option<Box<FrameDecoder>>) -> Self {
        match decoder {
            Some(decoder) => Self { source, decoder, inside: false },
            None => Self::new(source),
        }
    }

    /// What it reads from, and what it leaves for another.
    #[cfg(feature = "mcap")]
    pub(crate) fn into_parts(self) -> (R, Box<FrameDecoder>) {
        (self.source, self.decoder)
    }

    /// Begins the next frame; `false` at the end of the source.
    fn begin(&mut self) -> io::Result<bool> {
        loop {
            // The decoder takes the end of the source for a damaged header.
            let mut first = Vec::with_capacity(1);
            if self.source.by_ref().take(1).read_to_end(&mut first)? == 0 {
                return Ok(false);
            }
            match self.decoder.reset(first.as_slice().chain(&mut self.source)) {
                Ok(()) => {
                    self.inside = true;
                    return Ok(true);
                }
                Err(FrameDecoderError::ReadFrameHeaderError(ReadFrameHeaderError::SkipFrame {
                    length,
                    ..
                })) => {
                    let length = u64::from(length);
                    if io::copy(&mut self.source.by_ref().take(length), &mut io::sink())? < length {
                        return Err(io::ErrorKind::UnexpectedEof.into());
                    }
                }
                Err(error) => return Err(damaged(&error)),
            }
        }
    }
}

fn damaged(error: &dyn std::error::Error) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("damaged Zstandard: {error}"))
}

impl<R: Read> Read for Zstd<R> {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        loop {
            if !self.inside && !self.begin()? {
                return Ok(0);
            }
            if self.decoder.can_collect() > 0 {
                return self.decoder.read(room);
            }
            if self.decoder.is_finished() {
                let (said, is) =
                    (self.decoder.get_checksum_from_data(), self.decoder.get_calculated_checksum());
                self.inside = false;
                if said.is_some() && said != is {
                    return Err(damaged(&io::Error::other("the checksum is another")));
                }
                continue;
            }
            let step = BlockDecodingStrategy::UptoBlocks(1);
            self.decoder.decode_blocks(&mut self.source, step).map_err(|error| damaged(&error))?;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Write as _};

    use flate2::Compression;
    use flate2::write::GzEncoder;
    use ruzstd::encoding::{CompressionLevel, compress_to_vec};

    use super::*;

    fn text() -> Vec<u8> {
        (0..20_000).flat_map(|n| format!("({n}.000000) can0 520#{:08X}\n", n * 7).into_bytes()).collect()
    }

    fn gzip(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(bytes).expect("memory takes it");
        encoder.finish().expect("memory takes it")
    }

    fn zstd(bytes: &[u8]) -> Vec<u8> {
        compress_to_vec(bytes, CompressionLevel::Fastest)
    }

    /// What is unpacked of it, and how it ends.
    fn unpacked(bytes: Vec<u8>) -> (Vec<u8>, io::Result<()>) {
        let mut all = Vec::new();
        let end = unpack(Box::new(Cursor::new(bytes)), None)
            .and_then(|(_, mut source)| source.read_to_end(&mut all));
        (all, end.map(drop))
    }

    #[test]
    fn what_is_compressed_once_or_twice_is_read_as_if_it_were_not() {
        let text = text();
        let skipped = [&b"\x52\x2a\x4d\x18\x03\0\0\0abc"[..], &zstd(&text)].concat();
        let (half, rest) = text.split_at(text.len() / 2);
        let cases = [
            ("not at all", text.clone()),
            ("gzip", gzip(&text)),
            ("zstd", zstd(&text)),
            ("gzip of zstd", gzip(&zstd(&text))),
            ("zstd of gzip", zstd(&gzip(&text))),
            ("two members", [gzip(half), gzip(rest)].concat()),
            ("two frames", [zstd(half), zstd(rest)].concat()),
            ("a frame to be skipped", skipped),
        ];
        for (how, bytes) in cases {
            let (all, end) = unpacked(bytes);
            assert!(end.is_ok() && all == text, "{how}: {} bytes, {end:?}", all.len());
        }
    }

    #[test]
    fn what_is_cut_off_is_read_up_to_there_and_the_end_says_so() {
        let text = text();
        for packed in [gzip(&text), zstd(&text)] {
            let mut most = 0;
            for len in [0, 1, 2, 3, 5, 9, 17, packed.len() / 3, packed.len() / 2, packed.len() - 1] {
                let (all, end) = unpacked(packed[..len].to_vec());
                // So few bytes are no compression yet.
                assert!(len < 4 || end.is_err(), "{len}");
                assert!(len < 4 || text.starts_with(&all), "{len}: {} bytes", all.len());
                most = most.max(all.len());
            }
            assert!(most > text.len() / 4, "{most}");
        }
    }

    #[test]
    fn a_bit_that_is_turned_round_is_found() {
        let text = text();
        for packed in [gzip(&text), zstd(&text)] {
            for place in (20..packed.len()).step_by(packed.len() / 50) {
                let mut packed = packed.clone();
                packed[place] ^= 0x10;
                let (all, end) = unpacked(packed);
                assert!(end.is_err() || all == text, "{place}: it is another text, and nobody knows");
            }
        }
    }

    #[test]
    fn more_compressions_than_anybody_makes_are_not_undone() {
        let often = (0..=DEPTH).fold(b"x".to_vec(), |bytes, _| gzip(&bytes));
        assert!(unpacked(often).0.starts_with(GZIP));
    }

    #[test]
    fn a_file_that_claims_much_and_has_little_is_no_memory() {
        // A frame header with a window of 2^41 bytes.
        let claims = [ZSTD, &[0x00, 0xF8, 0x01, 0, 0, 0]].concat();
        let (all, end) = unpacked(claims);
        assert!(all.is_empty() && end.is_err_and(|error| error.kind() == io::ErrorKind::InvalidData));
    }
}
