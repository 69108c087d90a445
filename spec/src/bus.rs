//! What an edition puts on the bus: its messages, how they are read and written, and what nobody may send.

use core::fmt;
use core::ops::RangeInclusive;

use crate::messages::{
    AnyMessage, DecodeError, Device, DeviceMessage, Frame, Message, MessageDef, MessageRow, Node, SignalDef,
};

/// The bus of one edition.
#[derive(Clone, Copy)]
pub struct Bus {
    /// Every message of section 2, by ascending identifier.
    pub messages: &'static [&'static MessageDef],
    /// What asks for the cycle of each message, in their order: the numbers of `REQUIREMENTS.md`; see
    /// [`Bus::cycle_requirements`].
    pub cycles: &'static [&'static [&'static str]],
    /// What asks for the lengths of the messages: the numbers of `REQUIREMENTS.md`.
    pub lengths: &'static [&'static str],
    /// The identifiers that the AI Computer must not use (section 2.3), ascending.
    pub reserved: &'static [Reserved],
    /// What the VCU and its devices tell each other, by ascending identifier; the AI Computer has no part in it.
    pub devices: &'static [DeviceMessage],
    /// What forbids the AI Computer to send what is the VCU's or a device's: the numbers of `REQUIREMENTS.md`.
    pub senders: &'static [&'static str],
    /// Reads the data of a frame with this identifier; see [`Bus::decode`].
    pub read: fn(id: u16, data: &[u8]) -> Result<AnyMessage, DecodeError>,
    /// The frame of a message; see [`Bus::encode`].
    pub write: fn(&AnyMessage) -> Option<Frame>,
    /// Whether a message comes back as it was sent; see [`Bus::holds`].
    pub holds: fn(&AnyMessage) -> bool,
}

/// Identifiers that the AI Computer must not use (section 2.3).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Reserved {
    /// The first to the last of them.
    pub ids: RangeInclusive<u16>,
    /// What forbids them: the numbers of `REQUIREMENTS.md`.
    pub requirements: &'static [&'static str],
}

impl Bus {
    /// The message with this identifier.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let bus = Edition::V3_0.bus;
    /// assert_eq!(bus.message(0x520).map(|message| message.name), Some("VCU2AI_Status"));
    /// assert_eq!(bus.message(0x527), None);
    /// ```
    pub const fn message(&self, id: u16) -> Option<&'static MessageDef> {
        let mut i = 0;
        while i < self.messages.len() {
            if self.messages[i].id == id {
                return Some(self.messages[i]);
            }
            i += 1;
        }
        None
    }

    /// The message of a device with this identifier.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// assert_eq!(Edition::V2026.bus.device(0x181).map(|message| message.name), Some("RES_TPDO"));
    /// assert_eq!(Edition::V4_0.bus.device(0x181), None);
    /// ```
    pub const fn device(&self, id: u16) -> Option<&'static DeviceMessage> {
        let mut i = 0;
        while i < self.devices.len() {
            if self.devices[i].id == id {
                return Some(&self.devices[i]);
            }
            i += 1;
        }
        None
    }

    /// The signal that a field of a message carries: of the first message that has such a field.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let steer = Edition::V3_0.bus.signal_of("steer_request").expect("a field of 513h");
    /// assert_eq!((steer.name, steer.max), ("STEER_REQUEST_deg", 240));
    /// ```
    pub const fn signal_of(&self, field: &str) -> Option<&'static SignalDef> {
        let mut i = 0;
        while i < self.messages.len() {
            if let Some(signal) = self.messages[i].signal_of(field) {
                return Some(signal);
            }
            i += 1;
        }
        None
    }

    /// Every message, those of devices behind the others: what all have in common.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let mut rows = Edition::V2026.bus.rows();
    /// let remote = rows.find(|row| row.id == 0x181).expect("of the remote control");
    /// assert_eq!(remote.from, "RES");
    /// assert!(remote.signals().any(|signal| signal.name == "K2_SWITCH_GO_STATUS"));
    /// ```
    pub fn rows(&self) -> impl Iterator<Item = MessageRow> + use<> {
        let documented = self.messages.iter().map(|message| MessageRow::documented(message));
        documented.chain(self.devices.iter().map(MessageRow::of_device))
    }

    /// The message with this name.
    pub fn named(&self, name: &str) -> Option<&'static MessageDef> {
        self.messages.iter().copied().find(|message| message.name == name)
    }

    /// Reads the data of a frame with this identifier; see [`Layout::decode`](crate::messages::Layout::decode).
    ///
    /// # Errors
    ///
    /// [`DecodeError::UnknownId`] where the edition has no such message, and those of the message itself.
    pub fn decode(&self, id: u16, data: &[u8]) -> Result<AnyMessage, DecodeError> {
        (self.read)(id, data)
    }

    /// Reads the data of a frame that carries this kind of message.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    /// use adsdv_spec::messages::Ai2VcuSteer;
    ///
    /// let steer: Ai2VcuSteer = Edition::V3_0.bus.decode_as(&[0x9C, 0xFF])?;
    /// assert_eq!(steer.steer_request.to_string(), "-10 deg");
    /// # Ok::<(), adsdv_spec::messages::DecodeError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Fails if a signal is not there, or one has a value outside its range or its enumeration.
    pub fn decode_as<M: Message>(&self, data: &[u8]) -> Result<M, DecodeError> {
        let unknown = DecodeError::UnknownId { id: M::ID };
        M::of(self.decode(M::ID, data)?).ok_or(unknown)
    }

    /// The frame of a message; `None` where the edition has no such message.
    ///
    /// A value outside the edition's range goes out as the nearest inside; see [`Bus::holds`].
    ///
    /// ```
    /// use adsdv_spec::Edition;
    /// use adsdv_spec::messages::Ai2VcuDriveF;
    ///
    /// let frame = Edition::V3_0.bus.encode(Ai2VcuDriveF::default());
    /// assert_eq!(frame.map(|frame| frame.to_string()).as_deref(), Some("511#0000000000000000"));
    /// ```
    pub fn encode(&self, message: impl Into<AnyMessage>) -> Option<Frame> {
        (self.write)(&message.into())
    }

    /// Whether the edition can say all of a message: what is [encoded](Bus::encode) is decoded as the same.
    pub fn holds(&self, message: impl Into<AnyMessage>) -> bool {
        (self.holds)(&message.into())
    }

    /// What asks for the cycle of the message with this identifier: the numbers of `REQUIREMENTS.md`.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    /// assert_eq!(Edition::V4_0.bus.cycle_requirements(0x513), ["MSG-98"]);
    /// assert!(Edition::V3_0.bus.cycle_requirements(0x513).is_empty(), "its text gives no cycle");
    /// ```
    pub fn cycle_requirements(&self, id: u16) -> &'static [&'static str] {
        let place = self.messages.iter().position(|message| message.id == id);
        place.and_then(|place| self.cycles.get(place).copied()).unwrap_or_default()
    }

    /// The reserved identifiers that this one is of.
    pub const fn reserved_of(&self, id: u16) -> Option<&'static Reserved> {
        let mut i = 0;
        while i < self.reserved.len() {
            if id >= *self.reserved[i].ids.start() && id <= *self.reserved[i].ids.end() {
                return Some(&self.reserved[i]);
            }
            i += 1;
        }
        None
    }

    /// Whether the AI Computer must not send this identifier (section 2.3).
    ///
    /// ```
    /// use adsdv_spec::Edition;
    /// let bus = Edition::V3_0.bus;
    /// assert!(bus.is_reserved(0x470) && !bus.is_reserved(0x471) && !bus.is_reserved(0x510));
    /// ```
    pub const fn is_reserved(&self, id: u16) -> bool {
        self.reserved_of(id).is_some()
    }

    /// Whether a node may send frames with this identifier: its own messages, and, as far as the document goes,
    /// identifiers that it gives to nobody else and does not reserve (sections 2.1 to 2.3).
    ///
    /// ```
    /// use adsdv_spec::Edition;
    /// use adsdv_spec::messages::Node;
    /// let bus = Edition::V3_0.bus;
    /// assert!(bus.may_send(Node::Ai, 0x510) && !bus.may_send(Node::Ai, 0x520) && !bus.may_send(Node::Ai, 0x181));
    /// assert!(bus.may_send(Node::Vcu, 0x520) && !bus.may_send(Node::Vcu, 0x510));
    /// ```
    pub const fn may_send(&self, node: Node, id: u16) -> bool {
        match (node, self.message(id)) {
            (_, Some(message)) => message.sender as u8 == node as u8,
            (Node::Ai, None) => !self.is_reserved(id) && self.device(id).is_none(),
            (Node::Vcu, None) => match self.device(id) {
                Some(message) => matches!(message.sender, Device::Vcu),
                None => true,
            },
        }
    }
}

/// Two buses with the same messages, laid out alike, read and write alike.
//
// No number of a device's row is NaN, so a row equals itself.
impl PartialEq for Bus {
    fn eq(&self, other: &Self) -> bool {
        let asked = |bus: &Self| (bus.cycles, bus.lengths, bus.senders);
        self.messages == other.messages
            && self.reserved == other.reserved
            && self.devices == other.devices
            && asked(self) == asked(other)
    }
}

impl Eq for Bus {}

impl fmt::Debug for Bus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.messages.iter().map(|message| message.name);
        f.debug_struct("Bus")
            .field("messages", &Names(names))
            .field("reserved", &self.reserved)
            .field("devices", &Names(self.devices.iter().map(|message| message.name)))
            .finish_non_exhaustive()
    }
}

struct Names<I>(I);

impl<I: Iterator<Item: fmt::Debug> + Clone> fmt::Debug for Names<I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.0.clone()).finish()
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Bus {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut bus = serializer.serialize_struct("Bus", 3)?;
        bus.serialize_field("messages", self.messages)?;
        bus.serialize_field("reserved", self.reserved)?;
        bus.serialize_field("devices", self.devices)?;
        bus.end()
    }
}

/// What an edition has on the bus: its messages, by ascending identifier, each with the edition whose layout it has, and with
/// what asks for its cycle; after the edition, what asks for the lengths.
macro_rules! bus {
    (
        $edition:ident, lengths cites [$($length:literal),*]:
        $($message:ident of $layout:ident $(, cites [$($cycle:literal),+])?;)+
    ) => {
        impl $edition {
            /// Every message of the edition, by ascending identifier.
            pub const MESSAGES: &'static [&'static $crate::messages::MessageDef] =
                &[$(<$layout as $crate::messages::Layout<$message>>::DEF),+];

            /// Reads the data of a frame with this identifier; see [`Bus::decode`](crate::Bus::decode).
            ///
            /// # Errors
            ///
            /// Those of [`Bus::decode`](crate::Bus::decode).
            pub fn read(
                id: u16,
                data: &[u8],
            ) -> Result<$crate::messages::AnyMessage, $crate::messages::DecodeError> {
                use $crate::messages::{AnyMessage, DecodeError, Layout};
                match id {
                    $($message::ID => <$layout as Layout<$message>>::decode(data).map(AnyMessage::$message),)+
                    _ => Err(DecodeError::UnknownId { id }),
                }
            }

            /// The frame of a message; see [`Bus::encode`](crate::Bus::encode).
            pub fn write(message: &$crate::messages::AnyMessage) -> Option<$crate::messages::Frame> {
                use $crate::messages::{AnyMessage, Layout};
                #[allow(unreachable_patterns, reason = "an edition may have every message")]
                match message {
                    $(AnyMessage::$message(message) => Some(<$layout as Layout<$message>>::encode(message)),)+
                    _ => None,
                }
            }

            /// Whether a message comes back as it was sent; see [`Bus::holds`](crate::Bus::holds).
            pub fn holds(message: &$crate::messages::AnyMessage) -> bool {
                use $crate::messages::{AnyMessage, Layout};
                #[allow(unreachable_patterns, reason = "an edition may have every message")]
                match message {
                    $(AnyMessage::$message(message) => <$layout as Layout<$message>>::holds(message),)+
                    _ => false,
                }
            }

            /// The bus, with these identifiers reserved, and without devices.
            const fn bus(reserved: &'static [$crate::Reserved]) -> $crate::Bus {
                $crate::Bus {
                    messages: Self::MESSAGES,
                    cycles: &[$(&[$($($cycle),+)?]),+],
                    lengths: &[$($length),*],
                    reserved,
                    devices: &[],
                    senders: &[],
                    read: Self::read,
                    write: Self::write,
                    holds: Self::holds,
                }
            }
        }
    };
}

pub(crate) use bus;
