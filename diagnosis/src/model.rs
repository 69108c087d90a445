//! The specification with deviations: a state machine as good as any.

use adsdv_conform::protocol::{Answer, InputField, Showing, Shown, ShownValues};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{
    AsState, Atom, Atoms, Choice, Control, Edition, Faults, Handshake, Inputs, Machine, Noticed, Outputs,
    Reaction, Taken, Term,
};

use crate::causes;
use crate::deviation::{Deviation, Remembers};
use crate::hop::{By, Hop};
use crate::rest::{AS_STATE, HANDSHAKE, Rest, SHUTDOWN_CAUSE, flags};
use crate::seen::as_seen;

/// What is taken where no row of the table is: a deviation leads on, or the program itself.
const NO_ROW: Taken = Taken { row: u8::MAX, term: u8::MAX };

/// No arrow has been open.
const NOT_WAITED: (u8, AsState) = (0, AsState::Off);

/// A state machine that does what an edition says, but for some deviations.
#[derive(Clone, Debug)]
pub struct Model {
    /// What it deviates from.
    usual: Edition,
    machine: Machine,
    showing: Showing,
    rest: Vec<Rest>,
    /// A bit for each that is remembered otherwise.
    remembers: u16,
    /// Whether the cause that it shows in an emergency is not the one that it remembers.
    hides_the_cause: bool,
}

/// What such a machine remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Memory {
    /// What the specification remembers.
    pub control: Control,
    /// For how many steps an arrow that is late has been open, and where it leads.
    waited: (u8, AsState),
    /// How long AS_READY has lasted in all, up to the time that counts.
    ready_ms: u16,
}

impl Memory {
    /// After power-on.
    pub const INITIAL: Self = Self { control: Control::INITIAL, waited: NOT_WAITED, ready_ms: 0 };

    /// Whether an arrow that is late has been open for longer than it was.
    pub(crate) const fn waits_longer_than(&self, before: &Self) -> bool {
        self.waited.0 > before.waited.0
    }
}

/// What a step finds before anything is remembered.
struct Found {
    noticed: Noticed,
    taken: Option<(Taken, AsState)>,
    waited: (u8, AsState),
    /// How long AS_READY has lasted in all.
    ready_ms: u16,
    /// The control state before the step, as the deviations leave it.
    before: Control,
}

impl Model {
    /// An edition with these deviations. Of what it does not have, none deviates.
    pub fn new(edition: &Edition, deviations: &[Deviation]) -> Self {
        let changed = crate::deviation::changed(edition, deviations);
        let rest: Vec<Rest> = deviations.iter().filter_map(Rest::of).collect();
        let remembers = rest.iter().fold(0, |all, rest| match rest {
            Rest::Remembers(what) => all | 1 << *what as u8,
            _ => all,
        });
        let (machine, showing) = (Machine::new(changed, changed.readings), Showing::of(edition));
        let hides_the_cause = deviations.iter().any(Deviation::hides_the_cause);
        Self { usual: *edition, machine, showing, rest, remembers, hides_the_cause }
    }

    /// The edition that it deviates from.
    pub(crate) const fn usual(&self) -> &Edition {
        &self.usual
    }

    /// The machine behind it, with the rules as they are changed.
    pub const fn machine(&self) -> &Machine {
        &self.machine
    }

    /// What an arrow needs besides its guard, as inputs and whether they have to have the value.
    pub(crate) fn needs(
        &self,
        arrow: (AsState, AsState),
    ) -> impl Iterator<Item = (&'static InputField, i32, bool)> + '_ {
        self.rest.iter().filter_map(move |rest| match *rest {
            Rest::Needs { from, to, field, raw, is } if (from, to) == arrow => Some((field, raw, is)),
            _ => None,
        })
    }

    /// Where a state goes as soon as an input has a value, besides the table.
    pub(crate) fn also(
        &self,
        state: AsState,
    ) -> impl Iterator<Item = (&'static InputField, i32, AsState)> + '_ {
        self.rest.iter().filter_map(move |rest| match *rest {
            Rest::Also { from, to, field, raw } if from == state => Some((field, raw, to)),
            _ => None,
        })
    }

    /// The inputs that tell something in a state besides the table.
    pub(crate) fn keys_besides(&self, state: AsState) -> impl Iterator<Item = &'static str> + '_ {
        self.rest.iter().filter_map(move |rest| match rest {
            Rest::Needs { from, field, .. } | Rest::Also { from, field, .. } if *from == state => {
                Some(field.key)
            }
            Rest::Opens { field, .. } => Some(field.key),
            _ => None,
        })
    }

    /// The alternatives that lead out of a state, in order, each with where it leads.
    pub(crate) fn terms(&self, state: AsState) -> impl Iterator<Item = (Term, AsState)> + '_ {
        let table = &self.machine.edition().rules.table;
        let arrows = self.machine.arrows(state);
        arrows.filter_map(move |taken| Some((*taken.term(table)?, taken.row(table)?.to)))
    }

    /// Everything that leads out of a state.
    pub(crate) fn hops(&self, state: AsState) -> Vec<Hop> {
        let terms = self.terms(state).map(|(term, to)| Hop { by: By::Term(term), to });
        let also = self.also(state).map(|(field, raw, to)| Hop { by: By::Also(field, raw), to });
        terms.chain(also).collect()
    }

    /// Whether the bit of the handshake that is shown is not the one that is remembered.
    pub(crate) fn shows_handshake_otherwise(&self) -> bool {
        self.rest.iter().any(|rest| match rest {
            Rest::Shows { place, .. } | Rest::Writes { place, .. } => *place == HANDSHAKE,
            _ => false,
        })
    }

    /// For how many steps an arrow is open before it is taken.
    pub(crate) fn delay(&self, arrow: (AsState, AsState)) -> u8 {
        let late = self.rest.iter().filter_map(|rest| match *rest {
            Rest::Late { from, to, steps } if (from, to) == arrow => Some(steps),
            _ => None,
        });
        late.max().unwrap_or(0)
    }

    fn remembers(&self, what: Remembers) -> bool {
        self.remembers & 1 << what as u8 != 0
    }

    fn has(&self, is: impl Fn(&Rest) -> bool) -> bool {
        self.rest.iter().any(is)
    }

    /// One step.
    pub fn step(&self, memory: &Memory, inputs: &Inputs, dt_ms: u32) -> (Memory, Outputs) {
        if self.rest.is_empty() {
            let (control, outputs) = self.machine.step(&memory.control, inputs, dt_ms);
            return (Memory { control, waited: NOT_WAITED, ready_ms: self.ready_ms(memory, dt_ms) }, outputs);
        }
        let found = self.find(memory, inputs, dt_ms);
        let (reaction, after) = self.remember(&found, found.taken);
        (after, self.machine.outputs(memory.control.state, &reaction, inputs.go))
    }

    /// One step of a program that answered this: what the model shows, and what the program remembers now if it did what its
    /// answer shows, whatever the model would have done. So one wrong answer does not make those behind it wrong.
    pub(crate) fn follow(
        &self,
        memory: &Memory,
        inputs: &Inputs,
        dt_ms: u32,
        answer: &Answer,
    ) -> (Outputs, Memory) {
        let found = self.find(memory, inputs, dt_ms);
        let (mut reaction, mut after) = self.remember(&found, found.taken);
        let outputs = self.machine.outputs(memory.control.state, &reaction, inputs.go);
        let (own, from) = (reaction.control.state, memory.control.state);
        if let Some(state) = self.state_behind(answer, own).filter(|state| *state != own) {
            let taken = (state != from).then_some((NO_ROW, state));
            let waited = if state == from { memory.waited } else { NOT_WAITED };
            (reaction, after) = self.remember(&Found { waited, ..found }, taken);
        }
        // In any other state none begins: what is shown there may be shown wrongly.
        if after.control.state == AsState::EmergencyBrake {
            let cause = if self.hides_the_cause {
                self.cause_by_flags(memory, inputs, &reaction, answer)
            } else {
                answer.raw_at(SHUTDOWN_CAUSE).flatten().and_then(ShutdownCause::from_raw)
            };
            after.control.shutdown_cause = cause.unwrap_or(after.control.shutdown_cause);
        }
        (outputs, after)
    }

    /// The cause of an emergency that begins, by the flags that an answer has and the model has not, or the other way round.
    fn cause_by_flags(
        &self,
        before: &Memory,
        inputs: &Inputs,
        reaction: &Reaction,
        answer: &Answer,
    ) -> Option<ShutdownCause> {
        let Control { state, shutdown_cause, .. } = before.control;
        if state == AsState::EmergencyBrake || shutdown_cause != ShutdownCause::NoShutdown {
            return None;
        }
        let values = self.values(&self.machine.outputs(state, reaction, inputs.go), inputs);
        let (expected, found) =
            (flags(|place| values.at(place)), flags(|place| answer.raw_at(place).flatten()));
        let more = found.difference(expected);
        let fewer = expected.difference(found);
        let faults = reaction.faults.union(more).difference(fewer);
        (faults != reaction.faults && !faults.is_empty()).then(|| faults.cause())
    }

    /// The state that a program is in by its answer, where the model would be in this one; `None` if the answer tells none.
    fn state_behind(&self, answer: &Answer, own: AsState) -> Option<AsState> {
        let raw = answer.raw_at(AS_STATE)??;
        let shown = |state: AsState| self.written(AS_STATE, state.raw()) == raw;
        if shown(own) { Some(own) } else { AsState::ALL.into_iter().find(|state| shown(*state)) }
    }

    /// The same as the first part of [`Machine::react`], with the deviations in it.
    fn find(&self, memory: &Memory, inputs: &Inputs, dt_ms: u32) -> Found {
        let Memory { mut control, waited, .. } = *memory;
        let machine = &self.machine;
        let (rules, from) = (&machine.edition().rules, control.state);
        let seen = as_seen(&self.rest, inputs).observe(&rules.thresholds);
        let braking = from == AsState::EmergencyBrake;
        let opening = seen.faults().intersection(Faults::OPENING);
        if self.remembers(Remembers::LatestCause) && braking && !opening.is_empty() {
            control.shutdown_cause = opening.cause();
        }
        if self.remembers(Remembers::TimerWhileAsmsOff) && braking && inputs.asms {
            control.in_state_ms = 0;
        }
        let atoms = machine.atoms_of(seen);
        let active = machine.readings().is(Choice::HandshakeAlways) || atoms.has(Atom::Tsms);
        let limit = rules.timing.handshake_ms;
        let answer = atoms.has(Atom::AiHandshake);
        let mut handshake = self.handshake(control.handshake, active, answer, dt_ms);
        let begins = active && !control.handshake.active;
        if begins && answer != control.handshake.bit && self.remembers(Remembers::TimeBeforeHandshake) {
            handshake.unanswered_ms = u16::try_from(dt_ms).unwrap_or(limit).min(limit);
        }
        if self.remembers(Remembers::CommsLost) && active && control.handshake.is_lost(limit) {
            handshake.unanswered_ms = limit;
        }
        let state_limit = u32::from(rules.timing.in_state_limit(from));
        let stopped = self.remembers(Remembers::TimerWhileAsmsOff) && braking && inputs.asms;
        let passed_ms = if stopped { 0 } else { dt_ms };
        let ready_ms = self.ready_ms(memory, dt_ms);
        let counted = self.remembers(Remembers::DwellOfAllVisits) && from == AsState::Ready;
        let lasted_ms = if counted { memory.ready_ms } else { control.in_state_ms };
        let lasted = u32::from(lasted_ms).saturating_add(passed_ms).min(state_limit);
        let in_state_ms = u16::try_from(lasted).unwrap_or(u16::MAX);
        let watched = active || machine.readings().is(Choice::WatchAlways);
        let mut comms_lost = handshake.is_lost(limit) || atoms.has(Atom::AiMessagesMissed) && watched;
        let was_lost = control.handshake.unanswered_ms >= limit;
        if self.remembers(Remembers::CommsLostForGood) && (comms_lost || was_lost) {
            (comms_lost, handshake.unanswered_ms) = (true, limit);
        }
        let mut atoms = atoms.union(machine.control_atoms(&control, in_state_ms, comms_lost, atoms));
        if self.has(|rest| matches!(rest, Rest::GoLevel)) && from == AsState::Ready {
            atoms = if inputs.go { atoms.with(Atom::GoEdge) } else { atoms };
        }
        let mismatch = active && answer != control.handshake.bit;
        if mismatch && self.has(|rest| matches!(rest, Rest::GoNeedsHandshake)) {
            atoms = atoms.without(Atom::GoEdge);
        }
        let (taken, waited) = self.first_arrow(from, atoms, inputs, waited);
        let noticed = Noticed { atoms, faults: seen.faults(), in_state_ms, handshake, comms_lost };
        Found { noticed, taken, waited, ready_ms, before: control }
    }

    /// The VCU's side of the handshake after a step, as far as that is no matter of time.
    fn handshake(&self, before: Handshake, active: bool, answer: bool, dt_ms: u32) -> Handshake {
        let kept = self.remembers(Remembers::HandshakeBit);
        if !active && self.remembers(Remembers::Handshake) {
            return before;
        }
        if active && !before.active && self.remembers(Remembers::HandshakeBeginsWithOne) {
            return Handshake { active, bit: true, unanswered_ms: 0 };
        }
        // What is kept is only shown: it begins as it does from rest.
        let from = if kept && !before.active { Handshake::IDLE } else { before };
        let after = from.step(active, answer, dt_ms, self.machine.edition().rules.timing.handshake_ms);
        if kept && !active { Handshake { bit: before.bit, ..after } } else { after }
    }

    /// How long AS_READY has lasted in all after a step, up to the time that counts.
    fn ready_ms(&self, memory: &Memory, dt_ms: u32) -> u16 {
        if memory.control.state != AsState::Ready {
            return memory.ready_ms;
        }
        let limit = self.machine.edition().rules.timing.in_state_limit(AsState::Ready);
        let lasted = u32::from(memory.ready_ms).saturating_add(dt_ms).min(u32::from(limit));
        u16::try_from(lasted).unwrap_or(limit)
    }

    /// The last part of a step, where this arrow is taken.
    fn remember(&self, found: &Found, taken: Option<(Taken, AsState)>) -> (Reaction, Memory) {
        let Found { noticed, before, waited, .. } = found;
        let mut reaction = self.machine.remember(before, noticed, taken);
        let (from, control) = (before.state, &mut reaction.control);
        let ready = AsState::Ready;
        if self.remembers(Remembers::GoSeenOff) && from == ready && control.state == ready {
            control.go_seen_low |= before.go_seen_low;
        }
        let remembers = |what| self.remembers(what);
        causes::apply(&self.rest, remembers, (before, noticed), &mut reaction);
        let control = reaction.control;
        (reaction, Memory { control, waited: *waited, ready_ms: found.ready_ms })
    }

    /// The arrow that is taken, and for how many steps one that is late has been open.
    fn first_arrow(
        &self,
        from: AsState,
        atoms: Atoms,
        inputs: &Inputs,
        waited: (u8, AsState),
    ) -> (Option<(Taken, AsState)>, (u8, AsState)) {
        let table = &self.machine.edition().rules.table;
        let open = self.machine.arrows(from).find_map(|taken| {
            let (row, term) = (taken.row(table)?, taken.term(table)?);
            let holds = term.on.is_subset(atoms) && term.off.intersection(atoms).is_empty();
            let has = |(field, raw, is): (&InputField, i32, bool)| ((field.get)(inputs) == raw) == is;
            (holds && self.needs((from, row.to)).all(has)).then_some((taken, row.to))
        });
        if let Some((taken, to)) = open {
            let steps = if waited.1 == to { waited.0 } else { 0 };
            return if steps < self.delay((from, to)) {
                (None, (steps + 1, to))
            } else {
                (Some((taken, to)), NOT_WAITED)
            };
        }
        let also = self.also(from).find(|(field, raw, _)| (field.get)(inputs) == *raw);
        (also.map(|(.., to)| (NO_ROW, to)), NOT_WAITED)
    }

    /// What a step shows.
    pub fn shown(&self, outputs: &Outputs, inputs: &Inputs) -> Shown {
        self.showing.in_words(self.values(outputs, inputs))
    }

    /// The same as plain numbers.
    pub(crate) fn values(&self, outputs: &Outputs, inputs: &Inputs) -> ShownValues {
        let right = self.showing.values(outputs, inputs);
        let mut shown = right;
        for rest in &self.rest {
            if let Rest::Writes { place, value, raw } = *rest
                && right.at(place) == Some(value)
            {
                shown = shown.with(place, raw);
            }
        }
        for rest in &self.rest {
            if let Rest::Shows { state, place, raw } = *rest
                && state == outputs.state
            {
                shown = shown.with(place, raw);
            }
        }
        shown
    }

    /// The same memory with a state that has lasted for its time.
    pub(crate) const fn patient(&self, memory: &Memory) -> Memory {
        let timing = &self.machine.edition().rules.timing;
        let mut patient = *memory;
        patient.control.in_state_ms = timing.in_state_limit(memory.control.state);
        patient.ready_ms = timing.in_state_limit(AsState::Ready);
        patient
    }

    /// What a step would show if nothing was shown wrongly.
    pub(crate) fn right(&self, outputs: &Outputs, inputs: &Inputs) -> Shown {
        self.showing.shown(outputs, inputs)
    }

    /// The number that is written for this value of an output.
    fn written(&self, place: usize, value: i32) -> i32 {
        let written = self.rest.iter().rev().find_map(|rest| match *rest {
            Rest::Writes { place: own, value: of, raw } if (own, of) == (place, value) => Some(raw),
            _ => None,
        });
        written.unwrap_or(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With a deviation that changes nothing, the long way has to give what the short one gives.
    #[test]
    fn without_a_deviation_it_is_the_specification() {
        let nothing = Deviation::Late { from: AsState::Off, to: AsState::Finished, steps: 1 };
        for edition in Edition::ALL {
            let (plain, long) = (Model::new(edition, &[]), Model::new(edition, &[nothing]));
            assert!(plain.rest.is_empty() && !long.rest.is_empty());
            let tests = adsdv_conform::suite::generate(edition);
            for test in &tests {
                let (mut one, mut other) = (Memory::INITIAL, Memory::INITIAL);
                for step in &test.scenario.steps {
                    let (after, outputs) = plain.step(&one, &step.inputs, step.dt_ms);
                    let (long_after, long_outputs) = long.step(&other, &step.inputs, step.dt_ms);
                    assert_eq!((after, outputs), (long_after, long_outputs), "{}", test.name);
                    (one, other) = (after, long_after);
                }
            }
        }
    }
}
