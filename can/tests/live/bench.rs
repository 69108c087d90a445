//! A bus on which everything can go wrong, in a time of its own.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use adsdv_can::ai::Ai;
use adsdv_can::bus::{Bus, Disturbance, Event, Listen, Received};
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Frame;

/// The frame of a message.
pub(crate) fn encoded(message: impl Into<adsdv_spec::messages::AnyMessage>) -> Frame {
    adsdv_spec::Edition::DEFAULT.bus.encode(message).expect("every edition has it")
}

/// When the AI Computer's cycle begins after the VCU's.
pub(crate) const PHASE: Duration = Duration::from_millis(4);
const CYCLE: Duration = Duration::from_millis(10);

/// The bus, and the test's hand on it.
#[derive(Clone, Debug)]
pub(crate) struct Bench(Arc<Mutex<Inner>>);

#[derive(Debug)]
struct Inner {
    start: Instant,
    now: Instant,
    /// What comes from the bus, and when, in order.
    coming: VecDeque<(Instant, Event)>,
    /// What the node under test sent, and when.
    sent: Vec<(Duration, Frame)>,
    /// What sending comes to.
    sending: Result<(), Disturbance>,
    dropped: u64,
    /// How long it takes to take something from the bus.
    cost: Duration,
    /// By how much the next wait is longer than it was to be.
    oversleep: Duration,
    /// The AI Computer on the bus, and when its next cycle is.
    ai: Option<(Ai, Instant)>,
    /// It may refuse what the VCU sends.
    may_refuse: bool,
}

impl Bench {
    pub(crate) fn new() -> Self {
        let start = Instant::now();
        Self(Arc::new(Mutex::new(Inner {
            start,
            now: start,
            coming: VecDeque::new(),
            sent: Vec::new(),
            sending: Ok(()),
            dropped: 0,
            cost: Duration::ZERO,
            oversleep: Duration::ZERO,
            ai: None,
            may_refuse: false,
        })))
    }

    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The time since the start.
    pub(crate) fn time(&self) -> Duration {
        let inner = self.inner();
        inner.now - inner.start
    }

    /// Something comes so long after the start; later than all that is to come already.
    pub(crate) fn comes(&self, at: Duration, event: Event) {
        let mut inner = self.inner();
        let at = inner.start + at;
        inner.coming.push_back((at, event));
    }

    pub(crate) fn frame_comes(&self, at: Duration, kind: FrameKind, id: u32, data: &[u8]) {
        self.comes(at, Event::Frame(received(kind, id, data)));
    }

    /// What sending comes to from now on.
    pub(crate) fn sending(&self, sending: Result<(), Disturbance>) {
        self.inner().sending = sending;
    }

    pub(crate) fn cost(&self, cost: Duration) {
        self.inner().cost = cost;
    }

    /// The next wait lasts longer by so much, as if the machine had something else to do.
    pub(crate) fn oversleep(&self, by: Duration) {
        self.inner().oversleep = by;
    }

    pub(crate) fn dropped(&self, dropped: u64) {
        self.inner().dropped = dropped;
    }

    /// An AI Computer is plugged in; its first cycle is after the next of the VCU.
    pub(crate) fn plug_in(&self, ai: Ai) {
        let mut inner = self.inner();
        let first = inner.now + PHASE;
        inner.ai = Some((ai, first));
    }

    /// The same with one of another edition, which may refuse what the VCU sends.
    pub(crate) fn plug_in_other(&self, ai: Ai) {
        self.plug_in(ai);
        self.inner().may_refuse = true;
    }

    pub(crate) fn unplug(&self) {
        self.inner().ai = None;
    }

    /// Time passes while nobody looks.
    pub(crate) fn stall(&self, time: Duration) {
        self.inner().now += time;
    }

    /// What was sent since this was last asked.
    pub(crate) fn take_sent(&self) -> Vec<(Duration, Frame)> {
        std::mem::take(&mut self.inner().sent)
    }
}

impl Inner {
    /// The AI Computer's cycle, if it is before a time and before whatever else comes.
    fn ai_cycle(&mut self, until: Instant) {
        let coming = self.coming.front().map_or(until, |(at, _)| until.min(*at));
        let Some((ai, next)) = &mut self.ai else { return };
        if *next <= coming {
            let at = *next;
            *next += CYCLE;
            for frame in ai.cycle(10).iter().rev() {
                let event = Event::Frame(received(FrameKind::Standard, frame.id.into(), frame.data()));
                self.coming.push_front((at, event));
            }
        }
    }
}

impl Listen for Bench {
    fn name(&self) -> &'static str {
        "bench0"
    }

    fn receive(&mut self, until: Instant) -> Event {
        let mut inner = self.inner();
        let until = until.max(inner.now);
        if until > inner.now {
            let by = std::mem::take(&mut inner.oversleep);
            inner.now += by;
        }
        let until = until.max(inner.now);
        inner.ai_cycle(until);
        match inner.coming.front() {
            Some((at, _)) if *at <= until => {
                inner.now = inner.now.max(*at);
                let cost = inner.cost;
                inner.now += cost;
                inner.coming.pop_front().map_or(Event::Nothing, |(_, event)| event)
            }
            _ => {
                inner.now = until;
                Event::Nothing
            }
        }
    }

    fn dropped(&self) -> u64 {
        self.inner().dropped
    }

    fn now(&self) -> Instant {
        self.inner().now
    }
}

impl Bus for Bench {
    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance> {
        let mut inner = self.inner();
        inner.sending.clone()?;
        let at = inner.now - inner.start;
        inner.sent.push((at, *frame));
        if let Some((ai, _)) = &mut inner.ai {
            let taken = ai.receive(frame);
            assert!(taken.is_ok() || inner.may_refuse, "the VCU sends what the document allows: {taken:?}");
        }
        Ok(())
    }
}

pub(crate) fn received(kind: FrameKind, id: u32, data: &[u8]) -> Received {
    let mut bytes = [0; 8];
    for (place, byte) in bytes.iter_mut().zip(data) {
        *place = *byte;
    }
    let len = u8::try_from(data.len().min(8)).unwrap_or(8);
    Received { time_ns: 1_795_209_995_000_000_000, kind, id, len, data: bytes }
}
