//! What came of an exam: of each scenario, of each requirement, and what is wrong.

use adsdv_oracle::judge::{ResponseTimes, Rule};

use crate::catalogue::NEVER_MOVED;
use crate::session::Sent;

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
    /// The requirements that it put to the test, whether they were kept or broken, in the order of the document.
    pub exercised: Vec<&'static str>,
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
    /// What a verdict that nothing is wrong leaves open: that the vehicle never moved, so that nothing is known of how it is driven.
    pub fn leaves_open(&self) -> Option<&str> {
        self.requirements.iter().find_map(|one| match &one.outcome {
            Outcome::NotExercised(why) if why == NEVER_MOVED => Some(why.as_str()),
            _ => None,
        })
    }

    /// Whether nothing is wrong.
    pub fn passes(&self) -> bool {
        self.findings.is_empty()
    }

    /// How many requirements came to this: pass, fail, not exercised.
    pub fn count(&self, outcome: &str) -> usize {
        self.requirements.iter().filter(|one| one.outcome.name() == outcome).count()
    }
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
}
