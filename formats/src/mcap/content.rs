//! Where records come from: the file, or a chunk of it that may be compressed.

use std::io::{self, BufRead, BufReader, Read, Take};

use flate2::Crc;
use lz4_flex::frame::FrameDecoder as Lz4;
use ruzstd::decoding::FrameDecoder;

use crate::Source;
use crate::unpack::Zstd;

/// The file, of which no more is read than a chunk has.
type File = Take<BufReader<Remembering>>;

/// A source whose failure is kept: to those who unpack what it gives it is the end of the file, so that all that came before is read.
struct Remembering {
    source: Source,
    failure: Option<io::Error>,
}

impl Read for Remembering {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        if self.failure.is_some() {
            return Ok(0);
        }
        match self.source.read(room) {
            Err(error) if error.kind() != io::ErrorKind::Interrupted => {
                self.failure = Some(error);
                Ok(0)
            }
            other => other,
        }
    }
}

/// How a chunk is compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Zstd,
    Lz4,
}

impl Compression {
    /// That of this name.
    pub(super) fn named(name: &[u8]) -> Option<Self> {
        match name {
            b"" => Some(Self::None),
            b"zstd" => Some(Self::Zstd),
            b"lz4" => Some(Self::Lz4),
            _ => None,
        }
    }
}

enum Unpacked {
    Plain(File),
    Zstd(Box<Zstd<File>>),
    Lz4(Box<Lz4<File>>),
}

/// What a chunk holds, no more than it claims, and the checksum of that.
struct Chunk {
    unpacked: Unpacked,
    left: u64,
    crc: Crc,
}

impl Read for Chunk {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        let most = usize::try_from(self.left).unwrap_or(usize::MAX).min(room.len());
        let room = room.get_mut(..most).unwrap_or_default();
        if room.is_empty() {
            return Ok(0);
        }
        let count = match &mut self.unpacked {
            Unpacked::Plain(file) => file.read(room),
            Unpacked::Zstd(decoder) => decoder.read(room),
            Unpacked::Lz4(decoder) => decoder.read(room),
        }?;
        self.crc.update(room.get(..count).unwrap_or_default());
        self.left = self.left.saturating_sub(count as u64);
        Ok(count)
    }
}

/// Where records come from.
pub(super) struct Content {
    place: Place,
    /// What unpacked the chunk before: one does for all of them.
    decoder: Option<Box<FrameDecoder>>,
}

enum Place {
    File(File),
    /// A chunk, and what of its record stands behind what it holds.
    Chunk(BufReader<Chunk>, u64),
    /// Between the two.
    Nowhere,
}

impl Content {
    pub(super) fn new(source: Source) -> Self {
        let source = Remembering { source, failure: None };
        let file = BufReader::with_capacity(128 * 1024, source).take(u64::MAX);
        Self { place: Place::File(file), decoder: None }
    }

    pub(super) const fn is_chunk(&self) -> bool {
        matches!(self.place, Place::Chunk(..))
    }

    /// Goes into a chunk, which has so many bytes in the file and claims to have so many unpacked; behind it are others of its record.
    pub(super) fn enter(&mut self, compression: Compression, packed: u64, unpacked: u64, behind: u64) {
        let mut file = match std::mem::replace(&mut self.place, Place::Nowhere) {
            Place::File(file) => file,
            other => {
                self.place = other;
                return;
            }
        };
        file.set_limit(packed);
        let (packed, left) = match compression {
            Compression::None => (Unpacked::Plain(file), packed),
            Compression::Zstd => (Unpacked::Zstd(Box::new(Zstd::with(file, self.decoder.take()))), unpacked),
            Compression::Lz4 => (Unpacked::Lz4(Box::new(Lz4::new(file))), unpacked),
        };
        let chunk = Chunk { unpacked: packed, left, crc: Crc::new() };
        self.place = Place::Chunk(BufReader::with_capacity(64 * 1024, chunk), behind);
    }

    /// Leaves a chunk, whatever of it was read: the checksum of what was.
    pub(super) fn leave(&mut self) -> io::Result<u32> {
        let (chunk, behind) = match std::mem::replace(&mut self.place, Place::Nowhere) {
            Place::Chunk(chunk, behind) => (chunk.into_inner(), behind),
            other => {
                self.place = other;
                return Ok(0);
            }
        };
        let mut file = match chunk.unpacked {
            Unpacked::Plain(file) => file,
            Unpacked::Zstd(decoder) => {
                let (file, decoder) = decoder.into_parts();
                self.decoder = Some(decoder);
                file
            }
            Unpacked::Lz4(decoder) => decoder.into_inner(),
        };
        let rest = file.limit().saturating_add(behind);
        file.set_limit(rest);
        let skipped = io::copy(&mut file, &mut io::sink());
        file.set_limit(u64::MAX);
        self.place = Place::File(file);
        skipped.map(|_| chunk.crc.sum())
    }

    /// Why the source failed, if it did.
    pub(super) fn failure(&mut self) -> Option<io::Error> {
        match &mut self.place {
            Place::File(file) => file.get_mut().get_mut().failure.take(),
            Place::Chunk(..) | Place::Nowhere => None,
        }
    }

    /// Puts up to so many bytes into `room`, in place of what is there: fewer where they end.
    pub(super) fn take(&mut self, room: &mut Vec<u8>, count: usize) -> io::Result<()> {
        room.clear();
        self.each_piece(count as u64, |piece| room.extend_from_slice(piece)).map(drop)
    }

    /// Passes over so many bytes; whether there were as many.
    pub(super) fn skip(&mut self, count: u64) -> io::Result<bool> {
        Ok(self.each_piece(count, |_| {})? == count)
    }

    /// Goes through up to so many bytes; how many there were.
    fn each_piece(&mut self, count: u64, take: impl FnMut(&[u8])) -> io::Result<u64> {
        match &mut self.place {
            Place::File(file) => each_piece(file, count, take),
            Place::Chunk(chunk, _) => each_piece(chunk, count, take),
            Place::Nowhere => Ok(0),
        }
    }
}

/// As a record of a few bytes is read fastest: out of what is buffered.
fn each_piece(source: &mut impl BufRead, count: u64, mut take: impl FnMut(&[u8])) -> io::Result<u64> {
    let mut left = count;
    while left > 0 {
        let buffered = match source.fill_buf() {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            other => other?,
        };
        let len = usize::try_from(left).unwrap_or(usize::MAX).min(buffered.len());
        if len == 0 {
            break;
        }
        take(buffered.get(..len).unwrap_or_default());
        source.consume(len);
        left -= len as u64;
    }
    Ok(count - left)
}
