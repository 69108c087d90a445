//! The whole exam: one scenario after the other, and what comes of it for each requirement.

use adsdv_oracle::judge::ResponseTimes;
use adsdv_spec::Edition;

use crate::catalogue::{self, Entry};
use crate::expectations::ANSWERS;
use crate::findings::findings;
use crate::program_error::StackError;
use crate::report::{ExamFinding, ExamReport, Examined, Outcome, ScenarioOutcome};
use crate::scenario::ExamScenario;
use crate::session::{Ran, Sent, SessionError, run};
use crate::stack::Stack;
use crate::tally::Tally;

/// How an exam is held.
#[derive(Clone, Copy, Debug)]
pub struct ExamOptions {
    /// The edition of the interface.
    pub edition: &'static Edition,
    /// How long a mission may take, in milliseconds of AS_DRIVING.
    pub mission_ms: u64,
}

impl ExamOptions {
    /// How an AI Computer of this edition is examined where nobody asks for something else.
    pub const fn of(edition: &'static Edition) -> Self {
        Self { edition, mission_ms: 60_000 }
    }
}

/// How far it is, and what was on the bus of the scenario that has just ended.
#[derive(Debug)]
pub struct ExamProgress<'a> {
    /// The name of the scenario.
    pub name: &'a str,
    /// How many are done, and how many there are.
    pub done: (usize, usize),
    /// All frames of it.
    pub sent: &'a [Sent],
}

/// Examines an AI Computer in these scenarios.
///
/// `ended` gets each scenario when it is over. A stack that [fails](crate::StackErrorKind::Failed) ends its scenario, and that is a finding; every
/// other error of a stack ends the exam.
///
/// ```
/// use adsdv_exam::{ExamOptions, Reference, exam, scenarios};
/// use adsdv_spec::Edition;
///
/// let options = ExamOptions::of(Edition::DEFAULT);
/// let some: Vec<_> = scenarios().into_iter().filter(|one| one.name == "mission-track-drive").collect();
/// let report = exam(&mut Reference::default(), &some, &options, &mut |_| {})?;
/// assert!(report.passes());
/// # Ok::<(), adsdv_exam::StackError>(())
/// ```
///
/// # Errors
///
/// Fails if the stack does in another way than that, such as a program that cannot be started or speaks of another edition.
pub fn exam(
    stack: &mut dyn Stack,
    scenarios: &[ExamScenario],
    options: &ExamOptions,
    ended: &mut dyn FnMut(&ExamProgress<'_>),
) -> Result<ExamReport, StackError> {
    let mut collector = Collector::new(options.edition);
    stack.hello(options.edition)?;
    for (place, scenario) in scenarios.iter().enumerate() {
        let ran = match run(scenario, options.edition, options.mission_ms, stack) {
            Ok(ran) => ran,
            Err(SessionError::Stack(error)) => return Err(error),
            Err(SessionError::Scenario(wrong)) => {
                // The tests read every scenario of this crate: somebody else's is left out, and named.
                collector.note(format!("{}: {wrong}", scenario.name));
                continue;
            }
        };
        let findings = findings(&ran, options.edition);
        collector.ran(scenario, &ran, findings);
        let done = (place + 1, scenarios.len());
        ended(&ExamProgress { name: &scenario.name, done, sent: &ran.sent });
    }
    stack.end()?.into_iter().for_each(|note| collector.note(note));
    Ok(collector.finish())
}

/// The report as it becomes, scenario by scenario.
pub(crate) struct Collector {
    marks: Marks,
    report: ExamReport,
}

impl Collector {
    pub(crate) fn new(edition: &'static Edition) -> Self {
        let report = ExamReport {
            scenarios: Vec::new(),
            requirements: Vec::new(),
            findings: Vec::new(),
            slowest: None,
            notes: Vec::new(),
        };
        Self { marks: Marks::new(edition), report }
    }

    /// Something is worth a note.
    pub(crate) fn note(&mut self, note: String) {
        self.report.notes.push(note);
    }

    /// Something was wrong in a scenario, or seemed so, and it is not certain that this was the AI Computer: why.
    pub(crate) fn in_doubt(&mut self, ids: &[&'static str], why: &str) {
        self.marks.in_doubt.extend(ids.iter().map(|id| (*id, why.to_owned())));
    }

    /// A scenario was run, and this is wrong in it.
    pub(crate) fn ran(&mut self, scenario: &ExamScenario, ran: &Ran, findings: Vec<ExamFinding>) {
        let Self { marks, report } = self;
        let place = report.scenarios.len();
        let exercised = marks.ran(ran, &findings);
        report.scenarios.push(ScenarioOutcome {
            name: scenario.name.clone(),
            about: scenario.about.clone(),
            duration_ms: ran.duration_ms,
            frames: ran.sent.len(),
            findings: findings.len(),
            exercised,
            stuck: ran.stuck.as_ref().map(ToString::to_string),
        });
        report.findings.extend(findings.into_iter().map(|one| ExamFinding { scenario: place, ..one }));
        let slower = |slowest: &ResponseTimes| ran.report.responses.max_ms() > slowest.max_ms();
        if ran.report.responses.count() > 0 && report.slowest.as_ref().is_none_or(slower) {
            report.slowest = Some(ran.report.responses.clone());
        }
    }

    pub(crate) fn finish(self) -> ExamReport {
        let Self { marks, mut report } = self;
        report.requirements = marks.outcomes(&report.findings);
        report
    }
}

/// Which requirements were exercised.
struct Marks {
    edition: &'static Edition,
    entries: Vec<Entry>,
    expected: Vec<&'static str>,
    tally: Tally,
    /// The requirements that something was against of which it is not certain who is at fault: why.
    in_doubt: Vec<(&'static str, String)>,
    /// In how many scenarios the stack failed.
    failed: usize,
}

impl Marks {
    fn new(edition: &'static Edition) -> Self {
        Self {
            edition,
            entries: catalogue::of_edition(edition),
            expected: Vec::new(),
            tally: Tally::default(),
            in_doubt: Vec::new(),
            failed: 0,
        }
    }

    /// Counts a scenario, and tells what it put to the test.
    fn ran(&mut self, ran: &Ran, findings: &[ExamFinding]) -> Vec<&'static str> {
        let followed = ran.followed.iter().filter(|followed| followed.exercised);
        let mut expected: Vec<&'static str> =
            followed.flat_map(|followed| followed.expectation.against).copied().collect();
        // An answer within the cycle is never seen to be missing.
        if ran.report.responses.count() > 0 {
            expected.extend(ANSWERS.against);
        }
        let is_exercised = |entry: &&Entry| {
            let broken = || findings.iter().any(|one| one.requirements.contains(&entry.id));
            entry.lacks(&ran.tally, expected.contains(&entry.id)).is_none() || broken()
        };
        let exercised = self.entries.iter().filter(is_exercised).map(|entry| entry.id).collect();
        self.tally.add(&ran.tally);
        self.expected.extend(expected);
        self.failed += usize::from(ran.failed.is_some());
        exercised
    }

    fn outcomes(self, findings: &[ExamFinding]) -> Vec<Examined> {
        let one = |entry: &Entry| {
            let broken = findings.iter().enumerate().filter(|(_, one)| one.requirements.contains(&entry.id));
            let mut broken: Vec<(i64, usize)> = broken.map(|(place, one)| (one.t_ns, place)).collect();
            broken.sort_unstable();
            let outcome = if broken.is_empty() {
                let doubt = self.in_doubt.iter().find(|(id, _)| *id == entry.id).map(|(_, why)| why.clone());
                let lacks = doubt.or_else(|| entry.lacks(&self.tally, self.expected.contains(&entry.id)));
                lacks.map_or(Outcome::Pass, |why| Outcome::NotExercised(self.why(entry, why)))
            } else {
                Outcome::Fail(broken.into_iter().map(|(_, place)| place).collect())
            };
            Examined { id: entry.id, section: entry.section(), about: entry.about(self.edition), outcome }
        };
        self.entries.iter().map(one).collect()
    }

    /// Why it was not exercised, with that the stack has failed, where that may be why.
    fn why(&self, entry: &Entry, why: String) -> String {
        match self.failed {
            0 => why,
            _ if !entry.can_be_exercised() => why,
            1 => format!("{why}; the stack failed in 1 scenario"),
            count => format!("{why}; the stack failed in {count} scenarios"),
        }
    }
}
