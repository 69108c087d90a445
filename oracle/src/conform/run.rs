//! The suite, then random scenarios, and what came of them.

use std::time::Duration;

use adsdv_spec::Machine;

use super::blame::Blame;
use super::failures::Failures;
use super::keys::Keys;
use super::options::{ConformOptions, ConformProgress, Phase};
use super::program_error::{ProgramError, Work};
use super::report::{ConformReport, Failure};
use super::requirements;
use super::suite::Suite;
use super::vcu::{Reply, Vcu};
use super::verdict;
use crate::protocol::SHOWN;
use crate::suite::{Scenario, Test, about_the_vcu};

/// Judges a program by a suite, and then by random scenarios.
pub fn conform(
    vcu: &mut dyn Vcu,
    tests: &[Test],
    options: &ConformOptions,
    progress: &mut dyn FnMut(ConformProgress),
) -> Result<ConformReport, ProgramError> {
    let at = ConformProgress { phase: Phase::Suite, done: 0, all: tests.len() };
    let shrinking = options.shrinking;
    let mut run = Run { vcu, options, progress, at, steps: 0, suite_steps: 0, shown: Keys::NONE, shrinking };
    let judged = run.judge(tests);
    judged.map_err(|trouble| {
        trouble.after(Work { at: run.at, steps: run.steps, suite_steps: run.suite_steps, runs: options.runs })
    })
}

/// What goes on, and what it has come to.
pub(super) struct Run<'a> {
    pub(super) vcu: &'a mut dyn Vcu,
    pub(super) options: &'a ConformOptions,
    progress: &'a mut dyn FnMut(ConformProgress),
    /// How far it is.
    at: ConformProgress,
    /// The steps that the program has made.
    pub(super) steps: u64,
    /// Those of the whole suite.
    pub(super) suite_steps: u64,
    /// The outputs that it has shown.
    shown: Keys,
    /// How long the search for shorter scenarios may still take.
    pub(super) shrinking: Duration,
}

impl Run<'_> {
    fn judge(&mut self, tests: &[Test]) -> Result<ConformReport, ProgramError> {
        let options = self.options;
        self.vcu.hello(&options.edition)?;
        let suite = self.suite(tests, options.latency)?;
        let mut notes = self.later(tests, &suite)?;
        let blame = Blame::of(&Machine::new(options.edition, suite.judged_by()), tests);
        let in_suite = self.suite_failures(tests, &suite, &blame)?;
        let in_random = self.random(&suite, &in_suite, &blame)?;
        notes.extend(self.vcu.end()?);

        let Failures { told, more, wrong, broken } = in_suite;
        let follows = if suite.failed.is_empty() {
            verdict::follows(&options.edition, &in_random.readings)
        } else {
            verdict::mixes(&options.edition, &suite.explain, &suite.names, &suite.explained_by_state, &wrong)
        };
        let failures: Vec<Failure> = told.into_iter().chain(in_random.failures).collect();
        let Suite { failed, late, not_told, asked, shown, .. } = suite;
        let ran = requirements::ran(tests, asked.into_iter().zip(shown), broken);
        Ok(ConformReport {
            tests: tests.len() - not_told.len(),
            failed_tests: failed.len(),
            runs: options.runs,
            failed_runs: in_random.failed,
            steps: self.steps,
            late,
            readings: in_random.readings.first().copied().unwrap_or_default(),
            follows,
            requirements: requirements::table(&options.edition, tests, &ran, &in_random.broken),
            about_the_vcu: about_the_vcu(&options.edition).len(),
            failures,
            more_failures: more.len() + in_random.more.len(),
            not_shown: SHOWN
                .iter()
                .filter(|field| field.is_in(&options.edition) && !self.shown.has(field.key))
                .map(|field| field.key)
                .collect(),
            not_told,
            notes,
        })
    }

    /// Asks, counts steps, notes what is shown, and tells how far it is.
    pub(super) fn ask(
        &mut self,
        named: &[(&str, &Scenario)],
        phase: Phase,
        before: usize,
        all: usize,
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError> {
        let Self { vcu, progress, at, steps, shown, .. } = self;
        *at = ConformProgress { phase, done: before, all };
        vcu.ask(named, &mut |place, replies| {
            *steps += replies.len() as u64;
            *shown = replies.iter().fold(*shown, |shown, reply| shown.or(Keys::given(reply)));
            answered(place, replies);
            *at = ConformProgress { phase, done: before + place + 1, all };
            progress(*at);
        })
    }

    /// Tells how far it is.
    pub(super) fn report(&mut self, at: ConformProgress) {
        self.at = at;
        (self.progress)(at);
    }
}
