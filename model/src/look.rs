//! A look at a control state: every step out of it, made once.
//!
//! Stateright asks for properties of states. A property of steps holds in a state if every step out of it keeps it.

use adsdv_spec::{Control, Machine, Timing};

use crate::action::Action;
use crate::document::Document;
use crate::goals::goals;
use crate::planes::Words;
use crate::property::{Led, Property};
use crate::step::{CYCLE_MS, Step};

/// What the steps out of a control state showed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Look {
    /// The properties that some step breaks, a bit for each place in
    /// [`PROPERTIES`](crate::PROPERTIES).
    pub(crate) broken: u64,
    /// The goals that some step reaches, a bit for each place in [`goals`].
    pub(crate) reached: u64,
    /// One way to each control state that comes next.
    pub(crate) ways: Vec<Action>,
    /// How many steps were made.
    pub(crate) steps: u64,
}

/// Looks at a control state with these input vectors; `timing` has the times that the properties speak of.
pub(crate) fn look(machine: &Machine, timing: &Timing, control: &Control, vectors: &Words) -> Look {
    let document = Document::of_machine(machine);
    let (each, at_once): (Vec<_>, Vec<_>) = Property::of(document.edition, control.state)
        .iter()
        .partition::<Vec<_>, _>(|(_, property)| property.needs_each_step());
    let mut look = Look { steps: vectors.len() as u64, ..Look::default() };
    let mut next: Vec<Control> = Vec::new();
    // Most steps lead where the one before them led, and many differ from it in the faults alone.
    let mut last: Option<Step> = None;
    for (word, planes) in vectors.words() {
        let mut lead = Led::default();
        for (place, &seen) in word.iter().enumerate() {
            let reaction = machine.react(control, seen, CYCLE_MS);
            lead.leads(place, reaction.control.state);
            if last.as_ref().is_some_and(|last| last.is(seen, &reaction)) {
                continue;
            }
            let step = Step::taken_by(document, timing, *control, seen, reaction);
            for (place, property) in &each {
                look.broken |= u64::from(!property.holds(machine, &step)) << place;
            }
            if last.as_ref().is_none_or(|last| last.after() != step.after()) && !next.contains(step.after()) {
                next.push(*step.after());
                look.ways.push(Action::Step(seen));
            }
            last = Some(step);
        }
        for (place, property) in &at_once {
            look.broken |= u64::from(property.is_broken_in(planes, &lead)) << place;
        }
    }
    for after in &next {
        for (place, goal) in goals(document.edition).iter().enumerate() {
            look.reached |= u64::from(goal.is_reached(control, after)) << place;
        }
    }
    if *control != Control::INITIAL {
        look.ways.push(Action::PowerCycle);
    }
    look
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Edition, Mutation};

    use super::*;
    use crate::reachable::reachable;
    use crate::sweep::short_timers;
    use crate::vectors::{Cache, Vectors, varied};

    /// What a look says of the properties is what each of them says of each step: in every edition, of the document's machine and of
    /// each mutant of its table.
    #[test]
    fn properties_of_64_steps_at_once_are_those_of_each_step() {
        let mut broken = 0_u64;
        for edition in Edition::ALL {
            let timing = short_timers(edition);
            let machine = |edition: Edition| Machine::new(edition.with_timing(timing), edition.readings);
            let mutants = Mutation::all(edition).map(|mutation| machine(mutation.apply(edition)));
            let cache = Cache::default();
            let original = machine(**edition);
            let mut states: Vec<Control> = reachable(&original, timing, Vectors::Few).into_iter().collect();
            states.sort_unstable();
            for machine in std::iter::once(original).chain(mutants) {
                for control in states.iter().step_by(101) {
                    let vectors = cache.get(varied(&machine, &timing, control, Vectors::Few), Vectors::Few);
                    let look = look(&machine, &timing, control, &vectors);
                    let one_by_one = Property::of(Document::of_machine(&machine).edition, control.state)
                        .iter()
                        .filter(|(_, property)| {
                            vectors.iter().any(|&seen| {
                                !property.holds(&machine, &Step::of(&machine, &timing, *control, seen))
                            })
                        })
                        .fold(0, |all, (place, _)| all | 1 << place);
                    assert_eq!(look.broken, one_by_one, "{control:?}");
                    broken |= one_by_one;
                }
            }
        }
        assert!(broken.count_ones() > 25, "the mutants break many: {broken:b}");
    }
}
