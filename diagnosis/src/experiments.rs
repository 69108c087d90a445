//! What is tried in each state that the program gets to.

use adsdv_oracle::conform::ProgramError;
use adsdv_oracle::protocol::{Domain, InputField, Protocol};
use adsdv_spec::messages::{AsState, MissionStatus};
use adsdv_spec::{Atom, Term};

use crate::model::Model;
use crate::pilot::Pilot;
use crate::record::Record;
use crate::subject::Subject;

/// So many cycles are looked at behind what is tried: a program may take its time.
const BEHIND: usize = 4;
/// So many experiments in each state change several inputs at once.
const AT_RANDOM: usize = 80;

/// An input, with the values of it that are worth trying.
pub(crate) struct Dial {
    pub(crate) field: &'static InputField,
    pub(crate) values: Vec<i32>,
}

/// Every input, but for the handshake, which follows the program's own bit.
pub(crate) fn dials(model: &Model) -> Vec<Dial> {
    let edition = model.machine().edition();
    let protocol = Protocol::of(edition);
    let inputs = protocol.inputs().filter(|(field, _)| field.key != "handshake");
    let of =
        |(field, domain): (&'static InputField, Domain)| Dial { field, values: values(model, field, domain) };
    inputs.map(of).collect()
}

/// The values of an input that are worth trying: all, or those around a number where something may begin to count.
fn values(model: &Model, field: &InputField, domain: Domain) -> Vec<i32> {
    let thresholds = &model.machine().edition().rules.thresholds;
    let (min, max) = match domain {
        Domain::Flag => return vec![0, 1],
        Domain::Names(names) => return names.iter().map(|(raw, _)| *raw).collect(),
        Domain::Number { min, max } => (min, max),
    };
    let around: Vec<i32> = if field.key.ends_with("wheel_speed") {
        let limit = thresholds.wheel_speed.raw();
        vec![0, limit - 1, limit, limit + 1, max]
    } else if field.key == "steer_angle" {
        let limit = thresholds.straight.raw();
        vec![0, limit - 1, limit, 1 - limit, -limit, max]
    } else if let (true, Some(limit)) = (field.part == "ai_silence", thresholds.missed_ms) {
        let limit = i32::from(limit);
        vec![0, limit - 1, limit, limit + 1]
    } else {
        vec![0, 1, max]
    };
    let mut values: Vec<i32> = around.into_iter().map(|raw| raw.clamp(min, max)).collect();
    values.sort_unstable();
    values.dedup();
    values
}

/// Experiments with a program, in the ways that a model of it knows.
pub(crate) struct Experiments<'a> {
    subject: &'a mut dyn Subject,
    model: &'a Model,
    records: Vec<Record>,
    random: Random,
}

/// The next of a row of numbers that look random, the same every time.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap_or(0) % end.max(1)
    }
}

/// What was tried and answered.
pub(crate) fn all(subject: &mut dyn Subject, model: &Model, seed: u64) -> Result<Vec<Record>, ProgramError> {
    let mut experiments = Experiments { subject, model, records: Vec::new(), random: Random(seed) };
    let dials = dials(model);
    for state in AsState::ALL {
        experiments.alone(state, &dials)?;
        let terms = experiments.terms(state);
        for (term, to) in &terms {
            experiments.with_each_dial(state, term, *to, &dials)?;
            experiments.too_early(state, term, *to)?;
        }
        experiments.pairs(state, &terms)?;
        experiments.silence(state)?;
        experiments.at_random(state, &dials, &terms)?;
    }
    experiments.go()?;
    experiments.after_an_emergency()?;
    Ok(experiments.records)
}

impl Experiments<'_> {
    /// Leads the program somewhere, does something, and looks at what follows.
    fn try_it(
        &mut self,
        state: AsState,
        act: impl FnOnce(&mut Pilot<'_>) -> Result<(), ProgramError>,
    ) -> Result<(), ProgramError> {
        let mut pilot = Pilot::new(self.subject, self.model)?;
        if pilot.to(state)? {
            pilot.cycles(1)?;
            act(&mut pilot)?;
            pilot.cycles(BEHIND)?;
        }
        self.records.push(pilot.record());
        Ok(())
    }

    /// The alternatives that lead out of a state, by the model and by the document: what the program does not do at all may only
    /// want something else besides.
    fn terms(&self, state: AsState) -> Vec<(Term, AsState)> {
        let usual = Model::new(self.model.usual(), &[]);
        let mut all: Vec<(Term, AsState)> = Vec::new();
        for machine in [self.model.machine(), usual.machine()] {
            let table = &machine.edition().rules.table;
            let arrows = machine.arrows(state);
            let terms = arrows.filter_map(|taken| Some((*taken.term(table)?, taken.row(table)?.to)));
            for one in terms {
                if !all.contains(&one) {
                    all.push(one);
                }
            }
        }
        all
    }

    /// Several inputs at once, and then an arrow.
    fn at_random(
        &mut self,
        state: AsState,
        dials: &[Dial],
        terms: &[(Term, AsState)],
    ) -> Result<(), ProgramError> {
        for _ in 0..AT_RANDOM {
            let mut changes: Vec<(&InputField, i32)> = Vec::new();
            for _ in 0..=self.random.below(4) {
                if let Some(Dial { field, values }) = dials.get(self.random.below(dials.len()))
                    && let Some(&raw) = values.get(self.random.below(values.len()))
                {
                    changes.push((field, raw));
                }
            }
            let term = terms.get(self.random.below(terms.len().max(1))).copied();
            let first = self.random.below(2) == 0;
            self.try_it(state, |pilot| {
                if let Some((term, to)) = term.filter(|_| first) {
                    pilot.prepare(&term, to, 0)?;
                }
                for (field, raw) in changes {
                    (field.set)(&mut pilot.inputs, raw);
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
    fn alone(&mut self, state: AsState, dials: &[Dial]) -> Result<(), ProgramError> {
        for Dial { field, values } in dials {
            for &raw in values {
                self.try_it(state, |pilot| {
                    (field.set)(&mut pilot.inputs, raw);
                    Ok(())
                })?;
            }
        }
        Ok(())
    }

    /// An arrow, and an arrow with each input otherwise in the step that decides.
    fn with_each_dial(
        &mut self,
        state: AsState,
        term: &Term,
        to: AsState,
        dials: &[Dial],
    ) -> Result<(), ProgramError> {
        self.try_it(state, |pilot| {
            pilot.prepare(term, to, 0)?;
            pilot.take(term, to)
        })?;
        for Dial { field, values } in dials {
            for &raw in values {
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
        }
        Ok(())
    }

    /// An arrow that waits for a time, a moment before it, and a cycle before.
    fn too_early(&mut self, state: AsState, term: &Term, to: AsState) -> Result<(), ProgramError> {
        if term.on.has(Atom::DwellElapsed) || term.on.has(Atom::EbsTimerComplete) {
            for early_ms in [1, 10, 100] {
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
        for silent_ms in [limit / 2, limit - 1, limit, limit + 1] {
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
