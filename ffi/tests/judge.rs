//! The judge through the C interface finds what the judge finds, and is safe to use wrongly.
#![cfg(feature = "judge")]

mod common;

use std::collections::BTreeMap;
use std::ffi::CStr;
use std::ptr::{null, null_mut};

use adsdv::adsdv_status::*;
use adsdv::*;
use adsdv_oracle::judge::{Finding, Judge, JudgeOptions, Report, Severity};
use adsdv_spec::messages::{AmiState, Frame};
use adsdv_spec::{Choice, Edition};
use adsdv_tests::world::World;
use common::{no_error, number, outcome, text};

/// A recorded run in which much is wrong.
fn recording() -> Vec<(i64, Frame)> {
    let mut world = World::reference();
    world.inputs.ami = AmiState::TrackDrive;
    world.wait(300);
    world.shows = |status| status.as_state = adsdv_spec::AsState::Driving;
    world.wait(300);
    world.shows = |status| status.bms_fault = true;
    world.inputs.asms = true;
    world.wait(300);
    world.shows = |_| {};
    world.ai_answers = false;
    world.inputs.tsms = true;
    world.wait(500);
    world.log.iter().map(|recorded| (recorded.t, recorded.frame)).collect()
}

/// A judge that is freed.
struct Handle(*mut adsdv_judge);

impl Handle {
    fn new(options: *const adsdv_judge_options) -> Self {
        let mut error = no_error();
        // SAFETY: the pointers are to what they are said to be, or NULL.
        let judge = unsafe { adsdv_judge_new(options, &raw mut error) };
        assert!(!judge.is_null() && error.status == 0);
        Self(judge)
    }

    fn frame(&self, t_ns: i64, frame: Frame) -> Result<(), (adsdv_status, String)> {
        let (id, data) = (frame.id.into(), frame.data());
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_judge_frame(self.0, t_ns, id, data.as_ptr(), data.len(), error) })
    }

    fn next(&self) -> Option<String> {
        // SAFETY: numbers and a pointer, of which 0 is one.
        let mut finding: adsdv_finding = unsafe { std::mem::zeroed() };
        // SAFETY: the pointers are to what they are said to be.
        unsafe { adsdv_judge_next(self.0, &raw mut finding) }.then(|| {
            // SAFETY: the judge's texts end with a NUL, and stay until the next call.
            let message = unsafe { CStr::from_ptr(finding.message) }.to_str().unwrap();
            let words =
                [&finding.severity_name[..], &finding.party, &finding.section, &finding.rule].map(text);
            let severity = ["violation", "warning", "note"][usize::from(finding.severity)];
            assert_eq!(words[0], severity);
            format!("{} {} {message}", finding.t_ns, words.join(" "))
        })
    }

    fn finish(&self) -> adsdv_report {
        let mut report = adsdv_report::default();
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_judge_finish(self.0, &raw mut report, error) }).unwrap();
        report
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: it is a judge that was not freed yet.
        unsafe { adsdv_judge_free(self.0) };
    }
}

fn line(finding: &Finding) -> String {
    let (severity, party) = (finding.severity.name(), finding.party.name());
    format!(
        "{} {severity} {party} {} {} {}",
        finding.t_ns,
        finding.section,
        finding.rule.id(),
        finding.message()
    )
}

fn counted(lines: impl IntoIterator<Item = String>) -> BTreeMap<String, u32> {
    lines.into_iter().fold(BTreeMap::new(), |mut counts, line| {
        *counts.entry(line).or_default() += 1;
        counts
    })
}

fn in_rust(options: JudgeOptions) -> Report {
    let mut judge = Judge::new(options);
    for (t_ns, frame) in recording() {
        judge.frame(t_ns, frame.id.into(), frame.data());
    }
    judge.finish()
}

fn agrees(report: adsdv_report, found: Vec<String>, expected: &Report) {
    assert_eq!(counted(found), counted(expected.findings.iter().map(line)));
    let count = |severity| expected.count(severity) as u64;
    let expected = adsdv_report {
        frames: expected.frames,
        violations: count(Severity::Violation),
        warnings: count(Severity::Warning),
        notes: count(Severity::Note),
        duration_ns: expected.duration_ns,
    };
    assert_eq!(report, expected);
    assert!(report.violations > 3, "the recording was to have violations: {report:?}");
}

#[test]
fn it_finds_what_the_judge_finds_at_the_end() {
    let judge = Handle::new(null());
    for (t_ns, frame) in recording() {
        judge.frame(t_ns, frame).unwrap();
    }
    let report = judge.finish();
    let found = std::iter::from_fn(|| judge.next()).collect();
    agrees(report, found, &in_rust(JudgeOptions::default()));
    assert_eq!(judge.finish(), report, "a second call says the same");
    let refused = (ADSDV_FINISHED, "the judge has finished; expected a new one for more frames".to_owned());
    assert_eq!(judge.frame(0, Frame::default()), Err(refused));
}

#[test]
fn it_finds_the_same_as_it_happens() {
    let judge = Handle::new(null());
    let mut found = Vec::new();
    for (t_ns, frame) in recording() {
        judge.frame(t_ns, frame).unwrap();
        found.extend(std::iter::from_fn(|| judge.next()));
    }
    assert!(!found.is_empty(), "something is known before the end");
    let report = judge.finish();
    found.extend(std::iter::from_fn(|| judge.next()));
    agrees(report, found, &in_rust(JudgeOptions::default()));
}

#[test]
fn options_count() {
    // SAFETY: numbers and a pointer, of which 0 is one.
    let mut options: adsdv_judge_options = unsafe { std::mem::zeroed() };
    // SAFETY: the pointer is to what it is said to be.
    outcome(|error| unsafe { adsdv_judge_options_init(&raw mut options, error) }).unwrap();
    let usual = JudgeOptions::default();
    assert_eq!((options.window_ms, options.deadline_ms), (usual.window_ms, usual.deadline_ms));
    assert!(options.readings.is_null());

    (options.window_ms, options.deadline_ms) = (1, 100);
    options.readings = c"comms-lost=no-arrow".as_ptr();
    let judge = Handle::new(&raw const options);
    for (t_ns, frame) in recording() {
        judge.frame(t_ns, frame).unwrap();
    }
    let report = judge.finish();
    let readings = Edition::DEFAULT.choices.pin(Choice::CommsNoArrow);
    let expected =
        in_rust(JudgeOptions { window_ms: 1, deadline_ms: 100, readings, ..JudgeOptions::default() });
    agrees(report, std::iter::from_fn(|| judge.next()).collect(), &expected);
    assert_ne!(expected.findings, in_rust(usual).findings, "the options were to make a difference");

    options.readings = c"comms-lost=maybe".as_ptr();
    let mut error = no_error();
    // SAFETY: the pointers are to what they are said to be.
    assert!(unsafe { adsdv_judge_new(&raw const options, &raw mut error) }.is_null());
    assert_eq!(error.status, ADSDV_UNKNOWN_NAME as i32);
    assert!(text(&error.text).starts_with("readings: \"comms-lost=maybe\": no such choice of comms-lost"));
}

/// The recording is of 3.0: by 4.0 its frames are too long, and its handshake is slow enough.
#[test]
fn it_judges_by_the_edition_that_it_is_given() {
    for &edition in Edition::ALL {
        // SAFETY: numbers and a pointer, of which 0 is one.
        let mut options: adsdv_judge_options = unsafe { std::mem::zeroed() };
        // SAFETY: the pointer is to what it is said to be.
        outcome(|error| unsafe { adsdv_judge_options_init(&raw mut options, error) }).unwrap();
        assert_eq!(options.edition, adsdv_edition_default());
        options.edition = number(edition);
        let judge = Handle::new(&raw const options);
        for (t_ns, frame) in recording() {
            judge.frame(t_ns, frame).unwrap();
        }
        let report = judge.finish();
        let found = std::iter::from_fn(|| judge.next()).collect();
        agrees(report, found, &in_rust(JudgeOptions::of(edition)));
    }
    let by_newer = in_rust(JudgeOptions::of(&Edition::V4_0)).findings;
    assert_ne!(by_newer, in_rust(JudgeOptions::default()).findings, "the edition was to make a difference");
}

#[test]
fn an_edition_that_there_is_not_and_readings_that_it_settles_are_refused() {
    let (newer, none) = (number(&Edition::V4_0), adsdv_edition_count());
    let settled = c"fault-trigger=edge";
    for (edition, readings, status, said) in [
        (none, c"", ADSDV_UNKNOWN_EDITION, format!("options.edition is {none}; expected less than {none}")),
        (
            newer,
            settled,
            ADSDV_UNKNOWN_NAME,
            "readings: fault-trigger=edge is no answer in edition 4.0; expected fault-trigger=level"
                .to_owned(),
        ),
    ] {
        let options =
            adsdv_judge_options { window_ms: 30, deadline_ms: 50, edition, readings: readings.as_ptr() };
        let mut error = no_error();
        // SAFETY: the pointers are to what they are said to be.
        assert!(unsafe { adsdv_judge_new(&raw const options, &raw mut error) }.is_null());
        assert_eq!((error.status, text(&error.text)), (status as i32, said));
    }
}

/// A caller who never asks for findings does not fill the memory: a judge keeps a bounded number.
#[test]
fn findings_that_nobody_takes_are_counted_only() {
    let judge = Handle::new(null());
    let (bad, good) = (Frame::new(0x513, &[0xFF, 0x7F]).unwrap(), Frame::new(0x513, &[0; 2]).unwrap());
    for t in 0..5000 {
        judge.frame(t * 20_000_000, bad).unwrap();
        judge.frame(t * 20_000_000 + 10_000_000, good).unwrap();
    }
    let found = std::iter::from_fn(|| judge.next()).count();
    assert!((1..1000).contains(&found), "{found}");
}

#[test]
fn other_frames_are_counted_and_null_is_refused() {
    let judge = Handle::new(null());
    // SAFETY: the pointers are to what they are said to be, or NULL.
    unsafe {
        outcome(|error| adsdv_judge_other_frame(judge.0, 5, error)).unwrap();
        // No data is fine, wherever it is.
        outcome(|error| adsdv_judge_frame(judge.0, 9, 0x7FF, null(), 0, error)).unwrap();
        let refused = outcome(|error| adsdv_judge_frame(judge.0, 9, 0x7FF, null(), 1, error));
        assert_eq!(refused, Err((ADSDV_BAD_POINTER, "data is NULL; expected a pointer".to_owned())));
        let refused = outcome(|error| adsdv_judge_frame(null_mut(), 9, 0x7FF, null(), 0, error));
        assert_eq!(refused, Err((ADSDV_BAD_POINTER, "judge is NULL; expected a pointer".to_owned())));
        outcome(|error| adsdv_judge_finish(judge.0, null_mut(), error)).unwrap();
    }
    assert_eq!(judge.finish().frames, 2);
}
