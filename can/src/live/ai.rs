//! The reference AI Computer on a bus.

use adsdv_spec::messages::{AsState, Node, Vcu2AiStatus};

use super::handle::Runner;
use super::line::LiveBus;
use super::note::Note;
use super::partner::Partner;
use crate::ai::Ai;
use crate::bus::{Bus, Received};
use crate::car::Action;
use crate::status::{HappeningKind, Status};

/// For so long the VCU may be silent before it is taken to be without power, in milliseconds: many of its cycles.
const SILENT_MS: u64 = 200;

/// The [`Ai`] on a bus: one [`turn`](Self::turn) is one of its cycles.
///
/// Its [`Status`] has what is of the bus, the cycle, and the AS state that the VCU shows; what is of a car is at its default.
#[derive(Debug)]
pub struct AiComputer<B> {
    line: LiveBus<B>,
    ai: Ai,
    partner: Partner,
    /// The AS state that the VCU shows, and when it did so last, in milliseconds since the beginning.
    shown: Option<(AsState, u64)>,
}

impl<B: Bus> AiComputer<B> {
    /// An AI Computer that has just been switched on.
    pub fn new(bus: B, ai: Ai) -> Self {
        let line = LiveBus::new(bus, ai.edition());
        Self { line, partner: Partner::new(Node::Vcu, ai.edition()), ai, shown: None }
    }

    /// One cycle: receives until it is due, and sends its frames.
    pub fn turn(&mut self) {
        while let Some(frame) = self.line.next_frame() {
            self.hear(&frame);
        }
        let begun = self.line.begin();
        let frames = self.ai.cycle(begun.dt_ms);
        self.line.send_all(&frames);
        self.look_for_vcu();
        self.line.end();
    }

    /// How everything stands after the last turn.
    pub fn status(&self) -> &Status {
        &self.line.status
    }

    fn hear(&mut self, received: &Received) {
        let Some(frame) = received.frame() else { return };
        self.line.listen(&mut self.partner, &frame);
        let bus = self.ai.edition().bus;
        if bus.message(frame.id).is_some_and(|message| message.sender == Node::Ai) {
            self.line.status.foreign += 1;
            let id = frame.id;
            self.line.note(Note::Foreign, || {
                HappeningKind::OtherAi(format!("somebody else sends {id:03X}h, which is the AI Computer's"))
            });
            return;
        }
        if let Err(error) = self.ai.receive(&frame) {
            self.line.status.refused += 1;
            let id = frame.id;
            self.line.note(Note::Refused(id), || HappeningKind::Refused(format!("{id:03X}h: {error}")));
        } else if frame.id == Vcu2AiStatus::ID
            && let Ok(status) = bus.decode_as::<Vcu2AiStatus>(frame.data())
        {
            self.show(status.as_state);
        }
    }

    fn show(&mut self, state: AsState) {
        let now = self.line.time_ms();
        let before = self.shown.replace((state, now)).map(|(state, _)| state);
        if before != Some(state) {
            self.change(before, Some(state), "");
        }
    }

    fn look_for_vcu(&mut self) {
        let now = self.line.time_ms();
        if let Some((state, at)) = self.shown
            && now > at + SILENT_MS
        {
            self.shown = None;
            self.change(Some(state), None, "the VCU is not heard any more");
        }
    }

    fn change(&mut self, from: Option<AsState>, to: Option<AsState>, why: &str) {
        self.line.happen(HappeningKind::State { from, to, section: "", why: why.to_owned() });
    }
}

impl<B: Bus> Runner for AiComputer<B> {
    fn turn(&mut self) {
        Self::turn(self);
    }

    /// An AI Computer has no switches.
    fn act(&mut self, _action: &Action) {}

    fn status(&self) -> &Status {
        Self::status(self)
    }
}
