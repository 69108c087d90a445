//! A team's own rules through the C interface: what breaks them is found, what became of them is reported, and what is wrong with
//! them is said with its place.
#![cfg(feature = "judge")]

mod common;

use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

use adsdv::adsdv_status::*;
use adsdv::*;
use adsdv_oracle::judge::{Judge, JudgeOptions};
use adsdv_spec::Edition;
use adsdv_tests::world::World;
use common::{no_error, number, outcome, text};

/// Some that hold, some that are broken, and one of which nothing can be said.
const RULES: &str = "# ours\n\
                     calm: never AS_STATE is AS_READY \"it stays off\"\n\
                     on: after ASMS on, AS_STATE is AS_READY within 1 s\n\
                     end: after AS_STATE is AS_FINISHED, ASMS off within 5 s\n";

/// A judge that is freed.
struct Handle(*mut adsdv_judge);

impl Handle {
    fn of(edition: &Edition) -> Self {
        let options = adsdv_judge_options {
            window_ms: 30,
            deadline_ms: 50,
            edition: number(edition),
            readings: null(),
        };
        let mut error = no_error();
        // SAFETY: the pointers are to what they are said to be.
        let judge = unsafe { adsdv_judge_new(&raw const options, &raw mut error) };
        assert!(!judge.is_null(), "{}", text(&error.text));
        Self(judge)
    }

    /// Follows rules; what is wrong with them, with its place.
    fn follow(&self, rules: &str) -> Result<(), (adsdv_status, adsdv_rule_place, String)> {
        let (rules, mut place) = (CString::new(rules).expect("no NUL"), adsdv_rule_place::default());
        // SAFETY: the pointers are to what they are said to be.
        let outcome =
            outcome(|error| unsafe { adsdv_judge_follow(self.0, rules.as_ptr(), &raw mut place, error) });
        outcome.map_err(|(status, text)| (status, place, text))
    }

    /// Sees a run to AS_READY.
    fn sees_a_run(&self) {
        for (t_ns, id, data) in run() {
            // SAFETY: the pointers are to what they are said to be.
            outcome(|error| unsafe { adsdv_judge_frame(self.0, t_ns, id, data.as_ptr(), data.len(), error) })
                .expect("it takes frames");
        }
    }

    fn finish(&self) -> adsdv_report {
        let mut report = adsdv_report::default();
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_judge_finish(self.0, &raw mut report, error) }).expect("it ends");
        report
    }

    /// The findings of rules, as they are said.
    fn broken(&self) -> Vec<(String, String)> {
        // SAFETY: numbers and a pointer, of which 0 is one.
        let mut finding: adsdv_finding = unsafe { std::mem::zeroed() };
        let mut all = Vec::new();
        // SAFETY: the pointers are to what they are said to be.
        while unsafe { adsdv_judge_next(self.0, &raw mut finding) } {
            if text(&finding.party) == "OWN" {
                all.push((text(&finding.section), said(finding.message)));
            }
        }
        all
    }

    /// What became of a rule.
    fn rule(&self, index: usize) -> Option<String> {
        // SAFETY: numbers and pointers, of which 0 is one.
        let mut rule: adsdv_rule_report = unsafe { std::mem::zeroed() };
        // SAFETY: the pointers are to what they are said to be.
        unsafe { adsdv_judge_rule(self.0, index, &raw mut rule) }.then(|| {
            let (name, asks, why) = (said(rule.name), said(rule.rule), said(rule.why));
            let verdict = [
                adsdv_rule_verdict::ADSDV_RULE_HOLDS,
                adsdv_rule_verdict::ADSDV_RULE_BROKEN,
                adsdv_rule_verdict::ADSDV_RULE_UNDECIDED,
            ][usize::from(rule.verdict)];
            let (line, counts) = (rule.line, [rule.held, rule.broken, rule.undecided]);
            format!("{line} {name}: {asks}: {verdict:?} {} {counts:?} {why}", text(&rule.verdict_name))
        })
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: it is a judge that was not freed yet.
        unsafe { adsdv_judge_free(self.0) };
    }
}

/// A text of the judge's.
fn said(text: *const c_char) -> String {
    // SAFETY: the judge's texts end with a NUL, and stay until the next call.
    unsafe { CStr::from_ptr(text) }.to_str().expect("UTF-8").to_owned()
}

/// A run to AS_READY, frame by frame.
fn run() -> Vec<(i64, u32, Vec<u8>)> {
    let mut world = World::reference();
    world.ready();
    world.log.iter().map(|one| (one.t, one.frame.id.into(), one.frame.data().to_vec())).collect()
}

#[test]
fn what_breaks_a_rule_is_found_and_what_became_of_each_is_reported() {
    let judge = Handle::of(&Edition::V3_0);
    judge.follow(RULES).expect("they are right");
    judge.sees_a_run();
    assert_eq!(judge.rule(0), None, "not before the end");
    assert_eq!(judge.finish().violations, 1);
    let calm = "calm (it stays off): AS_STATE is AS_READY; expected never AS_STATE is AS_READY";
    assert_eq!(judge.broken(), [("line 2".to_owned(), calm.to_owned())]);
    assert_eq!(
        [0, 1, 2, 3].map(|index| judge.rule(index)),
        [
            Some(
                "2 calm: never AS_STATE is AS_READY: ADSDV_RULE_BROKEN broken [1, 1, 0] "
                    .to_owned()
            ),
            Some(
                "3 on: after ASMS on, AS_STATE is AS_READY within 1 s: ADSDV_RULE_HOLDS holds [1, 0, 0] "
                    .to_owned()
            ),
            Some(
                "4 end: after AS_STATE is AS_FINISHED, ASMS off within 5 s: ADSDV_RULE_UNDECIDED never decided \
                 [0, 0, 0] what it waits for never came"
                    .to_owned()
            ),
            None,
        ]
    );
}

#[test]
fn it_says_of_rules_what_the_judge_says() {
    let judge = Handle::of(&Edition::V3_0);
    judge.follow(RULES).expect("they are right");
    judge.sees_a_run();
    judge.finish();
    let mut in_rust = Judge::new(JudgeOptions::default());
    in_rust.follow(&RULES.parse().expect("they are right")).expect("3.0 has all");
    for (t_ns, id, data) in run() {
        in_rust.frame(t_ns, id, &data);
    }
    let rules = in_rust.finish().rules;
    for (index, rule) in rules.iter().enumerate() {
        let reported = judge.rule(index).expect("as many");
        let counts = format!("{:?}", [rule.held, rule.broken, rule.undecided]);
        assert!(reported.contains(&rule.name) && reported.contains(&counts), "{reported}");
    }
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let judge = Handle::of(&Edition::V3_0);
    let (status, place, text) = judge.follow("# ours\nsafe: never sped > 5").expect_err("sped");
    assert_eq!((status, place), (ADSDV_BAD_RULES, adsdv_rule_place { line: 2, column: 13, width: 4 }));
    assert!(text.starts_with("rules, line 2, column 13: found \"sped\""), "{text}");
    let newer = "stage: never EBS_STATE is EBS_FAULT";
    let (status, place, text) = judge.follow(newer).expect_err("it is of 2026");
    assert_eq!((status, place.line, place.column), (ADSDV_BAD_RULES, 1, 14));
    assert!(text.contains("edition 3.0 has no such signal"), "{text}");
    Handle::of(&Edition::V2026).follow(newer).expect("2026 has it");
    assert_eq!(judge.finish().violations, 0, "what is refused is not followed");
    assert_eq!(judge.rule(0), None);
}

#[test]
fn pointers_that_are_null_are_refused_or_left_alone() {
    let judge = Handle::of(&Edition::V3_0);
    // SAFETY: the pointers are NULL, or to what they are said to be.
    unsafe {
        let refused = outcome(|error| adsdv_judge_follow(judge.0, null(), null_mut(), error));
        assert_eq!(refused, Err((ADSDV_BAD_POINTER, "rules is NULL; expected a pointer".to_owned())));
        let refused = outcome(|error| adsdv_judge_follow(null_mut(), c"".as_ptr(), null_mut(), error));
        assert_eq!(refused, Err((ADSDV_BAD_POINTER, "judge is NULL; expected a pointer".to_owned())));
        assert_eq!(adsdv_judge_follow(judge.0, c"?".as_ptr(), null_mut(), null_mut()), ADSDV_BAD_RULES);
        assert!(!adsdv_judge_rule(judge.0, 0, null_mut()));
    }
}

#[test]
fn a_judge_that_has_finished_follows_nothing() {
    let judge = Handle::of(&Edition::V3_0);
    judge.finish();
    let (status, _, text) = judge.follow("calm: never ASMS on").expect_err("it has finished");
    assert_eq!(
        (status, text.as_str()),
        (ADSDV_FINISHED, "the judge has finished; expected a new one for more frames")
    );
}
