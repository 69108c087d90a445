//! Follows all rules of a file through a recording.

use std::fmt::Write as _;

use adsdv_spec::{Edition, Knowledge, Truth};

use super::limits::BREACHES;
use super::mistakes::RuleErrors;
use super::predicate::{Predicate, Subject, SubjectKind};
use super::report::{Breach, RuleReport};
use super::syntax::Form;
use super::track::{RuleOutcome, Track};
use super::undecided::{Course, GoHidden};
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
    /// Which of its predicates were ever unknown for nothing but "Go".
    up_to_go: [bool; 3],
    /// Of those that are undecided, how many the end of the recording left so.
    ended: u64,
    report: RuleReport,
}

impl Runner {
    pub(crate) fn new(file: &RuleFile, edition: &Edition) -> Result<Self, RuleErrors> {
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
            RunningRule {
                track: Track::of(&form),
                form,
                subjects,
                begun: false,
                up_to_go: [false; 3],
                ended: 0,
                report,
            }
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
        if changed {
            self.follow();
        }
    }

    /// "Go" was off up to `t`, and that is known only now: what else is known is as it was.
    pub(crate) fn go_was_off(&mut self, t: i64) {
        self.step(t, |subject| if subject.is_go() { subject.value.or(Some(0)) } else { subject.value });
    }

    /// The rules go by what is known now.
    fn follow(&mut self) {
        let Self { edition, subjects, rules, now, findings } = self;
        for RunningRule { form, track, subjects: about, begun, up_to_go, ended, report } in rules {
            let mut truths = [Truth::Unknown; 3];
            for ((truth, up_to_go), predicate) in truths.iter_mut().zip(up_to_go).zip(form.predicates()) {
                *truth = predicate.truth(subjects);
                let unknown = *truth == Truth::Unknown && !*up_to_go;
                *up_to_go |= unknown && predicate.is_known_but_for_go(subjects);
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

    /// There is nothing more to come after `t`; `complete`: nor can any frame be missing.
    pub(crate) fn end(&mut self, t: i64, hidden: Option<GoHidden>, complete: bool) {
        self.pass(t);
        let Self { edition, subjects, rules, now, findings } = self;
        for running in rules {
            let RunningRule { track, report, ended, subjects: about, .. } = running;
            track.end(*now, &mut |outcome| {
                findings.extend(count(report, ended, outcome, || values(edition, subjects, about)));
            });
            if running.report.held + running.report.broken == 0 {
                let RunningRule { form, subjects: about, begun, up_to_go, ended, report, .. } = running;
                let about = about.iter().filter_map(|place| subjects.get(*place)).copied().collect();
                let (begun, up_to_go, undecided) = (*begun, *up_to_go, [report.undecided, *ended]);
                let course = Course { form, about, begun, up_to_go, undecided, complete };
                report.why = Some(course.why(edition, hidden));
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
