//! Steps made one by one.

use adsdv_spec::Control;

use super::{Looker, Shown};
use crate::action::Action;
use crate::cycle::cycle_ms;
use crate::planes::Words;
use crate::step::Step;

impl Looker {
    pub(super) fn one_by_one(&self, control: &Control, vectors: &Words) -> Shown {
        let properties = self.properties(control);
        let (mut broken, mut next) = (0, Vec::new());
        let mut last: Option<Step> = None;
        for &seen in vectors.iter() {
            let reaction = self.machine.react(control, seen, cycle_ms(&self.machine));
            // Many steps differ from the one before them in the faults alone.
            if last.as_ref().is_some_and(|last| last.is(seen, &reaction)) {
                continue;
            }
            let step = Step::taken_by(self.document, &self.timing, *control, seen, reaction);
            let steps = step.steps();
            for (place, property) in properties {
                broken |= u64::from(property.broken_in(&self.machine, &steps) != 0) << place;
            }
            if !next.iter().any(|(after, _)| after == step.after()) {
                next.push((*step.after(), Action::Step(seen)));
            }
            last = Some(step);
        }
        (broken, next)
    }
}
