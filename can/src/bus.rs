//! A bus: where frames come from and go to.
//!
//! The kernel's SocketCAN is one (`socket`), a bus within the program is another ([`crate::demo`]); tests have buses on which
//! everything goes wrong.

use std::fmt;
use std::time::Instant;

use adsdv_oracle::candump::{FrameKind, Record};
use adsdv_spec::messages::Frame;

/// A bus to receive from.
pub trait Listen {
    /// The name of the bus, such as `vcan0`.
    fn name(&self) -> &str;

    /// Waits until a frame comes, something happens to the bus, or it is this time. Never longer, and never without end.
    fn receive(&mut self, until: Instant) -> Event;

    /// How many frames the kernel has had to drop so far, because nobody took them in time. It tells with each frame how many
    /// before it were dropped: this is as of the last frame that came.
    fn dropped(&self) -> u64;

    /// Whether the kernel keeps fewer frames for this program than were asked for, so that it drops some sooner.
    fn has_small_buffer(&self) -> bool {
        false
    }

    /// The time now. Buses of tests have a time of their own.
    fn now(&self) -> Instant {
        Instant::now()
    }
}

/// A bus to receive from and to send to. What is sent is not received back.
pub trait Bus: Listen {
    /// Sends a frame. It does not wait: a frame that the bus does not take at once is not sent.
    ///
    /// # Errors
    ///
    /// Fails if the frame was not sent, and says what keeps the bus from taking it.
    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance>;
}

/// What came of waiting.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A frame came.
    Frame(Received),
    /// Nothing came in time.
    Nothing,
    /// Something happened to the bus. It may come back: receiving goes on, and tells [`Event::Up`] when it does.
    Disturbance(Disturbance),
    /// The bus is there again: its interface is up, or others are heard on it.
    Up,
}

/// A frame that came, of whatever kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Received {
    /// When the kernel had it, in nanoseconds since 1970.
    pub time_ns: i64,
    /// What sort of frame it is.
    pub kind: FrameKind,
    /// Its identifier; for an error frame, its class.
    pub id: u32,
    /// How many bytes of `data` came; none with a remote frame, whose kind says how many it asks for.
    pub len: u8,
    /// The data; zero from `len` on.
    pub data: [u8; 8],
}

/// The flags beside the identifier of a `struct can_frame`.
const EXTENDED_FLAG: u32 = 0x8000_0000;
const REMOTE_FLAG: u32 = 0x4000_0000;
const ERROR_FLAG: u32 = 0x2000_0000;

impl Received {
    /// The bytes of `struct can_frame`: identifier and flags, length, three that do not count, and the data.
    pub const CAN_FRAME: usize = 16;

    /// A frame as Linux tells it, in a `struct can_frame`. Any bytes are one.
    pub fn of_can_frame(time_ns: i64, bytes: [u8; Self::CAN_FRAME]) -> Self {
        let [i0, i1, i2, i3, len, _, _, _, data @ ..] = bytes;
        let word = u32::from_ne_bytes([i0, i1, i2, i3]);
        let len = len.min(8);
        let extended = word & EXTENDED_FLAG != 0;
        let kind = if word & ERROR_FLAG != 0 {
            FrameKind::Error
        } else if word & REMOTE_FLAG != 0 {
            FrameKind::Remote { extended, len }
        } else if extended {
            FrameKind::Extended
        } else {
            FrameKind::Standard
        };
        let len = if matches!(kind, FrameKind::Remote { .. }) { 0 } else { len };
        let mut clean = [0; 8];
        for (place, byte) in clean.iter_mut().zip(data).take(len.into()) {
            *place = byte;
        }
        Self { time_ns, kind, id: word & kind.max_id(), len, data: clean }
    }

    /// The bytes that came.
    pub fn data(&self) -> &[u8] {
        self.data.get(..usize::from(self.len)).unwrap_or(&self.data)
    }

    /// The line of a log that this frame is, with the name of the bus that it came from.
    pub fn record<'a>(&'a self, interface: &'a str) -> Record<'a> {
        let Self { time_ns, kind, id, .. } = *self;
        // What time it was before 1970 no log can say.
        let time_ns = time_ns.max(0);
        Record { line: 0, time_ns, interface, kind, id, data: self.data(), direction: None, terminated: true }
    }

    /// The frame, if it is a data frame with an 11-bit identifier: no other is of the document.
    pub fn frame(&self) -> Option<Frame> {
        let id = u16::try_from(self.id).ok().filter(|_| self.kind == FrameKind::Standard)?;
        Frame::new(id, self.data())
    }
}

/// What is wrong with a bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Disturbance {
    /// The interface is down.
    Down,
    /// The interface is gone.
    Gone,
    /// The controller has gone bus-off: it neither sends nor receives until it is restarted.
    BusOff,
    /// The queue of frames to be sent is full: the bus does not take them.
    Full,
    /// Something else, in the words of the kernel.
    Other(String),
}

impl fmt::Display for Disturbance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Down => f.write_str("the interface is down"),
            Self::Gone => f.write_str("the interface is gone"),
            Self::BusOff => f.write_str("the controller is bus-off"),
            Self::Full => f.write_str("the bus does not take frames: the queue is full"),
            Self::Other(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for Disturbance {}

#[cfg(test)]
mod tests {
    use std::io;

    use super::*;

    fn frame(word: u32, len: u8) -> Received {
        let [a, b, c, d] = word.to_ne_bytes();
        Received::of_can_frame(5, [a, b, c, d, len, 9, 9, 9, 1, 2, 3, 4, 5, 6, 7, 8])
    }

    #[test]
    fn a_frame_of_every_kind_is_read() {
        let cases = [
            (0x520, 3, FrameKind::Standard, 0x520, 3, [1, 2, 3, 0, 0, 0, 0, 0]),
            (0x7FF, 8, FrameKind::Standard, 0x7FF, 8, [1, 2, 3, 4, 5, 6, 7, 8]),
            (0x520, 15, FrameKind::Standard, 0x520, 8, [1, 2, 3, 4, 5, 6, 7, 8]),
            (0x8000_0520, 0, FrameKind::Extended, 0x520, 0, [0; 8]),
            (0x9FFF_FFFF, 1, FrameKind::Extended, 0x1FFF_FFFF, 1, [1, 0, 0, 0, 0, 0, 0, 0]),
            (0x4000_0123, 5, FrameKind::Remote { extended: false, len: 5 }, 0x123, 0, [0; 8]),
            (0xC000_0123, 2, FrameKind::Remote { extended: true, len: 2 }, 0x123, 0, [0; 8]),
            (0x2000_0040, 8, FrameKind::Error, 0x40, 8, [1, 2, 3, 4, 5, 6, 7, 8]),
        ];
        for (word, bytes, kind, id, len, data) in cases {
            let expected = Received { time_ns: 5, kind, id, len, data };
            assert_eq!(frame(word, bytes), expected, "{word:X}");
        }
    }

    #[test]
    fn a_frame_of_a_bus_is_the_line_of_a_log() -> io::Result<()> {
        let cases = [
            (0x520, 3, "520#010203"),
            (0xC000_0123, 2, "00000123#R2"),
            (0x4000_0123, 0, "123#R"),
            (0x2000_0004, 8, "20000004#0102030405060708"),
            (0x98FF_50E5, 0, "18FF50E5#"),
        ];
        for (word, len, text) in cases {
            let mut line = Vec::new();
            adsdv_oracle::candump::write_record(&mut line, &frame(word, len).record("vcan0"))?;
            assert_eq!(String::from_utf8_lossy(&line), format!("(0000000000.000000005) vcan0 {text}\n"));
        }
        Ok(())
    }
}
