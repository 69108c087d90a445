//! What is tried in each state that the program gets to.

use std::time::Instant;

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::InputField;
use adsdv_oracle::chance::SplitMix64;
use adsdv_spec::messages::{AsState, MissionStatus};
use adsdv_spec::{Atom, Term};

use crate::hop::Hop;
use crate::lead::lead;
use crate::model::Model;
use crate::pilot::Pilot;
use crate::record::Record;
use crate::subject::Subject;
use crate::ways::Ways;

/// So many cycles are looked at behind what is tried: a program may take its time.
const BEHIND: usize = 4;
/// So many experiments in each state change several inputs at once.
const AT_RANDOM: usize = 80;

/// Experiments with a program, in the ways that a model of it knows.
pub(crate) struct Experiments<'a> {
    subject: &'a mut dyn Subject,
    model: &'a Model,
    ways: &'a Ways<'a>,
    records: Vec<Record>,
    random: SplitMix64,
    /// When they end, whatever has not been tried.
    until: Option<Instant>,
}

/// What was tried and answered in these states.
pub(crate) fn all(
    subject: &mut dyn Subject,
    ways: &Ways<'_>,
    seed: u64,
    states: &[AsState],
    until: Option<Instant>,
) -> Result<Vec<Record>, ProgramError> {
    let (model, records, random) = (ways.model, Vec::new(), SplitMix64(seed));
    let mut experiments = Experiments { subject, model, ways, records, random, until };
    for &state in states {
        experiments.alone(state)?;
        let terms = experiments.terms(state);
        for (term, to) in &terms {
            experiments.with_each_dial(state, term, *to)?;
            experiments.too_early(state, term, *to)?;
            experiments.at_the_moment(state, term, *to)?;
        }
        experiments.pairs(state, &terms)?;
        experiments.silence(state)?;
        experiments.silence_from_its_beginning(state)?;
        experiments.at_random(state, &terms)?;
        match state {
            AsState::Ready => {
                experiments.go()?;
                experiments.again()?;
            }
            AsState::EmergencyBrake => experiments.after_an_emergency()?,
            _ => {}
        }
    }
    Ok(experiments.records)
}

impl Experiments<'_> {
    /// Leads the program somewhere, does something, and looks at what follows.
    pub(crate) fn try_it(
        &mut self,
        state: AsState,
        act: impl Fn(&mut Pilot<'_>) -> Result<(), ProgramError>,
    ) -> Result<(), ProgramError> {
        if self.until.is_some_and(|until| Instant::now() >= until) {
            return Ok(());
        }
        let ((), record) = lead(self.subject, self.ways, |pilot| {
            if pilot.to(state)? {
                if pilot.aim(state, pilot.cycle_ms()) {
                    pilot.cycles(1)?;
                }
                act(pilot)?;
                pilot.cycles(BEHIND)?;
            }
            Ok(())
        })?;
        self.records.push(record);
        Ok(())
    }

    /// Every input with every value that is worth trying.
    fn changes(&self) -> Vec<(&'static InputField, i32)> {
        self.ways.changes().collect()
    }

    /// The alternatives that lead out of a state, by the model and by the document: what the program does not do at all may only
    /// want something else besides.
    fn terms(&self, state: AsState) -> Vec<(Term, AsState)> {
        let usual = Model::new(self.model.usual(), &[]);
        let mut all: Vec<(Term, AsState)> = Vec::new();
        for one in self.model.terms(state).chain(usual.terms(state)) {
            if !all.contains(&one) {
                all.push(one);
            }
        }
        all
    }

    /// Several inputs at once, and then an arrow.
    fn at_random(&mut self, state: AsState, terms: &[(Term, AsState)]) -> Result<(), ProgramError> {
        let all = self.changes();
        for _ in 0..self.ways.interface.fewer(AT_RANDOM) {
            let count = 1 + self.random.below(4);
            let changes: Vec<(&InputField, i32)> =
                (0..count).filter_map(|_| all.get(self.random.below(all.len())).copied()).collect();
            let term = terms.get(self.random.below(terms.len().max(1))).copied();
            let first = self.random.below(2) == 0;
            self.try_it(state, |pilot| {
                if let Some((term, to)) = term.filter(|_| first) {
                    pilot.prepare(&term, to, 0)?;
                }
                for (field, raw) in &changes {
                    (field.set)(&mut pilot.inputs, *raw);
                }
                pilot.cycles(2)?;
                if let Some((term, to)) = term.filter(|_| !first) {
                    pilot.prepare(&term, to, 0)?;
                    pilot.take(&term, to)?;
                }
                Ok(())
            })?;
        }
        Ok(())
    }

    /// Each input by itself.
    fn alone(&mut self, state: AsState) -> Result<(), ProgramError> {
        for (field, raw) in self.changes() {
            self.try_it(state, |pilot| {
                (field.set)(&mut pilot.inputs, raw);
                Ok(())
            })?;
        }
        Ok(())
    }

    /// An arrow, an arrow with the handshake not answered, and with each input otherwise, in the step that decides.
    fn with_each_dial(&mut self, state: AsState, term: &Term, to: AsState) -> Result<(), ProgramError> {
        self.try_it(state, |pilot| {
            pilot.prepare(term, to, 0)?;
            pilot.take(term, to)
        })?;
        for tsms in [true, false] {
            self.try_it(state, |pilot| {
                pilot.inputs.tsms |= tsms;
                pilot.wait(pilot.cycle_ms())?;
                pilot.prepare(term, to, 0)?;
                pilot.answers = false;
                pilot.take(term, to)?;
                pilot.answers = true;
                Ok(())
            })?;
        }
        for (field, raw) in self.changes() {
            self.try_it(state, |pilot| {
                pilot.prepare(term, to, 0)?;
                if (field.get)(&pilot.inputs) != raw {
                    (field.set)(&mut pilot.inputs, raw);
                    pilot.take(term, to)?;
                }
                Ok(())
            })?;
            if term.on.has(Atom::GoEdge) {
                self.try_it(state, |pilot| {
                    pilot.prepare_with(term, to, 0, Some((field, raw)))?;
                    pilot.take(term, to)
                })?;
            }
        }
        Ok(())
    }

    /// An arrow that waits for a time, a moment before it, a cycle before, and some cycles.
    fn too_early(&mut self, state: AsState, term: &Term, to: AsState) -> Result<(), ProgramError> {
        if term.on.has(Atom::DwellElapsed) || term.on.has(Atom::EbsTimerComplete) {
            let early =
                self.ways.interface.cycle_ms().map_or([1, 10, 100], |cycle| [cycle, 2 * cycle, 4 * cycle]);
            for early_ms in early {
                self.try_it(state, |pilot| {
                    pilot.prepare(term, to, early_ms)?;
                    pilot.take(term, to)
                })?;
            }
        }
        Ok(())
    }

    /// Two arrows at once.
    fn pairs(&mut self, state: AsState, terms: &[(Term, AsState)]) -> Result<(), ProgramError> {
        for (place, (one, to)) in terms.iter().enumerate() {
            for (other, _) in terms.iter().take(place) {
                self.try_it(state, |pilot| {
                    pilot.prepare(one, *to, 0)?;
                    for (atom, value) in other.literals() {
                        pilot.show(atom, value);
                    }
                    pilot.take(one, *to)
                })?;
            }
        }
        Ok(())
    }

    /// An AI Computer that does not answer for just too short, and for just long enough; and one that answers late.
    fn silence(&mut self, state: AsState) -> Result<(), ProgramError> {
        let limit = u32::from(self.model.machine().edition().rules.timing.handshake_ms);
        for silent_ms in [limit / 2, limit.saturating_sub(1), limit, limit + 1] {
            for tsms in [true, false] {
                self.try_it(state, |pilot| {
                    pilot.inputs.tsms = tsms || state != AsState::Off;
                    pilot.step(pilot.cycle_ms())?;
                    pilot.answers = false;
                    pilot.step(silent_ms)?;
                    pilot.answers = true;
                    pilot.step(pilot.cycle_ms())
                })?;
            }
        }
        Ok(())
    }

    /// An AI Computer that does not answer from where the handshake begins, for as long as would be too long with that step.
    fn silence_from_its_beginning(&mut self, state: AsState) -> Result<(), ProgramError> {
        let timing = &self.model.machine().edition().rules.timing;
        let limit = u32::from(timing.handshake_ms);
        let cycle = self.ways.interface.cycle_ms().unwrap_or_else(|| timing.cycle_ms.into());
        self.try_it(state, |pilot| {
            pilot.inputs.tsms = false;
            pilot.step(cycle)?;
            (pilot.inputs.tsms, pilot.answers) = (true, false);
            pilot.step(cycle)?;
            pilot.step(limit.saturating_sub(cycle))?;
            pilot.answers = true;
            pilot.step(cycle)
        })
    }

    /// "Go" that is on before it counts, that goes on and off, and that comes while the handshake does not match.
    fn go(&mut self) -> Result<(), ProgramError> {
        let ready = AsState::Ready;
        let armed = |pilot: &mut Pilot<'_>, go: bool| {
            pilot.inputs.go = go;
            let left = pilot.left_ms();
            pilot.step(left)
        };
        self.try_it(ready, |pilot| armed(pilot, true))?;
        self.try_it(ready, |pilot| {
            armed(pilot, true)?;
            pilot.inputs.go = false;
            pilot.step(10)?;
            pilot.inputs.go = true;
            pilot.step(10)
        })?;
        self.try_it(ready, |pilot| {
            armed(pilot, false)?;
            pilot.answers = false;
            pilot.inputs.go = true;
            pilot.step(10)?;
            pilot.answers = true;
            pilot.step(10)
        })?;
        self.try_it(ready, |pilot| {
            armed(pilot, false)?;
            pilot.show(Atom::SteerRequestZero, false);
            pilot.inputs.go = true;
            pilot.step(10)?;
            pilot.show(Atom::SteerRequestZero, true);
            pilot.step(10)
        })?;
        self.try_it(AsState::Driving, |pilot| {
            pilot.inputs.ai.status.mission_status = MissionStatus::Selected;
            pilot.step(10)
        })
    }

    /// AS_READY for half of its time, once more after it was left, and "Go" after the other half.
    fn again(&mut self) -> Result<(), ProgramError> {
        let (ready, off) = (AsState::Ready, AsState::Off);
        let way: Vec<Hop> = self.ways.to(ready).unwrap_or_default().to_vec();
        let hops = self.model.hops(ready);
        let Some(back) = hops.iter().find(|hop| hop.to == off) else { return Ok(()) };
        let driving = self.model.terms(ready).find(|(_, to)| *to == AsState::Driving);
        self.try_it(ready, |pilot| {
            let half = pilot.left_ms() / 2;
            pilot.wait(half)?;
            if !pilot.hop(back)? {
                return Ok(());
            }
            for hop in &way {
                if !pilot.hop(hop)? {
                    return Ok(());
                }
            }
            if let Some((term, to)) = driving {
                pilot.prepare(&term, to, half)?;
                pilot.take(&term, to)?;
            }
            Ok(())
        })
    }

    /// What is left of an emergency once it is over: the latch, the cause, and the flags.
    fn after_an_emergency(&mut self) -> Result<(), ProgramError> {
        let brake = AsState::EmergencyBrake;
        let Some((term, to)) = self.terms(brake).first().copied() else { return Ok(()) };
        self.try_it(brake, |pilot| {
            pilot.prepare(&term, to, 0)?;
            pilot.take(&term, to)?;
            pilot.cycles(2)?;
            if let Some(ready) = pilot.term(AsState::Ready) {
                pilot.prepare(&ready, AsState::Ready, 0)?;
                pilot.take(&ready, AsState::Ready)?;
            }
            Ok(())
        })?;
        self.try_it(brake, |pilot| {
            pilot.inputs.reports.ebs_fault = true;
            pilot.step(10)?;
            pilot.inputs.reports.ebs_fault = false;
            pilot.step(10)
        })
    }
}
