//! What an AI Computer may do wrong: to see what comes of it.

use adsdv_spec::Bus;
use adsdv_spec::messages::{Frame, MissionStatus, Node};

/// A mistake of an AI Computer, made in the frames that it sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    /// It sends nothing.
    Silent,
    /// It holds the HANDSHAKE bit.
    HoldsHandshake,
    /// It asks for an emergency stop.
    AsksForStop,
    /// It says that its mission is finished.
    SaysFinished,
    /// It asks for torque.
    AsksForTorque,
}

/// A tenth of the range, in steps of 0.1 Nm: more than any noise.
const TORQUE: i32 = 200;

impl Slip {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Silent, Self::HoldsHandshake, Self::AsksForStop, Self::SaysFinished, Self::AsksForTorque];

    /// A word for it.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Silent => "silent",
            Self::HoldsHandshake => "holds-handshake",
            Self::AsksForStop => "asks-for-stop",
            Self::SaysFinished => "says-finished",
            Self::AsksForTorque => "asks-for-torque",
        }
    }

    /// What the AI Computer does then, in a few words.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Silent => "sends nothing",
            Self::HoldsHandshake => "holds the HANDSHAKE bit",
            Self::AsksForStop => "asks for an emergency stop",
            Self::SaysFinished => "says FINISHED, whatever the car does",
            Self::AsksForTorque => "asks for torque, whatever the state",
        }
    }

    /// The field of its messages that it is in, and what it says there.
    const fn field(self) -> Option<(&'static str, i32)> {
        match self {
            Self::Silent => None,
            Self::HoldsHandshake => Some(("handshake", 0)),
            Self::AsksForStop => Some(("estop_request", 1)),
            Self::SaysFinished => Some(("mission_status", MissionStatus::Finished.raw())),
            Self::AsksForTorque => Some(("front_axle_trq_request", TORQUE)),
        }
    }

    /// Makes the mistake in frames of an AI Computer.
    ///
    /// ```
    /// use adsdv_can::demo::Slip;
    /// use adsdv_spec::Edition;
    /// use adsdv_spec::messages::Frame;
    ///
    /// let mut frames = vec![Frame::new(0x510, &[0x01, 0, 0, 0, 0, 0, 0, 0]).expect("a frame")];
    /// Slip::HoldsHandshake.spoil(&Edition::V3_0.bus, &mut frames);
    /// assert_eq!(frames[0].data, [0; 8]);
    /// Slip::Silent.spoil(&Edition::V3_0.bus, &mut frames);
    /// assert!(frames.is_empty());
    /// ```
    pub fn spoil(self, bus: &Bus, frames: &mut Vec<Frame>) {
        let Some((field, raw)) = self.field() else { return frames.clear() };
        for frame in frames {
            let message = bus.message(frame.id).filter(|message| message.sender == Node::Ai);
            if let Some(signal) = message.and_then(|message| message.signal_of(field)) {
                frame.data = signal.put(frame.data, raw);
            }
        }
    }
}
