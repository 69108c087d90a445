//! The channels of a file, and which of them hold frames.

use std::collections::HashMap;
use std::sync::Arc;

use adsdv_oracle::candump::Direction;

use super::layout::Layout;
use super::message::Encoding;
use super::words::speak_of_can;
use crate::bytes::{u16_at, u32_at};

/// No interface has a longer name.
const LONGEST_NAME: usize = 200;

/// The interface of topics that have nothing before their last part.
const ROOT: &str = "/can_bus";

const SCHEMA: &str = "a schema with an identifier, a name, an encoding and a definition";
const CHANNEL: &str = "a channel with an identifier, a schema, a topic and an encoding";
const KNOWN_SCHEMA: &str = "the schema of this channel, before it";
const FRAMES: &str = "frames of CAN as ROS defines them, an id and data as bytes, in the encoding cdr or ros1; this channel is not read";

/// Where a record cannot be read, what was found, and what should stand there.
pub(super) type ChannelFlaw<'a> = (usize, &'a [u8], &'static str);

/// A channel whose messages are frames.
pub(super) struct Channel {
    pub(super) interface: String,
    pub(super) direction: Option<Direction>,
    /// The same for all channels of the interface.
    pub(super) bus: usize,
    pub(super) encoding: Encoding,
    pub(super) layout: Arc<Layout>,
}

enum Schema {
    Frames(Arc<Layout>),
    /// It speaks of CAN, and is not read.
    Unread(Vec<u8>),
    Other,
}

/// What a file has said of its channels; identifiers have 16 bits, so that there is an end to it.
#[derive(Default)]
pub(super) struct Channels {
    schemas: HashMap<u16, Schema>,
    known: HashMap<u16, Option<Channel>>,
    /// The interfaces of them.
    buses: Vec<String>,
    /// Whether there is one of frames that the host sends.
    sends: bool,
}

impl Channels {
    /// The channel of this identifier, if its messages are frames.
    pub(super) fn get(&self, id: u16) -> Option<&Channel> {
        self.known.get(&id)?.as_ref()
    }

    /// Whether a frame may be on two channels: sent, and looped back to the host that sent it.
    pub(super) fn may_echo(&self) -> bool {
        self.sends
    }

    /// Whether a channel of this identifier has been told of.
    pub(super) fn has(&self, id: u16) -> bool {
        self.known.contains_key(&id)
    }

    /// Messages of this channel, which was never told of, are not asked about again.
    pub(super) fn pass_over(&mut self, id: u16) {
        self.known.insert(id, None);
    }

    /// Takes the body of a schema.
    pub(super) fn schema(&mut self, body: &[u8]) -> Result<(), ChannelFlaw<'static>> {
        let mut at = 2;
        let id = u16_at(body, 0).ok_or((0, &[][..], SCHEMA))?;
        let name = text(body, &mut at).ok_or((2, &[][..], SCHEMA))?;
        let encoding = text(body, &mut at).ok_or((at, &[][..], SCHEMA))?;
        let definition = body.get(at + 4..).unwrap_or_default();
        let name = String::from_utf8_lossy(name);
        let schema = if speak_of_can(&name) {
            match Layout::of(&name, &String::from_utf8_lossy(encoding), definition) {
                Some(layout) => Schema::Frames(Arc::new(layout)),
                None => Schema::Unread(name.as_bytes().iter().take(LONGEST_NAME).copied().collect()),
            }
        } else {
            Schema::Other
        };
        self.schemas.insert(id, schema);
        Ok(())
    }

    /// Takes the body of a channel.
    pub(super) fn channel<'a>(&'a mut self, body: &'a [u8]) -> Result<(), ChannelFlaw<'a>> {
        let (id, schema) = u16_at(body, 0).zip(u16_at(body, 2)).ok_or((0, &[][..], CHANNEL))?;
        let mut at = 4;
        let topic = text(body, &mut at).ok_or((4, &[][..], CHANNEL))?;
        let encoding = text(body, &mut at).ok_or((at, &[][..], CHANNEL))?;
        if self.known.contains_key(&id) {
            // Each chunk repeats it, and does not change.
            return Ok(());
        }
        let topic = String::from_utf8_lossy(topic);
        let encoding = match encoding {
            b"cdr" => Some(Encoding::Cdr),
            b"ros1" => Some(Encoding::Ros1),
            _ => None,
        };
        let (channel, told) = match (self.schemas.get(&schema), encoding) {
            (Some(Schema::Frames(layout)), Some(encoding)) => {
                let (interface, direction) = bus(&topic);
                let known = self.buses.iter().position(|bus| *bus == interface);
                let bus = known.unwrap_or(self.buses.len());
                if known.is_none() {
                    self.buses.push(interface.clone());
                }
                self.sends |= direction == Some(Direction::Tx);
                (Some(Channel { interface, direction, bus, encoding, layout: Arc::clone(layout) }), Ok(()))
            }
            (Some(Schema::Frames(_)), None) => (None, Err((at, body.get(8..).unwrap_or_default(), FRAMES))),
            (Some(Schema::Unread(name)), _) => (None, Err((2, name.as_slice(), FRAMES))),
            // Without a schema the topic alone tells.
            (None, _) if schema == 0 && speak_of_can(&topic) => {
                (None, Err((8, body.get(8..).unwrap_or_default(), FRAMES)))
            }
            (None, _) if schema != 0 => (None, Err((2, body.get(2..4).unwrap_or_default(), KNOWN_SCHEMA))),
            (Some(Schema::Other) | None, _) => (None, Ok(())),
        };
        self.known.insert(id, channel);
        told
    }
}

/// The text at a place, whose length stands before it.
pub(super) fn text<'a>(body: &'a [u8], at: &mut usize) -> Option<&'a [u8]> {
    let begin = *at + 4;
    let end = begin.checked_add(usize::try_from(u32_at(body, *at)?).ok()?)?;
    let text = body.get(begin..end)?;
    *at = end;
    Some(text)
}

/// The interface and the direction that a topic tells. An interface is named as the whole topic, for its last part alone is the same for
/// every bus; where that part is one that a bridge between ROS and SocketCAN has, as what is before it.
fn bus(topic: &str) -> (String, Option<Direction>) {
    let sane = |letter: char| if letter.is_whitespace() || letter.is_control() { '_' } else { letter };
    let named = |name: &str| name.chars().map(sane).take(LONGEST_NAME).collect::<String>();
    let (namespace, last) = topic.rsplit_once('/').unwrap_or(("", topic));
    let direction = match last {
        // Frames that the host itself has sent are among them where its kernel loops them back.
        "from_can_bus" | "from_can_bus_fd" | "received_messages" => Direction::Rx,
        "to_can_bus" | "to_can_bus_fd" | "sent_messages" => Direction::Tx,
        "" if namespace.is_empty() => return ("mcap".to_owned(), None),
        _ => return (named(topic), None),
    };
    (if namespace.is_empty() { ROOT.to_owned() } else { named(namespace) }, Some(direction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_topics_of_a_bridge_are_one_interface_with_directions() {
        let (rx, tx) = (Some(Direction::Rx), Some(Direction::Tx));
        for (topic, interface, direction) in [
            ("/can0/from_can_bus", "/can0", rx),
            ("/can0/to_can_bus", "/can0", tx),
            ("/can0/from_can_bus_fd", "/can0", rx),
            ("/can0/to_can_bus_fd", "/can0", tx),
            ("/car/can 1/to_can_bus", "/car/can_1", tx),
            ("/from_can_bus", "/can_bus", rx),
            ("to_can_bus", "/can_bus", tx),
            ("/front/received_messages", "/front", rx),
            ("/front/sent_messages", "/front", tx),
        ] {
            assert_eq!(bus(topic), (interface.to_owned(), direction), "{topic}");
        }
    }

    #[test]
    fn any_other_topic_is_an_interface_by_itself() {
        for topic in [
            "/can0",
            "/can0/from_can",
            "/can0/from_can_bus/raw",
            "/can0/From_can_bus",
            "/can0/my_to_can_bus",
            "from/to",
            "/can0/",
        ] {
            assert_eq!(bus(topic), (topic.to_owned(), None));
        }
        assert_eq!([bus(""), bus("/")], [("mcap".to_owned(), None), ("mcap".to_owned(), None)]);
        assert_eq!(bus(&"x".repeat(300)).0.len(), LONGEST_NAME);
    }
}
