//! BLF, the binary log of Vector's tools (CANoe, CANalyzer, CANape, loggers), which python-can writes as well.
//!
//! ```text
//! LOGG, sizes, when the measurement began    the header of the file
//! LOBJ container                             what follows is compressed by zlib, or not
//!   LOBJ 48 bytes, type 86, its time         an object: a frame, an error, a value, a comment ...
//!        channel, flags, length, identifier, data
//!   LOBJ ...                                 one may go on in the next container
//! LOBJ container ...
//! ```
//!
//! Vector describes the objects in the header of its library for them, `binlog_objects.h`, which comes with its tools; what is used here
//! are sizes and places that its users have published, and what python-can and Vector's own programs write.
//!
//! Of all types of object those are read that are of CAN: messages (`CAN_MESSAGE`, `CAN_MESSAGE2`), CAN FD (`CAN_FD_MESSAGE`,
//! `CAN_FD_MESSAGE_64`), error and overload frames (`CAN_ERROR`, `CAN_ERROR_EXT`, `CAN_FD_ERROR_64`, `CAN_OVERLOAD`). All others are
//! passed over. So are requests to send (`TxRq`), which the frame itself follows. Not kept are how long a frame took, and where on the bus
//! an error was seen.
//!
//! Channel 1 is `can0`, as `asc2log` and python-can name it; `canX` is a channel that has no number. A file that was cut off gives all that
//! is in it. Damage costs one container or one object, and reading goes on with the next one whose header makes sense. Sizes in the file
//! decide how much is read or skipped, never how much memory is used: that is fixed.

mod contents;
mod frame;
mod object;
mod start;
#[cfg(test)]
mod tests;
mod window;

use std::fmt::Write as _;
use std::mem;

use adsdv_oracle::candump::{Entries, Entry, LineError, ReadError, Record, Unit};

use self::contents::{Contents, LOOK, More, PADDING, broken};
use self::frame::BlfFrame;
use self::object::{BASE, Header, LOG_CONTAINER};
pub(crate) use self::start::MAGIC;
use self::window::Window;
use crate::Source;

/// No frame's object is larger than this.
const LARGEST: usize = 4096;

const LOBJ: &str = "an object, which begins with LOBJ";
const SMALLER: &str = "an object of at most 4096 bytes for a frame";
const OUTSIDE: &str = "no container within another";
const TIME: &str = "a time before the year 2262";
const WHOLE: &str = "the rest of an object, before the end of the file";

/// Reads the objects of a file.
pub(crate) struct BlfReader {
    contents: Contents,
    content: Window,
    /// What stands behind the content, once it is known.
    behind: Option<More>,
    /// So many bytes of an object that is not read are still to come.
    skip: usize,
    /// The next object is looked for, and it has been said why.
    searching: bool,
    /// What came out of the container last was no object, and it has been said.
    rubbish: bool,
    /// How many objects have been read.
    count: u64,
    /// The last frame.
    frame: BlfFrame,
    interface: String,
    /// The channel that the interface is named for.
    channel: Option<u16>,
}

/// What became of the next object.
enum BlfStep {
    Frame(i64),
    Broken(LineError),
    /// It is nothing to be told.
    Passed,
    End,
}

impl BlfReader {
    pub(crate) fn new(source: Source) -> Self {
        Self {
            contents: Contents::new(source),
            content: Window::new(),
            behind: None,
            skip: 0,
            searching: false,
            rubbish: false,
            count: 0,
            frame: BlfFrame::NONE,
            interface: String::new(),
            channel: None,
        }
    }

    /// Waits until so many bytes are there; `false` if they are not to come.
    fn fill(&mut self, count: usize) -> Result<bool, ReadError> {
        while self.content.len() < count {
            if self.behind.is_some() {
                return Ok(false);
            }
            match self.contents.read(&mut self.content) {
                Ok(More::Bytes) => {}
                Ok(behind) => self.behind = Some(behind),
                Err(source) => return Err(ReadError { unit: Unit::Object, line: self.count, source }),
            }
        }
        Ok(true)
    }

    /// Tells what stands behind the content. An object that has begun there does not go on.
    fn stopped(&mut self) -> BlfStep {
        let Some(More::Broken(error)) = self.behind.take() else { return self.end() };
        self.content.skip(self.content.len());
        (self.skip, self.searching) = (0, true);
        // What comes out of a container before its damage is found is rubbish at its end: it is one damage.
        if mem::take(&mut self.rubbish) { BlfStep::Passed } else { self.broken(error) }
    }

    fn broken(&mut self, error: LineError) -> BlfStep {
        self.count += 1;
        BlfStep::Broken(error)
    }

    /// One step on.
    fn step(&mut self) -> Result<BlfStep, ReadError> {
        if self.skip > 0 {
            return self.pass();
        }
        if !self.fill(BASE)? {
            return Ok(self.stopped());
        }
        if let Some(header) = object::header(self.content.bytes()) {
            (self.searching, self.rubbish) = (false, false);
            return self.object(header);
        }
        self.fill(LOOK)?;
        Ok(self.search())
    }

    /// Passes over what is not read.
    fn pass(&mut self) -> Result<BlfStep, ReadError> {
        if !self.fill(1)? {
            return Ok(self.stopped());
        }
        let count = self.skip.min(self.content.len());
        self.content.skip(count);
        self.skip -= count;
        Ok(BlfStep::Passed)
    }

    /// What is left at the end is padding, or an object that was cut off.
    fn end(&mut self) -> BlfStep {
        let rest = self.content.bytes();
        let told = self.skip == 0 && (rest.len() <= PADDING || self.searching);
        self.skip = 0;
        let error = broken(rest, 0, WHOLE);
        self.content.skip(self.content.len());
        if told { BlfStep::End } else { self.broken(error) }
    }

    /// Looks for the next object, behind padding or behind damage.
    fn search(&mut self) -> BlfStep {
        let bytes = self.content.bytes();
        let next = object::find(bytes);
        // So much is certain to be none, and there are more bytes than a header has: this goes on.
        let none = next.unwrap_or_else(|none| none.max(1));
        let begins = bytes.get(none..).unwrap_or_default().starts_with(object::SIGNATURE);
        if self.searching || begins && none <= PADDING {
            self.content.skip(none);
            return BlfStep::Passed;
        }
        (self.searching, self.rubbish) = (true, true);
        let error = broken(bytes, 0, LOBJ);
        // The size of the object before it may be what is damaged: the next one may have begun inside of that.
        if self.content.take_back() {
            self.content.skip(object::SIGNATURE.len());
        }
        self.broken(error)
    }

    /// Reads an object, or begins to pass over it.
    fn object(&mut self, header: Header) -> Result<BlfStep, ReadError> {
        let Header { len, size, kind } = header;
        self.fill(len.max(LOOK))?;
        if kind == LOG_CONTAINER {
            // The size of the one around it is damaged; if this one is not compressed, its objects can be read.
            let error = broken(self.content.bytes(), 0, OUTSIDE);
            self.content.skip(len);
            self.searching = true;
            return Ok(self.broken(error));
        }
        if !frame::is_frame(kind) {
            self.count += 1;
            self.skip = size;
            return Ok(BlfStep::Passed);
        }
        if size > LARGEST {
            let error = broken(self.content.bytes().get(8..).unwrap_or_default(), 8, SMALLER);
            self.content.skip(object::SIGNATURE.len());
            self.searching = true;
            return Ok(self.broken(error));
        }
        if !self.fill(size)? {
            return Ok(self.stopped());
        }
        let object = self.content.bytes().get(..size).unwrap_or_default();
        let time = object::time(object).and_then(|time| time.checked_add(self.contents.began()));
        let body = object.get(len..).unwrap_or_default();
        let step = match (frame::read(kind, body), time) {
            (Ok(Some(frame)), Some(time)) => {
                self.frame = frame;
                BlfStep::Frame(time)
            }
            (Ok(None), _) => BlfStep::Passed,
            (Ok(_), None) => BlfStep::Broken(broken(object.get(24..).unwrap_or_default(), 24, TIME)),
            (Err((at, expected)), _) => {
                BlfStep::Broken(broken(body.get(at..).unwrap_or_default(), len.saturating_add(at), expected))
            }
        };
        self.count += 1;
        self.content.skip_and_keep(size);
        Ok(step)
    }

    /// Names the interface of a channel.
    fn name(&mut self, channel: u16) {
        if self.channel != Some(channel) {
            self.channel = Some(channel);
            self.interface.clear();
            // Writing to text does not fail.
            let _ = match channel.checked_sub(1) {
                Some(number) => write!(self.interface, "can{number}"),
                None => self.interface.write_str("canX"),
            };
        }
    }
}

impl Entries for BlfReader {
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        loop {
            match self.step()? {
                BlfStep::Frame(time_ns) => {
                    self.name(self.frame.channel);
                    let BlfFrame { kind, id, direction, len, .. } = self.frame;
                    return Ok(Some(Entry::Frame(Record {
                        line: self.count,
                        time_ns,
                        interface: &self.interface,
                        kind,
                        id,
                        data: self.frame.data.get(..len).unwrap_or_default(),
                        direction,
                        terminated: true,
                    })));
                }
                BlfStep::Broken(error) => {
                    return Ok(Some(Entry::Broken(LineError { line: self.count, ..error })));
                }
                BlfStep::Passed => {}
                BlfStep::End => return Ok(None),
            }
        }
    }

    fn count(&self) -> u64 {
        self.count
    }

    fn unit(&self) -> Unit {
        Unit::Object
    }
}
