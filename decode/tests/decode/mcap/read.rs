//! A reader of files that are sound, of no more than these tests need.

use std::collections::BTreeMap;
use std::io::{Cursor, Read as _};

use adsdv_decode::{Catalog, Options, Recording, Summary, mcap};
use serde_json::Value as Json;

/// A message of a channel in JSON.
#[derive(Debug)]
pub(crate) struct Said {
    pub(crate) topic: String,
    pub(crate) time: u64,
    pub(crate) says: Json,
}

/// What a file has.
#[derive(Debug, Default)]
pub(crate) struct Contents {
    /// The messages in JSON, as they stand.
    pub(crate) said: Vec<Said>,
    /// How many others there are.
    pub(crate) others: usize,
    /// The schema of each topic in JSON.
    pub(crate) schemas: BTreeMap<String, Json>,
    pub(crate) topics: Vec<String>,
}

/// A log as MCAP, with what came of it and the notes.
pub(crate) fn written(log: &str, catalog: &Catalog, options: &Options) -> (Vec<u8>, Summary, Vec<String>) {
    let opened = adsdv_formats::open(Cursor::new(log.to_owned())).expect("a log");
    let recording = Recording::begin(opened, options).expect("a frame");
    let mut out = Vec::new();
    let mut sink = mcap(catalog, options, &mut out).expect("it was built in");
    let summary = recording.decode(catalog, &mut *sink, |_| {}).expect("a vector takes everything");
    let notes = sink.notes();
    drop(sink);
    (out, summary, notes)
}

/// What a log of an edition that is named becomes.
pub(crate) fn contents(log: &str, catalog: &Catalog) -> Contents {
    let options = Options { edition: Some(catalog.edition()), ..Options::default() };
    Contents::of(&written(log, catalog, &options).0)
}

fn number(bytes: &[u8], at: usize, len: usize) -> usize {
    bytes[at..at + len].iter().rev().fold(0, |number, byte| number << 8 | usize::from(*byte))
}

fn text(bytes: &[u8], at: &mut usize) -> String {
    let begin = *at + 4;
    let end = begin + number(bytes, *at, 4);
    *at = end;
    String::from_utf8(bytes[begin..end].to_vec()).expect("text")
}

impl Contents {
    pub(crate) fn of(file: &[u8]) -> Self {
        assert!(file.starts_with(b"\x89MCAP0\r\n") && file.ends_with(b"\x89MCAP0\r\n"));
        let (mut contents, mut schemas, mut channels) = (Self::default(), BTreeMap::new(), BTreeMap::new());
        contents.records(&file[8..], &mut schemas, &mut channels);
        contents
    }

    fn records(
        &mut self,
        mut rest: &[u8],
        schemas: &mut BTreeMap<usize, (String, String)>,
        channels: &mut BTreeMap<usize, (String, bool)>,
    ) {
        while !rest.is_empty() {
            let len = number(rest, 1, 8);
            let (kind, body) = (rest[0], &rest[9..9 + len]);
            rest = &rest[9 + len..];
            match kind {
                0x03 => {
                    let mut at = 2;
                    let (_, encoding) = (text(body, &mut at), text(body, &mut at));
                    schemas.insert(number(body, 0, 2), (encoding, text(body, &mut at)));
                }
                0x04 => {
                    let mut at = 4;
                    let (topic, encoding) = (text(body, &mut at), text(body, &mut at));
                    let (schema_encoding, schema) = &schemas[&number(body, 2, 2)];
                    let is_json = encoding == "json";
                    assert_eq!(is_json, schema_encoding == "jsonschema", "{topic}");
                    if is_json {
                        let schema = serde_json::from_str(schema).expect("a schema");
                        self.schemas.insert(topic.clone(), schema);
                    }
                    assert!(!self.topics.contains(&topic), "{topic} twice");
                    self.topics.push(topic.clone());
                    channels.insert(number(body, 0, 2), (topic, is_json));
                }
                0x05 => match &channels[&number(body, 0, 2)] {
                    (topic, true) => self.said.push(Said {
                        topic: topic.clone(),
                        time: number(body, 6, 8) as u64,
                        says: serde_json::from_slice(&body[22..]).expect("JSON"),
                    }),
                    (_, false) => self.others += 1,
                },
                0x06 => {
                    let mut at = 28;
                    assert_eq!(text(body, &mut at), "lz4");
                    let mut unpacked = Vec::new();
                    let mut packed = lz4_flex::frame::FrameDecoder::new(&body[at + 8..]);
                    packed.read_to_end(&mut unpacked).expect("a chunk");
                    assert_eq!(unpacked.len(), number(body, 16, 8));
                    self.records(&unpacked, schemas, channels);
                }
                // The end of the data: behind it stands the summary, which the reader of Python sees through.
                0x0F => return,
                _ => {}
            }
        }
    }

    /// What was said on a topic.
    pub(crate) fn on<'a>(&'a self, topic: &'a str) -> impl Iterator<Item = &'a Said> {
        self.said.iter().filter(move |said| said.topic == topic)
    }
}
