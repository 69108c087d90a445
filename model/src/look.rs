//! A look at a control state: every step out of it, made once.
//!
//! Stateright asks for properties of states. A property of steps holds in a state if every step out of it keeps it.

use adsdv_spec::{Control, Machine, Observation, Timing};

use crate::action::Action;
use crate::document::Document;
use crate::goals::goals;
use crate::property::Property;
use crate::step::Step;

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
pub(crate) fn look(machine: &Machine, timing: &Timing, control: &Control, vectors: &[Observation]) -> Look {
    let document = Document::of_machine(machine);
    let concerned = Property::of(document.edition, control.state);
    let mut look = Look { steps: vectors.len() as u64, ..Look::default() };
    let mut next: Vec<Control> = Vec::new();
    // Most steps lead where the one before them led.
    let mut last = None;
    for &seen in vectors {
        let step = Step::of_document(machine, document, timing, *control, seen);
        for (place, property) in concerned {
            look.broken |= u64::from(!property.holds(machine, &step)) << place;
        }
        if last.replace(*step.after()) != Some(*step.after()) && !next.contains(step.after()) {
            next.push(*step.after());
            look.ways.push(Action::Step(seen));
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
