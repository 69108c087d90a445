//! The shortest scenario that shows a deviation: by itself, or beside as few others as can be.

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{Difference, Shown};
use adsdv_conform::suite::{self, Scenario, Step};
use adsdv_spec::{AsState, Edition};

use crate::deviation::Deviation;
use crate::experiments;
use crate::interface::Interface;
use crate::model::{Memory, Model};
use crate::ways::Ways;

/// A scenario in whose last step a deviation shows.
#[derive(Clone, Debug)]
pub struct Example {
    /// The steps.
    pub scenario: Scenario,
    /// What is shown in the last of them, and what is expected there.
    pub differences: Vec<Difference>,
    /// The other deviations without which it would not be the same.
    pub beside: Vec<Deviation>,
}

/// A step, with whether the AI Computer answers the handshake in it.
#[derive(Clone, Copy, PartialEq)]
struct Relative {
    step: Step,
    answers: bool,
}

/// For each of the deviations of a program the shortest scenario that was found with the inputs and the outputs that it has.
///
/// # Errors
///
/// Those of the program under test; the machine with these deviations, which is asked in this process, has none.
pub fn examples(
    edition: &Edition,
    interface: &Interface,
    deviations: &[Deviation],
) -> Result<Vec<Option<Example>>, ProgramError> {
    let program = Model::new(edition, deviations);
    let ways = Ways::of(&program, interface);
    let asked = experiments::all(&mut program.clone().running(), &ways, 0, &AsState::ALL, None)?;
    let usual = Model::new(edition, &[]);
    let tests = suite::generate(edition);
    let asked = asked.iter().map(|record| relative(&program, &record.steps));
    // The tests have every time and threshold just below, at, and just above.
    let can_be_asked = |test: &&suite::Test| {
        let lasts = |ms: u32| interface.cycle_ms().is_none_or(|cycle| ms > 0 && ms.is_multiple_of(cycle));
        let can = |step: &Step| interface.held(step.inputs) == step.inputs && lasts(step.dt_ms);
        test.scenario.steps.iter().all(can)
    };
    let tested = tests.iter().filter(can_be_asked).map(|test| relative(&usual, &test.scenario.steps));
    let pool: Vec<Vec<Relative>> = asked.chain(tested).collect();
    let search = |place| ExampleSearch::new(edition, interface, deviations, place).shortest(&pool);
    Ok((0..deviations.len()).map(search).collect())
}

/// What tells one deviation from the others.
struct ExampleSearch<'a> {
    edition: &'a Edition,
    interface: &'a Interface,
    program: Model,
    /// The program without it.
    without: Model,
    /// The other deviations, each with the program without that one.
    others: Vec<(Deviation, Model)>,
}

impl<'a> ExampleSearch<'a> {
    fn new(edition: &'a Edition, interface: &'a Interface, deviations: &[Deviation], place: usize) -> Self {
        let but = |place: usize| {
            let mut fewer = deviations.to_vec();
            fewer.remove(place);
            Model::new(edition, &fewer)
        };
        let others = deviations.iter().enumerate().filter(|(other, _)| *other != place);
        Self {
            edition,
            interface,
            program: Model::new(edition, deviations),
            without: but(place),
            others: others.map(|(other, deviation)| (*deviation, but(other))).collect(),
        }
    }

    /// The best of the steps that were asked, shortened.
    fn shortest(&self, pool: &[Vec<Relative>]) -> Option<Example> {
        let shown = pool.iter().filter_map(|steps| self.cut(steps));
        let best = shown.min_by_key(|steps| (self.beside(steps).len(), steps.len(), time_ms(steps)))?;
        let best = self.shortened(best);
        let mut scenario = self.scenario(&best);
        // At a fixed cycle the last step is as many as it takes.
        scenario.steps.truncate(self.first_difference(&self.without, &scenario)? + 1);
        let last = last_shown(&self.program, &scenario)?;
        let usual = Model::new(self.edition, &[]);
        // Where another deviation hides what the document expects, it is what the program would show without this one.
        let expected = last_shown(&usual, &scenario).filter(|shown| !self.interface.are_alike(&last, shown));
        let expected = expected.or_else(|| last_shown(&self.without, &scenario))?;
        let differences = self.interface.compared(&last.into()).differences(&expected).collect();
        Some(Example { scenario, differences, beside: self.beside(&best) })
    }

    /// The steps up to the first in which the deviation shows; `None` if there is none.
    fn cut(&self, steps: &[Relative]) -> Option<Vec<Relative>> {
        let scenario = self.scenario(steps);
        let place = self.first_difference(&self.without, &scenario)?;
        let mut ends = 0;
        let count = steps.iter().take_while(|one| {
            let begins = ends;
            ends += self.interface.cycles(one.step.dt_ms);
            begins <= place
        });
        Some(count.copied().collect())
    }

    /// The others that matter in these steps.
    fn beside(&self, steps: &[Relative]) -> Vec<Deviation> {
        let scenario = self.scenario(steps);
        let matters =
            |(_, without): &&(Deviation, Model)| self.first_difference(without, &scenario).is_some();
        self.others.iter().filter(matters).map(|(deviation, _)| *deviation).collect()
    }

    /// Leaves out steps, and joins such as differ in nothing but the time, as long as it shows in the last one and no more of the
    /// others matter.
    fn shortened(&self, mut steps: Vec<Relative>) -> Vec<Relative> {
        let most = self.beside(&steps).len();
        let is_as_good = |fewer: &Vec<Relative>| {
            self.cut(fewer).is_some_and(|cut| cut.len() == fewer.len()) && self.beside(fewer).len() <= most
        };
        let mut place = 0;
        while place < steps.len() {
            let mut fewer = steps.clone();
            let left_out = fewer.remove(place);
            let alone = fewer.clone();
            let joined = fewer.get_mut(place).map(|next| {
                next.step.dt_ms = next.step.dt_ms.saturating_add(left_out.step.dt_ms);
            });
            if is_as_good(&alone) {
                steps = alone;
            } else if joined.is_some() && is_as_good(&fewer) {
                steps = fewer;
            } else {
                place += 1;
            }
        }
        steps
    }

    /// The first step in which the program does not show what another does.
    fn first_difference(&self, other: &Model, scenario: &Scenario) -> Option<usize> {
        let mut both = shown(&self.program, scenario).zip(shown(other, scenario));
        both.position(|(one, other)| !self.interface.are_alike(&one, &other))
    }

    /// The steps, with the handshake as the AI Computer answers the program's own bit.
    fn scenario(&self, steps: &[Relative]) -> Scenario {
        let mut memory = Memory::INITIAL;
        let mut bit = false;
        let cycle_ms = self.interface.cycle_ms();
        let all = steps.iter().flat_map(|one| {
            let dt_ms = cycle_ms.unwrap_or(one.step.dt_ms);
            let each = Relative { step: Step { dt_ms, ..one.step }, ..*one };
            std::iter::repeat_n(each, self.interface.cycles(one.step.dt_ms))
        });
        let each = all.map(|one| {
            let mut step = one.step;
            step.inputs.ai.status.handshake = bit == one.answers;
            step.inputs = self.interface.held(step.inputs);
            let (after, outputs) = self.program.step(&memory, &step.inputs, step.dt_ms);
            (memory, bit) = (after, outputs.handshake);
            step
        });
        Scenario { steps: each.collect() }
    }
}

/// The steps, with whether each answers the bit that the program showed before.
fn relative(program: &Model, steps: &[Step]) -> Vec<Relative> {
    let mut memory = Memory::INITIAL;
    let mut bit = false;
    let each = steps.iter().map(|step| {
        let answers = step.inputs.ai.status.handshake == bit;
        let (after, outputs) = program.step(&memory, &step.inputs, step.dt_ms);
        (memory, bit) = (after, outputs.handshake);
        Relative { step: *step, answers }
    });
    each.collect()
}

/// What a model shows in each step.
fn shown<'a>(model: &'a Model, scenario: &'a Scenario) -> impl Iterator<Item = Shown> + 'a {
    scenario.steps.iter().scan(Memory::INITIAL, move |memory, step| {
        let (after, outputs) = model.step(memory, &step.inputs, step.dt_ms);
        *memory = after;
        Some(model.shown(&outputs, &step.inputs))
    })
}

fn last_shown(model: &Model, scenario: &Scenario) -> Option<Shown> {
    shown(model, scenario).last()
}

fn time_ms(steps: &[Relative]) -> u64 {
    steps.iter().map(|one| u64::from(one.step.dt_ms)).sum()
}
