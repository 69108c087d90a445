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

/// So often a file may be compressed one over the other.
const DEPTH: usize = 4;
/// The largest window of Zstandard, which is what it needs of memory: that of `zstd --long=27`, which `zstdcat` takes as well.
const WINDOW: u64 = 1 << 27;

const GZIP: &[u8] = b"\x1f\x8b";
const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";
/// A frame to be skipped has any number from 0x184D2A50 to 0x184D2A5F before it.
const ZSTD_SKIPPED: &[u8] = b"\x2a\x4d\x18";

/// A source without its compression, and its beginning.
pub(crate) fn unpack(source: Source) -> io::Result<(Vec<u8>, Source)> {
    let (mut head, mut source) = look(source)?;
    for _ in 0..DEPTH {
        source = if head.starts_with(GZIP) {
            ahead(Box::new(MultiGzDecoder::new(source)))
        } else if is_zstd(&head) {
            ahead(Box::new(Zstd::new(BufReader::new(source))))
        } else {
            break;
        };
        (head, source) = look(source)?;
    }
    Ok((head, source))
}

fn is_zstd(head: &[u8]) -> bool {
    let skipped = matches!(head, [0x50..=0x5f, rest @ ..] if rest.starts_with(ZSTD_SKIPPED));
    head.starts_with(ZSTD) || skipped
}

/// Frames of Zstandard, one behind the other.
pub(crate) struct Zstd<R> {
    source: R,
    decoder: FrameDecoder,
    /// A frame has begun, and has not ended.
    inside: bool,
}

impl<R: Read> Zstd<R> {
    pub(crate) fn new(source: R) -> Self {
        let mut decoder = FrameDecoder::new();
        decoder.set_max_window_size(WINDOW);
        Self { source, decoder, inside: false }
    }

    /// What it reads from.
    #[cfg(feature = "mcap")]
    pub(crate) fn into_inner(self) -> R {
        self.source
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
