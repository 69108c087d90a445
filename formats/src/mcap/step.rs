//! The records, one after the other: into chunks and out of them, and past whatever is damaged.

use std::io;

use adsdv_oracle::candump::{LineError, ReadError, Unit};

use super::McapReader;
use super::content::Compression;
use super::message;
use crate::bytes::{u16_at, u32_at, u64_at};

/// How a file begins.
const MAGIC: usize = 8;
/// The kind and the length of a record.
const HEAD: usize = 9;
/// What of a record is looked at; no schema or message of a frame is longer.
const LARGEST: usize = 64 * 1024;
/// What stands before a message.
const MESSAGE: usize = 22;
/// What stands before the name of a chunk's compression, that name, and how long the chunk is.
const CHUNK: usize = 28;

const END_OF_FILE: &str = "the rest of the file, with the mark of its end";
const END_OF_CHUNK: &str = "the rest of a record, before the end of its chunk";
const KIND: &str = "a record of a kind that there is";
const OUTSIDE: &str = "no chunk within another";
const COMPRESSION: &str = "a chunk compressed by zstd or lz4, or not at all";
const UNPACKED: &str = "a chunk that can be unpacked";
const CHECKSUM: &str = "a chunk with the checksum that it claims";
const TIME: &str = "a message with a time before the year 2262";
const CHANNEL: &str = "a message of a channel that was told of before it";

/// What became of the next record.
pub(super) enum McapStep {
    Frame { channel: u16, time: i64 },
    Broken(LineError),
    Passed,
    End,
}

impl McapReader {
    fn step(&mut self) -> io::Result<McapStep> {
        if !self.begun {
            self.begun = true;
            self.content.skip(MAGIC as u64)?;
        }
        if self.ended {
            return Ok(McapStep::End);
        }
        self.content.take(&mut self.body, HEAD)?;
        let (Some(&kind), Some(len)) = (self.body.first(), u64_at(&self.body, 1)) else {
            return self.short();
        };
        self.count += 1;
        match kind {
            0 if self.content.is_chunk() => self.leave(broken(&self.body, 0, KIND)),
            0 => {
                self.ended = true;
                Ok(McapStep::Broken(broken(&self.body, 0, KIND)))
            }
            0x03..=0x05 => self.read(kind, len),
            0x06 if self.content.is_chunk() => self.leave(broken(&self.body, 0, OUTSIDE)),
            0x06 => self.enter(len),
            // The footer, or the end of the data before it.
            0x02 | 0x0F if !self.content.is_chunk() => {
                self.ended = true;
                Ok(McapStep::End)
            }
            _ => {
                if self.content.skip(len)? {
                    return Ok(McapStep::Passed);
                }
                self.short()
            }
        }
    }

    /// There was less than a record: a chunk has ended, or the file.
    fn short(&mut self) -> io::Result<McapStep> {
        if !self.content.is_chunk() {
            if let Some(failure) = self.content.failure() {
                return Err(failure);
            }
            self.ended = true;
            self.count += 1;
            return Ok(McapStep::Broken(broken(&self.body, 0, END_OF_FILE)));
        }
        if !self.body.is_empty() {
            self.count += 1;
            return self.leave(broken(&self.body, 0, END_OF_CHUNK));
        }
        let sum = self.content.leave()?;
        if self.checksum == 0 || self.checksum == sum {
            return Ok(McapStep::Passed);
        }
        self.count += 1;
        Ok(McapStep::Broken(broken(&sum.to_le_bytes(), 0, CHECKSUM)))
    }

    /// Leaves a chunk in which something is wrong.
    fn leave(&mut self, error: LineError) -> io::Result<McapStep> {
        self.content.leave()?;
        Ok(McapStep::Broken(error))
    }

    /// Goes into a chunk.
    fn enter(&mut self, len: u64) -> io::Result<McapStep> {
        let begin = CHUNK + 4;
        self.content.take(&mut self.body, begin)?;
        let named = u32_at(&self.body, CHUNK);
        let name_len = named.and_then(|len| usize::try_from(len).ok()).filter(|len| *len <= 16);
        let (unpacked, checksum) = (u64_at(&self.body, 16), u32_at(&self.body, 24));
        let Some(name_len) = name_len else {
            let error = broken(self.body.get(CHUNK..).unwrap_or_default(), CHUNK, COMPRESSION);
            self.content.skip(len.saturating_sub(self.body.len() as u64))?;
            return Ok(McapStep::Broken(error));
        };
        self.content.take(&mut self.body, name_len + 8)?;
        let compression = self.body.get(..name_len).and_then(Compression::named);
        let rest = len.checked_sub((begin + name_len + 8) as u64);
        let packed = u64_at(&self.body, name_len);
        let behind = rest.zip(packed).and_then(|(rest, packed)| rest.checked_sub(packed));
        let (Some(compression), Some(packed), Some(unpacked), Some(behind)) =
            (compression, packed, unpacked, behind)
        else {
            let error = broken(&self.body, begin, COMPRESSION);
            self.content.skip(rest.unwrap_or(0))?;
            return Ok(McapStep::Broken(error));
        };
        self.checksum = checksum.unwrap_or(0);
        self.content.enter(compression, packed, unpacked, behind);
        Ok(McapStep::Passed)
    }

    /// Reads a schema, a channel or a message.
    fn read(&mut self, kind: u8, len: u64) -> io::Result<McapStep> {
        let most = usize::try_from(len).unwrap_or(LARGEST).min(LARGEST);
        let first = if kind == 0x05 { most.min(MESSAGE) } else { most };
        self.content.take(&mut self.body, first)?;
        if self.body.len() < first {
            return self.cut();
        }
        let left = len.saturating_sub(first as u64);
        let told = match kind {
            0x03 => self.channels.schema(&self.body),
            0x04 => self.channels.channel(&self.body),
            _ => return self.message(left),
        };
        let step = match told {
            Ok(()) => McapStep::Passed,
            Err((at, found, expected)) => McapStep::Broken(broken(found, at, expected)),
        };
        if self.content.skip(left)? { Ok(step) } else { self.cut() }
    }

    /// A record that has begun, and does not end.
    fn cut(&mut self) -> io::Result<McapStep> {
        self.count -= 1;
        if self.body.is_empty() {
            self.body.push(0);
        }
        self.short()
    }

    fn message(&mut self, left: u64) -> io::Result<McapStep> {
        let (id, logged) = (u16_at(&self.body, 0), u64_at(&self.body, 6));
        let (Some(id), Some(logged)) = (id, logged) else { return self.unknown(None, left) };
        let Some(channel) = self.channels.get(id) else {
            if !self.channels.has(id) {
                return self.unknown(Some(id), left);
            }
            return if self.content.skip(left)? { Ok(McapStep::Passed) } else { self.cut() };
        };
        let most = usize::try_from(left).unwrap_or(LARGEST).min(LARGEST);
        self.content.take(&mut self.body, most)?;
        if self.body.len() < most {
            return self.cut();
        }
        let read = message::read(&channel.layout, channel.encoding, &self.body);
        let side =
            channel.direction.filter(|_| self.channels.may_echo()).map(|direction| (channel.bus, direction));
        if !self.content.skip(left.saturating_sub(most as u64))? {
            return self.cut();
        }
        Ok(match read {
            Ok(frame) => match frame.time.or(i64::try_from(logged).ok()) {
                Some(time) if side.is_some_and(|(bus, side)| self.echoes.has(bus, side, time, &frame)) => {
                    McapStep::Passed
                }
                Some(time) => {
                    self.frame = frame;
                    McapStep::Frame { channel: id, time }
                }
                None => McapStep::Broken(broken(&logged.to_le_bytes(), 6, TIME)),
            },
            Err((at, expected)) => {
                let found = self.body.get(at..).unwrap_or_default();
                McapStep::Broken(broken(found, at.saturating_add(MESSAGE), expected))
            }
        })
    }

    /// A message that cannot be told what it is of; a recording with more of these is not reported again.
    fn unknown(&mut self, channel: Option<u16>, left: u64) -> io::Result<McapStep> {
        let error = broken(&self.body, 0, CHANNEL);
        if let Some(id) = channel {
            self.channels.pass_over(id);
        }
        if self.content.skip(left)? { Ok(McapStep::Broken(error)) } else { self.cut() }
    }

    /// The next step, after whatever cannot be unpacked.
    pub(super) fn sure_step(&mut self) -> Result<McapStep, ReadError> {
        let step = match self.step() {
            // Only what unpacks a chunk fails so; the source says why it did when it is asked.
            Err(_) if self.content.is_chunk() => {
                self.count += 1;
                self.leave(broken(&[], 0, UNPACKED))
            }
            other => other,
        };
        step.map_err(|source| ReadError { unit: Unit::Record, line: self.count, source })
    }
}

/// These bytes were found at a place in a record whose number is for the reader to say.
fn broken(found: &[u8], at: usize, expected: &'static str) -> LineError {
    LineError { column: at.saturating_add(1), ..LineError::new(Unit::Record, 0, found, 0, expected) }
}
