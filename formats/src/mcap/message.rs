//! A message: the fields of its layout, as CDR of ROS 2 or the encoding of ROS 1 has them, and the frame that they make.

use adsdv_oracle::candump::FrameKind;

use super::layout::{Field, Layout, Many, Role};

const REPRESENTATION: &str = "a message in plain CDR, of either byte order";
const LONGER: &str = "all fields of a message of its type";
const STAMP: &str = "a time with less than 1000000000 nanoseconds";
const STANDARD_ID: &str = "an identifier up to 7FF, or the mark of an extended one";
const AT_MOST: &str = "no more data than a frame of its kind holds";

/// Marks in the identifier where the type has no fields for them, as SocketCAN has them.
const MARK_EXTENDED: u32 = 1 << 31;
const MARK_REMOTE: u32 = 1 << 30;
const MARK_ERROR: u32 = 1 << 29;
const ID: u32 = 0x1FFF_FFFF;

/// How messages are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Cdr,
    Ros1,
}

/// Where a message cannot be read, and what should stand there.
pub(super) type MessageFlaw = (usize, &'static str);

/// What was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct McapFrame {
    /// The time in its header; `None` where that is not set.
    pub(super) time: Option<i64>,
    pub(super) kind: FrameKind,
    pub(super) id: u32,
    pub(super) data: [u8; 64],
    pub(super) len: usize,
}

impl McapFrame {
    /// None so far.
    pub(super) const NONE: Self =
        Self { time: None, kind: FrameKind::Standard, id: 0, data: [0; 64], len: 0 };
}

/// Reads a message.
pub(super) fn read(layout: &Layout, encoding: Encoding, message: &[u8]) -> Result<McapFrame, MessageFlaw> {
    let mut cursor = CdrCursor::new(encoding, message)?;
    let mut found = FrameFound { fd: layout.fd, ..FrameFound::default() };
    for field in &layout.fields {
        match *field {
            Field::Header => {
                if encoding == Encoding::Ros1 {
                    cursor.number(4)?;
                }
                found.time = cursor.time()?;
                cursor.text()?;
            }
            Field::Time => found.time = found.time.or(cursor.time()?),
            Field::Text => cursor.text()?,
            Field::Number { size, many: Many::One, role } => {
                let number = cursor.number(size)?;
                if role == Role::Id {
                    found.id_at = cursor.at - size;
                }
                found.take(role, number);
            }
            Field::Number { size, many, role } => {
                let count = match many {
                    Many::Fixed(count) => count,
                    _ => cursor.count()?,
                };
                let bytes = cursor.array(size, count)?;
                if role == Role::Data {
                    found.data = bytes;
                    found.data_at = cursor.at - bytes.len();
                    found.counted = many == Many::Counted;
                }
            }
        }
    }
    found.frame()
}

/// What the fields say.
#[derive(Clone, Copy, Debug, Default)]
struct FrameFound<'a> {
    time: Option<i64>,
    id: u32,
    /// Where the identifier stands, and where the data.
    id_at: usize,
    data_at: usize,
    remote: bool,
    extended: bool,
    error: bool,
    fd: bool,
    rate_switch: bool,
    error_state: bool,
    len: Option<usize>,
    data: &'a [u8],
    counted: bool,
}

impl FrameFound<'_> {
    fn take(&mut self, role: Role, number: u64) {
        let is = number != 0;
        match role {
            Role::Id => {
                let id = u32::try_from(number).unwrap_or(u32::MAX);
                self.id = id & ID;
                self.extended |= id & MARK_EXTENDED != 0;
                self.remote |= id & MARK_REMOTE != 0;
                self.error |= id & MARK_ERROR != 0;
            }
            Role::Remote => self.remote |= is,
            Role::Extended => self.extended |= is,
            Role::Error => self.error |= is,
            Role::Fd => self.fd |= is,
            Role::RateSwitch => self.rate_switch = is,
            Role::ErrorState => self.error_state = is,
            Role::Len => self.len = usize::try_from(number).ok(),
            Role::Data | Role::Other => {}
        }
    }

    fn frame(self) -> Result<McapFrame, MessageFlaw> {
        // Of an array whose size is fixed a number says how much counts; where it is a code, 9 to 15 stand for all 8.
        let len = match self.len {
            Some(len) if !self.counted && !self.fd && len <= 15 => len.min(8),
            Some(len) if !self.counted || len < self.data.len() => len,
            _ => self.data.len(),
        };
        let extended = self.extended;
        let kind = if self.error {
            FrameKind::Error
        } else if self.remote {
            FrameKind::Remote { extended, len: u8::try_from(self.len.unwrap_or(len).min(8)).unwrap_or(8) }
        } else if self.fd {
            FrameKind::Fd { extended, flags: u8::from(self.rate_switch) | u8::from(self.error_state) << 1 }
        } else if extended {
            FrameKind::Extended
        } else {
            FrameKind::Standard
        };
        let (len, most) = match kind {
            FrameKind::Remote { .. } => (0, 0),
            FrameKind::Fd { .. } => (len, 64),
            _ => (len, 8),
        };
        if self.id > kind.max_id() {
            return Err((self.id_at, STANDARD_ID));
        }
        let from = self.data.get(..len).filter(|_| len <= most).ok_or((self.data_at, AT_MOST))?;
        let mut data = [0; 64];
        for (place, byte) in data.iter_mut().zip(from) {
            *place = *byte;
        }
        Ok(McapFrame { time: self.time, kind, id: self.id, data, len })
    }
}

/// Takes numbers out of a message.
struct CdrCursor<'a> {
    message: &'a [u8],
    at: usize,
    /// What numbers are aligned from; nothing is in ROS 1.
    origin: Option<usize>,
    /// What they are aligned to, at most.
    alignment: usize,
    big_endian: bool,
}

impl<'a> CdrCursor<'a> {
    fn new(encoding: Encoding, message: &'a [u8]) -> Result<Self, MessageFlaw> {
        if encoding == Encoding::Ros1 {
            return Ok(Self { message, at: 0, origin: None, alignment: 1, big_endian: false });
        }
        let (big_endian, alignment) = match message {
            [0, 0, _, _, ..] => (true, 8),
            [0, 1, _, _, ..] => (false, 8),
            [0, 6, _, _, ..] => (true, 4),
            [0, 7, _, _, ..] => (false, 4),
            _ => return Err((0, REPRESENTATION)),
        };
        Ok(Self { message, at: 4, origin: Some(4), alignment, big_endian })
    }

    fn align(&mut self, size: usize) {
        if let Some(origin) = self.origin {
            let size = size.min(self.alignment);
            self.at = (self.at - origin).next_multiple_of(size) + origin;
        }
    }

    fn bytes(&mut self, count: usize) -> Result<&'a [u8], MessageFlaw> {
        let rest = self.message.get(self.at..).unwrap_or_default();
        let bytes = rest.get(..count).ok_or((self.at.min(self.message.len()), LONGER))?;
        self.at += count;
        Ok(bytes)
    }

    /// A number of 1 to 8 bytes.
    fn number(&mut self, size: usize) -> Result<u64, MessageFlaw> {
        self.align(size);
        let bytes = self.bytes(size)?;
        let fold = |number: u64, byte: &u8| number << 8 | u64::from(*byte);
        Ok(if self.big_endian { bytes.iter().fold(0, fold) } else { bytes.iter().rev().fold(0, fold) })
    }

    fn count(&mut self) -> Result<usize, MessageFlaw> {
        let at = self.at;
        usize::try_from(self.number(4)?).map_err(|_| (at, LONGER))
    }

    fn array(&mut self, size: usize, count: usize) -> Result<&'a [u8], MessageFlaw> {
        if count > 0 {
            self.align(size);
        }
        self.bytes(count.checked_mul(size).ok_or((self.at, LONGER))?)
    }

    fn text(&mut self) -> Result<(), MessageFlaw> {
        let count = self.count()?;
        self.bytes(count).map(|_| ())
    }

    /// A time after 1970; `None` if it is none.
    fn time(&mut self) -> Result<Option<i64>, MessageFlaw> {
        let (seconds, nanos) = (self.number(4)?, self.number(4)?);
        if nanos >= 1_000_000_000 {
            return Err((self.at - 4, STAMP));
        }
        // In ROS 2 seconds have a sign; a time that is so late that it has one here is none.
        let seconds = i32::try_from(seconds).unwrap_or(0);
        let nanos = i64::try_from(nanos).unwrap_or(0);
        Ok(Some(i64::from(seconds) * 1_000_000_000 + nanos).filter(|_| seconds > 0 || nanos > 0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FD: &str = "uint32 id\nbool is_error\nbool is_rtr\nuint8[<=64] data";

    fn fd(id: u32, error: u8, remote: u8, count: u8) -> Result<McapFrame, MessageFlaw> {
        let layout = Layout::of("can/msg/FdFrame", "ros2msg", FD.as_bytes()).expect("it is a frame");
        let mut message = vec![0, 1, 0, 0];
        message.extend(id.to_le_bytes());
        message.extend([error, remote, 0, 0, count, 0, 0, 0]);
        message.extend(vec![7; usize::from(count)]);
        read(&layout, Encoding::Cdr, &message)
    }

    #[test]
    fn a_frame_has_no_more_data_than_its_kind_holds() {
        assert_eq!(fd(1, 0, 0, 64).map(|frame| frame.len), Ok(64));
        assert_eq!(fd(1, 0, 0, 65).map(|frame| frame.len), Err((16, AT_MOST)));
        assert_eq!(fd(1, 1, 0, 8).map(|frame| frame.kind), Ok(FrameKind::Error));
        assert_eq!(fd(1, 1, 0, 9).map(|frame| frame.len), Err((16, AT_MOST)));
        assert_eq!(fd(1, 0, 1, 9).map(|frame| frame.len), Ok(0));
    }

    #[test]
    fn an_identifier_may_have_the_marks_of_socketcan() {
        let kind = |id| fd(id, 0, 0, 8).map(|frame| (frame.kind, frame.id));
        assert_eq!(kind(0x9234_5678), Ok((FrameKind::Fd { extended: true, flags: 0 }, 0x1234_5678)));
        assert_eq!(kind(0x2000_0004), Ok((FrameKind::Error, 4)));
        let standard = Layout::of("can_msgs/Frame", "", b"").expect("it is known");
        let mut message = vec![0; 20];
        message[17] = 8;
        message.extend([0; 12]);
        assert_eq!(read(&standard, Encoding::Ros1, &message), Err((16, STANDARD_ID)));
    }
}
