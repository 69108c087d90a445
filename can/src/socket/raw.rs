//! One socket: frames in and out, when they came, and how many the kernel dropped.

use std::io::{self, IoSliceMut};
use std::os::fd::{AsFd as _, AsRawFd as _};
use std::time::{Instant, SystemTime};

use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Frame;
use nix::cmsg_space;
use nix::errno::Errno;
use nix::poll::{PollFd, PollFlags, ppoll};
use nix::sys::socket::{ControlMessageOwned, MsgFlags, getsockopt, recvmsg, setsockopt, sockopt};
use nix::sys::time::TimeSpec;
use socketcan::{CanDataFrame, CanSocket, EmbeddedFrame as _, Socket as _, SocketOptions as _, StandardId};

use super::RECEIVE_BUFFER;
use crate::bus::Received;

/// The bytes of `struct can_frame`: identifier and flags, length, three that do not count, and the data.
const FRAME_BYTES: usize = 16;
/// The flags beside the identifier.
const EXTENDED_FLAG: u32 = 0x8000_0000;
const REMOTE_FLAG: u32 = 0x4000_0000;
const ERROR_FLAG: u32 = 0x2000_0000;
const EXTENDED_MASK: u32 = 0x1FFF_FFFF;
const STANDARD_MASK: u32 = 0x7FF;

/// A socket on one interface.
#[derive(Debug)]
pub(super) struct Raw {
    socket: CanSocket,
    /// Room for what the kernel tells beside a frame.
    control: Vec<u8>,
    /// How many frames it has dropped, as it counts: it begins again after 2^32.
    dropped: u32,
    /// Whether it keeps less than was asked for.
    small_buffer: bool,
}

impl Raw {
    /// Whether this machine can have such a socket at all.
    pub(super) fn probe() -> io::Result<()> {
        // Interface 0 stands for all of them; the socket is closed at once.
        CanSocket::open_iface(0).map(drop)
    }

    /// A socket on the interface of this number.
    pub(super) fn open(index: u32) -> io::Result<Self> {
        let socket = CanSocket::open_iface(index)?;
        socket.set_nonblocking(true)?;
        socket.set_error_filter_accept_all()?;
        setsockopt(&socket, sockopt::ReceiveTimestampns, &true)?;
        setsockopt(&socket, sockopt::RxqOvfl, &1)?;
        let small_buffer = enlarge(&socket) < RECEIVE_BUFFER;
        Ok(Self { socket, control: cmsg_space!(TimeSpec, u32), dropped: 0, small_buffer })
    }

    /// Waits for a frame until a time; `None` if none came.
    pub(super) fn receive(&mut self, until: Instant) -> Result<Option<Received>, Errno> {
        loop {
            match self.take() {
                Ok(Some(frame)) => return Ok(Some(frame)),
                // What is no frame of classic CAN is passed over.
                Ok(None) | Err(Errno::EINTR) => {}
                Err(Errno::EAGAIN) => {
                    if !self.wait(until)? {
                        return Ok(None);
                    }
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Waits until there is something to take: a frame, or an error. Tells whether there is.
    fn wait(&self, until: Instant) -> Result<bool, Errno> {
        loop {
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Ok(false);
            }
            let mut polled = [PollFd::new(self.socket.as_fd(), PollFlags::POLLIN)];
            match ppoll(&mut polled, Some(TimeSpec::from_duration(left)), None) {
                Ok(0) | Err(Errno::EINTR) => {}
                Ok(_) => return Ok(true),
                Err(error) => return Err(error),
            }
        }
    }

    /// Takes a frame that is there.
    fn take(&mut self) -> Result<Option<Received>, Errno> {
        let mut bytes = [0; FRAME_BYTES];
        let mut room = [IoSliceMut::new(&mut bytes)];
        let fd = self.socket.as_raw_fd();
        let message = recvmsg::<()>(fd, &mut room, Some(&mut self.control), MsgFlags::empty())?;
        let mut time_ns = None;
        for told in message.cmsgs()? {
            match told {
                ControlMessageOwned::ScmTimestampns(time) => time_ns = Some(nanoseconds(time)),
                ControlMessageOwned::RxqOvfl(dropped) => self.dropped = dropped,
                _ => {}
            }
        }
        let len = message.bytes;
        Ok((len == FRAME_BYTES).then(|| received(time_ns.unwrap_or_else(now_ns), bytes)))
    }

    /// Sends a frame, or fails at once.
    pub(super) fn send(&self, frame: &Frame) -> io::Result<()> {
        let id = StandardId::new(frame.id);
        let frame = id.and_then(|id| CanDataFrame::new(id, frame.data()));
        let frame = frame.ok_or_else(|| io::Error::from(io::ErrorKind::InvalidInput))?;
        self.socket.write_frame(&frame)
    }

    /// How many frames the kernel has dropped, as of the last frame that it delivered.
    pub(super) fn dropped(&self) -> u32 {
        self.dropped
    }

    /// Whether it keeps fewer frames than were asked for.
    pub(super) fn has_small_buffer(&self) -> bool {
        self.small_buffer
    }
}

/// Asks for a large buffer, with privileges if there are any, and tells how much was granted, in bytes. A small one is no reason
/// to fail: what it costs is counted.
fn enlarge(socket: &CanSocket) -> usize {
    if setsockopt(socket, sockopt::RcvBufForce, &RECEIVE_BUFFER).is_err() {
        // More than `net.core.rmem_max` is no error: that much is granted.
        let _ = setsockopt(socket, sockopt::RcvBuf, &RECEIVE_BUFFER);
    }
    getsockopt(socket, sockopt::RcvBuf).unwrap_or_default()
}

/// The frame that 16 bytes of `struct can_frame` are.
fn received(time_ns: i64, bytes: [u8; FRAME_BYTES]) -> Received {
    let [i0, i1, i2, i3, len, _, _, _, data @ ..] = bytes;
    let word = u32::from_ne_bytes([i0, i1, i2, i3]);
    let len = len.min(8);
    let extended = word & EXTENDED_FLAG != 0;
    let (kind, mask) = if word & ERROR_FLAG != 0 {
        (FrameKind::Error, EXTENDED_MASK)
    } else if word & REMOTE_FLAG != 0 {
        (FrameKind::Remote { extended, len }, if extended { EXTENDED_MASK } else { STANDARD_MASK })
    } else if extended {
        (FrameKind::Extended, EXTENDED_MASK)
    } else {
        (FrameKind::Standard, STANDARD_MASK)
    };
    let len = if matches!(kind, FrameKind::Remote { .. }) { 0 } else { len };
    let mut clean = [0; 8];
    for (place, byte) in clean.iter_mut().zip(data).take(len.into()) {
        *place = byte;
    }
    Received { time_ns, kind, id: word & mask, len, data: clean }
}

fn nanoseconds(time: TimeSpec) -> i64 {
    time.tv_sec().saturating_mul(1_000_000_000).saturating_add(time.tv_nsec())
}

/// The time that the kernel gives frames, now.
pub(super) fn now_ns() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(word: u32, len: u8) -> Received {
        let [a, b, c, d] = word.to_ne_bytes();
        received(5, [a, b, c, d, len, 9, 9, 9, 1, 2, 3, 4, 5, 6, 7, 8])
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
