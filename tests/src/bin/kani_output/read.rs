//! The text, as the harnesses that it is about.

use std::collections::BTreeMap;

/// What Kani has printed of one harness.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Harness {
    /// Its name, such as `codec::ai::ai2vcu_brake_514h`.
    pub(crate) name: String,
    pub(crate) verdict: Outcome,
    /// How long it took, where Kani says so.
    pub(crate) seconds: Option<f64>,
    /// Each interesting case, and whether it is reached.
    pub(crate) cases: BTreeMap<Case, bool>,
}

/// What came out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Nothing: the run ended before.
    #[default]
    Missing,
    /// It holds.
    Verified,
    /// These checks failed.
    Refuted(Vec<String>),
    /// It failed without a check that does: out of time or of memory.
    Undecided,
}

/// An interesting case. Several checks may be about one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Case {
    /// The file, line and column, and the function.
    pub(crate) place: String,
    /// What is to be seen there.
    pub(crate) description: String,
}

/// A check that is being read: four lines.
#[derive(Default)]
struct Check<'a> {
    is_cover: bool,
    status: &'a str,
    description: &'a str,
}

/// All harnesses, in the order in which they were checked.
pub(crate) fn harnesses(text: &str) -> Vec<Harness> {
    let mut all: Vec<Harness> = Vec::new();
    let mut check = Check::default();
    for line in text.lines() {
        let line = line.trim();
        if let Some(rest) = line.strip_prefix("Checking harness ") {
            check = Check::default();
            all.push(Harness { name: rest.trim_end_matches('.').to_owned(), ..Harness::default() });
            continue;
        }
        let Some(harness) = all.last_mut() else { continue };
        if let Some(rest) = line.strip_prefix("Check ") {
            // Its name is that of the function and what is checked, such as `.cover.1` or `.assertion.3`.
            let mut name = rest.rsplit('.');
            let is_numbered = name.next().is_some_and(|number| number.parse::<u32>().is_ok());
            check = Check { is_cover: is_numbered && name.next() == Some("cover"), ..Check::default() };
        } else if let Some(status) = line.strip_prefix("- Status: ") {
            check.status = status;
        } else if let Some(description) = line.strip_prefix("- Description: ") {
            check.description = description.trim_matches('"');
        } else if let Some(place) = line.strip_prefix("- Location: ")
            && check.is_cover
        {
            let Check { status, description, .. } = std::mem::take(&mut check);
            let case = Case { place: place.to_owned(), description: description.to_owned() };
            *harness.cases.entry(case).or_default() |= status == "SATISFIED";
        } else if let Some(failed) = line.strip_prefix("Failed Checks: ") {
            match &mut harness.verdict {
                Outcome::Refuted(checks) => checks.push(failed.to_owned()),
                verdict => *verdict = Outcome::Refuted(vec![failed.to_owned()]),
            }
        } else if let Some(verdict) = line.strip_prefix("VERIFICATION:- ") {
            match (verdict, &harness.verdict) {
                (verdict, _) if verdict.starts_with("SUCCESSFUL") => harness.verdict = Outcome::Verified,
                (_, Outcome::Refuted(_)) => {}
                _ => harness.verdict = Outcome::Undecided,
            }
        } else if let Some(time) = line.strip_prefix("Verification Time: ") {
            harness.seconds = time.trim_end_matches('s').parse().ok();
        }
    }
    all
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{Case, Harness, Outcome, harnesses};

    /// As Kani 0.57 prints it: a condition of two parts, one of which cannot be on its own.
    pub(crate) const VERIFIED: &str = include_str!("recorded/verified.txt");
    /// A case in a function that is inlined twice.
    pub(crate) const INLINED: &str = include_str!("recorded/inlined.txt");
    /// A case that cannot be reached, though the theorem is verified.
    pub(crate) const UNREACHED: &str = include_str!("recorded/unreached.txt");
    /// A theorem that does not hold.
    pub(crate) const REFUTED: &str = include_str!("recorded/refuted.txt");
    /// A theorem without an answer, and the end of the run.
    pub(crate) const NO_ANSWER: &str = include_str!("recorded/no-answer.txt");
    /// The terse format of several threads, which has no checks.
    pub(crate) const TERSE: &str = include_str!("recorded/terse.txt");

    fn only(text: &str) -> Harness {
        let all = harnesses(text);
        assert_eq!(all.len(), 1, "{all:#?}");
        all.into_iter().next().expect("one")
    }

    fn cases(harness: &Harness) -> Vec<(&str, &str, bool)> {
        harness
            .cases
            .iter()
            .map(|(Case { place, description }, &reached)| (place.as_str(), description.as_str(), reached))
            .collect()
    }

    #[test]
    fn a_case_of_several_checks_is_reached_if_one_of_them_is_satisfied() {
        let harness = only(VERIFIED);
        assert_eq!(harness.name, "codec::ai::ai2vcu_brake_514h");
        assert_eq!(harness.verdict, Outcome::Verified);
        assert_eq!(harness.seconds, Some(2.667_361_3));
        let at = "in function codec::ai::ai2vcu_brake_514h";
        assert_eq!(
            cases(&harness),
            [
                (&*format!("proofs/src/codec/ai.rs:100:5 {at}"), "too much at the rear", true),
                (&*format!("proofs/src/codec/ai.rs:99:5 {at}"), "too much at the front", true),
            ]
        );
    }

    #[test]
    fn a_case_that_is_inlined_twice_is_reached_if_it_is_at_one_of_the_places() {
        let harness = only(INLINED);
        let reached: Vec<_> = cases(&harness).into_iter().map(|(_, what, reached)| (what, reached)).collect();
        assert_eq!(reached, [("the end is missing", true)]);
    }

    #[test]
    fn a_case_is_not_reached_by_another_of_the_same_words() {
        let harness = only(UNREACHED);
        assert_eq!(harness.verdict, Outcome::Verified);
        let reached: Vec<_> = cases(&harness).into_iter().map(|(_, what, reached)| (what, reached)).collect();
        assert_eq!(reached, [("lost", true), ("lost", false), ("never looked at", false)]);
    }

    #[test]
    fn what_fails_is_refuted_or_has_no_answer() {
        let refuted = only(REFUTED);
        assert_eq!(refuted.verdict, Outcome::Refuted(vec!["\"the condition leads there\"".to_owned()]));
        let none = only(NO_ANSWER);
        assert_eq!((none.verdict, none.seconds), (Outcome::Undecided, None));
        assert_eq!(only("Checking harness time::cut_off...\nCheck 1: x").verdict, Outcome::Missing);
    }

    #[test]
    fn the_terse_format_has_no_harness_that_could_be_read() {
        assert_eq!(harnesses(TERSE), []);
        assert_eq!(harnesses(""), []);
    }
}
