//! A thread that listens and does nothing else, so that nothing is lost while the rest judges, prints and writes.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant, SystemTime};

use adsdv_can::bus::{Event, Listen};

/// So much may wait to be judged: more than three seconds of ten times a full bus of 500 kbit/s. Beyond that the kernel drops
/// frames, and counts them.
const ROOM: usize = 1 << 17;
/// For so long nothing comes before the thread reports that nothing came.
const SILENCE: Duration = Duration::from_millis(50);
/// So much is handed over at once.
const BATCH: usize = 4096;

/// What was heard.
#[derive(Debug)]
pub(super) struct Arrival {
    pub(super) event: Event,
    /// How many frames had been dropped by then.
    pub(super) dropped: u64,
    /// When it was heard, in nanoseconds since 1970; of nothing, up to when it is certain that nothing came.
    pub(super) now_ns: i64,
}

/// The thread, and what it has heard.
#[derive(Debug)]
pub(super) struct Ears {
    heard: Receiver<Arrival>,
    stop: Arc<AtomicBool>,
    thread: JoinHandle<()>,
}

impl Ears {
    pub(super) fn start(bus: impl Listen + Send + 'static) -> io::Result<Self> {
        let (tell, heard) = sync_channel(ROOM);
        let stop = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&stop);
        let thread =
            thread::Builder::new().name("ears".to_owned()).spawn(move || listen(bus, &tell, &theirs))?;
        Ok(Self { heard, stop, thread })
    }

    /// What has been heard: waits for the first, but not for long.
    pub(super) fn take(&self) -> Vec<Arrival> {
        match self.heard.recv_timeout(SILENCE) {
            Ok(first) => std::iter::once(first).chain(self.heard.try_iter()).take(BATCH).collect(),
            Err(RecvTimeoutError::Timeout) => Vec::new(),
            Err(RecvTimeoutError::Disconnected) => {
                // The thread ends before it is stopped by a mistake only; then at least this one does not spin.
                thread::sleep(SILENCE);
                Vec::new()
            }
        }
    }

    /// Stops listening, and hands out what is left.
    pub(super) fn finish(self) -> Vec<Arrival> {
        self.stop.store(true, Ordering::Release);
        // The thread may wait for room.
        let mut rest = Vec::new();
        while !self.thread.is_finished() {
            rest.extend(self.heard.recv_timeout(Duration::from_millis(1)));
        }
        rest.extend(self.heard.try_iter());
        rest
    }
}

fn listen(mut bus: impl Listen, tell: &SyncSender<Arrival>, stop: &AtomicBool) {
    // Once stopped, what is there already is still taken, but no longer than this.
    let mut last = None;
    loop {
        if last.is_none() && stop.load(Ordering::Acquire) {
            last = Some(Instant::now() + SILENCE);
        }
        let until = if last.is_some() { Instant::now() } else { Instant::now() + SILENCE };
        // A thread may be held up behind the waiting as well, while frames come.
        let asked = now_ns();
        let event = bus.receive(until);
        let nothing = event == Event::Nothing;
        if nothing && last.is_some() {
            return;
        }
        let now_ns = if nothing { asked } else { now_ns() };
        let heard = Arrival { event, dropped: bus.dropped(), now_ns };
        // What was taken from the bus is handed over, however late it is.
        if tell.send(heard).is_err() || last.is_some_and(|last| Instant::now() >= last) {
            return;
        }
    }
}

pub(super) fn now_ns() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}
