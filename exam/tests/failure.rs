//! A stack in the process of the exam that fails: that is a finding of its scenario, and the exam goes on.

use adsdv_exam::{
    ExamForm, ExamOptions, Failure, Outcome, Reference, Shorter, Stack, StackError, StackErrorKind, exam,
    scenarios, shorter,
};
use adsdv_spec::Edition;
use adsdv_spec::messages::Frame;

/// The reference, until it fails.
struct Fails {
    reference: Reference,
    what: fn() -> StackErrorKind,
}

impl Stack for Fails {
    fn hello(&mut self, edition: &Edition) -> Result<(), StackError> {
        self.reference.hello(edition)
    }
    fn reset(&mut self) -> Result<(), StackError> {
        self.reference.reset()
    }
    fn step(&mut self, time_ms: u64, frames: &[Frame]) -> Result<Vec<Frame>, StackError> {
        if time_ms > 2000 {
            Err(StackError::new((self.what)()))
        } else {
            self.reference.step(time_ms, frames)
        }
    }
}

fn failure() -> StackErrorKind {
    StackErrorKind::Failed(Failure {
        why: "it divides by 0".to_owned(),
        trace: Some("in line 7".to_owned()),
        expected: "no such thing",
    })
}

#[test]
fn a_stack_that_fails_has_a_finding_in_each_scenario() {
    let options = ExamOptions::of(Edition::DEFAULT);
    let some = &scenarios()[..2];
    let mut stack = Fails { reference: Reference::default(), what: failure };
    let report = exam(&mut stack, some, &options, &mut |_| {}).expect("a report");
    assert_eq!(report.findings.len(), 2);
    for (place, finding) in report.findings.iter().enumerate() {
        assert_eq!(
            (finding.scenario, finding.t_ns, finding.found_by.id()),
            (place, 2_004_000_000, "stack-failed")
        );
        assert_eq!(finding.words(), "it divides by 0; expected no such thing");
        assert_eq!(finding.ids(), ["stack-failed"]);
    }
    assert_eq!(report.others(), [0, 1]);
    let outcome = |id| report.requirements.iter().find(|one| one.id == id).map(|one| &one.outcome);
    assert_eq!(outcome("RDY-7"), Some(&Outcome::Pass));
    let why = "no scenario came so far; the stack failed in 2 scenarios".to_owned();
    assert_eq!(outcome("FIN-1"), Some(&Outcome::NotExercised(why)));
    let found = shorter(&mut stack, some, &report, &options, 40, &mut |_, _| {}).expect("some");
    assert_eq!(
        found.get(&0).map(|one| one.scenario.to_string()),
        Some("0.5 asms on\n+1.524 end\n".to_owned())
    );
    let text = report.description(&report.others(), &found);
    assert!(
        text.contains("(2 scenarios in all)") && text.contains("\nin line 7\nshortest scenario"),
        "{text}"
    );
    let form = ExamForm {
        edition: Edition::DEFAULT,
        program: Vec::new(),
        shorter: &Shorter::new(),
        reason: &|_| None,
        unused: Vec::new(),
        passes: report.passes(),
    };
    assert!(form.text(&report).contains("\"shortest\":null,\"trace\":\"in line 7\"}"));
}

#[test]
fn an_exam_that_is_stopped_has_no_report() {
    let options = ExamOptions::of(Edition::DEFAULT);
    let mut stack = Fails { reference: Reference::default(), what: || StackErrorKind::Stopped };
    let error = exam(&mut stack, &scenarios()[..1], &options, &mut |_| {}).expect_err("it is stopped");
    assert_eq!(error.to_string(), "the exam was stopped\n  in        no-mission, at 2.000 s");
}
