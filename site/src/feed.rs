//! A stream of lines, such as the frames of a bus: one writes, and every page that is open reads all of them.
//!
//! Lines have numbers, so that a page whose connection broke goes on where it was. What was written last is kept; of what was before, a
//! page is told how much it missed.

use std::collections::VecDeque;
use std::fmt;
use std::mem;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// So many bytes of lines are kept: six minutes of a bus of 500 kbit/s at full load.
const KEPT: usize = 64 << 20;
/// So many bytes go together.
const TOGETHER: usize = 64 << 10;

/// A stream that can be written and read from several threads.
///
/// ```
/// use std::time::Duration;
///
/// let feed = adsdv_site::Feed::new("can0");
/// feed.line("(1.000000) can0 520#00");
/// let some = feed.after(0, Duration::ZERO);
/// assert_eq!((some.text.as_str(), some.next, some.missed), ("(1.000000) can0 520#00\n", 1, 0));
/// ```
#[derive(Clone)]
pub struct Feed {
    shared: Arc<Shared>,
}

struct Shared {
    name: String,
    /// By which edition it is judged, empty where its lines are to tell, and with which readings.
    judged: Vec<String>,
    /// Tells this stream from another at the same address.
    run: String,
    state: Mutex<State>,
    news: Condvar,
}

#[derive(Default)]
struct State {
    chunks: VecDeque<Chunk>,
    /// What is written, and in no chunk yet.
    open: String,
    /// The number of the next line.
    next: u64,
    bytes: usize,
    end: Option<String>,
    readers: usize,
}

/// Some lines, with the number of the first.
struct Chunk {
    first: u64,
    text: Arc<str>,
}

/// What comes after a line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lines {
    /// Lines, each with its end.
    pub text: String,
    /// The number of the line that comes next.
    pub next: u64,
    /// How many lines before these are not kept any more.
    pub missed: u64,
    /// Why nothing comes behind them.
    pub end: Option<String>,
}

impl Feed {
    /// A stream with a name for people, which is judged by the edition that its lines tell.
    pub fn new(name: &str) -> Self {
        Self::judged(name, None, &[])
    }

    /// The same, judged by this edition and with these readings, each as `reading=choice`.
    pub fn judged(name: &str, edition: Option<&str>, readings: &[String]) -> Self {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let run = format!("{:x}-{:x}", now.as_nanos(), std::process::id());
        let judged =
            std::iter::once(edition.unwrap_or_default().to_owned()).chain(readings.iter().cloned()).collect();
        let (state, news) = (Mutex::default(), Condvar::new());
        Self { shared: Arc::new(Shared { name: name.to_owned(), judged, run, state, news }) }
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.shared.name
    }

    /// By what it is judged: the edition, and then readings.
    pub(crate) fn judged_by(&self) -> &[String] {
        &self.shared.judged
    }

    /// What tells it from another stream at the same address.
    pub(crate) fn run(&self) -> &str {
        &self.shared.run
    }

    /// Writes a line.
    pub fn line(&self, line: &str) {
        let mut state = self.state();
        state.open.push_str(line);
        state.open.push('\n');
        state.next += 1;
        if state.open.len() >= TOGETHER {
            state.close();
        }
        drop(state);
        self.shared.news.notify_all();
    }

    /// Nothing comes any more, and why. Waits so long at most for the pages to have read all.
    pub fn end(&self, why: &str, patience: Duration) {
        let mut state = self.state();
        state.end = Some(why.to_owned());
        self.shared.news.notify_all();
        let read = self.shared.news.wait_timeout_while(state, patience, |state| state.readers > 0);
        drop(read);
    }

    /// The lines from this number on, as many as go together; if there are none, waits so long for some. Numbers count from 0.
    pub fn after(&self, line: u64, patience: Duration) -> Lines {
        let state = self.state();
        let nothing = |state: &mut State| state.next <= line && state.end.is_none();
        let (mut state, _) = self
            .shared
            .news
            .wait_timeout_while(state, patience, nothing)
            .unwrap_or_else(PoisonError::into_inner);
        state.close();
        state.from(line)
    }

    /// A page reads, until this is dropped; `None` where that many read already.
    pub(crate) fn reader(&self, most: usize) -> Option<Reader> {
        let mut state = self.state();
        let more = state.readers < most;
        state.readers += usize::from(more);
        more.then(|| Reader { feed: self.clone() })
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.shared.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl fmt::Debug for Feed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Feed").field("name", &self.shared.name).finish_non_exhaustive()
    }
}

/// Somebody who reads.
pub(crate) struct Reader {
    pub(crate) feed: Feed,
}

impl Drop for Reader {
    fn drop(&mut self) {
        self.feed.state().readers -= 1;
        self.feed.shared.news.notify_all();
    }
}

impl State {
    /// Puts what is written into a chunk, and leaves out what is too old.
    fn close(&mut self) {
        if self.open.is_empty() {
            return;
        }
        let text: Arc<str> = mem::take(&mut self.open).into();
        let lines = text.bytes().filter(|byte| *byte == b'\n').count() as u64;
        self.bytes += text.len();
        self.chunks.push_back(Chunk { first: self.next - lines, text });
        while self.bytes > KEPT
            && let Some(old) = self.chunks.pop_front()
        {
            self.bytes -= old.text.len();
        }
    }

    fn from(&self, line: u64) -> Lines {
        let first = self.chunks.front().map_or(self.next, |chunk| chunk.first);
        let begin = line.clamp(first, self.next);
        let place = self.chunks.partition_point(|chunk| chunk.first <= begin).saturating_sub(1);
        let (mut text, mut next) = (String::new(), begin);
        for (place, chunk) in self.chunks.iter().enumerate().skip(place) {
            let end = self.chunks.get(place + 1).map_or(self.next, |chunk| chunk.first);
            let before = usize::try_from(begin.saturating_sub(chunk.first)).unwrap_or(usize::MAX);
            text.extend(chunk.text.split_inclusive('\n').skip(before));
            next = end;
            if text.len() >= TOGETHER {
                break;
            }
        }
        let end = self.end.clone().filter(|_| next == self.next);
        Lines { text, next, missed: begin.saturating_sub(line), end }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(text: &str) -> Vec<u64> {
        text.lines()
            .map(|line| line.split(' ').next().and_then(|word| word.parse().ok()).expect("a number"))
            .collect()
    }

    #[test]
    fn every_line_comes_once_and_in_order_to_everybody() {
        const LINES: u64 = 50_000;
        let feed = Feed::new("can0");
        let readers: Vec<_> = (0..3)
            .map(|_| {
                let feed = feed.clone();
                std::thread::spawn(move || {
                    let (mut at, mut read) = (0, Vec::new());
                    loop {
                        let Lines { text, next, missed, end } = feed.after(at, Duration::from_secs(5));
                        assert_eq!(missed, 0);
                        read.extend(numbers(&text));
                        at = next;
                        if end.is_some() {
                            return read;
                        }
                    }
                })
            })
            .collect();
        (0..LINES).for_each(|number| feed.line(&format!("{number} and so on")));
        feed.end("over", Duration::ZERO);
        for reader in readers {
            assert!(reader.join().expect("it reads").into_iter().eq(0..LINES));
        }
    }

    #[test]
    fn who_comes_back_goes_on_where_it_was_and_who_is_too_late_is_told_how_much_it_missed() {
        let feed = Feed::new("can0");
        let long = "x".repeat(1 << 10);
        let lines = 2 * (KEPT as u64 >> 10);
        (0..lines).for_each(|number| feed.line(&format!("{number} {long}")));
        let late = feed.after(7, Duration::ZERO);
        let first = numbers(&late.text)[0];
        assert_eq!(late.missed, first - 7);
        assert!(first > lines / 3 && first < lines, "{first}");
        assert_eq!(late.next, first + numbers(&late.text).len() as u64);
        let back = feed.after(lines - 2, Duration::ZERO);
        assert_eq!((numbers(&back.text), back.missed), (vec![lines - 2, lines - 1], 0));
        assert_eq!(feed.after(lines, Duration::ZERO), Lines { next: lines, ..Lines::default() });
    }
}
