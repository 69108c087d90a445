//! A bus of Linux's SocketCAN, with all that can go wrong.
//!
//! | to read about | look in |
//! |---|---|
//! | which interface can be used, and what to do if it cannot | `interface` |
//! | one socket: frames in and out, and how many were dropped | `raw` |
//! | when frames came, also while the kernel only begins to note it | `arrival` |
//! | going down and coming back, being removed and made again, bus-off | `link` |
//!
//! [`open`] opens a bus to take part in. [`listen`] opens one to listen to: a [`Listener`] has no way to send.
//!
//! Frames of classic CAN of every kind come, error frames included, also those that other programs on this machine send; those
//! that the bus sends itself do not. Frames of CAN FD do not come: the ADS-DV has none.

#[cfg(target_os = "linux")]
mod arrival;
mod error;
#[cfg(target_os = "linux")]
mod interface;
#[cfg(target_os = "linux")]
mod link;
#[cfg(not(target_os = "linux"))]
#[path = "elsewhere.rs"]
mod link;
#[cfg(target_os = "linux")]
mod raw;

pub use error::OpenError;
pub use link::{CanBus, Listener, error_text};

/// What the kernel may keep for us, in bytes: it counts less than 1 kB for a frame, so that this is some 10 000 frames, a
/// quarter of a second of ten times a full bus of 500 kbit/s. It grants a program without privileges
/// no more than `net.core.rmem_max`.
pub const RECEIVE_BUFFER: usize = 8 << 20;

/// Opens a CAN interface that is up, to send to and to receive from.
///
/// ```no_run
/// use std::time::{Duration, Instant};
/// use adsdv_can::bus::{Bus as _, Event, Listen as _};
///
/// let mut bus = adsdv_can::socket::open("vcan0")?;
/// if let Event::Frame(frame) = bus.receive(Instant::now() + Duration::from_secs(1)) {
///     println!("{:03X}h {:02X?}", frame.id, frame.data());
/// }
/// # Ok::<(), adsdv_can::socket::OpenError>(())
/// ```
///
/// # Errors
///
/// Fails if there is no such interface, it is down or no CAN interface, or the system refuses a socket.
pub fn open(name: &str) -> Result<CanBus, OpenError> {
    CanBus::open(name)
}

/// Opens a CAN interface that is up, to receive from.
///
/// What it opens cannot send:
///
/// ```compile_fail,E0599
/// use adsdv_can::bus::Bus as _;
/// use adsdv_spec::Edition;
/// use adsdv_spec::messages::Vcu2AiStatus;
///
/// let mut listener = adsdv_can::socket::listen("vcan0").unwrap();
/// listener.send(&Edition::DEFAULT.bus.encode(Vcu2AiStatus::default()).unwrap());
/// ```
///
/// # Errors
///
/// As [`open`].
pub fn listen(name: &str) -> Result<Listener, OpenError> {
    Listener::open(name)
}
