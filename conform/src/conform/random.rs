//! Random scenarios, run, and what is wrong in them.

use adsdv_oracle::requirements::are_decisions;
use adsdv_spec::{Inputs, Machine, Readings};

use super::blame::{Blame, WrongAnswers};
use super::broken::Break;
use super::explain::Explain;
use super::failures::{Failures, LISTED, share};
use super::options::{ConformProgress, Phase};
use super::program_error::ProgramError;
use super::report::{Failure, is_observation};
use super::rng::Rng;
use super::run::Run;
use super::shrink::with_tail;
use super::suite::Suite;
use super::vcu::Reply;
use super::walker::Walker;
use crate::suite::Scenario;

/// So many random scenarios are asked for at once.
const BATCH: u32 = 64;

/// What random scenarios showed.
#[derive(Debug)]
pub(super) struct RandomRuns {
    /// The combinations that are still possible.
    pub(super) readings: Vec<Readings>,
    /// Each thing that is wrong and that the suite has not found, shortened.
    pub(super) failures: Vec<Failure>,
    /// Those that are too many to be listed.
    pub(super) more: Vec<Break>,
    /// How many scenarios failed.
    pub(super) failed: u32,
    /// How many are only against decisions of ours, where that is no failure.
    pub(super) observed: u32,
    /// The requirements that are broken, each with the first scenario that breaks it.
    pub(super) broken: Vec<(String, String)>,
}

/// Something new that is wrong.
struct New {
    /// The place of the scenario.
    place: usize,
    replies: Vec<Reply>,
    found: Break,
    requirements: Vec<String>,
}

impl Run<'_> {
    /// What the program does not have stays at its default.
    fn leave_out_what_it_lacks(&self, scenario: &mut Scenario) {
        let usual = Inputs::default();
        for step in &mut scenario.steps {
            for field in &self.lacking {
                (field.set)(&mut step.inputs, (field.get)(&usual));
            }
        }
    }

    /// Random scenarios, as many as were asked for; `known` is what is wrong in the suite.
    pub(super) fn random(
        &mut self,
        suite: &Suite,
        known: &Failures,
        blame: &Blame<'_>,
    ) -> Result<RandomRuns, ProgramError> {
        let options = self.options;
        let known: Vec<&Break> =
            known.listed.iter().chain(&known.more).filter_map(|failure| failure.found.as_ref()).collect();
        let mut explain = Explain::new(&options.edition, suite.readings.clone());
        let mut random = RandomRuns {
            readings: suite.readings.clone(),
            failures: Vec::new(),
            more: Vec::new(),
            failed: 0,
            observed: 0,
            broken: Vec::new(),
        };
        let mut run = 0;
        while run < options.runs {
            let batch = BATCH.min(options.runs - run);
            let Some(machine) = explain.machine(0) else { break };
            let scenarios: Vec<(String, Scenario)> = (run..run + batch)
                .map(|run| {
                    let rng = Rng::new(options.seed, run.into());
                    let mut scenario = Walker::new(&machine, options.cycle_ms, rng).scenario();
                    self.leave_out_what_it_lacks(&mut scenario);
                    (
                        format!("random scenario {run} of seed {}", options.seed),
                        with_tail(&scenario, options.latency),
                    )
                })
                .collect();
            let named: Vec<(&str, &Scenario)> =
                scenarios.iter().map(|(name, scenario)| (name.as_str(), scenario)).collect();
            let mut alive = explain.all();
            let mut new: Vec<New> = Vec::new();
            let RandomRuns { failures, more, failed, observed, broken, .. } = &mut random;
            let listed = failures.iter().filter_map(|failure| failure.found.as_ref()).chain(more.iter());
            let listed: Vec<&Break> = known.iter().copied().chain(listed).collect();
            self.ask(&named, Phase::Random, run as usize, options.runs as usize, &mut |place, replies| {
                let Some((name, scenario)) = named.get(place) else { return };
                let left = alive.and(&explain.explaining(scenario, replies, suite.late));
                if !left.is_empty() {
                    alive = left;
                    return;
                }
                let Some(machine) = alive.iter().next().and_then(|first| explain.machine(first)) else {
                    return;
                };
                let wrong = WrongAnswers::find(&machine, scenario, replies, suite.late);
                let requirements = blame.broken(&[], &wrong);
                let only_decided = are_decisions(&requirements);
                if options.strict || wrong.is_nothing() || !only_decided {
                    *failed += 1;
                } else {
                    *observed += 1;
                }
                for id in &requirements {
                    if broken.iter().all(|(other, _)| other != id) {
                        broken.push((id.clone(), (*name).to_owned()));
                    }
                }
                let Some(found) = Break::find(&machine, scenario, replies, suite.late) else { return };
                let mut all = listed.iter().copied().chain(new.iter().map(|one| &one.found));
                if !all.any(|one| one.is_like(&found)) {
                    new.push(New { place, replies: replies.to_vec(), found, requirements });
                }
            })?;
            let readings: Vec<Readings> =
                alive.iter().filter_map(|place| explain.readings().get(place).copied()).collect();
            let judge = readings.first().map_or(machine, |&readings| Machine::new(options.edition, readings));
            for New { place, replies, found, requirements } in new {
                let Some((name, scenario)) = scenarios.get(place) else { continue };
                if random.failures.len() >= LISTED {
                    random.more.push(found);
                    continue;
                }
                let observed = !options.strict && is_observation(&requirements, Some(&found));
                let failure = Failure {
                    name: name.clone(),
                    observed,
                    about: String::new(),
                    requirements,
                    also: Vec::new(),
                    explained_by: Vec::new(),
                    expected: Vec::new(),
                    scenario: scenario.clone(),
                    replies,
                    found: Some(found),
                };
                self.report(ConformProgress {
                    phase: Phase::Shrinking,
                    done: run as usize,
                    all: options.runs as usize,
                });
                // How many more there will be nobody knows.
                let share = share(self.shrinking, 0, 4);
                random.failures.push(self.shortest(failure, &judge, suite.late, share)?);
            }
            explain = Explain::new(&options.edition, readings.clone());
            random.readings = readings;
            run += batch;
        }
        Ok(random)
    }
}
