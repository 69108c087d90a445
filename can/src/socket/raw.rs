//! One socket: frames in and out, when they came, and how many the kernel dropped.

use std::io::{self, IoSliceMut};
use std::os::fd::{AsFd as _, AsRawFd as _};
use std::time::Instant;

use adsdv_spec::messages::Frame;
use nix::cmsg_space;
use nix::errno::Errno;
use nix::poll::{PollFd, PollFlags, ppoll};
use nix::sys::socket::{ControlMessageOwned, MsgFlags, getsockopt, recvmsg, setsockopt, sockopt};
use nix::sys::time::TimeSpec;
use socketcan::{CanDataFrame, CanSocket, EmbeddedFrame as _, Socket as _, SocketOptions as _, StandardId};

use super::RECEIVE_BUFFER;
use super::arrival::{Arrival, now_ns};
use crate::bus::Received;

/// A socket on one interface.
#[derive(Debug)]
pub(super) struct Raw {
    socket: CanSocket,
    /// Room for what the kernel tells beside a frame.
    control: Vec<u8>,
    /// How many frames it has dropped, as it counts: it begins again after 2^32.
    dropped: u32,
    arrival: Arrival,
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
        Ok(Self {
            socket,
            control: cmsg_space!(TimeSpec, u32),
            dropped: 0,
            arrival: Arrival::NEW,
            small_buffer,
        })
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
        let mut bytes = [0; Received::CAN_FRAME];
        let mut room = [IoSliceMut::new(&mut bytes)];
        let fd = self.socket.as_raw_fd();
        let asked = self.arrival.asked();
        let message = recvmsg::<()>(fd, &mut room, Some(&mut self.control), MsgFlags::empty())?;
        let mut time_ns = None;
        for control in message.cmsgs()? {
            match control {
                ControlMessageOwned::ScmTimestampns(time) => time_ns = Some(nanoseconds(time)),
                ControlMessageOwned::RxqOvfl(dropped) => self.dropped = dropped,
                _ => {}
            }
        }
        let whole = message.bytes == bytes.len();
        let time_ns = self.arrival.time(time_ns.unwrap_or_else(now_ns), asked);
        Ok(whole.then(|| Received::of_can_frame(time_ns, bytes)))
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

fn nanoseconds(time: TimeSpec) -> i64 {
    time.tv_sec().saturating_mul(1_000_000_000).saturating_add(time.tv_nsec())
}
