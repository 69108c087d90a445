//! The reader of databases of a user's own (DBC), on any bytes, and what decodes by what it has read.

use std::io::Cursor;

use adsdv_decode::{
    Catalog, Csv, Database, DbcError, JsonLines, Options, Recording, Sink, Text, TextLayout, VcdFile,
};
use adsdv_formats::open;
use adsdv_spec::Edition;

use super::Bytes;

/// So many messages of a database are decoded.
const MESSAGES: usize = 16;

/// Reads the bytes as a database, behind those of a frame: it is refused with a sentence, or frames of its messages are decoded in
/// every form, and what comes out can be read.
pub fn body(bytes: &[u8]) {
    let (edition, data, database) = read(bytes);
    let database = match database {
        Ok(database) => database,
        Err(error) => {
            // Rubbish in a database does not reach a terminal.
            let text = error.to_string();
            assert!(!text.is_empty() && !text.chars().any(char::is_control), "{text:?}");
            return;
        }
    };
    for message in &database.messages {
        let all: Vec<_> = message.readings(&data).collect();
        for len in 0..data.len() {
            // A multiplexer that a short frame does not have chooses nothing.
            let short = message.readings(data.get(..len).unwrap_or_default());
            assert!({ short }.all(|reading| all.contains(&reading)), "{} of {len} bytes", message.name);
        }
    }
    let log = log(&database, data);
    let catalog = Catalog::with(edition, &[database]);
    for message in catalog.messages() {
        assert!(catalog.named(&message.name).is_some(), "{}", message.name);
    }
    let mut json = Vec::new();
    decode(&log, &catalog, &mut JsonLines::new(&catalog, &mut json, false));
    for line in json.split(|byte| *byte == b'\n').filter(|line| !line.is_empty()) {
        let value: Result<serde_json::Value, _> = serde_json::from_slice(line);
        assert!(value.is_ok_and(|value| value.is_object()), "{}", String::from_utf8_lossy(line));
    }
    for layout in [TextLayout::Lines, TextLayout::SingleLine] {
        let mut text = Vec::new();
        decode(&log, &catalog, &mut Text::new(&catalog, &mut text, layout, false));
        assert!(str::from_utf8(&text).is_ok());
    }
    let (mut csv, mut vcd) = (Vec::new(), Vec::new());
    decode(&log, &catalog, &mut Csv::new(&catalog, &mut csv, false));
    decode(&log, &catalog, &mut VcdFile::new(&catalog, &mut vcd));
    assert!(str::from_utf8(&csv).is_ok() && str::from_utf8(&vcd).is_ok());
}

/// An edition, the data of a frame, and what comes of the rest as a database.
pub fn read(bytes: &[u8]) -> (&'static Edition, [u8; 8], Result<Database, DbcError>) {
    let mut bytes = Bytes::new(bytes);
    (bytes.edition(), bytes.any(), Database::read("team.dbc", bytes.rest()))
}

/// A frame of each of the first messages.
fn log(database: &Database, data: [u8; 8]) -> String {
    let frame = |message: &adsdv_decode::Message| {
        let digits = format!("{:016X}", u64::from_be_bytes(data));
        let digits = digits.get(..2 * message.len).unwrap_or(&digits);
        format!("(1.000000) can0 {}#{digits}\n", message.id_text())
    };
    database.messages.iter().take(MESSAGES).map(frame).collect()
}

fn decode(log: &str, catalog: &Catalog, sink: &mut impl Sink) {
    let Ok(log) = open(Cursor::new(log.to_owned())) else { return };
    let Ok(recording) = Recording::begin(log, &Options::default()) else { return };
    let summary = recording.decode(catalog, sink, |_| {}).expect("memory takes it");
    assert_eq!(summary.broken, 0, "the frames are ours");
}
