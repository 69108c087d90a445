//! A VCU that remembers or shows something else than the specification.

use adsdv_conform::protocol::{SHOWN, Showing};
use adsdv_diagnosis::{Deviation, Memory, Model};
use adsdv_spec::messages::{Frame, MessageDef, Vcu2AiStatus};
use adsdv_spec::{Control, Edition, Inputs, Machine, Outputs};

use super::World;

/// What it is, what it remembers, and when it first showed something else than it should.
#[derive(Clone, Debug)]
pub(super) struct Deviating {
    model: Model,
    memory: Memory,
    showing: Showing,
    status: Option<&'static MessageDef>,
    lied_at: Option<i64>,
}

impl World {
    /// A world with a VCU of an edition that deviates from it, under the default readings.
    pub fn deviating(edition: &Edition, deviation: Deviation) -> Self {
        let model = Model::new(edition, &[deviation]);
        let status = edition.bus.message(Vcu2AiStatus::ID);
        let (memory, showing) = (Memory::INITIAL, Showing::of(edition));
        let deviating = Deviating { model, memory, showing, status, lied_at: None };
        Self { deviating: Some(deviating), ..Self::new(Machine::new(*edition, edition.readings)) }
    }

    /// When the VCU first did something else than this one would have, from the same memory and the same inputs, or showed something
    /// else.
    pub fn differs_at(&self, specification: &Machine) -> Option<i64> {
        let after = self.steps.iter().skip(1).map(|(control, _)| control).chain([&self.control]);
        let mut steps = self.steps.iter().zip(after).zip(0_i64..);
        let does = steps.find_map(|(((before, inputs), after), step)| {
            let differs = specification.step(before, inputs, super::CYCLE_MS.into()).0 != *after;
            differs.then_some(step * super::CYCLE)
        });
        let shows = self.deviating.as_ref().and_then(|deviating| deviating.lied_at);
        [does, shows].into_iter().flatten().min()
    }
}

impl Deviating {
    pub(super) fn step(&mut self, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        let (memory, outputs) = self.model.step(&self.memory, inputs, dt_ms);
        self.memory = memory;
        (memory.control, outputs)
    }

    /// Makes 520h of a step show what the VCU shows.
    pub(super) fn shows(&mut self, frame: &mut Frame, outputs: &Outputs, inputs: &Inputs, t: i64) {
        let Some(status) = self.status.filter(|status| status.id == frame.id) else { return };
        let before = *frame;
        let (shown, right) = (self.model.shown(outputs, inputs), self.showing.shown(outputs, inputs));
        for (place, field) in SHOWN.iter().enumerate() {
            let raw = shown.raw_at(place).filter(|raw| right.raw_at(place) != Some(*raw));
            if let (Some(signal), Some(raw)) = (status.signal_of(field.key), raw) {
                frame.data = signal.put(frame.data, raw);
            }
        }
        if *frame != before {
            self.lied_at = self.lied_at.or(Some(t));
        }
    }

    /// The handshake bit that a frame of 520h shows.
    pub(super) fn handshake(&self, frame: &Frame) -> Option<bool> {
        let status = self.status.filter(|status| status.id == frame.id)?;
        Some(status.signal_of("handshake")?.raw(frame.data())? == 1)
    }
}
