//! A car on a bus in simulated time, so that a picture shows what really happens, and the same each time.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use adsdv_can::ai::Ai;
use adsdv_can::bus::{Bus, Disturbance, Event, Listen, Received};
use adsdv_can::live::Vcu;
use adsdv_can::scenario::{Player, Scenario};
use adsdv_can::status::Status;
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::Machine;
use adsdv_spec::messages::Frame;

/// How it stands so long after the start of the built-in mission.
pub(super) fn mission(time: Duration) -> Status {
    let mut vcu = Vcu::new(Simulated::new(), Machine::REFERENCE, Some(Player::new(&Scenario::mission())));
    while u128::from(vcu.status().time_ms) < time.as_millis() {
        vcu.turn();
    }
    vcu.status().clone()
}

/// When the AI Computer's cycle begins after the VCU's.
const PHASE: Duration = Duration::from_millis(3);

struct Simulated {
    now: Instant,
    ai: Ai,
    /// When the AI Computer's next cycle is due.
    next: Instant,
    sent: VecDeque<Frame>,
}

impl Simulated {
    fn new() -> Self {
        let now = Instant::now();
        Self { now, ai: Ai::default(), next: now + PHASE, sent: VecDeque::new() }
    }
}

impl Listen for Simulated {
    fn name(&self) -> &'static str {
        "vcan0"
    }

    fn receive(&mut self, until: Instant) -> Event {
        loop {
            if let Some(frame) = self.sent.pop_front() {
                let (id, kind) = (frame.id.into(), FrameKind::Standard);
                return Event::Frame(Received { time_ns: 0, kind, id, len: frame.len, data: frame.data });
            }
            if self.next > until {
                self.now = self.now.max(until);
                return Event::Nothing;
            }
            let cycle_ms = self.ai.edition().rules.timing.cycle_ms;
            self.now = self.now.max(self.next);
            self.next += Duration::from_millis(cycle_ms.into());
            self.sent.extend(self.ai.cycle(cycle_ms.into()));
        }
    }

    fn dropped(&self) -> u64 {
        0
    }

    fn now(&self) -> Instant {
        self.now
    }
}

impl Bus for Simulated {
    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance> {
        self.ai.receive(frame).map_err(|error| Disturbance::Other(error.to_string()))
    }
}
