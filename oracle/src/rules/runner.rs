//! Follows all rules of a file through a recording.

use std::fmt::Write as _;

use adsdv_spec::{Edition, Knowledge, Truth};

use super::error::RuleError;
use super::limits::BREACHES;
use super::predicate::{Predicate, Subject, SubjectKind};
use super::report::{Breach, RuleReport};
use super::syntax::Form;
use super::track::{RuleOutcome, Track};
use super::{RuleFile, resolve};
use crate::judge::{Finding, Party, Rule, Section};

/// A finding lists so many values of a rule that is broken.
const VALUES: usize = 8;

/// The rules of a file under an edition, and what became of them so far.
#[derive(Debug)]
pub(crate) struct Runner {
    edition: Edition,
    subjects: Vec<Subject>,
    rules: Vec<RunningRule>,
    now: i64,
    findings: Vec<Finding>,
}

#[derive(Debug)]
struct RunningRule {
    form: Form<Predicate>,
    track: Track,
    /// What it is about, each once.
    subjects: Vec<usize>,
    /// Whether what it begins with was ever true.
    begun: bool,
    /// Of those that are undecided, how many the end of the recording left so.
    ended: u64,
    report: RuleReport,
}

impl Runner {
    pub(crate) fn new(file: &RuleFile, edition: &Edition) -> Result<Self, RuleError> {
        let (forms, subjects) = resolve::all(&file.rules, edition)?;
        let rules = file.rules.iter().zip(forms).map(|(line, form)| {
            let mut subjects = Vec::new();
            form.predicates().for_each(|predicate| predicate.subjects(&mut subjects));
            let mut kept = Vec::new();
            subjects.retain(|place| {
                !kept.contains(place) && {
                    kept.push(*place);
                    true
                }
            });
            let report = RuleReport {
                name: line.name.clone(),
                line: line.number,
                rule: line.rule.clone(),
                note: line.note.clone(),
                held: 0,
                broken: 0,
                undecided: 0,
                breaches: Vec::new(),
                why: None,
            };
            RunningRule { track: Track::of(&form), form, subjects, begun: false, ended: 0, report }
        });
        Ok(Self { edition: *edition, subjects, rules: rules.collect(), now: i64::MIN, findings: Vec::new() })
    }

    /// Messages have become too old, or time alone has made something else known. `fresh` tells whether what the message with an
    /// identifier said last still counts.
    pub(crate) fn aged(&mut self, t: i64, known: Knowledge, fresh: impl Fn(u16) -> bool) {
        self.step(t, |subject| subject.aged(known, &fresh));
    }

    /// The messages show this now.
    pub(crate) fn shown(&mut self, t: i64, known: Knowledge, data: impl Fn(u16) -> Option<([u8; 8], usize)>) {
        self.step(t, |subject| subject.shown(known, &data));
    }

    /// Nothing has come up to this time.
    pub(crate) fn pass(&mut self, t: i64) {
        self.now = self.now.max(t);
        for running in &mut self.rules {
            let RunningRule { track, report, ended, .. } = running;
            track.pass(self.now, &mut |outcome| {
                let seen = || values(&self.edition, &self.subjects, &running.subjects);
                self.findings.extend(count(report, ended, outcome, seen));
            });
        }
    }

    fn step(&mut self, t: i64, value: impl Fn(&Subject) -> super::predicate::RawValue) {
        self.pass(t);
        let mut changed = false;
        for subject in &mut self.subjects {
            let value = value(subject);
            changed |= value != subject.value;
            subject.value = value;
            subject.came |= value.is_some();
        }
        if !changed {
            return;
        }
        let Self { edition, subjects, rules, now, findings } = self;
        for RunningRule { form, track, subjects: about, begun, ended, report } in rules {
            let mut truths = [Truth::Unknown; 3];
            for (truth, predicate) in truths.iter_mut().zip(form.predicates()) {
                *truth = predicate.truth(subjects);
            }
            *begun |= truths[0] == Truth::True;
            track.step(*now, truths, &mut |outcome| {
                findings.extend(count(report, ended, outcome, || values(edition, subjects, about)));
            });
        }
    }

    /// What is new since this was last asked.
    pub(crate) fn news(&mut self) -> Vec<Finding> {
        std::mem::take(&mut self.findings)
    }

    /// There is nothing more to come after `t`.
    pub(crate) fn end(&mut self, t: i64) {
        self.pass(t);
        let Self { edition, subjects, rules, now, findings } = self;
        for running in rules {
            let RunningRule { track, report, ended, subjects: about, .. } = running;
            track.end(*now, &mut |outcome| {
                findings.extend(count(report, ended, outcome, || values(edition, subjects, about)));
            });
            if running.report.held + running.report.broken == 0 {
                running.report.why = Some(why(edition, subjects, running));
            }
        }
    }

    /// What became of the rules, in the order of the file.
    pub(crate) fn reports(self) -> Vec<RuleReport> {
        self.rules.into_iter().map(|running| running.report).collect()
    }
}

/// Counts what became of a rule once. A breach is a finding, unless there are too many.
fn count(
    report: &mut RuleReport,
    ended: &mut u64,
    outcome: RuleOutcome,
    seen: impl FnOnce() -> String,
) -> Option<Finding> {
    match outcome {
        RuleOutcome::Held => report.held += 1,
        RuleOutcome::Unknown => report.undecided += 1,
        RuleOutcome::Ended => {
            report.undecided += 1;
            *ended += 1;
        }
        RuleOutcome::Broken(t_ns) => {
            report.broken += 1;
            if report.breaches.len() < BREACHES {
                let seen = seen();
                let note = report.note.as_ref().map(|note| format!(" ({note})")).unwrap_or_default();
                let finding = Finding::violation(Party::Own, Section::Line(report.line), Rule::Custom, t_ns)
                    .seen(format!("{}{note}: {seen}", report.name))
                    .expected(report.rule.clone());
                report.breaches.push(Breach { t_ns, seen });
                return Some(finding);
            }
        }
    }
    None
}

/// What is known of all that a rule is about.
fn values(edition: &Edition, subjects: &[Subject], about: &[usize]) -> String {
    let mut text = String::new();
    for (nth, subject) in about.iter().filter_map(|place| subjects.get(*place)).take(VALUES).enumerate() {
        if nth > 0 {
            text.push_str(", ");
        }
        // Writing to a string does not fail.
        let _ = match (subject.what, subject.value) {
            (SubjectKind::Signal(place), Some(raw)) => {
                write!(text, "{} is {}", place.signal.name, place.signal.display(raw))
            }
            (SubjectKind::Signal(place), None) => write!(text, "{} is unknown", place.signal.name),
            (SubjectKind::Atom(atom), Some(raw)) => write!(text, "{}", edition.rules.text(atom, raw == 1)),
            (SubjectKind::Atom(atom), None) => write!(text, "{atom} is unknown"),
        };
    }
    text
}

/// Why nothing can be said of a rule.
fn why(edition: &Edition, subjects: &[Subject], running: &RunningRule) -> String {
    let missing = running.subjects.iter().filter_map(|place| subjects.get(*place)).find(|one| !one.came);
    match missing.map(|subject| subject.what) {
        Some(SubjectKind::Signal(place)) => {
            return format!(
                "{} ({:03X}h) never showed {}",
                place.message.name, place.message.id, place.signal.name
            );
        }
        Some(SubjectKind::Atom(atom)) => {
            return format!("it was never known whether {} ({atom})", edition.rules.text(atom, true));
        }
        None => {}
    }
    let RuleReport { undecided, .. } = running.report;
    match (&running.form, undecided > running.ended) {
        (_, true) => "something that it goes by was unknown each time".to_owned(),
        _ if undecided > 0 => "the recording ends before it is decided".to_owned(),
        (Form::AtMost(..), _) if !running.begun => "what must not last never began".to_owned(),
        (Form::Always(_) | Form::Never(_) | Form::AtMost(..) | Form::Until(None, ..), _) => {
            "what it goes by was never known".to_owned()
        }
        _ if running.begun => "what it waits for was so from the beginning, and never became so".to_owned(),
        _ => "what it waits for never came".to_owned(),
    }
}
