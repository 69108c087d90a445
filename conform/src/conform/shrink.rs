//! The shortest scenario that fails in the same way: found by leaving out and simplifying what can be, and asking again.

use std::time::Instant;

use adsdv_spec::{Inputs, Machine};

use super::broken::Break;
use super::program_error::ProgramError;
use super::vcu::{Reply, Vcu};
use crate::protocol::{INPUTS, InputField};
use crate::suite::{Scenario, Step};

/// What fails, and how it is asked for.
pub(super) struct Shrink<'a> {
    /// The program.
    pub(super) vcu: &'a mut dyn Vcu,
    /// What is expected of it.
    pub(super) machine: &'a Machine,
    /// How many steps late it is.
    pub(super) late: usize,
    /// Whether all steps take the same time, which stays.
    pub(super) fixed: bool,
    /// When what has been found is short enough.
    pub(super) deadline: Instant,
}

/// A scenario that fails.
#[derive(Clone, Debug)]
pub(super) struct Failing {
    /// The scenario.
    pub(super) scenario: Scenario,
    /// The program's answers.
    pub(super) replies: Vec<Reply>,
    /// Where it fails.
    pub(super) found: Break,
}

/// How much there is to read in a scenario: steps, then changes of inputs, then inputs that are not as usual, then time.
type Size = (usize, usize, usize, u64);

impl Shrink<'_> {
    /// Asks for a scenario; `None` if it does not fail, or not as this one does.
    pub(super) fn ask(
        &mut self,
        scenario: Scenario,
        as_this: Option<&Break>,
    ) -> Result<Option<Failing>, ProgramError> {
        let asked = with_tail(&scenario, self.late);
        let mut answers = Vec::new();
        self.vcu.ask(&[("a shorter scenario", &asked)], &mut |_, replies| answers = replies.to_vec())?;
        let found = Break::find(self.machine, &asked, &answers, self.late);
        let same = |found: &Break| as_this.is_none_or(|this| found.is_like(this));
        Ok(found.filter(same).map(|found| {
            let mut scenario = scenario;
            scenario.steps.truncate(found.about + 1);
            Failing { scenario, replies: answers.clone(), found }
        }))
    }

    /// Shortens a failing scenario until nothing can be left out any more, or the time is over.
    pub(super) fn shortest(&mut self, mut best: Failing) -> Result<Failing, ProgramError> {
        loop {
            let before = size(&best.scenario);
            self.fewer_steps(&mut best)?;
            self.usual_inputs(&mut best)?;
            self.fewer_changes(&mut best)?;
            if !self.fixed {
                self.less_time(&mut best)?;
            }
            if size(&best.scenario) >= before || self.is_late() {
                return Ok(best);
            }
        }
    }

    fn is_late(&self) -> bool {
        Instant::now() >= self.deadline
    }

    /// Takes a scenario instead of the best if it is simpler and fails in the same way.
    fn accept(&mut self, best: &mut Failing, steps: Vec<Step>) -> Result<bool, ProgramError> {
        let scenario = Scenario { steps };
        if self.is_late() || size(&scenario) >= size(&best.scenario) {
            return Ok(false);
        }
        let failing = self.ask(scenario, Some(&best.found))?;
        let accepted = failing.is_some();
        if let Some(failing) = failing {
            *best = failing;
        }
        Ok(accepted)
    }

    /// Without some steps, many at first; the time of what is left out passes before the next step, or not at all.
    fn fewer_steps(&mut self, best: &mut Failing) -> Result<(), ProgramError> {
        let mut width = best.scenario.steps.len();
        while width > 0 {
            let mut start = 0;
            while best.scenario.steps.get(start).is_some() && !self.is_late() {
                let steps = &best.scenario.steps;
                let end = (start + width).min(steps.len());
                let (before, rest) = steps.split_at(start);
                let (out, after) = rest.split_at(end - start);
                let mut without = [before, after].concat();
                let time = out.iter().fold(0_u32, |sum, step| sum.saturating_add(step.dt_ms));
                let mut later = without.clone();
                if let Some(next) = later.get_mut(start) {
                    next.dt_ms = next.dt_ms.saturating_add(time);
                }
                let mut left_out = self.accept(best, std::mem::take(&mut without))?;
                if !left_out && !self.fixed {
                    left_out = self.accept(best, later)?;
                }
                if !left_out {
                    start += width;
                }
            }
            width /= 2;
        }
        Ok(())
    }

    /// Each input at its default, in all steps or in one.
    fn usual_inputs(&mut self, best: &mut Failing) -> Result<(), ProgramError> {
        let usual = Inputs::default();
        for field in INPUTS {
            let default = (field.get)(&usual);
            let is_usual = |step: &Step| (field.get)(&step.inputs) == default;
            if best.scenario.steps.iter().all(is_usual) {
                continue;
            }
            let all = set(&best.scenario.steps, 0..usize::MAX, field, default);
            if self.accept(best, all)? {
                continue;
            }
            for place in 0..best.scenario.steps.len() {
                if best.scenario.steps.get(place).is_some_and(|step| !is_usual(step)) {
                    let one = set(&best.scenario.steps, place..place + 1, field, default);
                    self.accept(best, one)?;
                }
            }
        }
        Ok(())
    }

    /// Each input that changes and stays so for some steps, as it was before.
    fn fewer_changes(&mut self, best: &mut Failing) -> Result<(), ProgramError> {
        for field in INPUTS {
            let mut place = 1;
            while let (Some(last), Some(step)) =
                (best.scenario.steps.get(place - 1), best.scenario.steps.get(place))
            {
                let (before, now) = ((field.get)(&last.inputs), (field.get)(&step.inputs));
                if before != now {
                    let steps = &best.scenario.steps;
                    let same =
                        steps.iter().skip(place).take_while(|step| (field.get)(&step.inputs) == now).count();
                    let changed = set(steps, place..place + same, field, before);
                    self.accept(best, changed)?;
                }
                place += 1;
            }
        }
        Ok(())
    }

    /// The least time before each step: none, or where it begins to matter.
    fn less_time(&mut self, best: &mut Failing) -> Result<(), ProgramError> {
        let mut place = 0;
        while let Some(step) = best.scenario.steps.get(place) {
            let (mut too_little, mut enough) = (None, step.dt_ms);
            // From nothing at all to half of what is left between too little and enough.
            while enough > too_little.map_or(0, |little| little + 1) && !self.is_late() {
                let dt_ms = too_little.map_or(0, |little: u32| little + (enough - little) / 2);
                let mut steps = best.scenario.steps.clone();
                if let Some(step) = steps.get_mut(place) {
                    step.dt_ms = dt_ms;
                }
                if self.accept(best, steps)? {
                    enough = dt_ms;
                } else {
                    too_little = Some(dt_ms);
                }
            }
            place += 1;
        }
        Ok(())
    }
}

/// A scenario that goes on as it ended for as many steps as a program is late, so that it can answer all of it.
pub(super) fn with_tail(scenario: &Scenario, late: usize) -> Scenario {
    let mut steps = scenario.steps.clone();
    if let Some(&last) = steps.last() {
        steps.extend(std::iter::repeat_n(last, late));
    }
    Scenario { steps }
}

/// The steps with an input at another value in some of them.
fn set(steps: &[Step], places: std::ops::Range<usize>, field: &InputField, raw: i32) -> Vec<Step> {
    let mut steps = steps.to_vec();
    for step in steps.iter_mut().take(places.end).skip(places.start) {
        // It is a value that the field has had.
        (field.set)(&mut step.inputs, raw);
    }
    steps
}

fn size(scenario: &Scenario) -> Size {
    let usual = Inputs::default();
    let (mut changes, mut unusual, mut time) = (0, 0, 0);
    let mut last = &usual;
    for Step { dt_ms, inputs } in &scenario.steps {
        for field in INPUTS {
            let now = (field.get)(inputs);
            changes += usize::from(now != (field.get)(last));
            unusual += usize::from(now != (field.get)(&usual));
        }
        time += u64::from(*dt_ms);
        last = inputs;
    }
    (scenario.steps.len(), changes, unusual, time)
}
