//! The specification with deviations: a state machine as good as any.

use adsdv_oracle::conform::ProgramError;
use adsdv_oracle::protocol::{Answer, INPUTS, InputField, SHOWN, Shown};
use adsdv_spec::messages::WheelSpeed;
use adsdv_spec::{
    AsState, Atom, Atoms, Choice, Control, Edition, Inputs, Machine, Noticed, Outputs, Reaction, Taken,
};

use crate::deviation::{Deviation, Wheels};
use crate::subject::Subject;

/// A state machine that does what an edition says, but for some deviations.
#[derive(Clone, Debug)]
pub struct Model {
    /// What it deviates from.
    usual: Edition,
    machine: Machine,
    rest: Vec<Rest>,
}

/// What is no change of the rules, ready to be applied.
#[derive(Clone, Copy, Debug)]
enum Rest {
    Needs { from: AsState, to: AsState, field: &'static InputField, raw: i32, is: bool },
    Also { from: AsState, to: AsState, field: &'static InputField, raw: i32 },
    Late { from: AsState, to: AsState, steps: u8 },
    Wheels(Wheels),
    GoLevel,
    GoNeedsHandshake,
    Shows { state: AsState, place: usize, raw: i32 },
}

/// What such a machine remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory {
    /// What the specification remembers.
    pub control: Control,
    /// For how many steps an arrow that is late has been open.
    waited: u8,
}

impl Memory {
    /// After power-on.
    pub const INITIAL: Self = Self { control: Control::INITIAL, waited: 0 };
}

impl Model {
    /// An edition with these deviations. Of what it does not have, none deviates.
    pub fn new(edition: &Edition, deviations: &[Deviation]) -> Self {
        let changed = crate::deviation::changed(edition, deviations);
        let rest = deviations.iter().filter_map(Rest::of).collect();
        Self { usual: *edition, machine: Machine::new(changed, edition.readings), rest }
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

    /// For how many steps an arrow is open before it is taken.
    pub(crate) fn delay(&self, arrow: (AsState, AsState)) -> u8 {
        let late = self.rest.iter().filter_map(|rest| match *rest {
            Rest::Late { from, to, steps } if (from, to) == arrow => Some(steps),
            _ => None,
        });
        late.max().unwrap_or(0)
    }

    /// One step.
    pub fn step(&self, memory: &Memory, inputs: &Inputs, dt_ms: u32) -> (Memory, Outputs) {
        if self.rest.is_empty() {
            let (control, outputs) = self.machine.step(&memory.control, inputs, dt_ms);
            return (Memory { control, waited: 0 }, outputs);
        }
        let (reaction, waited) = self.react(memory, inputs, dt_ms);
        let outputs = self.machine.outputs(memory.control.state, &reaction, inputs.go);
        (Memory { control: reaction.control, waited }, outputs)
    }

    /// The same as [`Machine::react`], with the deviations in it.
    fn react(&self, Memory { control, waited }: &Memory, inputs: &Inputs, dt_ms: u32) -> (Reaction, u8) {
        let machine = &self.machine;
        let (rules, from) = (&machine.edition().rules, control.state);
        let seen = self.as_seen(inputs).observe(&rules.thresholds);
        let atoms = machine.atoms_of(seen);
        let active = machine.readings().is(Choice::HandshakeAlways) || atoms.has(Atom::Tsms);
        let limit = rules.timing.handshake_ms;
        let answer = atoms.has(Atom::AiHandshake);
        let handshake = control.handshake.step(active, answer, dt_ms, limit);
        let state_limit = u32::from(rules.timing.in_state_limit(from));
        let lasted = u32::from(control.in_state_ms).saturating_add(dt_ms).min(state_limit);
        let in_state_ms = u16::try_from(lasted).unwrap_or(u16::MAX);
        let watched = active || machine.readings().is(Choice::WatchAlways);
        let comms_lost = handshake.is_lost(limit) || atoms.has(Atom::AiMessagesMissed) && watched;
        let mut atoms = atoms.union(machine.control_atoms(control, in_state_ms, comms_lost, atoms));
        if self.rest.iter().any(|rest| matches!(rest, Rest::GoLevel)) && from == AsState::Ready {
            atoms = if inputs.go { atoms.with(Atom::GoEdge) } else { atoms };
        }
        let mismatch = active && answer != control.handshake.bit;
        if mismatch && self.rest.iter().any(|rest| matches!(rest, Rest::GoNeedsHandshake)) {
            atoms = atoms.without(Atom::GoEdge);
        }
        let (taken, waited) = self.first_arrow(from, atoms, inputs, *waited);
        let noticed = Noticed { atoms, faults: seen.faults(), in_state_ms, handshake, comms_lost };
        (machine.remember(control, &noticed, taken), waited)
    }

    /// The inputs as the deviations let it see them.
    fn as_seen(&self, inputs: &Inputs) -> Inputs {
        let mut seen = *inputs;
        for rest in &self.rest {
            if let Rest::Wheels(wheels) = rest {
                let speeds = &mut seen.vehicle.wheel_speeds;
                let each = [
                    speeds.fl_wheel_speed,
                    speeds.fr_wheel_speed,
                    speeds.rl_wheel_speed,
                    speeds.rr_wheel_speed,
                ];
                let counts = match wheels {
                    Wheels::All => each.iter().map(|wheel| wheel.raw()).min(),
                    Wheels::Only(wheel) => each.get(usize::from(*wheel)).map(|wheel| wheel.raw()),
                };
                let counts = WheelSpeed::clamped(counts.unwrap_or_default());
                (speeds.fl_wheel_speed, speeds.fr_wheel_speed) = (counts, counts);
                (speeds.rl_wheel_speed, speeds.rr_wheel_speed) = (counts, counts);
            }
        }
        seen
    }

    /// The arrow that is taken, and for how many steps one that is late has been open.
    fn first_arrow(
        &self,
        from: AsState,
        atoms: Atoms,
        inputs: &Inputs,
        waited: u8,
    ) -> (Option<(Taken, AsState)>, u8) {
        let table = &self.machine.edition().rules.table;
        let open = self.machine.arrows(from).find_map(|taken| {
            let (row, term) = (taken.row(table)?, taken.term(table)?);
            let holds = term.on.is_subset(atoms) && term.off.intersection(atoms).is_empty();
            let needs = self.needs((from, row.to)).all(|(field, raw, is)| ((field.get)(inputs) == raw) == is);
            (holds && needs).then_some((taken, row.to))
        });
        let also = self.rest.iter().find_map(|rest| match *rest {
            Rest::Also { from: own, to, field, raw } if own == from && (field.get)(inputs) == raw => Some(to),
            _ => None,
        });
        match (open, also) {
            (Some((_, to)), _) if waited < self.delay((from, to)) => (None, waited + 1),
            (Some(open), _) => (Some(open), 0),
            // It has no row: the first of the state stands for it.
            (None, Some(to)) => (self.machine.arrows(from).next().map(|taken| (taken, to)), 0),
            (None, None) => (None, 0),
        }
    }

    /// What a step shows.
    pub fn shown(&self, outputs: &Outputs, inputs: &Inputs) -> Shown {
        let mut shown = Shown::of(self.machine.edition(), outputs, inputs);
        for rest in &self.rest {
            if let Rest::Shows { state, place, raw } = *rest
                && state == outputs.state
            {
                shown = shown.with(place, raw);
            }
        }
        shown
    }

    /// A program that runs it, from power-on.
    pub const fn running(self) -> Running {
        Running { model: self, memory: Memory::INITIAL }
    }
}

impl Rest {
    fn of(deviation: &Deviation) -> Option<Self> {
        let field = |key: &str| INPUTS.iter().find(|field| field.key == key);
        Some(match *deviation {
            Deviation::Changed(_) => return None,
            Deviation::Needs { from, to, key, raw, is } => {
                Self::Needs { from, to, field: field(key)?, raw, is }
            }
            Deviation::Also { from, to, key, raw } => Self::Also { from, to, field: field(key)?, raw },
            Deviation::Late { from, to, steps } => Self::Late { from, to, steps },
            Deviation::Wheels(wheels) => Self::Wheels(wheels),
            Deviation::GoLevel => Self::GoLevel,
            Deviation::GoNeedsHandshake => Self::GoNeedsHandshake,
            Deviation::Shows { state, key, raw } => {
                Self::Shows { state, place: SHOWN.iter().position(|field| field.key == key)?, raw }
            }
        })
    }
}

/// A model that runs in this process, as a program under test would.
#[derive(Clone, Debug)]
pub struct Running {
    model: Model,
    memory: Memory,
}

impl Running {
    /// One step, and what it shows.
    pub fn shown(&mut self, dt_ms: u32, inputs: &Inputs) -> Shown {
        let (memory, outputs) = self.model.step(&self.memory, inputs, dt_ms);
        self.memory = memory;
        self.model.shown(&outputs, inputs)
    }
}

impl Subject for Running {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.memory = Memory::INITIAL;
        Ok(())
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        Ok(self.shown(dt_ms, inputs).into())
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
            let tests = adsdv_oracle::suite::generate(edition);
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
