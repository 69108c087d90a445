//! A recording of any format, opened.

use std::io::{self, Read};
use std::sync::Arc;

use adsdv_oracle::candump::{Entries, Entry, ReadError, Reader, Unit};

use crate::asc::Asc;
use crate::csv::Csv;
use crate::savvycan::SavvyCan;
use crate::text::TextReader;
use crate::trc::Trc;
use crate::unpack::unpack;
use crate::watch::{Watch, watched};
use crate::{Format, OpenError, Source, blf, foreign};

/// A recording of any format, whose entries come one after the other.
pub struct Log {
    format: Format,
    reader: Inner,
}

enum Inner {
    /// Most are of this format, and it is the fastest: nothing is looked up for each frame.
    Candump(Reader<Source>),
    Other(Box<dyn Entries + Send>),
}

/// Recognises the format of a recording by how it begins, unpacks it, and reads it as that.
///
/// Of a source that is live no more is waited for than its first line.
///
/// # Errors
///
/// Fails if the source does before its first byte, or if it is a file of a kind that is known, and not read: by nobody here, or not by a
/// build without the feature for it.
pub fn open(source: impl Read + Send + 'static) -> Result<Log, OpenError> {
    begin(Box::new(source), None)
}

/// The same, with somebody who is asked whether to go on: before each piece of what is unpacked, and ten times a second while a compressed
/// source gives nothing, by the thread that reads the log. What `watch` fails with is what reading the log fails with; its kind is not to be
/// [`Interrupted`](io::ErrorKind::Interrupted), after which reading goes on.
///
/// # Errors
///
/// As [`open`], and if `watch` does.
pub fn open_watched(
    source: impl Read + Send + 'static,
    watch: impl Fn() -> io::Result<()> + Send + Sync + 'static,
) -> Result<Log, OpenError> {
    begin(Box::new(source), Some(Arc::new(watch)))
}

fn begin(source: Source, watch: Option<Watch>) -> Result<Log, OpenError> {
    let (head, source) = unpack(source, watch.as_ref()).map_err(OpenError::Read)?;
    let source = watched(source, watch);
    if let Some(foreign) = foreign::find(&head) {
        return Err(OpenError::Foreign(foreign));
    }
    let format = Format::of(&head);
    let reader = match format {
        Format::Candump => Inner::Candump(Reader::new(source)),
        Format::Blf => Inner::Other(Box::new(blf::BlfReader::new(source))),
        #[cfg(feature = "mcap")]
        Format::Mcap => Inner::Other(Box::new(crate::mcap::McapReader::new(source))),
        #[cfg(not(feature = "mcap"))]
        Format::Mcap => return Err(OpenError::NotBuilt { format, feature: "mcap" }),
        Format::Asc => Inner::Other(Box::new(TextReader::new(source, Asc::new(), "1"))),
        Format::Trc => Inner::Other(Box::new(TextReader::new(source, Trc::new(), "1"))),
        Format::Csv => Inner::Other(Box::new(TextReader::new(source, Csv, "can"))),
        Format::SavvyCan => Inner::Other(Box::new(TextReader::new(source, SavvyCan::new(), "0"))),
    };
    Ok(Log { format, reader })
}

impl Log {
    /// The format that it has.
    pub const fn format(&self) -> Format {
        self.format
    }
}

impl Entries for Log {
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        match &mut self.reader {
            Inner::Candump(reader) => reader.next_record(),
            Inner::Other(reader) => reader.next_entry(),
        }
    }

    fn count(&self) -> u64 {
        match &self.reader {
            Inner::Candump(reader) => reader.count(),
            Inner::Other(reader) => reader.count(),
        }
    }

    fn unit(&self) -> Unit {
        match &self.reader {
            Inner::Candump(reader) => reader.unit(),
            Inner::Other(reader) => reader.unit(),
        }
    }
}
