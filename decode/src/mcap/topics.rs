//! Which channels there are: those of the messages, of the interface that is judged and of others, and those of frames as they were.

use std::collections::HashMap;
use std::io::{self, Write};

use adsdv_oracle::candump::Direction;
use serde_json::Value as Json;

use super::frames::{DEFINED_IN, ENCODING, FrameType};
use super::schema;
use super::writer::McapWriter;
use crate::jsonl::{put_quoted, quoted};
use crate::{Catalog, Frame, Message, Origin, Value};

/// How messages in JSON and their schemas are named.
pub(super) const JSON: &str = "json";
const JSON_SCHEMA: &str = "jsonschema";

/// Of so many other interfaces there are channels of their own.
const MOST: usize = 64;

/// Adds a schema for messages in JSON.
pub(super) fn json_schema<W: Write>(writer: &mut McapWriter<W>, definition: &Json) -> Option<u16> {
    let name = definition.get("title").and_then(Json::as_str).unwrap_or_default();
    writer.schema(name, JSON_SCHEMA, definition.to_string().as_bytes())
}

/// The topic of a message of the interface that is judged, or of another one.
pub(super) fn topic(message: &Message, interface: Option<&str>) -> String {
    let whose = if message.origin == Origin::Edition { "adsdv" } else { "dbc" };
    match interface {
        None => format!("/{whose}/{}", message.name),
        Some(interface) => format!("/{whose}/{}/{}", interface.trim_matches('/'), message.name),
    }
}

/// What of a message does not depend on the frame.
struct MessageJson {
    /// Once it is in the file.
    schema: Option<u16>,
    signals: Vec<SignalJson>,
}

struct SignalJson {
    /// `"NAME":`.
    label: Vec<u8>,
    /// `,"NAME_name":`, where values have names.
    name: Option<Vec<u8>>,
}

/// The channels of one interface.
#[derive(Default)]
struct Interface {
    /// By the message's place.
    messages: HashMap<usize, Option<u16>>,
    /// By the last part of the topic.
    frames: HashMap<&'static str, Option<u16>>,
}

/// The channels of all messages and interfaces.
pub(super) struct Topics<'a> {
    catalog: &'a Catalog,
    messages: Vec<MessageJson>,
    frame_schemas: [Option<u16>; 2],
    /// Those of messages of the interface that is judged.
    judged: Interface,
    interfaces: HashMap<String, Interface>,
    /// How many frames are not in the file as they were, and of how many the signals are not.
    pub(super) frames_left_out: u64,
    pub(super) signals_left_out: u64,
}

impl<'a> Topics<'a> {
    /// Adds those that every file has: of the messages between the VCU and the AI Computer.
    pub(super) fn begin<W: Write>(catalog: &'a Catalog, writer: &mut McapWriter<W>) -> Self {
        let messages = catalog.messages().iter().map(|message| MessageJson {
            schema: None,
            signals: message
                .signals
                .iter()
                .map(|signal| {
                    let mut label = quoted(&signal.name);
                    label.push(b':');
                    let name = schema::name_property(message, signal).map(|name| {
                        let mut label = b",".to_vec();
                        put_quoted(&mut label, &name);
                        label.push(b':');
                        label
                    });
                    SignalJson { label, name }
                })
                .collect(),
        });
        let mut topics = Self {
            catalog,
            messages: messages.collect(),
            frame_schemas: [None; 2],
            judged: Interface::default(),
            interfaces: HashMap::new(),
            frames_left_out: 0,
            signals_left_out: 0,
        };
        let always = catalog.edition().bus.messages.len();
        for (place, message) in catalog.messages().iter().enumerate().take(always) {
            let channel = topics.channel(writer, place, message, None);
            topics.judged.messages.insert(place, channel);
        }
        topics
    }

    /// A new channel of a message.
    #[cold]
    fn channel<W: Write>(
        &mut self,
        writer: &mut McapWriter<W>,
        place: usize,
        message: &Message,
        interface: Option<&str>,
    ) -> Option<u16> {
        let json = self.messages.get_mut(place)?;
        if json.schema.is_none() {
            json.schema = json_schema(writer, &schema::of_message(message));
        }
        let mut metadata = vec![("id", message.id_text())];
        if message.origin == Origin::Edition {
            metadata.push(("edition", self.catalog.edition().version.to_owned()));
        }
        let metadata: Vec<_> = metadata.iter().map(|(key, value)| (*key, value.as_str())).collect();
        writer.channel(json.schema?, &topic(message, interface), JSON, &metadata)
    }

    /// The channels of an interface; `None` where there are too many.
    fn interface(&mut self, name: &str) -> Option<&mut Interface> {
        if !self.interfaces.contains_key(name) {
            if self.interfaces.len() >= MOST {
                return None;
            }
            self.interfaces.insert(name.to_owned(), Interface::default());
        }
        self.interfaces.get_mut(name)
    }

    /// Writes a frame as it was.
    pub(super) fn frame<W: Write>(
        &mut self,
        writer: &mut McapWriter<W>,
        frame: &Frame<'_>,
    ) -> io::Result<()> {
        let record = frame.record;
        let Some(kind) = FrameType::of(record.kind) else {
            self.frames_left_out += 1;
            return Ok(());
        };
        let last = kind.topic(record.direction);
        let known = self.interface(record.interface).map(|channels| channels.frames.get(last).copied());
        let channel = match known {
            None => None,
            Some(Some(channel)) => channel,
            Some(None) => {
                let channel = self.frame_channel(writer, kind, record.interface, record.direction);
                if let Some(channels) = self.interface(record.interface) {
                    channels.frames.insert(last, channel);
                }
                channel
            }
        };
        let Some(channel) = channel else {
            self.frames_left_out += 1;
            return Ok(());
        };
        writer.message(channel, record.time_ns, |out| kind.put(out, record))
    }

    #[cold]
    fn frame_channel<W: Write>(
        &mut self,
        writer: &mut McapWriter<W>,
        kind: FrameType,
        interface: &str,
        direction: Option<Direction>,
    ) -> Option<u16> {
        let schema = self.frame_schemas.get_mut(FrameType::ALL.iter().position(|one| *one == kind)?)?;
        if schema.is_none() {
            *schema = writer.schema(kind.name(), DEFINED_IN, kind.definition().as_bytes());
        }
        // An interface of MCAP begins so already.
        let before = if interface.starts_with('/') { "" } else { "/can/" };
        let topic = format!("{before}{}/{}", interface.trim_end_matches('/'), kind.topic(direction));
        writer.channel((*schema)?, &topic, ENCODING, &[])
    }

    /// Writes the signals of a frame of a message.
    pub(super) fn signals<W: Write>(
        &mut self,
        writer: &mut McapWriter<W>,
        frame: &Frame<'_>,
        is_judged: bool,
    ) -> io::Result<()> {
        let (Some((place, message)), record) = (frame.message, frame.record) else { return Ok(()) };
        let channels = if is_judged { Some(&mut self.judged) } else { self.interface(record.interface) };
        let channel = match channels.map(|channels| channels.messages.get(&place).copied()) {
            None => None,
            Some(Some(channel)) => channel,
            Some(None) => {
                let interface = (!is_judged).then_some(record.interface);
                let channel = self.channel(writer, place, message, interface);
                let channels =
                    if is_judged { Some(&mut self.judged) } else { self.interface(record.interface) };
                if let Some(channels) = channels {
                    channels.messages.insert(place, channel);
                }
                channel
            }
        };
        let (Some(channel), Some(json)) = (channel, self.messages.get(place)) else {
            self.signals_left_out += 1;
            return Ok(());
        };
        writer.message(channel, record.time_ns, |out| json.put(out, message, record.data))
    }
}

impl MessageJson {
    /// Appends the signals that data has, as an object.
    fn put(&self, out: &mut Vec<u8>, message: &Message, data: &[u8]) {
        out.push(b'{');
        let mut first = true;
        for (signal, json) in message.signals.iter().zip(&self.signals) {
            let Some(bits) = signal.place.bits(data).filter(|_| message.has(signal, data)) else { continue };
            let value = signal.value(bits);
            // JSON has no word for a float that is no number.
            if matches!(value, Value::Real(number) if !number.is_finite()) {
                continue;
            }
            if !first {
                out.push(b',');
            }
            first = false;
            out.extend_from_slice(&json.label);
            value.put(out, b"null");
            let Some(label) = &json.name else { continue };
            out.extend_from_slice(label);
            if let Some(name) = signal.value_name(bits) {
                put_quoted(out, name);
            } else {
                out.push(b'"');
                value.put(out, b"");
                out.push(b'"');
            }
        }
        out.push(b'}');
    }
}
