//! The tests of the suite, run, and the combinations of readings that explain them.

use adsdv_spec::{Choice, Machine, Readings};

use super::cycle::in_cycles;
use super::explain::Explain;
use super::keys::Keys;
use super::options::Phase;
use super::own_bit::differs;
use super::program_error::ProgramError;
use super::run::Run;
use super::set::Set;
use super::shrink::with_tail;
use super::vcu::Reply;
use super::verdict;
use crate::suite::{Scenario, Test};

/// So many steps more than are allowed for are tried where most of the suite fails.
const LATER: usize = 5;

/// What the suite showed.
pub(super) struct Suite {
    /// The combinations that explain all of it; if there is none, the one that explains the most.
    pub(super) readings: Vec<Readings>,
    /// How many steps late the outputs are.
    pub(super) late: usize,
    /// The tests that fail under the first of them.
    pub(super) failed: Vec<usize>,
    /// For each of these, the choices that it needs instead; `None` if no combination explains it.
    pub(super) explained_by: Vec<Option<Vec<Choice>>>,
    /// All combinations.
    pub(super) explain: Explain,
    /// The tests that were run, by their places.
    pub(super) asked: Vec<usize>,
    /// Their names.
    pub(super) names: Vec<String>,
    /// The combinations that explain each; where none does, those that explain the states that it shows.
    pub(super) explained_by_state: Vec<Set>,
    /// The outputs that all answers to each show.
    pub(super) shown: Vec<Keys>,
    /// The answers to each, where there may be no time to ask for them again.
    pub(super) kept: Vec<Vec<Reply>>,
    /// The scenarios as they were asked for.
    pub(super) scenarios: Vec<Option<Scenario>>,
    /// The tests that steps of the cycle cannot express, or for which there was no time.
    pub(super) not_run: Vec<String>,
    /// Whether some answers that nothing explains have another handshake bit than the default readings.
    pub(super) another_bit: bool,
}

/// What explains the answers to a test.
struct Explained {
    /// The combinations that explain all of them.
    all: Set,
    /// The same; where there is none, those that explain the states.
    state: Set,
}

impl Suite {
    /// How many tests have states that no combination of readings explains.
    fn losing(&self) -> usize {
        self.explained_by_state.iter().filter(|set| set.is_empty()).count()
    }

    /// The combination that what is expected is taken from.
    pub(super) fn judged_by(&self) -> Readings {
        self.readings.first().copied().unwrap_or_default()
    }
}

impl Run<'_> {
    /// Whether most of the suite fails only because the outputs are later than is allowed for.
    pub(super) fn later(&mut self, tests: &[Test], suite: &Suite) -> Result<Vec<String>, ProgramError> {
        if suite.failed.len() * 2 <= tests.len() || self.asked.until.is_some() {
            return Ok(Vec::new());
        }
        let steps = self.steps;
        let later = self.suite(tests, self.options.latency + LATER)?;
        self.steps = steps;
        let Suite { late, failed, .. } = later;
        // Outputs that are no later are the ones that have failed already.
        let fewer = failed.len() * 2 <= suite.failed.len();
        let steps = if late == 1 { "1 step".to_owned() } else { format!("{late} steps") };
        let note = || {
            format!(
                "with outputs {steps} late {} tests would fail: --latency {late} allows for that",
                failed.len()
            )
        };
        Ok(fewer.then(note).into_iter().collect())
    }

    /// Whether tests fail because the program's handshake bit is not the specification's: then its own is answered from here on,
    /// if fewer of them lose the state that way.
    pub(super) fn by_its_own_bit(
        &mut self,
        tests: &[Test],
        suite: &mut Suite,
    ) -> Result<Option<String>, ProgramError> {
        if !suite.another_bit || self.options.latency > 0 || self.asked.own.is_some() {
            return Ok(None);
        }
        let machine = Machine::new(self.options.edition, suite.judged_by());
        let steps = self.steps;
        self.asked.own = Some(machine);
        let again = self.suite(tests, 0)?;
        self.steps = steps;
        if again.losing() >= suite.losing() {
            self.asked.own = None;
            return Ok(None);
        }
        *suite = again;
        Ok(Some(
            "its HANDSHAKE is not the specification's; the AI Computer answers the bit that it shows"
                .to_owned(),
        ))
    }

    pub(super) fn suite(&mut self, tests: &[Test], latency: usize) -> Result<Suite, ProgramError> {
        let options = self.options;
        let explain = Explain::every(&options.edition, options.possible);
        let reference = Machine::new(options.edition, options.edition.readings);
        let stepped = |test: &Test| match options.cycle_ms {
            Some(cycle_ms) => in_cycles(&reference, &test.scenario, cycle_ms),
            None => Some(test.scenario.clone()),
        };
        let scenarios: Vec<Option<Scenario>> =
            tests.iter().map(|test| Some(with_tail(&stepped(test)?, latency))).collect();
        let mut asked: Vec<(usize, &str, &Scenario)> = tests
            .iter()
            .zip(&scenarios)
            .enumerate()
            .filter_map(|(place, (test, scenario))| Some((place, test.name.as_str(), scenario.as_ref()?)))
            .collect();

        // By latency, then by test: the combinations that explain the answers.
        let mut explained: Vec<Vec<Explained>> = Vec::new();
        explained.resize_with(latency + 1, || Vec::with_capacity(asked.len()));
        let mut shown: Vec<Keys> = Vec::with_capacity(asked.len());
        let (mut another_bit, mut kept) = (false, Vec::new());
        let keeps = self.asked.until.is_some();
        let named: Vec<(&str, &Scenario)> =
            asked.iter().map(|&(_, name, scenario)| (name, scenario)).collect();
        self.suite_steps = named.iter().map(|(_, scenario)| scenario.steps.len() as u64).sum();
        self.ask(&named, Phase::Suite, 0, named.len(), &mut |place, replies| {
            if let Some((_, scenario)) = named.get(place) {
                for (late, explained) in explained.iter_mut().enumerate() {
                    let by = Explained::of(&explain, scenario, replies, late);
                    another_bit |= by.state.is_empty() && differs(&reference, scenario, replies);
                    explained.push(by);
                }
                if keeps {
                    kept.push(replies.to_vec());
                }
                // Of the first answers a late program need not show more than AS_OFF.
                let given = replies.iter().skip(latency).map(Keys::given);
                shown.push(given.fold(Keys::ALL, Keys::and));
            }
        })?;

        // For the others there was no time.
        asked.truncate(shown.len());
        let was_asked = |place: &usize| asked.iter().any(|(own, ..)| own == place);
        let counted = explained.iter().enumerate().map(|(late, explained)| {
            let by = |set: fn(&Explained) -> &Set| explained.iter().map(set);
            (late, verdict::best(&explain, by(|one| &one.all), by(|one| &one.state)))
        });
        let (late, (best, _)) =
            counted.max_by_key(|(late, (_, counts))| (*counts, std::cmp::Reverse(*late))).unwrap_or_default();
        let explained = explained.into_iter().nth(late).unwrap_or_default();
        let (explained, explained_by_state): (Vec<Set>, Vec<Set>) =
            explained.into_iter().map(|one| (one.all, one.state)).unzip();
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
            not_run: tests
                .iter()
                .enumerate()
                .filter(|(place, _)| !was_asked(place))
                .map(|(_, test)| test.name.clone())
                .collect(),
            kept,
            asked: asked.iter().map(|(place, ..)| *place).collect(),
            explained_by_state,
            shown,
            another_bit,
            explain,
            scenarios,
        };
        Ok(suite)
    }
}

impl Explained {
    fn of(explain: &Explain, scenario: &Scenario, replies: &[Reply], late: usize) -> Self {
        let all = explain.explaining(scenario, replies, late);
        let state = if all.is_empty() {
            let states: Vec<Reply> = replies.iter().map(Reply::only_the_state).collect();
            explain.explaining(scenario, &states, late)
        } else {
            all.clone()
        };
        Self { all, state }
    }
}

/// The choices that all combinations which explain a test have and the best one has not; `None` if nothing explains it.
fn needed(explain: &Explain, best: usize, explaining: &Set) -> Option<Vec<Choice>> {
    let best = explain.readings().get(best).filter(|_| !explaining.is_empty())?;
    let allowed = |choice: Choice| {
        explaining
            .iter()
            .any(|place| explain.readings().get(place).is_some_and(|readings| readings.is(choice)))
    };
    let needed = explain.questions().iter().filter(|&&reading| !allowed(best.choice(reading)));
    Some(needed.flat_map(|reading| reading.choices()).copied().filter(|&choice| allowed(choice)).collect())
}
