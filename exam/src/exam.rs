//! The whole exam: one scenario after the other, and what comes of it for each requirement.

use std::collections::BTreeMap;

use adsdv_oracle::judge::{Finding, Party, ResponseTimes, Rule, Severity};
use adsdv_spec::{AiMessages, Atoms, Edition};

use crate::catalogue::{self, Entry};
use crate::expectation::{Expectation, Followed, Kind, Within};
use crate::expectations::{ANSWERS, CYCLES, HOLDS_STILL};
use crate::program_error::{Failure, StackError};
use crate::scenario::ExamScenario;
use crate::session::{Change, Ran, Sent, SessionError, run};
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

/// Where the words of a finding come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoundBy {
    /// The judge of `adsdv check`, by this rule.
    Judge(Rule),
    /// The exam: something that was to be done was not.
    Exam,
    /// The stack: it failed instead of an answer.
    Stack,
}

impl FoundBy {
    /// The stable identifier of the rule; `not-done` where the exam found it, and `stack-failed` where the
    /// stack failed itself.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Judge(rule) => rule.id(),
            Self::Exam => "not-done",
            Self::Stack => "stack-failed",
        }
    }
}

/// Something that is wrong in a scenario.
#[derive(Clone, Debug)]
pub struct ExamFinding {
    /// The place of the scenario.
    pub scenario: usize,
    /// When, in nanoseconds since its start.
    pub t_ns: i64,
    /// Where the rule stands.
    pub section: String,
    /// Who found it.
    pub found_by: FoundBy,
    /// The requirements that it is against; none where no single one is.
    pub requirements: Vec<&'static str>,
    /// What was seen.
    pub seen: String,
    /// What was expected instead.
    pub expected: String,
    /// What the operator had done by then, and when, in milliseconds.
    pub operator: Vec<(u64, String)>,
    /// The frames around it.
    pub frames: Vec<Sent>,
    /// What the car did then.
    pub car: String,
    /// Where in the stack it failed, in its own words, if it did.
    pub trace: Option<String>,
    /// In real time, how late this machine may be before it is in doubt who is at fault; `None` where that changes nothing.
    pub(crate) slack_ms: Option<u64>,
}

/// What came of a scenario.
#[derive(Clone, Debug)]
pub struct ScenarioOutcome {
    /// Its name.
    pub name: String,
    /// What it is about.
    pub about: String,
    /// How long it was, in milliseconds.
    pub duration_ms: u64,
    /// How many frames were on the bus.
    pub frames: usize,
    /// How many findings it has.
    pub findings: usize,
    /// What it waited for in vain, if it came to no end.
    pub stuck: Option<String>,
}

/// What came of a requirement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It was exercised, and kept.
    Pass,
    /// It was not kept: the places of the findings, the one of the shortest scenario first.
    Fail(Vec<usize>),
    /// Nothing shows whether it is kept: why.
    NotExercised(String),
}

impl Outcome {
    /// `pass`, `fail` or `not exercised`.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail(_) => "fail",
            Self::NotExercised(_) => "not exercised",
        }
    }
}

/// A requirement with its outcome.
#[derive(Clone, Debug)]
pub struct Examined {
    /// As `REQUIREMENTS.md` names it.
    pub id: &'static str,
    /// The section of the document that asks for it.
    pub section: &'static str,
    /// What it asks for, in a few words.
    pub about: String,
    /// What came of it.
    pub outcome: Outcome,
}

/// Everything that there is to say.
#[derive(Clone, Debug)]
pub struct ExamReport {
    /// The scenarios, in their order.
    pub scenarios: Vec<ScenarioOutcome>,
    /// The requirements, in the order of the document.
    pub requirements: Vec<Examined>,
    /// All that is wrong, in the order of the scenarios.
    pub findings: Vec<ExamFinding>,
    /// How fast the handshake was answered in the slowest scenario.
    pub slowest: Option<ResponseTimes>,
    /// What is worth a note about the program.
    pub notes: Vec<String>,
}

impl ExamReport {
    /// Whether nothing is wrong.
    pub fn passes(&self) -> bool {
        self.findings.is_empty()
    }

    /// How many requirements came to this: pass, fail, not exercised.
    pub fn count(&self, outcome: &str) -> usize {
        self.requirements.iter().filter(|one| one.outcome.name() == outcome).count()
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
        marks.ran(ran);
        report.scenarios.push(ScenarioOutcome {
            name: scenario.name.clone(),
            about: scenario.about.clone(),
            duration_ms: ran.duration_ms,
            frames: ran.sent.len(),
            findings: findings.len(),
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

    fn ran(&mut self, ran: &Ran) {
        self.tally.add(&ran.tally);
        self.failed += usize::from(ran.failed.is_some());
        let exercised = ran.followed.iter().filter(|followed| followed.exercised);
        self.expected.extend(exercised.flat_map(|followed| followed.expectation.against));
        // An answer within the cycle is never seen to be missing.
        if ran.report.responses.count() > 0 {
            self.expected.extend(ANSWERS.against);
        }
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

/// What is wrong in a scenario: what the judge says of the AI Computer, and what was to be done and was not.
pub(crate) fn findings(ran: &Ran, edition: &Edition) -> Vec<ExamFinding> {
    let mut found = judged(ran, edition);
    if let Some((time_ms, waiting)) = ran.flood {
        let cycles = edition.bus.cycle_requirements(AiMessages::IDS[0]).to_vec();
        found.push(ExamFinding {
            seen: format!("the bus cannot carry what the AI Computer sends: {waiting} of its frames wait"),
            expected: format!("each of its messages every {} ms", edition.rules.timing.cycle_ms),
            ..ExamFinding::new(ns(time_ms), "2.1", FoundBy::Exam, catalogue::held_by(edition, cycles))
        });
    }
    if let Some((time_ms, Failure { why, trace, expected })) = &ran.failed {
        found.push(ExamFinding {
            seen: why.clone(),
            expected: (*expected).to_owned(),
            trace: trace.clone(),
            ..ExamFinding::new(ns(*time_ms), "2.1", FoundBy::Stack, Vec::new())
        });
    }
    for followed in &ran.followed {
        // What the judge has said already is not said again.
        let is_said =
            |against: &[&str]| found.iter().any(|one| against.iter().all(|id| one.requirements.contains(id)));
        let missed = not_done(ran, edition, followed).filter(|missed| !is_said(&missed.requirements));
        found.extend(missed);
    }
    found.into_iter().map(|finding| finding.seen_in(ran)).collect()
}

impl ExamFinding {
    pub(crate) fn new(t_ns: i64, section: &str, found_by: FoundBy, requirements: Vec<&'static str>) -> Self {
        Self {
            scenario: 0,
            t_ns,
            section: section.to_owned(),
            found_by,
            requirements,
            seen: String::new(),
            expected: String::new(),
            operator: Vec::new(),
            frames: Vec::new(),
            car: String::new(),
            trace: None,
            slack_ms: None,
        }
    }

    /// The same with what was around it.
    pub(crate) fn seen_in(self, ran: &Ran) -> Self {
        let time_ms = u64::try_from(self.t_ns / 1_000_000).unwrap_or_default();
        Self {
            operator: operator_until(ran, time_ms),
            frames: frames_around(ran, self.t_ns),
            car: car_after(ran, time_ms),
            ..self
        }
    }
}

/// What the judge says of the AI Computer.
fn judged(ran: &Ran, edition: &Edition) -> Vec<ExamFinding> {
    // The judge counts from the first frame.
    let start_ns = ran.sent.first().map_or(0, |sent| sent.t_ns);
    let judged = ran.report.findings.iter().filter(|finding| finding.party == Party::Ai && is_wrong(finding));
    let one = |finding: &Finding| {
        let t_ns = finding.t_ns + start_ns;
        let against = catalogue::held_by(edition, finding.requirements.clone());
        ExamFinding {
            seen: finding.seen.clone(),
            expected: finding.expected.clone(),
            slack_ms: slack_of_rule(finding.rule),
            ..ExamFinding::new(t_ns, &finding.section.to_string(), FoundBy::Judge(finding.rule), against)
        }
    };
    judged.map(one).collect()
}

/// What was to be done and was not. An edition that does not ask for it does not fail for it.
fn not_done(ran: &Ran, edition: &Edition, followed: &Followed) -> Option<ExamFinding> {
    let (time_ms, seen) = followed.failed.as_ref()?;
    let expectation = followed.expectation;
    let mut against = catalogue::held_by(edition, expectation.against.to_vec());
    if against.is_empty() {
        return None;
    }
    let mut held = None;
    if std::ptr::eq(expectation, &raw const HOLDS_STILL) {
        let broken = catalogue::of_requests(requests_at(ran, edition, ns(*time_ms)));
        against.retain(|id| broken.is_empty() || broken.contains(id));
        held = ran.report.findings.iter().find(|finding| finding.rule == Rule::ReadyHeld);
    }
    let found_by = held.map_or(FoundBy::Exam, |finding| FoundBy::Judge(finding.rule));
    Some(ExamFinding {
        seen: held.map_or(seen, |finding| &finding.seen).clone(),
        expected: held.map_or(expectation.expected, |finding| &finding.expected).to_owned(),
        slack_ms: slack(expectation, edition),
        ..ExamFinding::new(ns(*time_ms), expectation.section, found_by, against)
    })
}

/// Violations, and a length that the database does not have, which is only worth a note where a log was cut.
fn is_wrong(finding: &Finding) -> bool {
    finding.severity == Severity::Violation || finding.rule == Rule::Length
}

/// In real time, a machine that is late by a cycle may have kept a message or an answer waiting that long.
pub(crate) const CYCLE_MS: u64 = 10;

/// How late this machine may be before it is in doubt whether the AI Computer has broken a rule.
fn slack_of_rule(rule: Rule) -> Option<u64> {
    matches!(rule, Rule::HandshakeLate | Rule::MessageMissed | Rule::ReadyHeld).then_some(CYCLE_MS)
}

/// Or has not done something: half of the time that it has for that. What never is to be is so at once, but for gaps.
fn slack(expectation: &'static Expectation, edition: &Edition) -> Option<u64> {
    match expectation.kind {
        // A mission takes longer than any machine is late.
        Kind::Comes { within: Within::Mission, .. } => None,
        Kind::Comes { within, .. } => Some(within.ms(edition, u64::MAX) / 2),
        Kind::Ends { .. } => Some(CYCLE_MS),
        Kind::Never { .. } => CYCLES.iter().any(|one| std::ptr::eq(one, expectation)).then_some(CYCLE_MS),
    }
}

/// What holds of the AI Computer's requests at a time.
fn requests_at(ran: &Ran, edition: &Edition, t_ns: i64) -> Atoms {
    let mut said = AiMessages::default();
    for sent in ran.sent.iter().filter(|sent| sent.by_ai).take_while(|sent| sent.t_ns <= t_ns) {
        // What does not decode requests nothing.
        let _ = said.receive(&edition.bus, sent.frame.id, sent.frame.data());
    }
    let AiMessages { status, drive_f, drive_r, steer, .. } = said;
    status.atoms().union(drive_f.atoms()).union(drive_r.atoms()).union(steer.atoms())
}

fn operator_until(ran: &Ran, time_ms: u64) -> Vec<(u64, String)> {
    let mut by_time: BTreeMap<u64, Vec<String>> = BTreeMap::new();
    for (time, action) in ran.actions.iter().filter(|(time, _)| *time <= time_ms) {
        by_time.entry(*time).or_default().push(action.to_string());
    }
    by_time.into_iter().map(|(time, actions)| (time, actions.join(", "))).collect()
}

/// The last frame of each message before it, of those that both sides send to each other, and the first behind it.
fn frames_around(ran: &Ran, t_ns: i64) -> Vec<Sent> {
    const MOST: usize = 12;
    let before = ran.sent.iter().rev().skip_while(|sent| sent.t_ns > t_ns);
    let mut frames: Vec<Sent> = Vec::new();
    for sent in before.take(200) {
        let is_of_both = sent.by_ai || sent.frame.id == adsdv_spec::messages::Vcu2AiStatus::ID;
        let is_new = frames.iter().all(|one| one.frame.id != sent.frame.id);
        if (is_of_both && is_new || sent.t_ns == t_ns) && frames.len() < MOST {
            frames.push(*sent);
        }
    }
    frames.reverse();
    frames
}

/// What became of the car in the second behind a finding, or what it was in.
fn car_after(ran: &Ran, time_ms: u64) -> String {
    /// So much later it has nothing to do with it.
    const LATER_MS: u64 = 1000;
    let name = |state: Option<adsdv_spec::AsState>| state.map_or("no power", adsdv_spec::AsState::name);
    let followed = ran.changes.iter().find(|change| {
        // A finding about FINISHED or NEUTRAL at speed is settled when the car has reacted.
        (time_ms.saturating_sub(10)..=time_ms + LATER_MS).contains(&change.time_ms)
    });
    let last = ran.changes.iter().rfind(|change| change.time_ms <= time_ms);
    match (followed, last) {
        (Some(Change { time_ms: at, from, to, cause }), _) => {
            let cause = if cause.raw() == 0 { String::new() } else { format!(" ({cause})") };
            format!("{} -> {} at {}.{:03} s{cause}", name(*from), name(*to), at / 1000, at % 1000)
        }
        (None, Some(last)) => format!("it stays in {}", name(last.to)),
        (None, None) => "it has no power yet".to_owned(),
    }
}

fn ns(ms: u64) -> i64 {
    i64::try_from(ms.saturating_mul(1_000_000)).unwrap_or(i64::MAX)
}
