//! A bus within the program in real time, with the AI Computer on it.

use std::collections::VecDeque;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Frame;

use super::BUS;
use crate::ai::Ai;
use crate::bus::{Bus, Disturbance, Event, Listen, Received};

/// A bus with the AI Computer on it, for a machine without CAN. Frames are there at once.
///
/// The AI Computer has a cycle of its own, as long as the VCU's and without drift. For cycles in which nobody waited, time
/// stands still for the AI Computer: what held up the one held up the other as well, and it takes nobody to be silent for that.
#[derive(Debug)]
pub struct LocalBus {
    ai: Ai,
    cycle: Duration,
    /// When the AI Computer's next cycle is due.
    next: Instant,
    sent: VecDeque<Frame>,
}

impl LocalBus {
    /// A bus with this AI Computer, whose first cycle is due at once.
    pub fn new(ai: Ai) -> Self {
        let now = Instant::now();
        let cycle = Duration::from_millis(ai.edition().rules.timing.cycle_ms.into());
        Self { ai, cycle, next: now, sent: VecDeque::new() }
    }

    fn ai_cycle(&mut self, now: Instant) {
        let late = now.saturating_duration_since(self.next);
        // In whole cycles, so that no time is lost to rounding.
        let missed = late.as_nanos().checked_div(self.cycle.as_nanos()).unwrap_or_default();
        let cycles = u32::try_from(missed).unwrap_or(u32::MAX).saturating_add(1);
        self.next += self.cycle.saturating_mul(cycles);
        self.sent.extend(self.ai.cycle(self.ai.edition().rules.timing.cycle_ms.into()));
    }
}

impl Listen for LocalBus {
    fn name(&self) -> &str {
        BUS
    }

    fn receive(&mut self, until: Instant) -> Event {
        loop {
            if let Some(frame) = self.sent.pop_front() {
                return Event::Frame(received(&frame));
            }
            let now = Instant::now();
            if now >= self.next {
                self.ai_cycle(now);
                continue;
            }
            if now >= until {
                return Event::Nothing;
            }
            thread::sleep(until.min(self.next).saturating_duration_since(now));
        }
    }

    fn dropped(&self) -> u64 {
        0
    }
}

impl Bus for LocalBus {
    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance> {
        // What does not decode is the business of the AI Computer, which nobody asks here.
        let _ = self.ai.receive(frame);
        Ok(())
    }
}

fn received(frame: &Frame) -> Received {
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    Received {
        time_ns: i64::try_from(now.as_nanos()).unwrap_or(i64::MAX),
        kind: FrameKind::Standard,
        id: frame.id.into(),
        len: frame.len,
        data: frame.data,
    }
}
