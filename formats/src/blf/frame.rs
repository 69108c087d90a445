//! The objects that are frames.

use adsdv_oracle::candump::{Direction, FrameKind};

use crate::bytes::{u16_at, u32_at};

const CAN_MESSAGE: u32 = 1;
const CAN_ERROR: u32 = 2;
const CAN_OVERLOAD: u32 = 3;
const CAN_ERROR_EXT: u32 = 73;
const CAN_MESSAGE2: u32 = 86;
const CAN_FD_MESSAGE: u32 = 100;
const CAN_FD_MESSAGE_64: u32 = 101;
const CAN_FD_ERROR_64: u32 = 104;

/// The bit of an identifier that says that it has 29.
const EXTENDED: u32 = 1 << 31;
/// The bits of an identifier.
const ID: u32 = 0x1FFF_FFFF;
/// The bit in the flags of a frame that says that it is a remote frame.
const REMOTE: u8 = 0x80;
/// The direction of a request to send, which is no frame on the bus.
const REQUEST: u8 = 2;

// `linux/can/error.h`: what a class of errors is called in a log of candump.
const CLASS_PROTOCOL: u32 = 0x08;
const CLASS_BUS_ERROR: u32 = 0x80;
/// An overload frame: the third byte of an error of the protocol.
const OVERLOAD: [u8; 8] = [0, 0, 0x20, 0, 0, 0, 0, 0];

const SHORT: &str = "an object that is long enough for its type";
const STANDARD_ID: &str = "an identifier up to 7FF, or the mark of an extended one";
const CODE: &str = "a data length code up to 15";
const AT_MOST_8: &str = "at most 8 bytes of data, the most that a CAN frame holds";
const AT_MOST_64: &str = "at most 64 bytes of data, the most that a CAN FD frame holds";

/// Where in the object's own bytes it cannot be read, and what should stand there.
pub(super) type BlfFlaw = (usize, &'static str);

/// What was read, apart from its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct BlfFrame {
    pub(super) channel: u16,
    pub(super) kind: FrameKind,
    pub(super) id: u32,
    pub(super) direction: Option<Direction>,
    pub(super) data: [u8; 64],
    pub(super) len: usize,
}

impl BlfFrame {
    /// None so far.
    pub(super) const NONE: Self =
        Self { channel: 0, kind: FrameKind::Standard, id: 0, direction: None, data: [0; 64], len: 0 };
}

/// Whether objects of this type are frames.
pub(super) const fn is_frame(kind: u32) -> bool {
    matches!(
        kind,
        CAN_MESSAGE
            | CAN_ERROR
            | CAN_OVERLOAD
            | CAN_ERROR_EXT
            | CAN_MESSAGE2
            | CAN_FD_MESSAGE
            | CAN_FD_MESSAGE_64
            | CAN_FD_ERROR_64
    )
}

/// Reads the bytes behind the header of an object of a type; `None` if it is no frame that was on the bus.
pub(super) fn read(kind: u32, body: &[u8]) -> Result<Option<BlfFrame>, BlfFlaw> {
    match kind {
        CAN_MESSAGE | CAN_MESSAGE2 => message(body),
        CAN_FD_MESSAGE => fd_message(body),
        CAN_FD_MESSAGE_64 => fd_message_64(body),
        CAN_ERROR => error(u16_at(body, 0), CLASS_BUS_ERROR, &[]),
        CAN_OVERLOAD => error(u16_at(body, 0), CLASS_PROTOCOL, &OVERLOAD),
        CAN_FD_ERROR_64 => error(body.first().copied().map(u16::from), CLASS_BUS_ERROR, &[]),
        CAN_ERROR_EXT => error_ext(body),
        _ => Ok(None),
    }
}

/// ```text
/// channel 2, flags 1, length code 1, identifier 4, data 8
/// ```
fn message(body: &[u8]) -> Result<Option<BlfFrame>, BlfFlaw> {
    let [_, _, flags, code, ..] = *body else { return Err((0, SHORT)) };
    let (id, data) = u32_at(body, 4).zip(body.get(8..16)).ok_or((0, SHORT))?;
    if flags & 0x0F == REQUEST {
        return Ok(None);
    }
    let data = classic_len(code).and_then(|len| data.get(..len)).ok_or((3, CODE))?;
    frame(
        u16_at(body, 0),
        BlfSort::Classic { remote: flags & REMOTE != 0 },
        id,
        direction(flags & 0x0F),
        data,
    )
}

/// ```text
/// channel 2, flags 1, length code 1, identifier 4, frame's length 4, bits 1, FD flags 1, bytes 1, - 5, data 64
/// ```
fn fd_message(body: &[u8]) -> Result<Option<BlfFrame>, BlfFlaw> {
    let [_, _, flags, code, ..] = *body else { return Err((0, SHORT)) };
    let (id, rest) = u32_at(body, 4).zip(body.get(13..)).ok_or((0, SHORT))?;
    let [fd, bytes, _, _, _, _, _, ref data @ ..] = *rest else { return Err((0, SHORT)) };
    if flags & 0x0F == REQUEST {
        return Ok(None);
    }
    let sort = BlfSort::of([fd & 1 != 0, fd & 2 != 0, fd & 4 != 0, flags & REMOTE != 0]);
    let len = sort.len(code, bytes).map_err(|expected| (14, expected))?;
    let data = data.get(..len).ok_or((20, SHORT))?;
    frame(u16_at(body, 0), sort, id, direction(flags & 0x0F), data)
}

/// ```text
/// channel 1, length code 1, bytes 1, - 1, identifier 4, frame's length 4, flags 4, - 16, bits 2, direction 1, offset of more 1, checksum 4,
/// data: as many as there are
/// ```
fn fd_message_64(body: &[u8]) -> Result<Option<BlfFrame>, BlfFlaw> {
    let [channel, code, bytes, ..] = *body else { return Err((0, SHORT)) };
    let (id, flags) = u32_at(body, 4).zip(u32_at(body, 12)).ok_or((0, SHORT))?;
    let (&sent, there) = body.get(34).zip(body.get(40..)).ok_or((0, SHORT))?;
    if sent == REQUEST {
        return Ok(None);
    }
    let sort = BlfSort::of([0x1000, 0x2000, 0x4000, 0x10].map(|bit| flags & bit != 0));
    let len = sort.len(code, bytes).map_err(|expected| (2, expected))?;
    // Vector's own library takes bytes that were not written for zeros.
    let mut data = [0; 64];
    for (place, byte) in data.iter_mut().zip(there) {
        *place = *byte;
    }
    frame(Some(u16::from(channel)), sort, id, direction(sent), data.get(..len).unwrap_or_default())
}

/// ```text
/// channel 2, length 2, flags 4, error code 1, position 1, length code 1, - 1, frame's length 4, identifier 4, more flags 2, - 2, data 8
/// ```
///
/// A controller of Vector's says in the flags what it knows, and the identifier is that of the frame which failed. Without flags it is a
/// class of errors with its data, as SocketCAN has them and python-can writes them.
fn error_ext(body: &[u8]) -> Result<Option<BlfFrame>, BlfFlaw> {
    let (channel, flags) = (u16_at(body, 0), u32_at(body, 4).ok_or((0, SHORT))?);
    if flags != 0 {
        return error(channel, CLASS_BUS_ERROR, &[]);
    }
    let (&code, class) = body.get(10).zip(u32_at(body, 16)).ok_or((0, SHORT))?;
    let len = classic_len(code).ok_or((10, CODE))?;
    error(channel, class & ID, body.get(24..24 + len).ok_or((24, SHORT))?)
}

fn error(channel: Option<u16>, class: u32, data: &[u8]) -> Result<Option<BlfFrame>, BlfFlaw> {
    filled(channel, FrameKind::Error, class, None, data)
}

/// What sort of frame it is, before its identifier is known.
#[derive(Clone, Copy)]
enum BlfSort {
    Classic { remote: bool },
    Fd { flags: u8 },
}

impl BlfSort {
    /// That of a frame with these marks: of CAN FD, of the rate switch, of the error state, of a remote frame.
    fn of([fd, rate_switch, error_state, remote]: [bool; 4]) -> Self {
        if fd {
            Self::Fd { flags: u8::from(rate_switch) | u8::from(error_state) << 1 }
        } else {
            Self::Classic { remote }
        }
    }

    /// How many bytes of data a frame has of which an object says this.
    fn len(self, code: u8, bytes: u8) -> Result<usize, &'static str> {
        let bytes = usize::from(bytes);
        match self {
            Self::Classic { remote: true } => classic_len(code).ok_or(CODE),
            Self::Classic { remote: false } if bytes > 8 => Err(AT_MOST_8),
            Self::Fd { .. } if bytes > 64 => Err(AT_MOST_64),
            Self::Classic { .. } | Self::Fd { .. } => Ok(bytes),
        }
    }
}

/// A frame of this sort. The data of a remote frame only stand for a length.
fn frame(
    channel: Option<u16>,
    sort: BlfSort,
    id: u32,
    direction: Option<Direction>,
    data: &[u8],
) -> Result<Option<BlfFrame>, BlfFlaw> {
    let extended = id & EXTENDED != 0;
    let (kind, data) = match sort {
        BlfSort::Classic { remote: true } => {
            (FrameKind::Remote { extended, len: u8::try_from(data.len()).unwrap_or(8) }, &[][..])
        }
        BlfSort::Classic { remote: false } if extended => (FrameKind::Extended, data),
        BlfSort::Classic { remote: false } => (FrameKind::Standard, data),
        BlfSort::Fd { flags } => (FrameKind::Fd { extended, flags }, data),
    };
    let id = id & ID;
    if id > kind.max_id() {
        return Err((4, STANDARD_ID));
    }
    filled(channel, kind, id, direction, data)
}

fn filled(
    channel: Option<u16>,
    kind: FrameKind,
    id: u32,
    direction: Option<Direction>,
    from: &[u8],
) -> Result<Option<BlfFrame>, BlfFlaw> {
    let mut data = [0; 64];
    for (place, byte) in data.iter_mut().zip(from) {
        *place = *byte;
    }
    let channel = channel.ok_or((0, SHORT))?;
    Ok(Some(BlfFrame { channel, kind, id, direction, data, len: from.len().min(64) }))
}

/// How many bytes a classic frame has of this code: 9 to 15 stand for 8.
fn classic_len(code: u8) -> Option<usize> {
    (code <= 15).then(|| usize::from(code).min(8))
}

/// The direction, where what the code means is known.
const fn direction(code: u8) -> Option<Direction> {
    match code {
        0 => Some(Direction::Rx),
        1 => Some(Direction::Tx),
        _ => None,
    }
}
