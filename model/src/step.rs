//! One step of the VCU.

use adsdv_spec::{Atoms, Control, Edition, Faults, Machine, Observation, Reaction, Taken, Timing};

use crate::document::{DEFAULT, Document};
use crate::steps::Steps;

/// The VCU's cycle, which is the model's, and the same in every edition. That steps of any length are right is for the proofs.
pub(crate) const CYCLE_MS: u32 = {
    let cycle_ms = DEFAULT.rules.timing.cycle_ms;
    let mut place = 0;
    while place < Edition::ALL.len() {
        assert!(Edition::ALL[place].rules.timing.cycle_ms == cycle_ms, "the model steps every edition alike");
        place += 1;
    }
    cycle_ms as u32
};

/// A step: what was, what was seen, and what the VCU made of it.
///
/// Of the faults it has the conditions that they decide, and the cause that is remembered: steps that differ in the faults alone
/// are the same to whoever looks at them so.
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
        let reaction = machine.react(&before, seen, CYCLE_MS);
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
