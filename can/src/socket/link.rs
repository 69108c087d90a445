//! A socket that is kept alive: down and up again, removed and made again, bus-off and restarted.

use std::collections::VecDeque;
use std::io;
use std::thread;
use std::time::{Duration, Instant};

use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Frame;
use nix::errno::Errno;
use socketcan::{CanError, CanErrorFrame};

use super::OpenError;
use super::interface::{Interfaces, State};
use super::raw::Raw;
use crate::bus::{Bus, Disturbance, Event, Listen, Received};

/// An interface that is not there is looked for this often.
const LOOK_EVERY: Duration = Duration::from_millis(200);
/// So many frames are taken from a socket that failed. It has no more, for nothing comes to it any longer.
const MOST_QUEUED: usize = 1 << 16;

/// A bus of SocketCAN, to send to and to receive from.
///
/// Once opened it lasts: an interface that goes down or is removed is [`Disturbance`], and [`Event::Up`] when it is back.
#[derive(Debug)]
pub struct CanBus(Link);

/// A bus of SocketCAN to listen to. There is no way to send with it.
#[derive(Debug)]
pub struct Listener(Link);

impl CanBus {
    pub(super) fn open(name: &str) -> Result<Self, OpenError> {
        Link::open(name).map(Self)
    }
}

impl Listener {
    pub(super) fn open(name: &str) -> Result<Self, OpenError> {
        Link::open(name).map(Self)
    }
}

impl Listen for CanBus {
    fn name(&self) -> &str {
        &self.0.name
    }

    fn receive(&mut self, until: Instant) -> Event {
        self.0.receive(until)
    }

    fn dropped(&self) -> u64 {
        self.0.dropped()
    }

    fn has_small_buffer(&self) -> bool {
        self.0.has_small_buffer()
    }
}

impl Bus for CanBus {
    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance> {
        self.0.send(frame)
    }
}

impl Listen for Listener {
    fn name(&self) -> &str {
        &self.0.name
    }

    fn receive(&mut self, until: Instant) -> Event {
        self.0.receive(until)
    }

    fn dropped(&self) -> u64 {
        self.0.dropped()
    }

    fn has_small_buffer(&self) -> bool {
        self.0.has_small_buffer()
    }
}

/// The socket and what is known of its interface.
#[derive(Debug)]
struct Link {
    name: String,
    interfaces: Interfaces,
    /// The socket, and the number of the interface that it is bound to; `None` while there is no such interface.
    socket: Option<(Raw, u32)>,
    up: bool,
    /// When the interface is looked for next, while it is not up.
    look_at: Instant,
    /// Whether the controller is bus-off.
    bus_off: bool,
    /// What `receive` hands out next.
    pending: VecDeque<Event>,
    /// What sockets before this one dropped.
    dropped_before: u64,
}

impl Link {
    fn open(name: &str) -> Result<Self, OpenError> {
        let interfaces = Interfaces::default();
        // Who may not have any socket has no use for an interface; and a machine without CAN has none either.
        let why_not = |error: &io::Error| cannot(name, error);
        let probed = Raw::probe();
        let index = match (&probed, interfaces.usable(name)) {
            (Err(error), _) if is_unsupported(error) || is_refused(error) => return Err(why_not(error)),
            (_, index) => index?,
        };
        probed.map_err(|error| why_not(&error))?;
        let socket = Raw::open(index).map_err(|error| why_not(&error))?;
        Ok(Self {
            name: name.to_owned(),
            interfaces,
            socket: Some((socket, index)),
            up: true,
            look_at: Instant::now(),
            bus_off: false,
            pending: VecDeque::new(),
            dropped_before: 0,
        })
    }

    fn receive(&mut self, until: Instant) -> Event {
        loop {
            if let Some(event) = self.pending.pop_front() {
                return event;
            }
            // While the interface is not up, it is looked for between waiting.
            let wait = if self.up { until } else { until.min(self.look_at) };
            let came = if let Some((socket, _)) = &mut self.socket {
                socket.receive(wait)
            } else {
                thread::sleep(wait.saturating_duration_since(Instant::now()));
                Ok(None)
            };
            match came {
                Ok(Some(frame)) => {
                    // Who hears others is on the bus, unless they were heard before it went down.
                    if !self.up && self.is_up() {
                        self.is_back();
                    }
                    self.came(frame);
                }
                Ok(None) if !self.up && Instant::now() >= self.look_at => self.look(),
                Ok(None) => return Event::Nothing,
                Err(error) => {
                    self.failed(error);
                }
            }
        }
    }

    /// A frame came: it is handed out, and what it says of the bus as well.
    fn came(&mut self, frame: Received) {
        let mut up = false;
        let mut off = false;
        if frame.kind == FrameKind::Error {
            if let Some(error) = decoded(&frame) {
                off = error.is_bus_off();
                up = self.bus_off && error.is_restarted();
            }
        } else {
            up = self.bus_off;
        }
        if up {
            self.bus_off = false;
            self.pending.push_back(Event::Up);
        }
        self.pending.push_back(Event::Frame(frame));
        if off {
            self.bus_off = true;
            self.pending.push_back(Event::Disturbance(Disturbance::BusOff));
        }
    }

    /// Looks for an interface that was not up.
    fn look(&mut self) {
        self.look_at = Instant::now() + LOOK_EVERY;
        let bound = self.socket.as_ref().map(|&(_, index)| index);
        match self.interfaces.state(&self.name) {
            State::Gone => {
                if bound.is_some() {
                    self.drain();
                    self.lose();
                    self.pending.push_back(Event::Disturbance(Disturbance::Gone));
                }
            }
            State::Up { index } | State::Down { index } if bound != Some(index) => {
                self.drain();
                self.lose();
                if let Ok(socket) = Raw::open(index) {
                    // Whether it is up is found out when it is looked for next, or when a frame comes.
                    self.socket = Some((socket, index));
                    self.look_at = Instant::now();
                    if !matches!(self.interfaces.state(&self.name), State::Up { .. }) {
                        self.pending.push_back(Event::Disturbance(Disturbance::Down));
                        self.look_at += LOOK_EVERY;
                    }
                }
            }
            State::Up { .. } => self.is_back(),
            State::Down { .. } => {}
        }
    }

    /// Whether the interface that the socket is bound to is up.
    fn is_up(&self) -> bool {
        let bound = self.socket.as_ref().map(|&(_, index)| index);
        matches!(self.interfaces.state(&self.name), State::Up { index } if bound == Some(index))
    }

    /// The interface is up again.
    fn is_back(&mut self) {
        self.up = true;
        self.bus_off = false;
        self.pending.push_back(Event::Up);
    }

    /// The socket is of no use any more.
    fn lose(&mut self) {
        self.dropped_before = self.dropped();
        self.socket = None;
        self.up = false;
    }

    /// What the socket still has comes before what is handed out next. Returns the last error that it had, if any.
    ///
    /// The kernel tells of an interface that goes down or is removed before it hands out the frames that came until then.
    fn drain(&mut self) -> Option<Errno> {
        let mut last = None;
        for _ in 0..MOST_QUEUED {
            let Some((socket, _)) = &mut self.socket else { break };
            match socket.receive(Instant::now()) {
                Ok(Some(frame)) => self.came(frame),
                Ok(None) => break,
                // It may go down and be removed at once.
                Err(error) => last = Some(error),
            }
        }
        last
    }

    /// The socket failed: what that means, which is also handed out once what it still has is.
    fn failed(&mut self, error: Errno) -> Disturbance {
        let error = self.drain().unwrap_or(error);
        self.look_at = Instant::now() + LOOK_EVERY;
        self.up = false;
        let trouble = match error {
            Errno::ENETDOWN => Disturbance::Down,
            Errno::ENODEV | Errno::ENXIO => {
                self.lose();
                Disturbance::Gone
            }
            error => {
                self.lose();
                Disturbance::Other(io::Error::from(error).to_string())
            }
        };
        self.pending.push_back(Event::Disturbance(trouble.clone()));
        trouble
    }

    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance> {
        let Some((socket, _)) = &self.socket else { return Err(Disturbance::Gone) };
        let Err(error) = socket.send(frame) else { return Ok(()) };
        Err(match error.raw_os_error().map(Errno::from_raw) {
            Some(Errno::ENOBUFS | Errno::EAGAIN) => Disturbance::Full,
            Some(gone @ (Errno::ENETDOWN | Errno::ENODEV | Errno::ENXIO)) => {
                if self.up {
                    self.failed(gone)
                } else if gone == Errno::ENETDOWN {
                    Disturbance::Down
                } else {
                    Disturbance::Gone
                }
            }
            // Receiving goes on, and finds out whether more is wrong.
            _ => Disturbance::Other(error.to_string()),
        })
    }

    fn dropped(&self) -> u64 {
        let now = self.socket.as_ref().map_or(0, |(socket, _)| socket.dropped());
        self.dropped_before.saturating_add(now.into())
    }

    fn has_small_buffer(&self) -> bool {
        self.socket.as_ref().is_some_and(|(socket, _)| socket.has_small_buffer())
    }
}

fn decoded(frame: &Received) -> Option<CanError> {
    CanErrorFrame::new_error(frame.id, frame.data()).ok().map(CanError::from)
}

/// What an error frame says, in words.
///
/// ```
/// use adsdv_can::bus::Received;
/// use adsdv_can::socket::error_text;
/// use adsdv_oracle::candump::FrameKind;
///
/// let frame = Received { time_ns: 0, kind: FrameKind::Error, id: 0x40, len: 8, data: [0; 8] };
/// # #[cfg(target_os = "linux")]
/// assert_eq!(error_text(&frame), "bus off");
/// ```
pub fn error_text(frame: &Received) -> String {
    decoded(frame).map_or_else(|| format!("error class {:X}", frame.id), |error| error.to_string())
}

fn is_unsupported(error: &io::Error) -> bool {
    matches!(
        error.raw_os_error().map(Errno::from_raw),
        Some(Errno::EAFNOSUPPORT | Errno::EPROTONOSUPPORT | Errno::ESOCKTNOSUPPORT)
    )
}

/// The kernel lets everybody have a CAN socket: what refuses it is a sandbox.
fn is_refused(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::PermissionDenied
}

/// Why there is no socket, although the interface may be there.
fn cannot(name: &str, error: &io::Error) -> OpenError {
    let (why, hint) = if is_unsupported(error) {
        (
            "the kernel of this machine has no CAN".to_owned(),
            "load its modules: sudo modprobe -a can can-raw vcan; where there are none, `adsdv demo --screen` is the car without CAN, and `adsdv exam --stdio` examines a stack",
        )
    } else if is_refused(error) {
        (
            format!("no permission to open a CAN socket: {error}"),
            "run it outside of the sandbox that refuses it; a container has to allow CAN sockets and share its host's network",
        )
    } else {
        (format!("cannot open it: {error}"), "see whether candump can: candump -n 1 with the same interface")
    };
    OpenError { what: name.to_owned(), why, hint: hint.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_without_a_socket_has_why_and_what_to_do() {
        let cases = [
            (Errno::EAFNOSUPPORT, "has no CAN", "modprobe"),
            (Errno::EPROTONOSUPPORT, "has no CAN", "adsdv demo"),
            (Errno::EPERM, "no permission to open", "sandbox"),
            (Errno::EACCES, "no permission to open", "container"),
            (Errno::EMFILE, "cannot open it: Too many open files", "candump"),
        ];
        for (errno, why, hint) in cases {
            let error = cannot("can0", &errno.into());
            assert_eq!(error.what, "can0");
            assert!(error.why.contains(why) && error.hint.contains(hint), "{error}");
        }
    }

    /// The machine that builds this often has no CAN: then it has to say so, and nothing worse.
    #[test]
    fn an_interface_that_is_not_there_is_refused() {
        for error in [Link::open("adsdv-none").map(drop), Link::open("").map(drop)] {
            let error = error.expect_err("there is no such interface");
            let known = ["has no CAN", "no such interface", "name of the interface is empty"];
            assert!(known.iter().any(|known| error.why.contains(known)), "{error}");
        }
    }

    #[test]
    fn error_frames_are_put_into_words() {
        let text = |id, data| error_text(&Received { time_ns: 0, kind: FrameKind::Error, id, len: 8, data });
        assert_eq!(text(0x40, [0; 8]), "bus off");
        assert_eq!(text(0x100, [0; 8]), "restarted");
        assert!(text(0x4, [0, 0x30, 0, 0, 0, 0, 0, 0]).contains("controller problem"), "{}", text(4, [0; 8]));
        // Whatever comes, there are words for it.
        for class in 0..=0x3FFF {
            for byte in [0, 0x7F, 0xFF] {
                assert!(!text(class, [byte; 8]).is_empty());
            }
        }
    }
}
