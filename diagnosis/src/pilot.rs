//! Leads a program through its states, by a model of it.

use adsdv_oracle::conform::ProgramError;
use adsdv_oracle::protocol::InputField;
use adsdv_oracle::suite::Step;
use adsdv_spec::messages::{AsState, DirectionRequest, MissionStatus};
use adsdv_spec::{Atom, Inputs, Term};

use crate::model::{Memory, Model};
use crate::record::Record;
use crate::subject::Subject;

/// Who leads a program. What it does is what the model says that leads on; what the program does is taken down.
pub(crate) struct Pilot<'a> {
    subject: &'a mut dyn Subject,
    model: &'a Model,
    memory: Memory,
    /// The inputs as they stand, but for the handshake.
    pub(crate) inputs: Inputs,
    /// Whether the AI Computer answers the handshake.
    pub(crate) answers: bool,
    /// The program's own bit.
    bit: bool,
    record: Record,
    /// Whether the program has shown something else than the model: what follows tells nothing.
    lost: bool,
}

impl<'a> Pilot<'a> {
    /// At power-on, with everything off.
    pub(crate) fn new(subject: &'a mut dyn Subject, model: &'a Model) -> Result<Self, ProgramError> {
        subject.reset()?;
        let (memory, inputs, record) = (Memory::INITIAL, Inputs::default(), Record::default());
        Ok(Self { subject, model, memory, inputs, answers: true, bit: false, record, lost: false })
    }

    /// What was asked and answered.
    pub(crate) fn record(self) -> Record {
        self.record
    }

    /// The state that the program showed last.
    pub(crate) fn shows(&self) -> Option<AsState> {
        AsState::from_raw(self.record.replies.last()?.get("as_state")?.raw?)
    }

    /// Whether the program showed that communication is lost.
    pub(crate) fn shows_comms_lost(&self) -> bool {
        let last = self.record.replies.last();
        last.and_then(|reply| reply.get("ai_comms_lost")?.raw) == Some(1)
    }

    /// The state of the model.
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

    /// One step; none any more once the program has done something else than the model.
    pub(crate) fn step(&mut self, dt_ms: u32) -> Result<(), ProgramError> {
        if self.lost {
            return Ok(());
        }
        self.inputs.ai.status.handshake = self.bit == self.answers;
        // What the edition's messages cannot hold no program can be asked for.
        self.inputs = self.inputs.held_by(&self.model.usual().bus);
        let reply = self.subject.step(dt_ms, &self.inputs)?;
        let (memory, outputs) = self.model.step(&self.memory, &self.inputs, dt_ms);
        self.memory = memory;
        self.bit =
            reply.get("handshake").and_then(|value| value.raw).map_or(outputs.handshake, |raw| raw == 1);
        self.lost = !reply.agrees(&self.model.shown(&outputs, &self.inputs));
        self.record.steps.push(Step { dt_ms, inputs: self.inputs });
        self.record.replies.push(reply);
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

    /// Takes away what leads to EMERGENCY_BRAKE.
    fn calm(&mut self) {
        for (atom, value) in [
            (Atom::SdcOpen, false),
            (Atom::AiEstop, false),
            (Atom::AiMessagesMissed, false),
            (Atom::BrakeRequestZero, true),
            (Atom::EbsUnavailable, false),
        ] {
            self.show(atom, value);
        }
    }

    /// The first alternative of an arrow by the model.
    pub(crate) fn term(&self, to: AsState) -> Option<Term> {
        let machine = self.model.machine();
        let table = &machine.edition().rules.table;
        { machine.arrows(self.state()) }
            .find_map(|taken| taken.term(table).filter(|_| taken.row(table).is_some_and(|row| row.to == to)))
            .copied()
    }

    /// Everything but the last step to an alternative of an arrow of this state, as the model has it.
    pub(crate) fn prepare(&mut self, term: &Term, to: AsState, early_ms: u32) -> Result<(), ProgramError> {
        self.prepare_with(term, to, early_ms, None)
    }

    /// Everything but the last step to an alternative of an arrow of this state; `early_ms`: so much too early; `with`: all the time
    /// with this input otherwise.
    pub(crate) fn prepare_with(
        &mut self,
        term: &Term,
        to: AsState,
        early_ms: u32,
        with: Option<(&InputField, i32)>,
    ) -> Result<(), ProgramError> {
        let cycle = self.cycle_ms();
        if to != AsState::EmergencyBrake {
            self.calm();
        }
        for (edge, before) in [
            (Atom::MissionFinishedEdge, Atom::MissionRunning),
            (Atom::DirectionNeutralEdge, Atom::DirectionNeutral),
        ] {
            if term.on.has(edge) {
                self.show(before, edge == Atom::MissionFinishedEdge);
                self.step(cycle)?;
            }
        }
        for (atom, value) in term.literals() {
            self.show(atom, value);
        }
        for (edge, after) in [
            (Atom::MissionFinishedEdge, Atom::MissionFinished),
            (Atom::DirectionNeutralEdge, Atom::DirectionNeutral),
        ] {
            if term.on.has(edge) {
                self.show(after, true);
            }
        }
        for (field, raw, is) in self.model.needs((self.state(), to)) {
            if ((field.get)(&self.inputs) == raw) != is {
                (field.set)(&mut self.inputs, if is { raw } else { i32::from(raw == 0) });
            }
        }
        if term.on.has(Atom::GoEdge) {
            self.inputs.go = false;
        }
        if let Some((field, raw)) = with {
            (field.set)(&mut self.inputs, raw);
        }
        let waits = term.on.has(Atom::DwellElapsed) || term.on.has(Atom::EbsTimerComplete);
        let left = self.left_ms();
        if waits && left > 0 && term.on.has(Atom::GoEdge) {
            self.step(left.saturating_sub(early_ms))?;
        } else if waits && left > cycle {
            // The last cycle is the step that is wanted.
            let (asms, late) = (self.inputs.asms, left - cycle);
            self.inputs.asms = true;
            self.step(late.saturating_sub(early_ms))?;
            self.inputs.asms = asms;
        }
        if term.on.has(Atom::GoEdge) {
            if !self.memory.control.go_seen_low {
                self.step(cycle)?;
            }
            self.inputs.go = true;
        }
        if term.on.has(Atom::AiCommsLost) {
            self.inputs.tsms = true;
            self.step(cycle)?;
            self.answers = false;
        }
        Ok(())
    }

    /// The last step to an alternative, with as many more as the arrow is late.
    pub(crate) fn take(&mut self, term: &Term, to: AsState) -> Result<(), ProgramError> {
        let delay = self.model.delay((self.state(), to));
        let handshake = u32::from(self.model.machine().edition().rules.timing.handshake_ms);
        let dt_ms = if term.on.has(Atom::AiCommsLost) { handshake } else { self.cycle_ms() };
        self.step(dt_ms)?;
        for _ in 0..delay {
            self.step(self.cycle_ms())?;
        }
        Ok(())
    }

    /// Into a state, with inputs that keep it there. Tells whether the model got there.
    pub(crate) fn to(&mut self, state: AsState) -> Result<bool, ProgramError> {
        let by = match state {
            AsState::Off => return Ok(true),
            AsState::Ready => AsState::Off,
            AsState::Driving | AsState::EmergencyBrake => AsState::Ready,
            AsState::Finished => AsState::Driving,
        };
        if !self.to(by)? || self.lost {
            return Ok(false);
        }
        let Some(term) = self.term(state) else { return Ok(false) };
        self.prepare(&term, state, 0)?;
        if state == AsState::Driving {
            self.inputs.ai.status.mission_status = MissionStatus::Running;
        }
        self.take(&term, state)?;
        match state {
            AsState::Driving => self.inputs.ai.status.direction_request = DirectionRequest::Forward,
            AsState::Finished => self.inputs.ai.status.direction_request = DirectionRequest::Neutral,
            _ => self.calm(),
        }
        Ok(self.state() == state && !self.lost)
    }
}
