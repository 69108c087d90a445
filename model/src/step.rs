//! One step of the VCU.

use adsdv_spec::{Atoms, Control, Faults, Machine, Observation, Reaction, Taken, Timing};

use crate::cycle::cycle_ms;
use crate::document::Document;
use crate::steps::Steps;

/// A step: what was, what was seen, and what the VCU made of it.
///
/// Of the faults it has the conditions that they decide, and the cause that is remembered: steps that differ in the faults alone
/// are the same to a property that looks at them so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The document: what the machine should follow.
    pub document: &'static Document,
    /// The times that the document gives, or those of a model with other timers.
    pub timing: Timing,
    /// The control state before the step.
    pub before: Control,
    /// What the VCU saw.
    seen: Atoms,
    /// What it did, but for the faults that it shows.
    reaction: Reaction,
}

impl Step {
    /// The step of a machine, one cycle after its last.
    pub fn of(machine: &Machine, timing: &Timing, before: Control, seen: Observation) -> Self {
        let reaction = machine.react(&before, seen, cycle_ms(machine));
        Self::taken_by(Document::of_machine(machine), timing, before, seen, reaction)
    }

    /// The same where it is known what the machine does.
    pub(crate) fn taken_by(
        document: &'static Document,
        timing: &Timing,
        before: Control,
        seen: Observation,
        reaction: Reaction,
    ) -> Self {
        let reaction = Reaction { faults: Faults::NONE, ..reaction };
        Self { document, timing: *timing, before, seen: seen.atoms(), reaction }
    }

    /// Whether the same machine, out of the same state, would take the same step where it sees this and does that.
    pub(crate) fn is(&self, seen: Observation, reaction: &Reaction) -> bool {
        let Reaction { control, taken, atoms, faults: _ } = reaction;
        let own = &self.reaction;
        (self.seen, &own.control, &own.taken, &own.atoms) == (seen.atoms(), control, taken, atoms)
    }

    /// The same step, had it led to another control state.
    #[must_use]
    pub fn leading_to(self, control: Control) -> Self {
        Self { reaction: Reaction { control, ..self.reaction }, ..self }
    }

    /// The row that was taken; `None` if the state stays.
    pub const fn taken(&self) -> Option<Taken> {
        self.reaction.taken
    }

    /// All conditions as the guards saw them.
    pub const fn guarded(&self) -> Atoms {
        self.reaction.atoms
    }

    /// The control state after the step.
    pub fn after(&self) -> &Control {
        &self.reaction.control
    }

    /// Whether communication is lost: as [`Steps::comms_lost`] has it.
    pub fn comms_lost(&self) -> bool {
        self.steps().comms_lost() & self.steps().lanes() != 0
    }

    /// The step as properties look at it: as one of many.
    pub fn steps(&self) -> Steps<'_> {
        Steps::one(self.document, &self.timing, &self.before, self.seen, &self.reaction)
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{AsState, Atom};

    use super::*;

    #[test]
    fn requests_reach_all_of_the_actuators_or_none() {
        let machine = Machine::REFERENCE;
        let seen = Observation::new(Atoms::of(&[Atom::Asms, Atom::Tsms, Atom::GoOn]), Faults::NONE);
        for state in AsState::ALL {
            let control = Control { state, ..Control::INITIAL };
            let step = Step::of(&machine, &machine.edition().rules.timing, control, seen);
            let reach = step.steps().requests_reach(&machine, true);
            assert_eq!(reach, [state == AsState::Driving; 4], "{state}");
        }
    }

    /// A property that looks at no inputs finds out what holds of all.
    #[test]
    fn who_looks_at_the_inputs_is_noticed() {
        let machine = Machine::REFERENCE;
        let timing = &machine.edition().rules.timing;
        let step = Step::of(&machine, timing, Control::INITIAL, Observation::default());
        let steps = step.steps();
        let _ = (steps.have_lasted(), steps.next_have_lasted(), steps.comms_lost(), steps.drive(&machine));
        assert!(!steps.were_looked_at());
        let looks: [fn(&Steps) -> u64; 3] = [
            |steps| steps.see(Atom::Asms),
            |steps| steps.show(Atoms::NONE, Atoms::of(&[Atom::Asms])),
            |steps| steps.have_reason_to_brake(),
        ];
        for look in looks {
            look(&steps);
            assert!(steps.were_looked_at() && !steps.were_looked_at());
        }
    }
}
