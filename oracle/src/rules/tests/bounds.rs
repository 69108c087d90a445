//! What each form comes to, to the nanosecond.

use adsdv_spec::Truth::{self, False, True, Unknown};

use super::super::limits::OPEN;
use super::super::syntax::Form;
use super::super::track::{RuleOutcome, Track};
use RuleOutcome::{Broken, Ended, Held, Unknown as NotKnown};

/// What the rule makes of a recording of these steps that ends then.
pub(super) fn outcomes(form: &Form<()>, steps: &[(i64, [Truth; 3])], end: i64) -> Vec<RuleOutcome> {
    let (mut track, mut out) = (Track::of(form), Vec::new());
    for &(t, truths) in steps {
        track.pass(t, &mut |outcome| out.push(outcome));
        track.step(t, truths, &mut |outcome| out.push(outcome));
    }
    track.pass(end, &mut |outcome| out.push(outcome));
    track.end(end, &mut |outcome| out.push(outcome));
    out
}

/// Of a form with one predicate.
fn one(form: &Form<()>, steps: &[(i64, Truth)], end: i64) -> Vec<RuleOutcome> {
    let steps: Vec<_> = steps.iter().map(|&(t, truth)| (t, [truth, Unknown, Unknown])).collect();
    outcomes(form, &steps, end)
}

/// Of a form with two.
fn two(form: &Form<()>, steps: &[(i64, Truth, Truth)], end: i64) -> Vec<RuleOutcome> {
    let steps: Vec<_> = steps.iter().map(|&(t, first, second)| (t, [first, second, Unknown])).collect();
    outcomes(form, &steps, end)
}

#[test]
fn always_and_never_are_broken_where_it_begins() {
    let steps = [(0, Unknown), (5, True), (6, Unknown), (7, False), (8, Unknown), (9, False), (10, True)];
    assert_eq!(one(&Form::Always(()), &steps, 20), [Held, Broken(7), Held]);
    assert_eq!(one(&Form::Never(()), &steps, 20), [Broken(5), Held, Broken(10)]);
    assert_eq!(one(&Form::Never(()), &[(0, Unknown)], 20), []);
}

#[test]
fn what_lasts_as_long_as_it_may_is_in_time() {
    let form = Form::AtMost((), 100);
    let run = |from, to| one(&form, &[(0, False), (from, True), (to, False)], 500);
    assert_eq!(run(10, 110), [Held]);
    assert_eq!(run(10, 111), [Broken(110)]);
    // It ends with the recording.
    assert_eq!(one(&form, &[(0, False), (10, True)], 110), [Ended]);
    assert_eq!(one(&form, &[(0, False), (10, True)], 111), [Broken(110)]);
    // It may have begun before the recording did.
    assert_eq!(one(&form, &[(0, True), (50, False)], 500), [NotKnown]);
    assert_eq!(one(&form, &[(0, True), (101, False)], 500), [Broken(100)]);
}

#[test]
fn what_may_have_lasted_longer_is_not_decided() {
    let form = Form::AtMost((), 100);
    let about = |unknown, from, to, back| {
        one(&form, &[(0, False), (unknown, Unknown), (from, True), (to, Unknown), (back, False)], 500)
    };
    assert_eq!(about(10, 40, 60, 110), [Held], "even all of it is in time");
    assert_eq!(about(10, 40, 60, 111), [NotKnown]);
    assert_eq!(about(10, 40, 140, 200), [NotKnown]);
    assert_eq!(about(10, 40, 141, 200), [Broken(140)], "what is certain of it is too long");
    // Two times that may be one are no breach, and once it is one, it is reported once.
    let broken =
        [(0, False), (10, True), (100, Unknown), (101, True), (202, Unknown), (203, True), (400, False)];
    assert_eq!(one(&form, &broken, 500), [Broken(201)]);
    assert_eq!(one(&form, &[(0, False), (10, Unknown), (400, False)], 500), [], "it may never have begun");
}

#[test]
fn within_counts_its_last_moment() {
    let form = Form::Within((), (), 100);
    let answered = |t| two(&form, &[(0, False, False), (10, True, False), (t, True, True)], 500);
    assert_eq!(answered(10), [Held]);
    assert_eq!(answered(110), [Held]);
    assert_eq!(answered(111), [Broken(110)]);
    assert_eq!(two(&form, &[(0, False, True), (10, True, True)], 500), [Held], "it was so already");
}

#[test]
fn within_that_the_recording_ends_in_is_not_decided() {
    let form = Form::Within((), (), 100);
    let steps = [(0, False, False), (10, True, False)];
    assert_eq!(two(&form, &steps, 109), [Ended]);
    assert_eq!(two(&form, &steps, 110), [Broken(110)]);
}

#[test]
fn what_was_unknown_meanwhile_is_not_decided() {
    let form = Form::Within((), (), 100);
    let steps = [(0, False, False), (10, True, False), (50, True, Unknown), (51, True, False)];
    assert_eq!(two(&form, &steps, 500), [NotKnown]);
    let steps = [(0, False, False), (10, True, Unknown), (50, True, True)];
    assert_eq!(two(&form, &steps, 500), [Held], "it came, whatever was before");
}

#[test]
fn each_time_that_the_premise_becomes_true_counts() {
    let form = Form::Within((), (), 100);
    let steps = [
        (0, True, False), // it did not become so
        (10, False, False),
        (20, True, False),
        (30, False, False),
        (40, True, False),
        (130, False, True), // too late for the first, in time for the second
        (140, Unknown, False),
        (150, Unknown, False),
    ];
    assert_eq!(two(&form, &steps, 500), [Broken(120), Held]);
}

#[test]
fn a_premise_that_was_unknown_became_true_some_time() {
    let form = Form::Within((), (), 100);
    let premise = |answer| {
        two(&form, &[(0, False, False), (10, Unknown, False), (60, True, False), (answer, True, True)], 500)
    };
    assert_eq!(premise(110), [Held], "in time from the first moment that it may have been");
    assert_eq!(premise(111), [NotKnown]);
    assert_eq!(premise(160), [NotKnown]);
    assert_eq!(premise(161), [Broken(160)], "too late even from the last");
    let steps = [(0, False, False), (10, Unknown, True), (20, Unknown, False), (60, True, False)];
    assert_eq!(two(&form, &steps, 500), [NotKnown], "it may have been answered already");
    let steps = [(0, False, True), (10, Unknown, False), (60, True, False)];
    assert_eq!(two(&form, &steps, 500), [Broken(160)], "what was before it may have begun is no answer");
    let steps = [(0, True, False), (10, Unknown, False), (60, True, False)];
    assert_eq!(two(&form, &steps, 500), [], "it may have been so all the time");
}

#[test]
fn for_counts_its_last_moment() {
    let form = Form::Throughout((), (), 100);
    let until = |t| two(&form, &[(0, False, False), (10, True, True), (t, True, False)], 500);
    assert_eq!(until(110), [Broken(110)]);
    assert_eq!(until(111), [Held]);
    assert_eq!(two(&form, &[(0, False, False), (10, True, False)], 500), [Broken(10)]);
    let steps = [(0, False, True), (10, True, True)];
    assert_eq!(two(&form, &steps, 109), [Ended]);
    assert_eq!(two(&form, &steps, 110), [Held]);
    let steps = [(0, False, True), (10, True, True), (50, True, Unknown), (51, True, True)];
    assert_eq!(two(&form, &steps, 500), [NotKnown]);
    let steps = [(0, False, True), (10, True, Unknown), (50, True, False)];
    assert_eq!(two(&form, &steps, 500), [Broken(50)], "broken, whatever was before");
    let steps = [(0, False, True), (10, Unknown, True), (60, True, True), (111, True, False)];
    assert_eq!(two(&form, &steps, 500), [NotKnown], "over already, if it began at once");
}

#[test]
fn until_is_kept_up_to_its_end() {
    let form = Form::Until(Some(()), (), (), Some(100));
    let run = |steps: &[(i64, Truth, Truth)], end| {
        let first = [(0, [False, False, False]), (10, [True, True, False])];
        let steps = steps.iter().map(|&(t, kept, end)| (t, [True, kept, end]));
        outcomes(&form, &first.into_iter().chain(steps).collect::<Vec<_>>(), end)
    };
    assert_eq!(run(&[(110, False, True)], 500), [Held], "at its end it need not be so any more");
    assert_eq!(run(&[(111, True, True)], 500), [Broken(110)]);
    assert_eq!(run(&[(50, False, False)], 500), [Broken(50)]);
    assert_eq!(run(&[(50, Unknown, False), (51, True, False), (60, True, True)], 500), [NotKnown]);
    assert_eq!(
        run(&[(50, Unknown, False), (51, False, False)], 500),
        [Broken(51)],
        "broken, whatever was before"
    );
    assert_eq!(run(&[(50, True, Unknown), (51, False, False)], 500), [NotKnown], "it may have ended before");
    assert_eq!(run(&[(50, True, Unknown), (51, True, False)], 500), [NotKnown], "and so at the bound");
    assert_eq!(run(&[(50, True, Unknown), (51, True, True)], 500), [Held]);
    assert_eq!(run(&[(50, False, Unknown)], 500), [NotKnown]);
    assert_eq!(run(&[], 109), [Ended]);
    assert_eq!(run(&[], 110), [Broken(110)]);
    let unknown = [(0, [False, True, False]), (10, [Unknown, True, False]), (60, [True, True, False])];
    let ends = |t| outcomes(&form, &[&unknown[..], &[(t, [True, True, True])]].concat(), 500);
    assert_eq!([ends(110), ends(111), ends(161)], [[Held], [NotKnown], [Broken(160)]]);
}

#[test]
fn until_without_a_bound_waits() {
    let form = Form::Until(Some(()), (), (), None);
    let first = [(0, [False, False, False]), (10, [True, True, False])];
    assert_eq!(outcomes(&form, &first, 1 << 60), [Ended]);
    let ends = [&first[..], &[(1 << 60, [False, False, True])]].concat();
    assert_eq!(outcomes(&form, &ends, 1 << 61), [Held]);
}

#[test]
fn until_without_a_premise_begins_when_it_is_known() {
    let form = Form::Until(None, (), (), None);
    let run = |steps: &[(i64, Truth, Truth)]| two(&form, steps, 500);
    assert_eq!(
        run(&[(0, Unknown, Unknown), (5, True, Unknown), (6, True, False), (9, False, False)]),
        [Broken(9)]
    );
    assert_eq!(run(&[(0, Unknown, False), (6, True, False), (9, False, True), (10, False, False)]), [Held]);
    assert_eq!(run(&[(0, Unknown, True), (6, False, False)]), [Held]);
    assert_eq!(run(&[(0, True, False)]), [Ended]);
    assert_eq!(run(&[(0, True, Unknown)]), []);
}

#[test]
fn what_cannot_be_followed_is_not_decided() {
    let open = i64::try_from(OPEN).expect("few");
    for form in [Form::Within((), (), 1 << 40), Form::Until(Some(()), (), (), Some(1 << 40))] {
        let edges = (0..=open).flat_map(|n| [(2 * n, [False; 3]), (2 * n + 1, [True, True, False])]);
        let kept = if matches!(form, Form::Within(..)) { False } else { True };
        let edges = edges.map(|(t, [premise, _, end])| (t, [premise, kept, end]));
        let outcomes = outcomes(&form, &edges.collect::<Vec<_>>(), 1 << 50);
        assert_eq!(outcomes.iter().filter(|one| **one == NotKnown).count(), 1);
        assert_eq!(outcomes.len(), OPEN + 1);
    }
}
