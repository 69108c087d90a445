//! Leads a program through its states, by a model of it.

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{Answer, InputField};
use adsdv_conform::suite::Step;
use adsdv_spec::messages::{AsState, DirectionRequest, MissionStatus};
use adsdv_spec::{Atom, Inputs, Term};

use crate::hop::{By, Hop};
use crate::model::{Memory, Model};
use crate::record::Record;
use crate::subject::Subject;
use crate::ways::Ways;

/// Who leads a program. What it does is what the model says that leads on; what the program does is taken down.
pub(crate) struct Pilot<'a> {
    subject: &'a mut dyn Subject,
    ways: &'a Ways<'a>,
    pub(crate) model: &'a Model,
    /// What the program remembers by the model, as far as what it showed agrees.
    pub(crate) memory: Memory,
    /// The inputs as they stand, but for the handshake.
    pub(crate) inputs: Inputs,
    /// Whether the AI Computer answers the handshake.
    pub(crate) answers: bool,
    /// The program's own bit.
    bit: bool,
    record: Record,
    /// Whether the program has gone elsewhere than the model: what was meant to follow has no sense there.
    lost: bool,
}

impl<'a> Pilot<'a> {
    /// At power-on, with everything off.
    pub(crate) fn new(subject: &'a mut dyn Subject, ways: &'a Ways<'a>) -> Result<Self, ProgramError> {
        subject.reset()?;
        let (memory, inputs, record) = (Memory::INITIAL, Inputs::default(), Record::default());
        let (model, answers) = (ways.model, true);
        Ok(Self { subject, ways, model, memory, inputs, answers, bit: false, record, lost: false })
    }

    /// What was asked and answered, step by step.
    pub(crate) const fn asked(&self) -> &Record {
        &self.record
    }

    /// The same, with like steps of a fixed cycle as one.
    pub(crate) fn record(self) -> Record {
        if self.ways.interface.cycle_ms().is_some() { self.record.joined() } else { self.record }
    }

    /// Whether the program has gone elsewhere than the model.
    pub(crate) const fn is_lost(&self) -> bool {
        self.lost
    }

    /// Goes on from where the program is.
    pub(crate) const fn find_again(&mut self) {
        self.lost = false;
    }

    /// What was asked last, and answered.
    pub(crate) fn last(&self) -> Option<&Answer> {
        self.record.replies.last()
    }

    /// Whether the program showed that communication is lost.
    pub(crate) fn shows_comms_lost(&self) -> bool {
        self.last().and_then(|reply| reply.get("ai_comms_lost")?.raw) == Some(1)
    }

    /// The state of the program, by what it shows.
    pub(crate) const fn state(&self) -> AsState {
        self.memory.control.state
    }

    /// How long the state has to last yet.
    pub(crate) fn left_ms(&self) -> u32 {
        let timing = &self.model.machine().edition().rules.timing;
        let limit = timing.in_state_limit(self.state());
        limit.saturating_sub(self.memory.control.in_state_ms).into()
    }

    /// The time of a cycle.
    pub(crate) fn cycle_ms(&self) -> u32 {
        self.model.machine().edition().rules.timing.cycle_ms.into()
    }

    /// One step, or as many of a fixed cycle as take so long; none any more once the program has gone elsewhere than the model.
    pub(crate) fn step(&mut self, dt_ms: u32) -> Result<(), ProgramError> {
        let each_ms = self.ways.interface.cycle_ms().unwrap_or(dt_ms);
        for _ in 0..self.ways.interface.cycles(dt_ms) {
            self.step_once(each_ms)?;
        }
        Ok(())
    }

    /// The same until the program is in this state, wherever the model goes meanwhile: it may take longer than the model thinks.
    pub(crate) fn step_until(&mut self, dt_ms: u32, to: AsState) -> Result<(), ProgramError> {
        let each_ms = self.ways.interface.cycle_ms().unwrap_or(dt_ms);
        for _ in 0..self.ways.interface.cycles(dt_ms) {
            self.find_again();
            self.step_once(each_ms)?;
            if self.state() == to {
                break;
            }
        }
        Ok(())
    }

    fn step_once(&mut self, dt_ms: u32) -> Result<(), ProgramError> {
        if self.lost {
            return Ok(());
        }
        // What the edition's messages cannot hold no program can be asked for.
        let inputs = self.answering(&self.inputs).held_by(&self.model.usual().bus);
        let reply = self.subject.step(dt_ms, &inputs)?;
        let (outputs, memory) = self.model.follow(&self.memory, &inputs, dt_ms, &reply);
        (self.memory, self.inputs) = (memory, inputs);
        let shown = reply.get("handshake").and_then(|value| value.raw).map(|raw| raw == 1);
        let tells = !self.model.shows_handshake_otherwise();
        self.bit = shown.filter(|_| tells).unwrap_or(memory.control.handshake.bit);
        self.lost = outputs.state != memory.control.state;
        self.record.steps.push(Step { dt_ms, inputs });
        self.record.replies.push(reply);
        Ok(())
    }

    /// The inputs with the answer to the handshake, as far as the program has them.
    fn answering(&self, inputs: &Inputs) -> Inputs {
        let mut answering = *inputs;
        answering.ai.status.handshake = self.bit == self.answers;
        self.ways.interface.held(answering)
    }

    /// What the model remembers after a step with these inputs.
    pub(crate) fn foreseen(&self, inputs: &Inputs, dt_ms: u32) -> Memory {
        self.model.step(&self.memory, &self.answering(inputs), dt_ms).0
    }

    /// Whether the model leads there with the next step, or is on its way where that is late; to another state as if this one had
    /// lasted for its time.
    fn leads_to(&self, inputs: &Inputs, dt_ms: u32, to: AsState) -> bool {
        if to == self.state() {
            return self.foreseen(inputs, dt_ms).control.state == to;
        }
        // What has to come before the time is over is led to at once.
        [self.memory, self.model.patient(&self.memory)].iter().any(|memory| {
            let after = self.model.step(memory, &self.answering(inputs), dt_ms).0;
            after.control.state == to || after.waits_longer_than(memory)
        })
    }

    /// Whether the model takes an arrow with the next step.
    pub(crate) fn is_led_to(&self, to: AsState, term: &Term) -> bool {
        self.leads_to(&self.inputs, self.last_ms(term), to)
    }

    /// Changes as few inputs as it takes for the next step to lead to a state by the model, or to stay in it; false if it does not
    /// with any.
    pub(crate) fn aim(&mut self, to: AsState, dt_ms: u32) -> bool {
        if self.leads_to(&self.inputs, dt_ms, to) {
            return true;
        }
        let ways = self.ways;
        let mut visible = ways.visible_in(self.state());
        for pair in [false, true] {
            let firsts: Vec<Inputs> = if pair {
                visible.by_ref().filter_map(|(field, raw)| with(&self.inputs, field, raw)).collect()
            } else {
                vec![self.inputs]
            };
            for first in firsts {
                for (field, raw) in ways.changes() {
                    if let Some(inputs) = with(&first, field, raw)
                        && self.leads_to(&inputs, dt_ms, to)
                    {
                        self.inputs = inputs;
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Time passes, and the state stays: what would end it by the model is otherwise meanwhile.
    pub(crate) fn wait(&mut self, dt_ms: u32) -> Result<(), ProgramError> {
        let wanted = self.inputs;
        self.aim(self.state(), dt_ms);
        self.step(dt_ms)?;
        self.inputs = wanted;
        Ok(())
    }

    /// So many cycles, whatever the program does in them.
    pub(crate) fn cycles(&mut self, count: usize) -> Result<(), ProgramError> {
        for _ in 0..count {
            self.lost = false;
            self.step(self.cycle_ms())?;
        }
        Ok(())
    }

    /// Changes an input so that a condition holds, or does not.
    pub(crate) fn show(&mut self, atom: Atom, value: bool) {
        self.inputs.show(atom, value, &self.model.machine().edition().rules.thresholds);
    }

    /// Into a state, with inputs that keep it there. Tells whether the program got there.
    pub(crate) fn to(&mut self, state: AsState) -> Result<bool, ProgramError> {
        let Some(way) = self.ways.to(state) else { return Ok(false) };
        for hop in way {
            if !self.hop(hop)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// From one state to the next, with inputs that keep it there. Tells whether the program got there.
    pub(crate) fn hop(&mut self, hop: &Hop) -> Result<bool, ProgramError> {
        let to = hop.to;
        match &hop.by {
            By::Term(term) => {
                self.prepare(term, to, 0)?;
                if to == AsState::Driving {
                    self.inputs.ai.status.mission_status = MissionStatus::Running;
                }
                self.aim(to, self.last_ms(term));
                self.take(term, to)?;
            }
            By::Also(field, raw) => {
                (field.set)(&mut self.inputs, *raw);
                self.aim(to, self.cycle_ms());
                self.step(self.cycle_ms())?;
            }
        }
        self.answers = true;
        match to {
            AsState::Driving => {
                self.inputs.ai.status.direction_request = DirectionRequest::Forward;
                (self.inputs.asms, self.inputs.go) = (true, true);
            }
            AsState::Finished => self.inputs.ai.status.direction_request = DirectionRequest::Neutral,
            _ => self.calm(),
        }
        if self.state() != to || self.lost {
            return Ok(false);
        }
        // What would end it at once by the model is changed, as far as that helps.
        self.aim(to, self.cycle_ms());
        Ok(true)
    }
}

/// The inputs with one otherwise; `None` if it is as it was.
fn with(inputs: &Inputs, field: &InputField, raw: i32) -> Option<Inputs> {
    let mut other = *inputs;
    ((field.get)(inputs) != raw && (field.set)(&mut other, raw)).then_some(other)
}
