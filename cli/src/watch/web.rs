//! `adsdv watch --web`: what is heard, streamed to a page of this machine.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use adsdv_oracle::candump::{Dropped, Record, write_dropped, write_record};
use adsdv_site::{Feed, Site};

use crate::args::{ChosenEdition, WatchArgs};
use crate::error::Error;

/// So long the pages may take at most to read the last lines.
const PATIENCE: Duration = Duration::from_secs(1);
/// So often it is looked whether the command is to stop.
const LOOK: Duration = Duration::from_millis(50);

/// Pages that show what is heard.
pub(super) struct Pages {
    feed: Feed,
    line: Vec<u8>,
}

impl Pages {
    /// Serves the page, if it is asked for, and says where on standard error: what is printed is the same with it and without.
    pub(super) fn serve(args: &WatchArgs, chosen: ChosenEdition, name: &str) -> Result<Option<Self>, Error> {
        if !args.web {
            return Ok(None);
        }
        let edition = chosen.asked_for().map(|_| chosen.edition().version);
        let readings: Vec<String> = args.readings.iter().map(ToString::to_string).collect();
        let feed = Feed::judged(name, edition, &readings);
        let site =
            Site::live(args.port, &feed).map_err(|error| Error::port(args.port, error.source_error()))?;
        anstream::eprintln!("http://{}/ shows it", site.address());
        let serve = move || site.serve();
        thread::Builder::new()
            .name("web".to_owned())
            .spawn(serve)
            .map_err(|error| Error::system("threads", &error))?;
        Ok(Some(Self { feed, line: Vec::new() }))
    }

    /// A frame was heard.
    pub(super) fn frame(&mut self, record: &Record<'_>) {
        self.send(|line| write_record(line, record));
    }

    /// Frames were lost before the next one.
    pub(super) fn dropped(&mut self, dropped: &Dropped<'_>) {
        self.send(|line| write_dropped(line, dropped));
    }

    /// As the log has it.
    fn send(&mut self, write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) {
        self.line.clear();
        // Memory takes it.
        let _ = write(&mut self.line);
        self.feed.line(String::from_utf8_lossy(&self.line).trim_end());
    }

    /// Nothing comes any more. Where the command was not stopped, pages may still be opened until it is.
    pub(super) fn end(self, why: &str, stop: &Arc<AtomicBool>, stays: bool) {
        self.feed.end(why, PATIENCE);
        while stays && !stop.load(Ordering::Relaxed) {
            thread::sleep(LOOK);
        }
    }
}
