//! What the containers hold, as one stream of bytes.

use std::io;

use adsdv_oracle::candump::{LineError, Unit};
use flate2::{Decompress, FlushDecompress, Status};

use super::object::{self, BASE, LOG_CONTAINER};
use super::start;
use super::window::Window;
use crate::Source;
use crate::bytes::{u16_at, u32_at};

/// A container's own header: the method 2, - 6, the size of what it unpacks to 4, - 4. That size is not looked at.
const CONTAINER: usize = 16;
const STORED: u16 = 0;
const DEFLATED: u16 = 2;
/// The longest header of a file that makes sense.
const LONGEST_HEADER: u32 = 4096;
/// So many bytes may stand between two objects.
pub(super) const PADDING: usize = 4;
/// What is decided by the next bytes, or shows them, waits for so many: the same comes of a file that is read in other pieces.
pub(super) const LOOK: usize = 64;
/// What goes into zlib at a time, and the most that comes out. What such a piece gives before it turns out to be damaged is lost, and it is
/// the same piece however the file is read.
const PIECE: usize = 512;
const UNPACKED: usize = 32 * 1024;

const LOGG: &str = "the header of a file, of 72 bytes or more";
const LOBJ: &str = "an object, which begins with LOBJ";
const METHOD: &str = "a container without compression, or with that of zlib";
const WHOLE_FILE: &str = "the rest of a container, before the end of the file";
const WHOLE: &str = "the rest of what is compressed, before the end of its container";
const ZLIB: &str = "data that zlib has compressed";

/// What has come of a file.
pub(super) enum More {
    /// Some bytes.
    Bytes,
    /// Something that cannot be read. What comes then does not continue what came before.
    Broken(LineError),
    /// Nothing, from now on.
    End,
}

/// The objects that a file has, out of their containers.
pub(super) struct Contents {
    source: Source,
    file: Window,
    state: State,
    inflate: Decompress,
    /// When the measurement began.
    began: i64,
}

#[derive(Clone, Copy)]
enum State {
    /// Before the header of the file.
    Header,
    /// Between two objects of the file; whether it has been said that there is something wrong.
    Between { said: bool },
    /// In something that is not compressed, of which so many bytes are left.
    Stored(usize),
    /// In something that is compressed, of which so many bytes are left.
    Deflated(usize),
    /// Behind all of it.
    End,
}

impl Contents {
    pub(super) fn new(source: Source) -> Self {
        Self { source, file: Window::new(), state: State::Header, inflate: Decompress::new(true), began: 0 }
    }

    /// When the measurement began; known once something has been read.
    pub(super) const fn began(&self) -> i64 {
        self.began
    }

    /// Puts what comes next behind what is there.
    pub(super) fn read(&mut self, content: &mut Window) -> io::Result<More> {
        loop {
            let more = match self.state {
                State::Header => self.header()?,
                State::Between { said } => self.begin(said)?,
                State::Stored(left) => self.stored(left, content)?,
                State::Deflated(left) => self.deflated(left, content)?,
                State::End => Some(More::End),
            };
            if let Some(more) = more {
                return Ok(more);
            }
        }
    }

    fn header(&mut self) -> io::Result<Option<More>> {
        self.file.fill(&mut self.source, start::LEN)?;
        self.began = start::began(self.file.bytes());
        let len = u32_at(self.file.bytes(), 4).filter(|len| *len <= LONGEST_HEADER);
        let len = len.and_then(|len| usize::try_from(len).ok()).filter(|len| *len >= start::LEN);
        if let Some(len) = len
            && self.file.fill(&mut self.source, len)?
        {
            self.file.skip(len);
            self.state = State::Between { said: false };
            return Ok(None);
        }
        // Of a file whose header makes no sense everything is looked through.
        self.file.skip(start::MAGIC.len());
        self.state = State::Between { said: true };
        Ok(Some(More::Broken(broken(self.file.bytes(), start::MAGIC.len(), LOGG))))
    }

    /// Begins the next object of the file.
    fn begin(&mut self, said: bool) -> io::Result<Option<More>> {
        let whole = self.file.fill(&mut self.source, LOOK)?;
        if let Some(header) = object::header(self.file.bytes()) {
            let whole = self.file.fill(&mut self.source, header.len + LOOK)?;
            return Ok(self.open(header, whole));
        }
        let file = self.file.bytes();
        let next = object::find(file);
        let here = next.unwrap_or(file.len());
        if here > PADDING && !said {
            self.state = State::Between { said: true };
            return Ok(Some(More::Broken(broken(file, 0, LOBJ))));
        }
        if next.is_err() && !whole {
            self.state = State::End;
        }
        self.file.skip(next.unwrap_or_else(|none| none));
        Ok(None)
    }

    /// Goes into an object of the file.
    fn open(&mut self, header: object::Header, whole: bool) -> Option<More> {
        if header.kind != LOG_CONTAINER {
            // An object as they are in containers.
            self.state = State::Stored(header.size);
            return None;
        }
        let own = self.file.bytes().get(header.len..).unwrap_or_default();
        let method = u16_at(own, 0).filter(|_| own.len() >= CONTAINER);
        let left = header.size.checked_sub(header.len + CONTAINER);
        let state = match (method, left) {
            (Some(STORED), Some(left)) => Ok(State::Stored(left)),
            (Some(DEFLATED), Some(left)) => {
                self.inflate.reset(true);
                Ok(State::Deflated(left))
            }
            _ => Err(broken(own, header.len, if whole { METHOD } else { WHOLE_FILE })),
        };
        match state {
            Ok(state) => {
                self.state = state;
                self.file.skip(header.len + CONTAINER);
                None
            }
            Err(error) => {
                self.state = State::Between { said: true };
                self.file.skip(object::SIGNATURE.len());
                Some(More::Broken(error))
            }
        }
    }

    fn stored(&mut self, left: usize, content: &mut Window) -> io::Result<Option<More>> {
        if left == 0 {
            self.state = State::Between { said: false };
            return Ok(None);
        }
        if !self.file.fill(&mut self.source, 1)? {
            self.state = State::End;
            return Ok(Some(More::Broken(broken(&[], 0, WHOLE_FILE))));
        }
        let room = content.room();
        let count = left.min(room.len()).min(self.file.len());
        for (place, byte) in room.iter_mut().zip(self.file.bytes()).take(count) {
            *place = *byte;
        }
        content.add(count);
        self.file.skip(count);
        self.state = State::Stored(left - count);
        Ok(Some(More::Bytes))
    }

    fn deflated(&mut self, left: usize, content: &mut Window) -> io::Result<Option<More>> {
        self.file.fill(&mut self.source, left.min(PIECE))?;
        let packed = self.file.bytes();
        let packed = packed.get(..left.min(PIECE)).unwrap_or(packed);
        if packed.is_empty() {
            let any = left == 0;
            let expected = if any { WHOLE } else { WHOLE_FILE };
            self.state = if any { State::Between { said: true } } else { State::End };
            return Ok(Some(More::Broken(broken(&[], self.inflated(), expected))));
        }
        let (consumed, made) = (self.inflate.total_in(), self.inflate.total_out());
        let room = content.room().get_mut(..UNPACKED).unwrap_or_default();
        let status = self.inflate.decompress(packed, room, FlushDecompress::None);
        let count = |now: u64, before: u64| usize::try_from(now.saturating_sub(before)).unwrap_or(0);
        let consumed = count(self.inflate.total_in(), consumed);
        let made = count(self.inflate.total_out(), made);
        self.file.skip(consumed);
        content.add(made);
        self.state = match status {
            Ok(Status::StreamEnd) => State::Between { said: false },
            Ok(_) if consumed > 0 || made > 0 => State::Deflated(left.saturating_sub(consumed)),
            // The size of what is damaged need not be right: the next container is looked for from here on.
            Ok(_) | Err(_) => {
                self.state = State::Between { said: true };
                self.file.fill(&mut self.source, LOOK)?;
                return Ok(Some(More::Broken(broken(self.file.bytes(), self.inflated(), ZLIB))));
            }
        };
        Ok((made > 0).then_some(More::Bytes))
    }

    /// Where in its container the reading of what is compressed has come to.
    fn inflated(&self) -> usize {
        usize::try_from(self.inflate.total_in()).unwrap_or(usize::MAX).saturating_add(BASE + CONTAINER)
    }
}

/// These bytes were found at a place in an object whose number is for the reader to say.
pub(super) fn broken(found: &[u8], at: usize, expected: &'static str) -> LineError {
    LineError { column: at.saturating_add(1), ..LineError::new(Unit::Object, 0, found, 0, expected) }
}
