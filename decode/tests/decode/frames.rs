//! Recordings made for a test, and what they decode to.

use std::fmt::Write as _;
use std::io::Cursor;

use adsdv_decode::{Catalog, Csv, JsonLines, Options, Recording, Sink, Summary, Text, TextLayout, VcdFile};
use adsdv_spec::Edition;

/// The formats.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Format {
    Lines,
    SingleLine,
    Csv,
    JsonLines,
    Vcd,
}

/// What a log decodes to with this catalog, as text.
pub(crate) fn decode(log: &str, catalog: &Catalog, format: Format) -> (String, Summary, Vec<String>) {
    let opened = adsdv_formats::open(Cursor::new(log.to_owned())).expect("a log");
    let options = Options { edition: Some(catalog.edition()), ..Options::default() };
    let recording = Recording::begin(opened, &options).expect("a frame");
    let mut out = Vec::new();
    let mut sink: Box<dyn Sink + '_> = match format {
        Format::Lines => Box::new(Text::new(catalog, &mut out, TextLayout::Lines, false)),
        Format::SingleLine => Box::new(Text::new(catalog, &mut out, TextLayout::SingleLine, false)),
        Format::Csv => Box::new(Csv::new(catalog, &mut out, false)),
        Format::JsonLines => Box::new(JsonLines::new(catalog, &mut out, false)),
        Format::Vcd => Box::new(VcdFile::new(catalog, &mut out)),
    };
    let summary = recording.decode(catalog, &mut *sink, |_| {}).expect("a vector takes everything");
    let notes = sink.notes();
    drop(sink);
    (String::from_utf8(out).expect("text"), summary, notes)
}

/// Random frames of every message of a catalog, so many of each, from a fixed seed.
pub(crate) fn random(catalog: &Catalog, each: usize) -> String {
    let mut random = fastrand::Rng::with_seed(1);
    let (mut log, mut time) = (String::new(), 0);
    for _ in 0..each {
        for message in catalog.messages() {
            time += 1;
            let _ = write!(log, "(1.{time:06}) can0 {}#", message.id_text());
            for _ in 0..message.len {
                let _ = write!(log, "{:02X}", random.u8(..));
            }
            log.push('\n');
        }
    }
    log
}

/// The messages of an edition.
pub(crate) fn catalog(edition: &'static Edition) -> Catalog {
    Catalog::of(edition)
}
