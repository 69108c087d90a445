//! The remote control, where an edition has it on the bus: its "Go" switch and its E-stop as they are, and not as the VCU takes
//! them.
//!
//! Which bits that are stands in the edition's table of devices; here are only the names by which the signals are found there.

use adsdv_spec::Bus;
use adsdv_spec::messages::{DeviceMessage, DeviceSignal, Frame};

/// The signal of the "Go" switch.
const GO: &str = "K2_SWITCH_GO_STATUS";

/// The signal of the E-stop.
const ESTOP: &str = "ESTOP_STATUS";

/// The signal of the radio link's quality, in percent.
const RADIO: &str = "RADIO_STRENGTH";

/// The message of the remote control, as an edition has it.
///
/// ```
/// use adsdv_oracle::remote::{Remote, Switches};
/// use adsdv_spec::Edition;
///
/// let remote = Remote::of(&Edition::V2026.bus).expect("the database of 2026 has one");
/// let switches = Switches { go: true, estop: false };
/// assert_eq!(remote.frame(switches, 100).map(|frame| frame.to_string()).as_deref(), Some("181#0200000000006400"));
/// assert_eq!(remote.read(&[0b10, 0, 0, 0, 0, 0, 100, 0]), Some(switches));
/// assert_eq!(remote.read(&[0b10]), None); // not a frame of this message
/// assert!(Remote::of(&Edition::V4_0.bus).is_none());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Remote {
    message: &'static DeviceMessage,
    go: &'static DeviceSignal,
    estop: &'static DeviceSignal,
}

/// What the remote control shows of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Switches {
    /// The "Go" switch is on.
    pub go: bool,
    /// The E-stop's bit. Which of its levels means that it is pressed, no document says.
    pub estop: bool,
}

impl Remote {
    /// The remote control of a bus, if it has one.
    pub fn of(bus: &Bus) -> Option<Self> {
        bus.devices.iter().find_map(|message| {
            Some(Self { message, go: message.signal(GO)?, estop: message.signal(ESTOP)? })
        })
    }

    /// The message.
    pub const fn message(&self) -> &'static DeviceMessage {
        self.message
    }

    /// What a frame's data says; `None` where it has another length than the message, so that it is none of it.
    pub fn read(&self, data: &[u8]) -> Option<Switches> {
        let bit = |signal: &DeviceSignal| signal.raw(data).map(|raw| raw != 0);
        let whole = data.len() == usize::from(self.message.len);
        whole.then_some(Switches { go: bit(self.go)?, estop: bit(self.estop)? })
    }

    /// The frame that says this, with a radio link of so many percent. All other bits are 0.
    pub fn frame(&self, switches: Switches, radio_pct: u8) -> Option<Frame> {
        let data = self.go.put([0; 8], switches.go.into());
        let data = self.estop.put(data, switches.estop.into());
        let data = self.message.signal(RADIO).map_or(data, |radio| radio.put(data, radio_pct.into()));
        Frame::new(self.message.id, data.get(..usize::from(self.message.len))?)
    }
}
