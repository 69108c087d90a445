//! The shortest scenario that still shows a finding: what can be left out is left out, and it is held again.
//!
//! As the shrinker of `adsdv_conform` does with the steps of a VCU; here it is lines of an operator and disturbances, of
//! which most wait for a state, so that nothing can be said of one without running it.

use adsdv_can::car::Physics;
use adsdv_can::scenario::{Line, Scenario, When};

use std::collections::BTreeMap;

use crate::exam::ExamOptions;
use crate::findings::findings;
use crate::program_error::StackError;
use crate::report::{ExamFinding, ExamReport};
use crate::scenario::ExamScenario;
use crate::session::{Ran, Sent, SessionError, run};
use crate::stack::Stack;

/// So many findings are shown in full, and shortened.
pub const FINDINGS: usize = 12;

/// How long behind a finding a scenario may end, in milliseconds: some are settled only when something has not come for long.
const SETTLED_MS: [u64; 3] = [20, 300, 1200];
/// Times are made shorter down to this, in milliseconds.
const SHORT_MS: u32 = 100;

/// The shortest scenarios, each beside the place of its finding.
pub type Shorter = BTreeMap<usize, Shortest>;

/// A scenario that shows a finding.
#[derive(Clone, Debug)]
pub struct Shortest {
    /// The scenario.
    pub scenario: ExamScenario,
    /// What was on the bus.
    pub sent: Vec<Sent>,
}

/// Looks for the shortest scenario that shows a finding of this one, in so many runs at most; `None` if it does not show it again:
/// the AI Computer does not do the same each time.
///
/// ```
/// use adsdv_exam::{ExamOptions, Stack, StackError, exam, scenarios, shortest};
/// # use adsdv_spec::{Edition, messages::Frame};
/// # struct Silent;
/// # impl Stack for Silent {
/// #     fn hello(&mut self, _: &Edition) -> Result<(), StackError> { Ok(()) }
/// #     fn reset(&mut self) -> Result<(), StackError> { Ok(()) }
/// #     fn step(&mut self, _: u64, _: &[Frame]) -> Result<Vec<Frame>, StackError> { Ok(Vec::new()) }
/// # }
///
/// let options = ExamOptions::of(Edition::DEFAULT);
/// let mission: Vec<_> = scenarios().into_iter().filter(|one| one.name == "mission-skidpad").collect();
/// let report = exam(&mut Silent, &mission, &options, &mut |_| {})?;
/// let finding = report.findings.iter().find(|one| one.requirements == ["RDY-7"]).expect("it confirms nothing");
/// let shortest = shortest(&mut Silent, &mission[0], finding, &options, 100)?.expect("it does the same again");
/// assert_eq!(shortest.scenario.to_string(), "0 ami SKIDPAD\n0.5 asms on\n+1.53 end\n");
/// # Ok::<(), StackError>(())
/// ```
///
/// # Errors
///
/// As [`exam`](crate::exam).
pub fn shortest(
    stack: &mut dyn Stack,
    scenario: &ExamScenario,
    finding: &ExamFinding,
    options: &ExamOptions,
    runs: u32,
) -> Result<Option<Shortest>, StackError> {
    let Ok(operator) = scenario.operator.parse::<Scenario>() else { return Ok(None) };
    let candidate = Candidate { lines: operator.lines().to_vec(), rest: scenario.clone() };
    let mut shrink = Shrink { stack, finding, options, left: runs };
    let Some(mut best) = shrink.run(candidate)? else { return Ok(None) };
    loop {
        let before = best.candidate.size();
        shrink.cut(&mut best)?;
        shrink.without_disturbances(&mut best)?;
        shrink.fewer_lines(&mut best)?;
        shrink.fewer_actions(&mut best)?;
        shrink.less_time(&mut best)?;
        if best.candidate.size() >= before || shrink.left == 0 {
            return Ok(Some(Shortest { scenario: best.candidate.scenario(), sent: best.ran.sent }));
        }
    }
}

/// The shortest scenarios of the findings that are shown, each in so many runs at most. The stack is said hello to again. `progress`
/// learns how many are done, and how many there are.
///
/// # Errors
///
/// As [`exam`](crate::exam).
pub fn shorter(
    stack: &mut dyn Stack,
    scenarios: &[ExamScenario],
    report: &ExamReport,
    options: &ExamOptions,
    runs: u32,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Shorter, StackError> {
    let places: Vec<usize> = report.shown().into_iter().take(FINDINGS).collect();
    let mut found = Shorter::new();
    stack.hello(options.edition)?;
    for (done, place) in places.iter().enumerate() {
        let Some(finding) = report.findings.get(*place) else { continue };
        let Some(scenario) = scenarios.get(finding.scenario) else { continue };
        progress(done, places.len());
        if let Some(shortest) = shortest(stack, scenario, finding, options, runs)? {
            found.insert(*place, shortest);
        }
    }
    Ok(found)
}

/// A scenario whose lines are apart.
#[derive(Clone, Debug)]
struct Candidate {
    lines: Vec<Line>,
    /// All else of it.
    rest: ExamScenario,
}

impl Candidate {
    fn scenario(&self) -> ExamScenario {
        let lines: Vec<String> = self.lines.iter().map(|line| line.to_string() + "\n").collect();
        let operator = lines.concat();
        ExamScenario { operator, ..self.rest.clone() }
    }

    /// How much there is to read: lines, then actions, then time.
    fn size(&self) -> (usize, usize, u64) {
        let Self { lines, rest } = self;
        let starts = usize::from(rest.vcu_starts_ms > 0) + usize::from(rest.ai_starts_ms > 0);
        let others = rest.disturbances.len() + starts + usize::from(rest.physics != Physics::DEFAULT);
        let actions = lines.iter().map(|line| line.actions.len()).sum();
        let waits = lines.iter().map(|line| u64::from(ms_of(line.when)));
        let lasts = rest.disturbances.iter().map(|one| one.after_ms.saturating_add(one.for_ms));
        (lines.len() + others, actions, waits.chain(lasts).fold(0, u64::saturating_add))
    }
}

/// A candidate that shows the finding.
struct Failing {
    candidate: Candidate,
    ran: Ran,
    /// When the finding is, in milliseconds.
    time_ms: u64,
}

struct Shrink<'a> {
    stack: &'a mut dyn Stack,
    finding: &'a ExamFinding,
    options: &'a ExamOptions,
    /// How many runs are left.
    left: u32,
}

impl Shrink<'_> {
    /// Holds a scenario; `None` if it does not show the finding, or there is no run left.
    fn run(&mut self, candidate: Candidate) -> Result<Option<Failing>, StackError> {
        let Some(left) = self.left.checked_sub(1) else { return Ok(None) };
        self.left = left;
        let scenario = candidate.scenario();
        let ran = match run(&scenario, self.options.edition, self.options.mission_ms, self.stack) {
            Ok(ran) => ran,
            Err(SessionError::Stack(error)) => return Err(error),
            Err(SessionError::Scenario(_)) => return Ok(None),
        };
        let found = findings(&ran, self.options.edition);
        let same = found.iter().find(|one| is_same(one, self.finding));
        let time_ms = same.map(|one| u64::try_from(one.t_ns / 1_000_000).unwrap_or_default());
        Ok(time_ms.map(|time_ms| Failing { candidate, ran, time_ms }))
    }

    /// Takes a candidate instead of the best if it is shorter and shows the finding as well.
    fn accept(&mut self, best: &mut Failing, candidate: Candidate) -> Result<bool, StackError> {
        if candidate.size() >= best.candidate.size() {
            return Ok(false);
        }
        let failing = self.run(candidate)?;
        let accepted = failing.is_some();
        if let Some(failing) = failing {
            *best = failing;
        }
        Ok(accepted)
    }

    /// Ends soon after the finding.
    fn cut(&mut self, best: &mut Failing) -> Result<(), StackError> {
        for settled_ms in SETTLED_MS {
            let until_ms = best.time_ms.saturating_add(settled_ms);
            let mut actions = best.ran.actions.iter();
            let (mut lines, mut last_ms) = (Vec::new(), 0);
            for line in best.candidate.lines.iter().filter(|line| !line.actions.is_empty()) {
                let taken = actions.by_ref().take(line.actions.len()).map(|(time_ms, _)| *time_ms).last();
                let Some(time_ms) = taken.filter(|time_ms| *time_ms <= until_ms) else { break };
                lines.push(Line { ends: false, ..line.clone() });
                last_ms = time_ms;
            }
            let wait = u32::try_from(until_ms.saturating_sub(last_ms)).unwrap_or(u32::MAX);
            let number = lines.last().map_or(1, |line| line.number + 1);
            lines.push(Line { number, when: When::After(wait), actions: Vec::new(), ends: true });
            if self.accept(best, Candidate { lines, ..best.candidate.clone() })? {
                break;
            }
        }
        Ok(())
    }

    fn without_disturbances(&mut self, best: &mut Failing) -> Result<(), StackError> {
        let mut place = 0;
        while place < best.candidate.rest.disturbances.len() {
            let mut candidate = best.candidate.clone();
            candidate.rest.disturbances.remove(place);
            if !self.accept(best, candidate)? {
                place += 1;
            }
        }
        let usual: [fn(&mut ExamScenario); 3] = [
            |scenario| scenario.vcu_starts_ms = 0,
            |scenario| scenario.ai_starts_ms = 0,
            |scenario| scenario.physics = Physics::DEFAULT,
        ];
        for make in usual {
            let mut candidate = best.candidate.clone();
            make(&mut candidate.rest);
            self.accept(best, candidate)?;
        }
        Ok(())
    }

    /// Without some lines, many at first; the last one, which ends it, stays.
    fn fewer_lines(&mut self, best: &mut Failing) -> Result<(), StackError> {
        let mut width = best.candidate.lines.len().saturating_sub(1);
        while width > 0 {
            let mut start = 0;
            while start + width < best.candidate.lines.len() {
                let mut candidate = best.candidate.clone();
                candidate.lines.drain(start..start + width);
                if !self.accept(best, candidate)? {
                    start += width;
                }
            }
            width /= 2;
        }
        Ok(())
    }

    fn fewer_actions(&mut self, best: &mut Failing) -> Result<(), StackError> {
        for line in 0..best.candidate.lines.len() {
            let mut action = 0;
            while best
                .candidate
                .lines
                .get(line)
                .is_some_and(|one| one.actions.len() > 1 && action < one.actions.len())
            {
                let mut candidate = best.candidate.clone();
                if let Some(one) = candidate.lines.get_mut(line) {
                    one.actions.remove(action);
                }
                if !self.accept(best, candidate)? {
                    action += 1;
                }
            }
        }
        Ok(())
    }

    /// Earlier: each line at once, else at half its time, for as long as that does it.
    fn less_time(&mut self, best: &mut Failing) -> Result<(), StackError> {
        for place in 0..best.candidate.lines.len() {
            let mut at_once = true;
            while let Some(line) = best.candidate.lines.get(place) {
                let ms = ms_of(line.when);
                let less = if at_once { 0 } else { ms / 20 * 10 };
                if ms == 0 || !at_once && ms < SHORT_MS {
                    break;
                }
                let mut candidate = best.candidate.clone();
                if let Some(line) = candidate.lines.get_mut(place) {
                    line.when = with_ms(line.when, less);
                }
                if !self.accept(best, candidate)? && !at_once {
                    break;
                }
                at_once = false;
            }
        }
        Ok(())
    }
}

/// Whether a finding is against all that another one is against; against no single requirement, whether the same rule says so.
fn is_same(one: &ExamFinding, other: &ExamFinding) -> bool {
    if other.requirements.is_empty() {
        return one.requirements.is_empty() && one.found_by == other.found_by;
    }
    other.requirements.iter().all(|id| one.requirements.contains(id))
}

const fn ms_of(when: When) -> u32 {
    match when {
        When::At(ms) | When::After(ms) | When::State(_, ms) => ms,
    }
}

const fn with_ms(when: When, ms: u32) -> When {
    match when {
        When::At(_) => When::At(ms),
        When::After(_) => When::After(ms),
        When::State(state, _) => When::State(state, ms),
    }
}
