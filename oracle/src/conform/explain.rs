//! Answers against the specification, under every combination of readings at once.
//!
//! There are thousands of combinations, and most of them do the same at a step. So combinations that are in the same
//! control state step together, and of those that do the same in its AS state only one steps: the arrows that leave
//! the state and the readings that the step itself asks for decide what it does.

use adsdv_spec::{AsState, Choices, Control, Edition, Machine, Outputs, Reading, Readings, Taken};

use super::set::Set;
use super::vcu::Reply;
use crate::protocol::Shown;
use crate::suite::{Scenario, Step};

/// The readings that a step asks for by itself, wherever it begins. All others only choose and order the arrows.
const ASKED: [Reading; 5] = [
    Reading::FaultTrigger,
    Reading::GoEdge,
    Reading::GoSignal,
    Reading::HandshakeActive,
    Reading::PowerCycle,
];

/// Combinations of readings, ready to be held against answers.
#[derive(Debug)]
pub(super) struct Explain {
    /// The default readings.
    usual: Readings,
    readings: Vec<Readings>,
    machines: Vec<Machine>,
    /// By state: machines of which each stands for all that do the same in that state, and for whom.
    classes: Vec<(AsState, Vec<(usize, Set)>)>,
}

impl Explain {
    /// Every combination of choices that are possible.
    pub(super) fn every(edition: &Edition, possible: Choices) -> Self {
        let questions: Vec<Reading> = edition.questions().collect();
        Self::new(edition, possible.intersection(edition.choices).combinations(&questions).collect())
    }

    /// These combinations, the ones that are preferred first.
    pub(super) fn new(edition: &Edition, readings: Vec<Readings>) -> Self {
        let machines: Vec<_> = readings.iter().map(|&answers| Machine::new(*edition, answers)).collect();
        let classes = AsState::ALL.into_iter().map(|state| (state, classes(&machines, state))).collect();
        Self { usual: edition.readings, readings, machines, classes }
    }

    /// How many questions these readings answer otherwise than the default ones do.
    pub(super) fn unusual(&self, readings: &Readings) -> usize {
        readings.choices().difference(self.usual.choices()).iter().count()
    }

    /// The combinations.
    pub(super) fn readings(&self) -> &[Readings] {
        &self.readings
    }

    /// The machine of a combination.
    pub(super) fn machine(&self, combination: usize) -> Option<&Machine> {
        self.machines.get(combination)
    }

    /// No combination.
    pub(super) fn none(&self) -> Set {
        Set::none(self.readings.len())
    }

    /// Every combination.
    pub(super) fn all(&self) -> Set {
        Set::all(self.readings.len())
    }

    /// The combinations under which these are right answers to a scenario, `late` steps late.
    pub(super) fn explaining(&self, scenario: &Scenario, replies: &[Reply], late: usize) -> Set {
        if !replies.iter().take(late).all(Reply::is_initial) {
            return self.none();
        }
        let mut groups = vec![(Control::INITIAL, self.all())];
        for (place, step) in scenario.steps.iter().enumerate() {
            // What a step shows that no answer tells any more cannot be wrong.
            let Some(reply) = replies.get(place + late) else { break };
            groups = self.step(&groups, step, reply);
        }
        groups.iter().fold(self.none(), |mut all, (_, members)| {
            all.add(members);
            all
        })
    }

    /// The groups after a step, without the combinations under which the answer is wrong.
    fn step(&self, groups: &[(Control, Set)], step: &Step, reply: &Reply) -> Vec<(Control, Set)> {
        let mut after: Vec<(Control, Set)> = Vec::with_capacity(groups.len());
        let mut judged: Vec<(Outputs, bool)> = Vec::new();
        for (control, members) in groups {
            let classes = self.classes.iter().filter(|(state, _)| *state == control.state);
            for (machine, class) in classes.flat_map(|(_, classes)| classes) {
                let Some(machine) = self.machines.get(*machine).filter(|_| class.meets(members)) else {
                    continue;
                };
                let (next, outputs) = machine.step(control, &step.inputs, step.dt_ms);
                if !right(&mut judged, &outputs, step, reply) {
                    continue;
                }
                let those = class.and(members);
                match after.iter_mut().find(|(other, _)| *other == next) {
                    Some((_, already)) => already.add(&those),
                    None => after.push((next, those)),
                }
            }
        }
        after
    }
}

/// Whether an answer is right where a step has these outputs; each is judged once.
fn right(judged: &mut Vec<(Outputs, bool)>, outputs: &Outputs, step: &Step, reply: &Reply) -> bool {
    let mut shown = *outputs;
    // What is shown depends on neither.
    (shown.taken, shown.from) = (None, outputs.state);
    if let Some((_, right)) = judged.iter().find(|(other, _)| *other == shown) {
        return *right;
    }
    let right = reply.agrees(&Shown::of(outputs, &step.inputs));
    judged.push((shown, right));
    right
}

/// Machines of which each stands for all that do the same in a state, and for whom.
fn classes(machines: &[Machine], state: AsState) -> Vec<(usize, Set)> {
    type Same = (Vec<Taken>, Choices);
    let asked =
        ASKED.iter().flat_map(|reading| reading.choices()).fold(Choices::NONE, |all, &one| all.with(one));
    let mut found: std::collections::HashMap<Same, usize> = std::collections::HashMap::new();
    let mut classes: Vec<(usize, Set)> = Vec::new();
    for (place, machine) in machines.iter().enumerate() {
        let same = (machine.arrows(state).collect(), machine.readings().choices().intersection(asked));
        let class = *found.entry(same).or_insert_with(|| {
            classes.push((place, Set::none(machines.len())));
            classes.len() - 1
        });
        if let Some((_, members)) = classes.get_mut(class) {
            members.insert(place);
        }
    }
    classes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conform::rng::Rng;
    use crate::conform::walker::Walker;

    /// One machine of a class stands for all of it: at every step of walks through every state.
    #[test]
    fn machines_of_a_class_do_the_same() {
        let explain = Explain::every(Edition::DEFAULT, Choices::ALL);
        assert_eq!(explain.readings.len(), 3072);
        assert_eq!(explain.readings[0], Readings::DEFAULT);
        let mut steps = 0;
        for seed in 0..24 {
            let machine = &explain.machines[(seed * 257) % explain.machines.len()];
            let scenario = Walker::new(machine, None, Rng::new(seed as u64, 0)).scenario();
            let mut control = Control::INITIAL;
            for Step { dt_ms, inputs } in &scenario.steps {
                let (_, classes) = explain.classes.iter().find(|(state, _)| *state == control.state).unwrap();
                for (first, members) in classes {
                    let step = |machine: usize| explain.machines[machine].step(&control, inputs, *dt_ms);
                    assert!(members.iter().all(|member| step(member) == step(*first)), "{control:?}");
                }
                assert_eq!(classes.iter().map(|(_, members)| members.iter().count()).sum::<usize>(), 3072);
                control = machine.step(&control, inputs, *dt_ms).0;
                steps += 1;
            }
        }
        assert!(steps > 300);
    }

    #[test]
    fn stepping_together_is_stepping_one_by_one() {
        let explain = Explain::every(Edition::DEFAULT, Choices::ALL);
        for seed in 0..10 {
            let machine = &explain.machines[(seed * 1009) % explain.machines.len()];
            let scenario = Walker::new(machine, None, Rng::new(seed as u64, 1)).scenario();
            let shown: Vec<Shown> = scenario.shown(machine).collect();
            let replies: Vec<Reply> = shown.iter().map(|&shown| Reply::from(shown)).collect();
            let together = explain.explaining(&scenario, &replies, 0);
            for (place, other) in explain.machines.iter().enumerate().step_by(7) {
                let alone = scenario.shown(other).zip(&shown).all(|(a, b)| a == *b);
                assert_eq!(together.has(place), alone, "{}", other.readings());
            }
        }
    }
}
