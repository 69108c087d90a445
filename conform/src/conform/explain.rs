//! Answers against the specification, under every combination of readings at once.
//!
//! There are thousands of combinations, and most of them do the same at a step. So combinations that are in the same
//! control state step together, and of those that do the same in its AS state only one steps: the arrows that leave
//! the state and the readings that the step itself asks for decide what it does.

use std::collections::HashMap;

use adsdv_spec::{AsState, Choices, Control, Edition, Machine, Outputs, Reading, Readings, Taken};

use super::set::Set;
use super::vcu::Reply;
use crate::protocol::Shown;
use crate::suite::{Scenario, Step};

/// The readings that a step asks for by itself where it begins in this state. All others only choose and order the arrows.
fn asked(state: AsState) -> impl Iterator<Item = Reading> {
    use Reading::{BmsFault, FaultTrigger, GoEdge, GoSignal, HandshakeActive, MessageWatch, PowerCycle};
    let everywhere = [GoSignal, HandshakeActive, MessageWatch, BmsFault];
    let there: &[Reading] = match state {
        AsState::Off => &[GoEdge],
        AsState::Ready => &[GoEdge, FaultTrigger, PowerCycle],
        AsState::Driving => &[FaultTrigger, PowerCycle],
        AsState::EmergencyBrake => &[],
        AsState::Finished => &[PowerCycle],
    };
    everywhere.into_iter().chain(there.iter().copied())
}

/// Combinations of readings, ready to be held against answers.
#[derive(Debug)]
pub(super) struct Explain {
    /// The questions that the edition leaves open.
    questions: Vec<Reading>,
    /// The default readings.
    usual: Readings,
    edition: Edition,
    readings: Vec<Readings>,
    /// By state: machines of which each stands for all that do the same in that state, and for whom. A machine for each
    /// combination would take a hundred megabytes.
    classes: Vec<(AsState, Vec<(Machine, Set)>)>,
}

impl Explain {
    /// Every combination of choices that are possible.
    pub(super) fn every(edition: &Edition, possible: Choices) -> Self {
        let questions: Vec<Reading> = edition.questions().collect();
        Self::new(edition, possible.intersection(edition.choices).combinations(&questions).collect())
    }

    /// These combinations, the ones that are preferred first.
    pub(super) fn new(edition: &Edition, readings: Vec<Readings>) -> Self {
        let questions = edition.questions().collect();
        let classes = classes(edition, &readings);
        Self { questions, usual: edition.readings, edition: *edition, readings, classes }
    }

    /// The questions that the edition leaves open.
    pub(super) fn questions(&self) -> &[Reading] {
        &self.questions
    }

    /// How many questions these readings answer otherwise than the default ones do.
    pub(super) fn unusual(&self, readings: &Readings) -> usize {
        readings.choices().difference(self.usual.choices()).len()
    }

    /// The combinations.
    pub(super) fn readings(&self) -> &[Readings] {
        &self.readings
    }

    /// The machine of a combination.
    pub(super) fn machine(&self, combination: usize) -> Option<Machine> {
        Some(Machine::new(self.edition, *self.readings.get(combination)?))
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
            // Of many classes most do the same: what they have in common with the group is worked out once for all of these.
            let mut alike: Vec<(Control, Set)> = Vec::new();
            for (machine, class) in classes.flat_map(|(_, classes)| classes) {
                if !class.meets(members) {
                    continue;
                }
                let (next, outputs) = machine.step(control, &step.inputs, step.dt_ms);
                if !right(&mut judged, machine.edition(), &outputs, step, reply) {
                    continue;
                }
                match alike.iter_mut().find(|(other, _)| *other == next) {
                    Some((_, already)) => already.add(class),
                    None => alike.push((next, class.clone())),
                }
            }
            for (next, classes) in alike {
                let those = classes.and(members);
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
fn right(
    judged: &mut Vec<(Outputs, bool)>,
    edition: &Edition,
    outputs: &Outputs,
    step: &Step,
    reply: &Reply,
) -> bool {
    let mut shown = *outputs;
    // What is shown depends on neither.
    (shown.taken, shown.from) = (None, outputs.state);
    if let Some((_, right)) = judged.iter().find(|(other, _)| *other == shown) {
        return *right;
    }
    let right = reply.agrees(&Shown::of(edition, outputs, &step.inputs));
    judged.push((shown, right));
    right
}

/// By state: machines of which each stands for all that do the same in that state, and for whom.
fn classes(edition: &Edition, readings: &[Readings]) -> Vec<(AsState, Vec<(Machine, Set)>)> {
    type Same = (Vec<Taken>, Choices);
    let asked =
        |state| asked(state).flat_map(Reading::choices).fold(Choices::NONE, |all, &one| all.with(one));
    let asked = AsState::ALL.map(|state| (state, asked(state)));
    let mut found = asked.map(|(state, asked)| (state, asked, HashMap::<Same, usize>::new(), Vec::new()));
    for (place, &answers) in readings.iter().enumerate() {
        let machine = Machine::new(*edition, answers);
        for (state, asked, found, classes) in &mut found {
            let same = (machine.arrows(*state).collect(), machine.readings().choices().intersection(*asked));
            let class = *found.entry(same).or_insert_with(|| {
                classes.push((machine, Set::none(readings.len())));
                classes.len() - 1
            });
            if let Some((_, members)) = classes.get_mut(class) {
                members.insert(place);
            }
        }
    }
    found.into_iter().map(|(state, _, _, classes)| (state, classes)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conform::rng::Rng;
    use crate::conform::walker::Walker;

    /// Every edition whose rules or choices are its own, and how many combinations of readings it has.
    const EDITIONS: [(&Edition, usize); 2] = [(&Edition::V3_0, 3072), (&Edition::V4_0, 12288)];

    /// What is tried of these editions holds for all: readings ask for nothing but rules and choices.
    #[test]
    fn every_edition_has_the_rules_and_the_choices_of_one_that_is_tried() {
        for edition in Edition::ALL {
            let tried = |of: &Edition| (of.rules, of.choices) == (edition.rules, edition.choices);
            let is_tried = EDITIONS.iter().any(|(of, _)| tried(of));
            assert!(
                is_tried,
                "`EDITIONS` of this file needs {}, with how many combinations it has",
                edition.version
            );
        }
    }

    /// One machine of a class stands for all of it: at every step of walks through every state.
    #[test]
    fn machines_of_a_class_do_the_same() {
        for (edition, combinations) in EDITIONS {
            let explain = Explain::every(edition, Choices::ALL);
            assert_eq!(explain.readings.len(), combinations);
            assert!(explain.readings.contains(&edition.readings));
            let machines: Vec<Machine> =
                (0..combinations).filter_map(|place| explain.machine(place)).collect();
            let mut steps = 0;
            for seed in 0..24 {
                let machine = &machines[(seed * 257) % combinations];
                let scenario = Walker::new(machine, None, Rng::new(seed as u64, 0)).scenario();
                let mut control = Control::INITIAL;
                for Step { dt_ms, inputs } in &scenario.steps {
                    let of_state = explain.classes.iter().find(|(state, _)| *state == control.state);
                    let (_, classes) = of_state.expect("each state has its classes");
                    for (first, members) in classes {
                        let step = |machine: &Machine| machine.step(&control, inputs, *dt_ms);
                        let first = step(first);
                        assert!(members.iter().all(|member| step(&machines[member]) == first), "{control:?}");
                    }
                    let all: usize = classes.iter().map(|(_, members)| members.iter().count()).sum();
                    assert_eq!(all, combinations);
                    control = machine.step(&control, inputs, *dt_ms).0;
                    steps += 1;
                }
            }
            assert!(steps > 300);
        }
    }

    #[test]
    fn stepping_together_is_stepping_one_by_one() {
        for (edition, combinations) in EDITIONS {
            let explain = Explain::every(edition, Choices::ALL);
            for seed in 0..10 {
                let machine = explain.machine((seed * 1009) % combinations).expect("a combination");
                let scenario = Walker::new(&machine, None, Rng::new(seed as u64, 1)).scenario();
                let shown: Vec<Shown> = scenario.shown(&machine).collect();
                let replies: Vec<Reply> = shown.iter().map(|&shown| Reply::from(shown)).collect();
                let together = explain.explaining(&scenario, &replies, 0);
                for place in (0..combinations).step_by(7) {
                    let other = explain.machine(place).expect("a combination");
                    let alone = scenario.shown(&other).zip(&shown).all(|(a, b)| a == *b);
                    assert_eq!(together.has(place), alone, "{}", other.readings());
                }
            }
        }
    }
}
