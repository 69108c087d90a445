//! Somebody who is asked whether reading is to go on, since what is compressed may stand for much more than it is.

use std::io::{self, Read};
use std::sync::Arc;

use crate::Source;

/// Asked before each piece is read; what it fails with ends the recording.
pub(crate) type Watch = Arc<dyn Fn() -> io::Result<()> + Send + Sync>;

/// The source, about which the watch is asked; itself where there is none.
pub(crate) fn watched(source: Source, watch: Option<Watch>) -> Source {
    match watch {
        Some(watch) => Box::new(Watched { source, watch }),
        None => source,
    }
}

struct Watched {
    source: Source,
    watch: Watch,
}

impl Read for Watched {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        (self.watch)()?;
        self.source.read(room)
    }
}
