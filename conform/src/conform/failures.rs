//! What is wrong in the tests that failed: each thing once, shortened.

use std::time::{Duration, Instant};

use adsdv_spec::{Choice, Machine};

use super::blame::{Blame, WrongAnswers};
use super::broken::Break;
use super::options::{ConformProgress, Phase};
use super::program_error::ProgramError;
use super::report::{Failure, is_observation};
use super::run::Run;
use super::shrink::{Failing, Shrink};
use super::suite::Suite;
use super::vcu::{Reply, Vcu as _};
use crate::suite::{Scenario, Test};

/// The report lists so many things that are wrong; of more only how many there are.
pub(super) const LISTED: usize = 20;

/// So many of the first tests are asked again at the end.
const FIRST: usize = 12;

/// What failed in the suite.
#[derive(Debug, Default)]
pub(super) struct Failures {
    /// Each thing that is wrong, shortened.
    pub(super) listed: Vec<Failure>,
    /// Those that are too many to be listed.
    pub(super) more: Vec<Failure>,
    /// The tests of which the states are wrong for a reason for which some test fails whatever the readings are.
    pub(super) wrong: Vec<String>,
    /// By the place of the test, what is wrong in it, and the requirements that are broken.
    pub(super) broken: Vec<(usize, WrongAnswers, Vec<String>)>,
}

/// What a failed test answered when it was asked again.
struct Again {
    /// The answers, if any of them is wrong.
    replies: Vec<Reply>,
    /// The first that is.
    found: Option<Break>,
}

impl Run<'_> {
    /// What is wrong in the tests that failed: each thing once, with the shortest scenario.
    pub(super) fn suite_failures(
        &mut self,
        tests: &[Test],
        suite: &Suite,
        blame: &Blame<'_>,
    ) -> Result<Failures, ProgramError> {
        let machine = Machine::new(self.options.edition, suite.judged_by());
        let failed: Vec<(usize, &Test, &Scenario, &Option<Vec<Choice>>)> = suite
            .failed
            .iter()
            .zip(&suite.explained_by)
            .filter_map(|(&place, by)| {
                Some((place, tests.get(place)?, suite.scenarios.get(place)?.as_ref()?, by))
            })
            .collect();
        // Their answers are asked for again: those of all tests are too many to be kept.
        let named: Vec<(&str, &Scenario)> =
            failed.iter().map(|(_, test, scenario, _)| (test.name.as_str(), *scenario)).collect();
        let mut again: Vec<Again> = Vec::with_capacity(named.len());
        let mut broken: Vec<(usize, WrongAnswers, Vec<String>)> = Vec::with_capacity(named.len());
        let mut look = |asked: usize, replies: &[Reply]| {
            let Some(&(place, test, scenario, _)) = failed.get(asked) else { return };
            let wrong = WrongAnswers::find(&machine, scenario, replies, suite.late);
            let requirements = blame.broken(&test.requirements, &wrong);
            broken.push((place, wrong, requirements));
            let found = Break::find(&machine, scenario, replies, suite.late);
            let replies = if found.is_some() { replies.to_vec() } else { Vec::new() };
            again.push(Again { replies, found });
        };
        let mut done = 0;
        self.asked.ask(&named, &mut |asked, replies| {
            look(asked, replies);
            done = asked + 1;
        })?;
        // For the others there was no time.
        for (asked, (place, ..)) in failed.iter().enumerate().skip(done) {
            let kept = suite.asked.iter().position(|own| own == place).and_then(|own| suite.kept.get(own));
            look(asked, kept.map_or(&[], Vec::as_slice));
        }

        let mut groups: Vec<Failure> = Vec::new();
        let mut wrong: Vec<String> = Vec::new();
        let each = failed.into_iter().zip(again).zip(&broken);
        for (((_, test, scenario, by), Again { replies, found }), (.., requirements)) in each {
            let observed = !self.options.strict && is_observation(requirements, found.as_ref());
            let same = |other: &Failure| match (&other.found, &found) {
                (Some(one), Some(another)) => one.is_like(another) && other.observed == observed,
                (None, None) => true,
                _ => false,
            };
            if let Some(group) = groups.iter_mut().find(|group| same(group)) {
                group.also.push(test.name.clone());
                if by.is_none() {
                    wrong.push(group.name.clone());
                }
                continue;
            }
            let failure = Failure {
                name: test.name.clone(),
                about: test.about.clone(),
                requirements: requirements.clone(),
                observed,
                also: Vec::new(),
                explained_by: by.clone().unwrap_or_default(),
                expected: scenario.shown(&machine).collect(),
                scenario: scenario.clone(),
                replies,
                found,
            };
            if by.is_none() {
                wrong.push(failure.name.clone());
            }
            groups.push(failure);
        }
        for group in groups.iter_mut().filter(|group| wrong.contains(&group.name)) {
            group.explained_by.clear();
        }
        let is_wrong = groups.iter().filter(|group| wrong.contains(&group.name));
        let mut wrong: Vec<String> =
            is_wrong.flat_map(|group| group.also.iter().chain([&group.name])).cloned().collect();
        // Where only other outputs are wrong the states still tell which readings are followed.
        let states_tell = broken.iter().filter(|(_, wrong, _)| !wrong.loses_the_state && !wrong.is_nothing());
        let states_tell: Vec<&str> =
            states_tell.filter_map(|(place, ..)| Some(tests.get(*place)?.name.as_str())).collect();
        wrong.retain(|name| !states_tell.contains(&name.as_str()));
        groups.sort_by_key(|failure| failure.found.as_ref().map_or((usize::MAX, "\u{7f}"), Break::order));
        let more = groups.split_off(LISTED.min(groups.len()));
        let all = groups.len();
        let mut listed = Vec::with_capacity(all);
        for (done, failure) in groups.into_iter().enumerate() {
            self.report(ConformProgress { phase: Phase::Shrinking, done, all });
            let share = share(self.shrinking, done, all);
            listed.push(self.shortest(failure, &machine, suite.late, share)?);
        }
        Ok(Failures { listed, more, wrong, broken })
    }

    /// Whether the first tests, asked again now that so much came between, come out as they did: a program that keeps something over
    /// a reset was fresh when they were asked. Only where there is time, and where some test fails.
    pub(super) fn begins_anew(&mut self, tests: &[Test], suite: &Suite) -> Result<bool, ProgramError> {
        if suite.failed.is_empty() || self.asked.until.is_some() {
            return Ok(true);
        }
        let machine = Machine::new(self.options.edition, suite.judged_by());
        let first: Vec<(usize, &Scenario)> = suite
            .asked
            .iter()
            .take(FIRST)
            .filter_map(|place| Some((*place, suite.scenarios.get(*place)?.as_ref()?)))
            .collect();
        let name = |place: usize| tests.get(place).map_or("", |test| test.name.as_str());
        let named: Vec<(&str, &Scenario)> =
            first.iter().map(|(place, scenario)| (name(*place), *scenario)).collect();
        let mut same = true;
        self.asked.ask(&named, &mut |asked, replies| {
            let Some((place, scenario)) = first.get(asked) else { return };
            let wrong = Break::find(&machine, scenario, replies, suite.late).is_some();
            same &= wrong == suite.failed.contains(place);
        })?;
        Ok(same)
    }

    /// The failure with the shortest scenario that is found in this time.
    pub(super) fn shortest(
        &mut self,
        mut failure: Failure,
        machine: &Machine,
        late: usize,
        time: Duration,
    ) -> Result<Failure, ProgramError> {
        let Some(found) = failure.found.clone() else { return Ok(failure) };
        let start = Instant::now();
        let mut shrink = Shrink {
            vcu: &mut self.asked,
            machine,
            late,
            fixed: self.options.cycle_ms.is_some(),
            deadline: start + time,
        };
        let scenario = std::mem::take(&mut failure.scenario);
        let failing = Failing { scenario, replies: std::mem::take(&mut failure.replies), found };
        let Failing { scenario, replies, found } = shrink.shortest(failing)?;
        self.shrinking = self.shrinking.saturating_sub(start.elapsed());
        failure.expected = scenario.shown(machine).collect();
        (failure.scenario, failure.replies, failure.found) = (scenario, replies, Some(found));
        Ok(failure)
    }
}

/// The fair part of the time for one of several, of which some are done.
pub(super) fn share(time: Duration, done: usize, all: usize) -> Duration {
    let left = all.saturating_sub(done).max(1);
    time / u32::try_from(left).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_has_its_share_of_the_time_that_is_left() {
        let minute = Duration::from_mins(1);
        let shares: Vec<u64> = (0..=4).map(|done| share(minute, done, 4).as_secs()).collect();
        assert_eq!(shares, [15, 20, 30, 60, 60]);
    }
}
