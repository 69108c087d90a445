//! Tests for a program whose time is that of a clock on the wall: each step takes as long as it says, so there is time for a few.

use std::time::{Duration, Instant};

use adsdv_spec::{Control, Machine};

use crate::protocol::Shown;
use crate::suite::{Kind, Scenario, Test};

/// So much longer than it says a step takes, at least and at most: a program that waits on a clock waits a little longer.
const LONGER_MS: [u32; 2] = [1, MOST_MS];
const MOST_MS: u32 = 9;
/// So often a test is tried in which a step may have taken less than it says, or more than it may: on a busy computer both sides
/// let each other wait now and then. For a program that is always slow that is no use, and tried less and less.
pub(super) const TRIES: usize = 8;
/// A test that has taken longer is not tried again.
pub(super) const TRIED: Duration = Duration::from_secs(2);
/// What a program may take for a step beside its time.
const ANSWER: Duration = Duration::from_millis(2);

/// How much longer than it says is waited for each step: between the two.
pub(super) const PATIENCE: Duration = Duration::from_millis(2);

/// When a step was written, and when it was answered: the program took it somewhere between the two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    pub(super) written: Instant,
    pub(super) answered: Instant,
}

impl Taken {
    /// Whether the time between a step and the one before it was, by the program's clock, as the tests allow for.
    pub(super) fn is_told(before: Self, now: Self, dt_ms: u32) -> bool {
        let time = Duration::from_millis(dt_ms.into());
        let least = now.written.saturating_duration_since(before.answered);
        let most = now.answered.saturating_duration_since(before.written);
        time <= least && most <= time + Duration::from_millis(MOST_MS.into())
    }
}

/// The places of the tests that are run: those that a clock can tell, by how many requirements more they check in how much time, as
/// many as there is time for.
pub(super) fn chosen(machine: &Machine, tests: &[Test], time: Duration) -> Vec<usize> {
    let steady = |(place, test): (usize, &Test)| is_steady(machine, &test.scenario).then_some(place);
    let mut left: Vec<usize> = tests.iter().enumerate().filter_map(steady).collect();
    let mut chosen = Vec::new();
    let mut checked: Vec<&str> = Vec::new();
    let mut time = time;
    while let Some(best) = best(tests, &left, &checked, time) {
        left.retain(|place| *place != best);
        let Some(test) = tests.get(best) else { continue };
        time = time.saturating_sub(takes(&test.scenario));
        checked.extend(test.requirements.iter().map(String::as_str));
        chosen.push(best);
    }
    chosen.sort_unstable();
    chosen
}

/// The test that tells most in its time, of those for which there is time.
fn best(tests: &[Test], left: &[usize], checked: &[&str], time: Duration) -> Option<usize> {
    let worth = |place: &usize| {
        let test = tests.get(*place).filter(|test| takes(&test.scenario) <= time)?;
        let new = test.requirements.iter().filter(|id| !checked.contains(&id.as_str())).count();
        // A row that was never tried tells more than another condition of one that was.
        let new = new * 2 + usize::from(test.kind == Kind::Row);
        let milliseconds = takes(&test.scenario).as_millis().max(1);
        Some((u128::try_from(new + 1).unwrap_or(1) * 1_000_000 / milliseconds, *place))
    };
    left.iter()
        .filter_map(worth)
        .max_by_key(|(worth, place)| (*worth, std::cmp::Reverse(*place)))
        .map(|(_, place)| place)
}

/// How long a scenario takes.
pub(super) fn takes(scenario: &Scenario) -> Duration {
    let each = scenario.steps.iter().map(|step| Duration::from_millis(step.dt_ms.into()));
    each.map(|time| time + PATIENCE + ANSWER).sum()
}

/// Whether a scenario shows the same if its steps take a little longer.
fn is_steady(machine: &Machine, scenario: &Scenario) -> bool {
    let usual: Vec<Shown> = scenario.shown(machine).collect();
    LONGER_MS.iter().all(|longer| {
        let mut control = Control::INITIAL;
        scenario.steps.iter().zip(&usual).all(|(step, usual)| {
            let (after, outputs) = machine.step(&control, &step.inputs, step.dt_ms.saturating_add(*longer));
            control = after;
            Shown::of(machine.edition(), &outputs, &step.inputs) == *usual
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite;

    #[test]
    fn a_step_is_told_if_it_took_its_time_wherever_between_line_and_answer_the_program_took_it() {
        let start = Instant::now();
        let at = |written, answered| Taken {
            written: start + Duration::from_millis(written),
            answered: start + Duration::from_millis(answered),
        };
        let told = |before, now| Taken::is_told(before, now, 50);
        assert!(told(at(0, 1), at(52, 53)) && told(at(0, 0), at(50, 59)));
        assert!(!told(at(0, 3), at(52, 53)), "it may have taken the one before late");
        assert!(!told(at(0, 1), at(52, 60)), "it may have taken this one late");
    }

    use adsdv_spec::Edition;

    #[test]
    fn what_a_clock_cannot_tell_is_not_chosen_and_the_time_is_kept() {
        let tests = suite::generate(Edition::DEFAULT);
        let all = chosen(&Machine::REFERENCE, &tests, Duration::from_secs(1 << 20));
        let name = |place: &usize| tests[*place].name.as_str();
        assert!(all.len() > tests.len() / 2 && all.len() < tests.len(), "{}", all.len());
        assert!(!all.iter().any(|place| name(place) == "ready-dwell-4999-ms"));
        let minute = Duration::from_mins(1);
        let few = chosen(&Machine::REFERENCE, &tests, minute);
        let time: Duration = few.iter().map(|place| takes(&tests[*place].scenario)).sum();
        assert!(!few.is_empty() && few.len() < all.len() && time <= minute, "{time:?}");
        let checked = |places: &[usize]| {
            let ids = places.iter().flat_map(|place| &tests[*place].requirements);
            ids.collect::<std::collections::HashSet<_>>().len()
        };
        let first: Vec<usize> = all.iter().copied().take(few.len()).collect();
        assert!(checked(&few) > checked(&first), "those that tell most");
    }
}
