//! The suite, then random scenarios, and what came of them.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use adsdv_spec::{Choice, Choices, Interface, Machine, Reading, Readings};

use super::broken::Break;
use super::cycle::in_cycles;
use super::explain::Explain;
use super::random::Walker;
use super::report::{Failure, Report};
use super::requirements;
use super::rng::Rng;
use super::set::Set;
use super::shrink::{Failing, Shrink, with_tail};
use super::trouble::Trouble;
use super::vcu::{Reply, Vcu};
use super::verdict;
use crate::protocol::SHOWN;
use crate::suite::{Kind, Scenario, Test};

/// So many random scenarios are asked for at once.
const BATCH: u32 = 64;
/// So many things that are wrong are told; more of them only repeat each other.
const TOLD: usize = 20;

/// So many steps more than are allowed for are tried where most of the suite fails.
const LATER: usize = 5;

/// How a program is judged.
#[derive(Clone, Debug)]
pub struct Options {
    /// The version of the document.
    pub interface: Interface,
    /// The choices of readings that are allowed for.
    pub possible: Choices,
    /// How many steps late its outputs may be.
    pub latency: usize,
    /// The cycle at which it steps, in milliseconds; `None`: any time may pass between two steps.
    pub cycle_ms: Option<u32>,
    /// The seed of the random scenarios.
    pub seed: u64,
    /// How many random scenarios there are.
    pub runs: u32,
    /// How long the search for shorter scenarios may take in all.
    pub shrinking: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            interface: Interface::V3_0,
            possible: Choices::ALL,
            latency: 0,
            cycle_ms: None,
            seed: 1,
            runs: 300,
            shrinking: Duration::from_secs(10),
        }
    }
}

/// How far it is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// What is being done.
    pub phase: Phase,
    /// How much of it is done.
    pub done: usize,
    /// How much there is.
    pub all: usize,
}

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The tests of the suite.
    Suite,
    /// The random scenarios.
    Random,
    /// The search for shorter scenarios that fail.
    Shrinking,
}

/// Judges a program by a suite, and then by random scenarios.
pub fn conform(
    vcu: &mut dyn Vcu,
    tests: &[Test],
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<Report, Trouble> {
    let mut run =
        Run { vcu, options, progress, steps: 0, shown: BTreeSet::new(), shrinking: options.shrinking };
    let suite = run.suite(tests, options.latency)?;
    let mut notes = run.later(tests, &suite)?;
    let (suite_failures, wrong) = run.suite_failures(tests, &suite)?;
    let mut random = run.random(&suite, &suite_failures)?;
    random
        .failures
        .iter_mut()
        .for_each(|failure| failure.requirements = behind(failure, tests, &options.interface));
    notes.extend(run.vcu.end()?);

    let failed: Vec<&str> =
        suite.failed.iter().filter_map(|&place| tests.get(place)).map(|t| t.name.as_str()).collect();
    let ran: Vec<Option<bool>> = tests
        .iter()
        .map(|test| (!suite.not_told.contains(&test.name)).then(|| !failed.contains(&test.name.as_str())))
        .collect();
    let shown: Vec<&str> = run.shown.iter().copied().collect();
    let follows = if suite.failed.is_empty() {
        verdict::follows(&random.readings)
    } else {
        verdict::mixes(&suite.explain, &suite.names, &suite.explained, &wrong)
    };
    Ok(Report {
        tests: tests.len() - suite.not_told.len(),
        failed_tests: suite.failed.len(),
        runs: options.runs,
        failed_runs: random.failed,
        steps: run.steps,
        late: suite.late,
        readings: random.readings.first().copied().unwrap_or_default(),
        follows,
        requirements: requirements::table(tests, &ran, &shown, &random.failures),
        failures: suite_failures.into_iter().chain(random.failures).collect(),
        not_shown: SHOWN.iter().map(|field| field.key).filter(|key| !run.shown.contains(key)).collect(),
        not_told: suite.not_told,
        notes,
    })
}

struct Run<'a> {
    vcu: &'a mut dyn Vcu,
    options: &'a Options,
    progress: &'a mut dyn FnMut(Progress),
    /// The steps that the program has made.
    steps: u64,
    /// The outputs that it has shown.
    shown: BTreeSet<&'static str>,
    /// How long the search for shorter scenarios may still take.
    shrinking: Duration,
}

/// What the suite showed.
struct Suite {
    /// The combinations that explain all of it; if there is none, the one that explains the most.
    readings: Vec<Readings>,
    /// How many steps late the outputs are.
    late: usize,
    /// The tests that fail under the first of them.
    failed: Vec<usize>,
    /// For each of these, the choices that it needs instead; `None` if no combination explains it.
    explained_by: Vec<Option<Vec<Choice>>>,
    /// All combinations.
    explain: Explain,
    /// The tests that were run, and the combinations that explain each.
    names: Vec<String>,
    explained: Vec<Set>,
    /// The scenarios as they were asked for.
    scenarios: Vec<Option<Scenario>>,
    /// The tests that cannot be told at the cycle.
    not_told: Vec<String>,
}

/// What random scenarios showed.
struct Random {
    readings: Vec<Readings>,
    failures: Vec<Failure>,
    failed: u32,
}

impl Run<'_> {
    /// Whether most of the suite fails only because the outputs are later than is allowed for.
    fn later(&mut self, tests: &[Test], suite: &Suite) -> Result<Vec<String>, Trouble> {
        if suite.failed.len() * 2 <= tests.len() {
            return Ok(Vec::new());
        }
        let steps = self.steps;
        let later = self.suite(tests, self.options.latency + LATER)?;
        self.steps = steps;
        let Suite { late, failed, .. } = later;
        let fewer = late > self.options.latency && failed.len() * 2 <= suite.failed.len();
        let steps = if late == 1 { "1 step".to_owned() } else { format!("{late} steps") };
        let note = || {
            format!(
                "with outputs {steps} late {} tests would fail: --latency {late} allows for that",
                failed.len()
            )
        };
        Ok(fewer.then(note).into_iter().collect())
    }

    fn suite(&mut self, tests: &[Test], latency: usize) -> Result<Suite, Trouble> {
        let options = self.options;
        let explain = Explain::every(&options.interface, options.possible);
        let reference = Machine::new(options.interface, Readings::DEFAULT);
        let told = |test: &Test| match options.cycle_ms {
            Some(cycle_ms) => in_cycles(&reference, &test.scenario, cycle_ms),
            None => Some(test.scenario.clone()),
        };
        let scenarios: Vec<Option<Scenario>> =
            tests.iter().map(|test| Some(with_tail(&told(test)?, latency))).collect();
        let asked: Vec<(usize, &str, &Scenario)> = tests
            .iter()
            .zip(&scenarios)
            .enumerate()
            .filter_map(|(place, (test, scenario))| Some((place, test.name.as_str(), scenario.as_ref()?)))
            .collect();

        // By latency, then by test: the combinations that explain the answers.
        let mut explained: Vec<Vec<Set>> = vec![Vec::with_capacity(asked.len()); latency + 1];
        let named: Vec<(&str, &Scenario)> =
            asked.iter().map(|&(_, name, scenario)| (name, scenario)).collect();
        self.ask(&named, Phase::Suite, 0, named.len(), &mut |place, replies| {
            if let Some((_, scenario)) = named.get(place) {
                for (late, explained) in explained.iter_mut().enumerate() {
                    explained.push(explain.explaining(scenario, replies, late));
                }
            }
        })?;

        let best = |explained: &Vec<Set>| verdict::best(&explain, explained);
        let latencies = explained.iter().enumerate().map(|(late, explained)| (late, best(explained)));
        let (late, (best, _)) = latencies
            .max_by_key(|(late, (_, count))| (*count, std::cmp::Reverse(*late)))
            .unwrap_or((0, (0, 0)));
        let explained = explained.into_iter().nth(late).unwrap_or_default();
        let all = verdict::all(&explain, &explained);
        let readings: Vec<Readings> = if all.is_empty() {
            explain.readings().get(best).copied().into_iter().collect()
        } else {
            // The one that is preferred comes first.
            let others = all.iter().filter(|&other| other != best);
            std::iter::once(best)
                .chain(others)
                .filter_map(|place| explain.readings().get(place).copied())
                .collect()
        };
        let failing = || asked.iter().zip(&explained).filter(|(_, set)| !set.has(best));
        let suite = Suite {
            late,
            failed: failing().map(|((place, ..), _)| *place).collect(),
            explained_by: failing().map(|(_, set)| needed(&explain, best, set)).collect(),
            names: asked.iter().map(|&(_, name, _)| name.to_owned()).collect(),
            readings,
            not_told: tests
                .iter()
                .zip(&scenarios)
                .filter(|(_, scenario)| scenario.is_none())
                .map(|(test, _)| test.name.clone())
                .collect(),
            explained,
            explain,
            scenarios,
        };
        Ok(suite)
    }

    /// What is wrong in the tests that failed: each thing once, with the shortest scenario. Then the tests that fail for a
    /// reason for which some test fails whatever the readings are.
    fn suite_failures(
        &mut self,
        tests: &[Test],
        suite: &Suite,
    ) -> Result<(Vec<Failure>, Vec<String>), Trouble> {
        let Some(&readings) = suite.readings.first() else { return Ok(Default::default()) };
        let machine = Machine::new(self.options.interface, readings);
        let failed: Vec<(&Test, &Scenario, &Option<Vec<Choice>>)> = suite
            .failed
            .iter()
            .zip(&suite.explained_by)
            .filter_map(|(&place, by)| Some((tests.get(place)?, suite.scenarios.get(place)?.as_ref()?, by)))
            .collect();
        // Their answers are asked for again: those of all tests are too many to be kept.
        let named: Vec<(&str, &Scenario)> =
            failed.iter().map(|(test, scenario, _)| (test.name.as_str(), *scenario)).collect();
        let mut again: Vec<(Vec<Reply>, Option<Break>)> = Vec::with_capacity(named.len());
        self.vcu.ask(&named, &mut |place, replies| {
            let found =
                named.get(place).and_then(|(_, asked)| Break::find(&machine, asked, replies, suite.late));
            let kept = if found.is_some() { replies.to_vec() } else { Vec::new() };
            again.push((kept, found));
        })?;

        let mut groups: Vec<Failure> = Vec::new();
        let mut wrong: Vec<String> = Vec::new();
        for ((test, scenario, by), (replies, found)) in failed.into_iter().zip(again) {
            let same = |other: &Failure| match (&other.found, &found) {
                (Some(one), Some(other)) => one.is_like(other),
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
                requirements: test.requirements.clone(),
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
        let wrong = is_wrong.flat_map(|group| group.also.iter().chain([&group.name])).cloned().collect();
        groups.sort_by_key(|failure| failure.found.as_ref().map_or((usize::MAX, "\u{7f}"), Break::order));
        groups.truncate(TOLD);
        let all = groups.len();
        let mut failures = Vec::with_capacity(all);
        for (done, failure) in groups.into_iter().enumerate() {
            (self.progress)(Progress { phase: Phase::Shrinking, done, all });
            failures.push(self.shortest(failure, &machine, suite.late, all - done)?);
        }
        Ok((failures, wrong))
    }

    /// The failure with the shortest scenario that is found in a fair part of the time that is left.
    fn shortest(
        &mut self,
        mut failure: Failure,
        machine: &Machine,
        late: usize,
        left: usize,
    ) -> Result<Failure, Trouble> {
        let Some(found) = failure.found.clone() else { return Ok(failure) };
        let start = Instant::now();
        let share = self.shrinking / u32::try_from(left.max(1)).unwrap_or(u32::MAX);
        let mut shrink = Shrink {
            vcu: &mut *self.vcu,
            machine,
            late,
            fixed: self.options.cycle_ms.is_some(),
            deadline: start + share,
        };
        let scenario = std::mem::take(&mut failure.scenario);
        let failing = Failing { scenario, replies: std::mem::take(&mut failure.replies), found };
        let Failing { scenario, replies, found } = shrink.shortest(failing)?;
        self.shrinking = self.shrinking.saturating_sub(start.elapsed());
        failure.expected = scenario.shown(machine).collect();
        (failure.scenario, failure.replies, failure.found) = (scenario, replies, Some(found));
        Ok(failure)
    }

    fn random(&mut self, suite: &Suite, known: &[Failure]) -> Result<Random, Trouble> {
        let options = self.options;
        let mut explain = Explain::new(&options.interface, suite.readings.clone());
        let mut random = Random { readings: suite.readings.clone(), failures: Vec::new(), failed: 0 };
        let mut run = 0;
        while run < options.runs {
            let batch = BATCH.min(options.runs - run);
            let Some(machine) = explain.machine(0).copied() else { break };
            let scenarios: Vec<(String, Scenario)> = (run..run + batch)
                .map(|run| {
                    let rng = Rng::new(options.seed, run.into());
                    let scenario = Walker::new(&machine, options.cycle_ms, rng).scenario();
                    (
                        format!("random scenario {run} of seed {}", options.seed),
                        with_tail(&scenario, options.latency),
                    )
                })
                .collect();
            let named: Vec<(&str, &Scenario)> =
                scenarios.iter().map(|(name, scenario)| (name.as_str(), scenario)).collect();
            let mut alive = explain.all();
            let mut wrong: Vec<(usize, Vec<Reply>, Break)> = Vec::new();
            let mut failed = 0;
            let told = known.iter().chain(&random.failures).filter_map(|failure| failure.found.as_ref());
            let told: Vec<&Break> = told.collect();
            let is_new = |found: &Break, wrong: &[(usize, Vec<Reply>, Break)]| {
                !told.iter().copied().chain(wrong.iter().map(|(.., one)| one)).any(|one| one.is_like(found))
            };
            self.ask(&named, Phase::Random, run as usize, options.runs as usize, &mut |place, replies| {
                let Some((_, scenario)) = named.get(place) else { return };
                let left = alive.and(&explain.explaining(scenario, replies, suite.late));
                if !left.is_empty() {
                    alive = left;
                    return;
                }
                failed += 1;
                let first = alive.iter().next().and_then(|first| explain.machine(first));
                let found = first.and_then(|machine| Break::find(machine, scenario, replies, suite.late));
                if let Some(found) = found.filter(|found| is_new(found, &wrong)) {
                    wrong.push((place, replies.to_vec(), found));
                }
            })?;
            random.failed += failed;
            let readings: Vec<Readings> =
                alive.iter().filter_map(|place| explain.readings().get(place).copied()).collect();
            let judge =
                readings.first().map_or(machine, |&readings| Machine::new(options.interface, readings));
            for (place, replies, found) in wrong {
                let Some((name, scenario)) = scenarios.get(place).filter(|_| random.failures.len() < TOLD)
                else {
                    break;
                };
                let failure = Failure {
                    name: name.clone(),
                    about: String::new(),
                    requirements: Vec::new(),
                    also: Vec::new(),
                    explained_by: Vec::new(),
                    expected: Vec::new(),
                    scenario: scenario.clone(),
                    replies,
                    found: Some(found),
                };
                (self.progress)(Progress {
                    phase: Phase::Shrinking,
                    done: run as usize,
                    all: options.runs as usize,
                });
                random.failures.push(self.shortest(failure, &judge, suite.late, 4)?);
            }
            explain = Explain::new(&options.interface, readings.clone());
            random.readings = readings;
            run += batch;
        }
        Ok(random)
    }

    /// Asks, counts steps, notes what is shown, and tells how far it is.
    fn ask(
        &mut self,
        named: &[(&str, &Scenario)],
        phase: Phase,
        before: usize,
        all: usize,
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), Trouble> {
        let (steps, shown, progress) = (&mut self.steps, &mut self.shown, &mut self.progress);
        self.vcu.ask(named, &mut |place, replies| {
            *steps += replies.len() as u64;
            for reply in replies {
                if let Reply::Answer(answer) = reply {
                    shown.extend(answer.keys());
                }
            }
            answered(place, replies);
            progress(Progress { phase, done: before + place + 1, all });
        })
    }
}

/// The requirements behind the row of Figure 2 that a random scenario found broken: those of the tests of that row.
fn behind(failure: &Failure, tests: &[Test], interface: &Interface) -> Vec<String> {
    let Some(row) = failure.found.as_ref().and_then(|found| found.why.row()) else { return Vec::new() };
    let machine = Machine::new(*interface, Readings::DEFAULT);
    let takes_it = |test: &&Test| {
        let last = test.scenario.run(&machine).last();
        test.kind == Kind::Row
            && last
                .and_then(|(_, outputs)| outputs.taken)
                .is_some_and(|taken| usize::from(taken.row) == row.place)
    };
    let mut behind: Vec<String> = Vec::new();
    for id in tests.iter().filter(takes_it).flat_map(|test| &test.requirements) {
        if !behind.contains(id) {
            behind.push(id.clone());
        }
    }
    behind
}

/// The choices that all combinations which explain a test have and the best one has not; `None` if nothing explains it.
fn needed(explain: &Explain, best: usize, explaining: &Set) -> Option<Vec<Choice>> {
    let best = explain.readings().get(best).filter(|_| !explaining.is_empty())?;
    let allowed = |choice: Choice| {
        explaining
            .iter()
            .any(|place| explain.readings().get(place).is_some_and(|readings| readings.is(choice)))
    };
    let needed = Reading::ALL.iter().filter(|&&reading| !allowed(best.choice(reading)));
    Some(needed.flat_map(|reading| reading.choices()).copied().filter(|&choice| allowed(choice)).collect())
}
