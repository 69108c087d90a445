//! A node's end of the line: the bus, the cycle, and what happened.

use std::time::{Duration, Instant};

use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Frame;

use crate::bus::{Bus, Event, Received, Trouble};
use crate::clock::{Begun, Clock};
use crate::socket;
use crate::status::{Status, What};

/// What comes again and again is noted once in so many milliseconds. It is counted every time.
const NOTED_EVERY_MS: u64 = 1000;

/// What comes again and again, and of which identifier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Note {
    Refused(u16),
    Foreign,
    Error,
}

/// The bus, the clock of the cycle, and the status that both fill.
#[derive(Debug)]
pub(super) struct Line<B> {
    bus: B,
    clock: Clock,
    pub(super) status: Status,
    /// When each was noted last. There are as many as notes, which are few.
    noted: Vec<(Note, u64)>,
    /// When this turn no longer takes frames that are there already, though its cycle is due; `None` before the first frame.
    give_up: Option<Instant>,
    /// For how long it does.
    patience: Duration,
}

impl<B: Bus> Line<B> {
    /// The first cycle is due now.
    pub(super) fn new(bus: B, cycle_ms: u32) -> Self {
        let status = Status { bus: bus.name().to_owned(), ..Status::default() };
        let clock = Clock::new(bus.now(), cycle_ms);
        let patience = Duration::from_millis(cycle_ms.into()) / 2;
        Self { bus, clock, status, noted: Vec::new(), give_up: None, patience }
    }

    /// The next frame before the cycle is due, of whatever kind but the error kind; `None` when the cycle is to begin.
    ///
    /// What is there already when a cycle is late is taken as well, so that nobody is blamed for an answer that nobody took; but
    /// not for long: a bus that brings more than can be taken does not hold up the cycle.
    pub(super) fn next_frame(&mut self) -> Option<Received> {
        let deadline = self.clock.deadline();
        let begun = self.bus.now();
        let give_up = *self.give_up.get_or_insert(deadline.max(begun) + self.patience);
        while self.bus.now() < give_up {
            match self.bus.receive(deadline) {
                Event::Nothing if self.bus.now() >= deadline => return None,
                Event::Nothing => {}
                Event::Trouble(trouble) => self.trouble(trouble),
                Event::Up => self.up(),
                Event::Frame(frame) => {
                    self.status.received += 1;
                    if frame.kind == FrameKind::Error {
                        self.status.errors += 1;
                        self.note(Note::Error, || What::ErrorFrame(socket::error_text(&frame)));
                    } else {
                        return Some(frame);
                    }
                }
            }
        }
        None
    }

    /// The cycle begins.
    pub(super) fn begin(&mut self) -> Begun {
        self.give_up = None;
        let begun = self.clock.begin(self.bus.now());
        if begun.left_out > 0 {
            self.happen(What::Late(begun.left_out));
        }
        begun
    }

    /// Sends a frame. Tells whether the bus took it.
    pub(super) fn send(&mut self, frame: &Frame) -> bool {
        match self.bus.send(frame) {
            Ok(()) => {
                self.status.sent += 1;
                true
            }
            Err(trouble) => {
                self.status.unsent += 1;
                self.trouble(trouble);
                false
            }
        }
    }

    /// Sends the frames of a cycle. Tells whether the bus took all of them.
    pub(super) fn send_all(&mut self, frames: &[Frame]) -> bool {
        let unsent = frames.iter().filter(|frame| !self.send(frame)).count();
        // That frames are taken again is all that tells of a queue that is no longer full.
        if unsent == 0
            && !frames.is_empty()
            && matches!(self.status.trouble, Some(Trouble::Full | Trouble::Other(_)))
        {
            self.up();
        }
        unsent == 0
    }

    /// The end of a turn: what the status has of the bus and the cycle.
    pub(super) fn end(&mut self) {
        self.status.dropped = self.bus.dropped();
        self.status.cycles = self.clock.cycles();
        self.status.time_ms = self.time_ms();
    }

    /// When the cycle was due, in milliseconds since the beginning.
    pub(super) fn cycle_time_ms(&self) -> u64 {
        self.clock.time_ms()
    }

    /// Since the beginning, in milliseconds.
    pub(super) fn time_ms(&self) -> u64 {
        self.now_ns().unsigned_abs() / 1_000_000
    }

    /// Since the beginning, in nanoseconds.
    pub(super) fn now_ns(&self) -> i64 {
        i64::try_from(self.clock.elapsed(self.bus.now()).as_nanos()).unwrap_or(i64::MAX)
    }

    pub(super) fn happen(&mut self, what: What) {
        let time_ms = self.time_ms();
        self.status.happen(time_ms, what);
    }

    /// Notes what may come again and again, not too often.
    pub(super) fn note(&mut self, note: Note, what: impl FnOnce() -> What) {
        let now = self.time_ms();
        match self.noted.iter_mut().find(|(noted, _)| *noted == note) {
            Some((_, last)) if now < *last + NOTED_EVERY_MS => return,
            Some((_, last)) => *last = now,
            None => self.noted.push((note, now)),
        }
        self.happen(what());
    }

    fn trouble(&mut self, trouble: Trouble) {
        // A full queue is what comes of a bus that is off, and says less.
        let known = match &self.status.trouble {
            Some(now) => *now == trouble || trouble == Trouble::Full,
            None => false,
        };
        if !known {
            self.status.trouble = Some(trouble.clone());
            self.happen(What::Trouble(trouble));
        }
    }

    fn up(&mut self) {
        if self.status.trouble.take().is_some() {
            self.happen(What::Up);
        }
    }
}
