//! The suite, then random scenarios, and what came of them.

use std::time::{Duration, Instant};

use adsdv_oracle::requirements::are_decisions;
use adsdv_spec::{Inputs, Machine};

use super::blame::{Blame, WrongAnswers};
use super::failures::Failures;
use super::keys::Keys;
use super::options::{ConformOptions, ConformProgress, Phase};
use super::own_bit::Asked;
use super::program_error::{ProgramError, Work};
use super::report::{ConformReport, Failure};
use super::requirements;
use super::run::Run;
use super::suite::Suite;
use super::vcu::Vcu;
use super::{verdict, wall_clock};
use crate::protocol::{About, INPUTS, InputField, SHOWN};
use crate::suite::{Test, about_the_vcu};

/// Judges a program by a suite, and then by random scenarios.
///
/// What it says of itself counts where `options` do not say otherwise: its cycle; the inputs that it has, for no other is asked for;
/// and its clock. One on the wall has time for a few tests, and for no random scenarios.
///
/// # Errors
///
/// Fails if the program cannot be asked: it does not start, ends, hangs, or answers what is no line of the protocol.
pub fn conform(
    vcu: &mut dyn Vcu,
    tests: &[Test],
    options: &ConformOptions,
    progress: &mut dyn FnMut(ConformProgress),
) -> Result<ConformReport, ProgramError> {
    let began = Instant::now();
    let about = vcu.hello(&options.edition)?;
    let mut options = options.clone();
    options.cycle_ms = options.cycle_ms.or(about.cycle_ms);
    if about.wall_clock {
        (options.runs, options.shrinking) = (0, Duration::ZERO);
    }
    let askable: Vec<Test> = askable(tests, &about, &options).cloned().collect();
    let at = ConformProgress { phase: Phase::Suite, done: 0, all: askable.len() };
    let shrinking = options.shrinking;
    // Each test is asked once: one line after the other, by its own bit, as long as there is time.
    let own = about.wall_clock.then(|| Machine::new(options.edition, options.edition.readings));
    let until = about.wall_clock.then(|| began + options.wall_time);
    let asked = Asked { vcu, own, until };
    let runs = options.runs;
    let mut run = Run {
        asked,
        lacking: lacking(&about),
        options: &options,
        progress,
        at,
        steps: 0,
        suite_steps: 0,
        shown: Keys::NONE,
        shrinking,
    };
    let judged = run.judge(&askable);
    let mut report = judged.map_err(|trouble| {
        trouble.after(Work { at: run.at, steps: run.steps, suite_steps: run.suite_steps, runs })
    })?;
    let left_out = tests.iter().filter(|test| !askable.iter().any(|one| one.name == test.name));
    report.not_run.extend(left_out.map(|test| test.name.clone()));
    report.notes.extend(said(&about, &report));
    report.about = about;
    Ok(report)
}

/// The tests that a program can be asked for.
fn askable<'a>(tests: &'a [Test], about: &About, options: &ConformOptions) -> impl Iterator<Item = &'a Test> {
    let machine = Machine::new(options.edition, options.edition.readings);
    let chosen = about.wall_clock.then(|| wall_clock::chosen(&machine, tests, options.wall_time));
    let lacking = lacking(about);
    let usual = Inputs::default();
    tests.iter().enumerate().filter_map(move |(place, test)| {
        let needs = |field: &&InputField| {
            test.scenario.steps.iter().any(|step| (field.get)(&step.inputs) != (field.get)(&usual))
        };
        let is_chosen = chosen.as_ref().is_none_or(|chosen| chosen.contains(&place));
        (is_chosen && !lacking.iter().any(needs)).then_some(test)
    })
}

/// The inputs that a program says it does not have.
fn lacking(about: &About) -> Vec<&'static InputField> {
    let has = |field: &&InputField| about.inputs.as_ref().is_none_or(|inputs| inputs.contains(&field.key));
    INPUTS.iter().filter(|field| !has(field)).collect()
}

/// What is worth knowing of what a program says of itself.
fn said(about: &About, report: &ConformReport) -> Vec<String> {
    let mut notes = Vec::new();
    if about.wall_clock {
        notes.push("it runs on a clock on the wall: the tests that tell most in the time are run, and no random scenarios".to_owned());
    }
    let promised = about.outputs.iter().flatten().filter(|key| report.not_shown.contains(key));
    let promised: Vec<&str> = promised.copied().collect();
    if !promised.is_empty() {
        notes.push(format!(
            "it says that it has these outputs, and never shows them: {}",
            promised.join(", ")
        ));
    }
    notes
}

/// What is said of a program that does not repeat its answers.
pub const NOT_ALIKE: &str = "it does not answer the same questions alike: what is said of it may be otherwise the next time; \
    it may go by chance or by a clock, or keep something over a reset";

impl Run<'_> {
    fn judge(&mut self, tests: &[Test]) -> Result<ConformReport, ProgramError> {
        let options = self.options;
        let mut suite = self.suite(tests, options.latency)?;
        let mut notes = self.later(tests, &suite)?;
        notes.extend(self.by_its_own_bit(tests, &mut suite)?);
        let blame = Blame::of(&Machine::new(options.edition, suite.judged_by()), tests);
        let in_suite = self.suite_failures(tests, &suite, &blame)?;
        let begins_anew = self.begins_anew(tests, &suite)?;
        let in_random = self.random(&suite, &in_suite, &blame)?;
        notes.extend(self.asked.end()?);

        let Failures { listed, more, wrong, broken } = in_suite;
        let strict = options.strict;
        let is_observed =
            |wrong: &WrongAnswers, ids: &[String]| !strict && !wrong.is_nothing() && are_decisions(ids);
        let repeats = broken.iter().all(|(_, wrong, _)| !wrong.is_nothing()) && begins_anew;
        if !repeats {
            notes.push(NOT_ALIKE.to_owned());
        }
        let observed_tests = broken.iter().filter(|(_, wrong, ids)| is_observed(wrong, ids)).count();
        let follows = if suite.failed.is_empty() {
            verdict::follows(&options.edition, &in_random.readings)
        } else {
            verdict::mixes(&options.edition, &suite.explain, &suite.names, &suite.explained_by_state, &wrong)
        };
        let found = listed.into_iter().chain(in_random.failures);
        let (observations, failures): (Vec<Failure>, Vec<Failure>) =
            found.partition(|failure| failure.observed);
        let Suite { failed, late, not_run, asked, shown, .. } = suite;
        let ran = requirements::ran(tests, asked.into_iter().zip(shown), broken);
        Ok(ConformReport {
            tests: tests.len() - not_run.len(),
            failed_tests: failed.len() - observed_tests,
            observed_tests,
            runs: options.runs,
            failed_runs: in_random.failed,
            observed_runs: in_random.observed,
            steps: self.steps,
            late,
            readings: in_random.readings.first().copied().unwrap_or_default(),
            follows,
            requirements: requirements::table((&options.edition, strict), tests, &ran, &in_random.broken),
            about_the_vcu: about_the_vcu(&options.edition).len(),
            failures,
            observations,
            more_failures: more.len() + in_random.more.len(),
            not_shown: SHOWN
                .iter()
                .filter(|field| field.is_in(&options.edition) && !self.shown.has(field.key))
                .map(|field| field.key)
                .collect(),
            not_run,
            notes,
            repeats,
            cycle_ms: options.cycle_ms,
            about: About::default(),
        })
    }
}
