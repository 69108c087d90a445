//! `adsdv watch -`: frames from standard input, as another program hears them.
//!
//! For adapters that only python-can or a vendor's tool reads, on any system. What time it is the lines say, and they alone: a pipe stutters, and
//! what comes late through it was not late on the bus. So nothing is judged by silence, either, until a line comes that proves it.

use std::io::{self, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use adsdv_can::live::Traffic;
use adsdv_formats::{Entries as _, Entry, Log};
use adsdv_oracle::log::{LogError, LogJudge};

use super::audience::Audience;
use super::news::News;
use crate::error::Error;

/// The interface that stands for standard input.
pub(super) const STDIN: &str = "-";
/// What a report calls it.
pub(super) const NAME: &str = "standard input";
/// After so much time of the frames it is looked what the car waits for.
const LOOK_NS: i64 = 100_000_000;

/// What was heard.
pub(super) struct Piped {
    pub(super) judge: LogJudge,
    pub(super) traffic: Traffic,
    pub(super) audience: Audience,
    pub(super) news: News,
    /// How many lines came.
    pub(super) lines: u64,
    /// Why no more could be read.
    pub(super) failure: Option<Error>,
}

/// Opens standard input: nothing is waited for longer than until `stop` is set.
pub(super) fn open(stop: &Arc<AtomicBool>) -> Result<Log, Error> {
    let source = Stoppable { source: io::stdin(), stop: Arc::clone(stop) };
    adsdv_formats::open(source).map_err(|error| Error::recording(NAME, &error))
}

/// Judges what comes, until it ends, it is stopped, or nothing can be printed any more.
pub(super) fn watch(
    mut log: Log,
    judge: LogJudge,
    audience: Audience,
    mut news: News,
    stop: &AtomicBool,
) -> Piped {
    news.lines.begin(NAME, audience.log());
    let mut piped = Piped { judge, traffic: Traffic::default(), audience, news, lines: 0, failure: None };
    let mut looked_ns = i64::MIN;
    while piped.news.lines.is_read() && !stop.load(Ordering::Relaxed) {
        let entry = match log.next_entry() {
            Ok(Some(entry)) => entry,
            Ok(None) => break,
            Err(error) => {
                piped.failure = Some(Error::log(NAME, &LogError::Read(error)));
                break;
            }
        };
        piped.hear(&entry);
        piped.news.print(&mut piped.judge);
        if let Entry::Frame(record) = &entry
            && record.time_ns.saturating_sub(looked_ns) >= LOOK_NS
        {
            looked_ns = record.time_ns;
            piped.news.print_waits(&piped.judge);
        }
    }
    piped.lines = log.count();
    piped.judge.decide();
    piped.news.print(&mut piped.judge);
    piped
}

impl Piped {
    fn hear(&mut self, entry: &Entry<'_>) {
        match entry {
            Entry::Frame(record) => {
                self.traffic.count(record.kind, record.time_ns);
                self.judge.frame(record);
                self.audience.frame(record);
            }
            Entry::Dropped(dropped) => {
                self.traffic.dropped += dropped.count;
                self.judge.dropped(dropped);
                self.audience.dropped(dropped);
            }
            Entry::Broken(error) => self.judge.broken(*error),
        }
        self.audience.flush_now_and_then();
    }
}

/// A source that ends when it is to stop, though it would have more to give.
struct Stoppable<R> {
    source: R,
    stop: Arc<AtomicBool>,
}

#[cfg(unix)]
impl<R: Read + std::os::fd::AsFd> Read for Stoppable<R> {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};

        const PATIENCE: Timespec = Timespec { tv_sec: 0, tv_nsec: 50_000_000 };
        while !self.stop.load(Ordering::Relaxed) {
            let mut fds = [PollFd::new(&self.source, PollFlags::IN)];
            match poll(&mut fds, Some(&PATIENCE)) {
                Ok(0) | Err(rustix::io::Errno::INTR) => {}
                Ok(_) => return self.source.read(room),
                Err(error) => return Err(error.into()),
            }
        }
        Ok(0)
    }
}

#[cfg(not(unix))]
impl<R: Read> Read for Stoppable<R> {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        if self.stop.load(Ordering::Relaxed) { Ok(0) } else { self.source.read(room) }
    }
}
