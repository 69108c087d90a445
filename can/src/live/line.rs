//! A node's end of the line: the bus, the cycle, and what happened.

use std::time::{Duration, Instant};

use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Frame;
use adsdv_spec::{Edition, Timing};

use crate::bus::{Bus, Disturbance, Event, Received};
use crate::clock::{Begun, Clock};
use crate::live::note::{LastNotes, Note};
use crate::live::partner::Partner;
use crate::socket;
use crate::status::{HappeningKind, Status};

/// For so long a bus has to take all frames of every cycle before its queue is no longer full. One that has room for a frame
/// now and then is full.
const WHOLE_MS: u64 = 1000;

/// The bus, the clock of the cycle, and the status that both fill.
#[derive(Debug)]
pub(super) struct LiveBus<B> {
    bus: B,
    clock: Clock,
    pub(super) status: Status,
    notes: LastNotes,
    /// What was reported of the bus last, which is not how it stands if that changes all the time.
    reported_disturbance: Option<Disturbance>,
    /// Since when the bus has taken all frames, in milliseconds since the beginning; `None` if it did not the last time.
    whole_since: Option<u64>,
    /// Cycles that were left out, and have not been reported.
    unreported_late: u64,
    /// Frames that were dropped and reported.
    reported_dropped: u64,
    /// When this turn no longer takes frames that are there already, though its cycle is due; `None` while it is not.
    give_up: Option<Instant>,
    /// For how long it does.
    patience: Duration,
}

impl<B: Bus> LiveBus<B> {
    /// The first cycle, which is as long as the edition has it, is due now.
    pub(super) fn new(bus: B, edition: &Edition) -> Self {
        let Timing { cycle_ms, handshake_ms, .. } = edition.rules.timing;
        let cycle_ms = u32::from(cycle_ms);
        let status = Status {
            bus: bus.name().to_owned(),
            edition: edition.version,
            answer_limit_ms: handshake_ms.into(),
            ..Status::default()
        };
        let clock = Clock::new(bus.now(), cycle_ms);
        let patience = Duration::from_millis(cycle_ms.into()) / 2;
        Self {
            bus,
            clock,
            status,
            notes: LastNotes::default(),
            reported_disturbance: None,
            whole_since: None,
            unreported_late: 0,
            reported_dropped: 0,
            give_up: None,
            patience,
        }
    }

    /// The next frame before the cycle is due, of whatever kind but the error kind; `None` when the cycle is to begin.
    ///
    /// What is there already when a cycle is late is taken as well, so that nobody is blamed for an answer that nobody took; but
    /// not for long: a bus that brings more than can be taken does not hold up the cycle.
    pub(super) fn next_frame(&mut self) -> Option<Received> {
        let deadline = self.clock.deadline();
        loop {
            let now = self.bus.now();
            // Counted from when the cycle is seen to be due: who was held up while waiting still takes what came meanwhile.
            if now >= deadline && now >= *self.give_up.get_or_insert(now + self.patience) {
                return None;
            }
            match self.bus.receive(deadline) {
                Event::Nothing if self.bus.now() >= deadline => return None,
                Event::Nothing => {}
                Event::Disturbance(trouble) => self.trouble(trouble),
                Event::Up => self.up(),
                Event::Frame(frame) => {
                    self.status.received += 1;
                    if frame.kind == FrameKind::Error {
                        self.status.errors += 1;
                        self.note(Note::Error, || HappeningKind::ErrorFrame(socket::error_text(&frame)));
                    } else {
                        return Some(frame);
                    }
                }
            }
        }
    }

    /// The cycle begins.
    pub(super) fn begin(&mut self) -> Begun {
        self.give_up = None;
        let begun = self.clock.begin(self.bus.now());
        self.unreported_late = self.unreported_late.saturating_add(begun.left_out);
        if self.unreported_late > 0 && self.may_report(Note::Late) {
            let late = std::mem::take(&mut self.unreported_late);
            self.happen(HappeningKind::Late(late));
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
        let now = self.time_ms();
        if unsent > 0 {
            self.whole_since = None;
        } else if !frames.is_empty() {
            // That frames are taken again is all that tells of a queue that is no longer full.
            let since = *self.whole_since.get_or_insert(now);
            if now >= since.saturating_add(WHOLE_MS)
                && matches!(self.status.trouble, Some(Disturbance::Full | Disturbance::Other(_)))
            {
                self.up();
            }
        }
        unsent == 0
    }

    /// The end of a turn: what the status has of the bus and the cycle.
    pub(super) fn end(&mut self) {
        self.report_disturbance();
        self.status.dropped = self.bus.dropped();
        let dropped = self.status.dropped.saturating_sub(self.reported_dropped);
        if dropped > 0 && self.may_report(Note::Dropped) {
            self.reported_dropped = self.status.dropped;
            self.happen(HappeningKind::Dropped {
                frames: dropped,
                small_buffer: self.bus.has_small_buffer(),
            });
        }
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

    pub(super) fn happen(&mut self, what: HappeningKind) {
        let time_ms = self.time_ms();
        self.status.happen(time_ms, what);
    }

    /// Has the partner listened to, and tells if it speaks another edition.
    pub(super) fn listen(&mut self, partner: &mut Partner, frame: &Frame) {
        if let Some(spoken) = partner.frame(self.now_ns(), frame) {
            let own = self.status.edition;
            self.happen(HappeningKind::OtherEdition { node: partner.node(), spoken, own });
        }
    }

    /// Tells what may come again and again, not too often.
    pub(super) fn note(&mut self, note: Note, what: impl FnOnce() -> HappeningKind) {
        if self.may_report(note) {
            self.happen(what());
        }
    }

    fn may_report(&mut self, note: Note) -> bool {
        let now = self.time_ms();
        self.notes.may(note, now)
    }

    fn trouble(&mut self, trouble: Disturbance) {
        // A full queue is what comes of a bus that is off, and says less.
        if self.status.trouble.is_none() || trouble != Disturbance::Full {
            self.status.trouble = Some(trouble);
            self.report_disturbance();
        }
    }

    fn up(&mut self) {
        self.status.trouble = None;
        self.report_disturbance();
    }

    /// Reports how the bus stands, if that is news; of a bus that goes and comes all the time, now and then.
    fn report_disturbance(&mut self) {
        if self.reported_disturbance == self.status.trouble
            || !self.may_report(Note::of(self.status.trouble.as_ref()))
        {
            return;
        }
        self.reported_disturbance.clone_from(&self.status.trouble);
        self.happen(self.status.trouble.clone().map_or(HappeningKind::Up, HappeningKind::Disturbance));
    }
}
