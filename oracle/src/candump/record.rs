//! One line of a log, read.

pub(super) const STANDARD_MASK: u32 = 0x7FF;
pub(super) const EXTENDED_MASK: u32 = 0x1FFF_FFFF;
/// `CAN_ERR_FLAG` of `linux/can.h`: with it, the identifier is a class of errors.
pub(super) const ERROR_FLAG: u32 = 0x2000_0000;

pub(super) const MAX_CLASSIC: usize = 8;
pub(super) const MAX_FD: usize = 64;
/// The largest data field of any frame: CAN XL.
pub(super) const MAX_DATA: usize = 2048;

/// One frame as the log has it. Text and data are borrowed from the [`Reader`](super::Reader) until its next
/// record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record<'a> {
    /// Number of the line in the log; the first is 1.
    pub line: u64,
    /// Time stamp in nanoseconds, never negative. Its origin is the log's: 1970 for `candump -L`, the first
    /// frame for `candump -L -tz`. Digits finer than a nanosecond are dropped.
    pub time_ns: i64,
    /// Name of the network interface, such as `vcan0`. Never empty; no white space or control characters.
    pub interface: &'a str,
    /// What sort of frame it is.
    pub kind: FrameKind,
    /// Identifier: 11 bits, or 29 bits when extended; the error class for [`FrameKind::Error`], the priority
    /// for [`FrameKind::Xl`].
    pub id: u32,
    /// Data: up to 8 bytes, up to 64 for [`FrameKind::Fd`], up to 2048 for [`FrameKind::Xl`]. Empty for
    /// [`FrameKind::Remote`].
    pub data: &'a [u8],
    /// Whether the frame was received or sent, if the log says so (`candump -x`).
    pub direction: Option<Direction>,
    /// Whether the line ended with a line feed. The last line of a log that was cut off does not, and may lack data.
    pub terminated: bool,
}

/// The sorts of frame that a log can hold. The ADS-DV uses [`FrameKind::Standard`] alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameKind {
    /// Data frame with an identifier of 11 bits: `520#0011`.
    Standard,
    /// Data frame with an identifier of 29 bits: `18FF50E5#0011`.
    Extended,
    /// Remote frame, which asks for data and holds none: `520#R`, `520#R8`.
    Remote {
        /// Whether the identifier has 29 bits.
        extended: bool,
        /// Number of data bytes asked for, 0 to 8; 0 if the log does not say.
        len: u8,
    },
    /// Error frame, which the CAN driver reports in place of traffic: `20000004#000C000000000000`.
    Error,
    /// CAN FD frame: `520##1AABB`.
    Fd {
        /// Whether the identifier has 29 bits.
        extended: bool,
        /// The digit after `##`: 1 bit rate switch, 2 error state, 4 FD frame.
        flags: u8,
    },
    /// CAN XL frame: `45123#81:00:12345678#11223344`. Network, flags and types of its header are not kept.
    Xl,
}

impl FrameKind {
    /// The largest identifier that a frame of this kind can have; for an error frame, the largest class. One of CAN XL has a
    /// priority in its place.
    pub const fn max_id(self) -> u32 {
        match self {
            Self::Extended
            | Self::Error
            | Self::Remote { extended: true, .. }
            | Self::Fd { extended: true, .. } => EXTENDED_MASK,
            Self::Standard | Self::Remote { .. } | Self::Fd { .. } | Self::Xl => STANDARD_MASK,
        }
    }
}

/// Whether the recording host received or sent a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Received: ` R` at the end of the line.
    Rx,
    /// Sent by the host itself: ` T` at the end of the line.
    Tx,
}
