//! Leads a program up to an arrow: everything but the last step, and that step.

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::InputField;
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Term};

use crate::pilot::Pilot;

impl Pilot<'_> {
    /// Takes away what leads to EMERGENCY_BRAKE.
    pub(crate) fn calm(&mut self) {
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
        self.model.terms(self.state()).find(|(_, leads)| *leads == to).map(|(term, _)| term)
    }

    /// Changes the inputs so that an alternative of an arrow of this state holds, as far as they decide.
    pub(crate) fn ready(&mut self, term: &Term, to: AsState) {
        if to != AsState::EmergencyBrake {
            self.calm();
        }
        for (atom, value) in term.literals() {
            self.show(atom, value);
        }
        for (field, raw, is) in self.model.needs((self.state(), to)) {
            if ((field.get)(&self.inputs) == raw) != is {
                (field.set)(&mut self.inputs, if is { raw } else { i32::from(raw == 0) });
            }
        }
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
                self.wait(cycle)?;
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
            self.wait_with(left.saturating_sub(early_ms), with)?;
        } else if waits && left > cycle {
            // The last cycle is the step that is wanted, unless the timer runs only as it is wanted.
            let (asms, late) = (self.inputs.asms, left - cycle);
            self.inputs.asms = true;
            if self.foreseen(&self.inputs, late).control.in_state_ms == 0 {
                self.inputs.asms = asms;
            }
            self.wait_with(late.saturating_sub(early_ms), with)?;
            self.inputs.asms = asms;
        }
        if term.on.has(Atom::GoEdge) {
            if !self.memory.control.go_seen_low {
                self.wait_with(cycle, with)?;
            }
            self.inputs.go = true;
        }
        if term.on.has(Atom::AiCommsLost) {
            self.inputs.tsms = true;
            self.wait_with(cycle, with)?;
            self.answers = false;
        }
        if with.is_none() {
            self.aim(to, self.last_ms(term));
        }
        Ok(())
    }

    /// Waits, with nothing changed where an input is to be otherwise all the time.
    fn wait_with(&mut self, dt_ms: u32, with: Option<(&InputField, i32)>) -> Result<(), ProgramError> {
        if with.is_some() { self.step(dt_ms) } else { self.wait(dt_ms) }
    }

    /// The time of the last step to an alternative.
    pub(crate) fn last_ms(&self, term: &Term) -> u32 {
        let timing = &self.model.machine().edition().rules.timing;
        if term.on.has(Atom::AiCommsLost) { timing.handshake_ms.into() } else { timing.cycle_ms.into() }
    }

    /// The last step to an alternative, with as many more as the arrow is late.
    pub(crate) fn take(&mut self, term: &Term, to: AsState) -> Result<(), ProgramError> {
        let delay = self.model.delay((self.state(), to));
        self.step(self.last_ms(term))?;
        for _ in 0..delay {
            self.step(self.cycle_ms())?;
        }
        Ok(())
    }
}
