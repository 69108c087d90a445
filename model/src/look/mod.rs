//! A look at a control state: every step out of it, made once.
//!
//! Stateright asks for properties of states. A property of steps holds in a state if every step out of it keeps it. What the
//! steps show is found by one of two [`Engine`]s, which find the same.

mod single;
mod words;

use adsdv_network::Network;
use adsdv_spec::{Control, Machine, Timing};

use crate::action::Action;
use crate::document::Document;
use crate::goals::goals;
use crate::planes::Words;
use crate::property::Property;

/// How the steps out of a control state are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Engine {
    /// 64 at a time, by a network over machine words (`adsdv-network`): theorems say that it is the step.
    #[default]
    Words,
    /// One by one, by [`Machine::react`]: slower, and the reference.
    Single,
}

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

/// Who looks at the control states of a machine.
#[derive(Debug)]
pub(crate) struct Looker {
    machine: Machine,
    document: &'static Document,
    /// The times that the properties speak of.
    timing: Timing,
    /// Of the engine that makes 64 steps at a time.
    network: Option<Box<Network>>,
}

impl Looker {
    pub(crate) fn new(machine: &Machine, timing: &Timing, engine: Engine) -> Self {
        let network = (engine == Engine::Words).then(|| Box::new(Network::new(machine)));
        Self { machine: *machine, document: Document::of_machine(machine), timing: *timing, network }
    }

    /// Looks at a control state with these input vectors.
    pub(crate) fn look(&self, control: &Control, vectors: &Words) -> Look {
        let (broken, next) = match &self.network {
            Some(network) => self.in_words(network, control, vectors),
            None => self.one_by_one(control, vectors),
        };
        let mut look = Look { broken, reached: 0, ways: Vec::new(), steps: vectors.len() as u64 };
        for (after, way) in next {
            look.ways.push(way);
            for (place, goal) in goals(self.document.edition).iter().enumerate() {
                look.reached |= u64::from(goal.is_reached(control, &after)) << place;
            }
        }
        if *control != Control::INITIAL {
            look.ways.push(Action::PowerCycle);
        }
        look
    }

    /// The properties to which steps from a control state can matter.
    fn properties(&self, control: &Control) -> &'static [(usize, &'static Property)] {
        Property::of(self.document.edition, control.state)
    }
}

/// What steps break, a bit for each place in the list of properties, and each control state that comes next, with the
/// first step that leads there.
type Shown = (u64, Vec<(Control, Action)>);

#[cfg(test)]
mod tests {
    use adsdv_spec::{Edition, Mutation, Readings};

    use super::*;
    use crate::document::state_machines;
    use crate::reachable::reachable;
    use crate::short_timers::short_timers;
    use crate::step::Step;
    use crate::vectors::{Cache, Vectors, varied};

    /// What both engines see at every so many-th of the control states that are given: how many steps, and what they break.
    fn both(
        machine: &Machine,
        timing: &Timing,
        states: &[Control],
        every: usize,
        vectors: Vectors,
    ) -> (u64, u64) {
        let lookers = [Engine::Words, Engine::Single].map(|engine| Looker::new(machine, timing, engine));
        let cache = Cache::default();
        let (mut steps, mut broken) = (0, 0);
        for control in states.iter().step_by(every) {
            let vectors = cache.get(varied(machine, timing, control, vectors), vectors);
            let [words, single] = lookers.each_ref().map(|looker| looker.look(control, &vectors));
            assert_eq!(words, single, "{control:?}");
            steps += words.steps;
            broken |= words.broken;
        }
        (steps, broken)
    }

    fn short(edition: &Edition) -> Edition {
        edition.with_timing(short_timers(edition))
    }

    fn all(machine: &Machine, timing: Timing) -> Vec<Control> {
        let mut states: Vec<Control> = reachable(machine, timing, Vectors::Few).into_iter().collect();
        states.sort_unstable();
        states
    }

    /// In every edition, with the default answers, with each other one alone and with all of them at once: the same steps, ways,
    /// properties and goals at every control state, and with every input vector at some.
    #[test]
    fn both_engines_find_the_same_under_every_answer() {
        let mut all_steps = 0;
        for edition in Edition::ALL {
            let timing = short_timers(edition);
            let others = edition.alternatives();
            let together = others.iter().fold(edition.readings, Readings::with);
            let alone = others.iter().map(|choice| edition.readings.with(choice));
            for readings in alone.chain([edition.readings, together]) {
                let machine = Machine::new(short(edition), readings);
                let states = all(&machine, timing);
                all_steps += both(&machine, &timing, &states, 1, Vectors::Few).0;
                all_steps += both(&machine, &timing, &states, 211, Vectors::Every).0;
            }
        }
        assert!(all_steps > 10_000_000, "{all_steps}");
    }

    /// And of each mutant of the table of each edition that has one of its own, from its own control states.
    #[test]
    fn both_engines_find_the_same_of_each_mutant() {
        let mut all_broken = 0_u64;
        for edition in state_machines() {
            let timing = short_timers(edition);
            for mutation in Mutation::all(edition) {
                let machine = Machine::new(mutation.apply(&short(edition)), edition.readings);
                let states = all(&machine, timing);
                all_broken |= both(&machine, &timing, &states, 23, Vectors::Read).1;
            }
        }
        assert!(all_broken.count_ones() > 25, "the mutants break many: {all_broken:b}");
    }

    /// What a look says of the properties is what each of them says of each step.
    #[test]
    fn properties_of_many_steps_at_once_are_those_of_each_step() {
        for edition in Edition::ALL {
            let timing = short_timers(edition);
            let mutant = |mutation: Mutation| Machine::new(mutation.apply(&short(edition)), edition.readings);
            let states = all(&Machine::new(short(edition), edition.readings), timing);
            for machine in Mutation::all(edition).map(mutant).step_by(7) {
                let (cache, looker) = (Cache::default(), Looker::new(&machine, &timing, Engine::Words));
                for control in states.iter().step_by(101) {
                    let vectors = cache.get(varied(&machine, &timing, control, Vectors::Few), Vectors::Few);
                    let breaks = |property: &Property| {
                        let step = |seen| Step::of(&machine, &timing, *control, seen);
                        vectors.iter().any(|&seen| !property.holds(&machine, &step(seen)))
                    };
                    let properties = Property::of_edition(looker.document.edition);
                    let broken = properties.filter(|(_, property)| breaks(property));
                    let broken = broken.fold(0, |all, (place, _)| all | 1 << place);
                    assert_eq!(looker.look(control, &vectors).broken, broken, "{control:?}");
                }
            }
        }
    }
}
