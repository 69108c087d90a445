//! What was passed, failed and not checked, requirement by requirement.

use std::collections::BTreeMap;

use adsdv_oracle::requirements::{is_decision, is_of_a_reading, order};
use adsdv_spec::Edition;

use super::about::shows;
use super::blame::WrongAnswers;
use super::keys::Keys;
use crate::suite::Test;

/// A requirement that tests name, or that something wrong breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// As `spec/REQUIREMENTS.md` numbers it, such as `RDY-5`.
    pub id: String,
    /// What came of it.
    pub outcome: Outcome,
    /// How many tests name it.
    pub tests: usize,
    /// How many of them checked it: they were run, what it is about was shown, and the state did not go wrong before.
    pub checked: usize,
    /// The tests that break it, whether they name it or not, and the first random scenario that does.
    pub failed: Vec<String>,
}

impl Requirement {
    fn new(id: &str) -> Self {
        let (id, outcome) = (id.to_owned(), Outcome::NotChecked);
        Self { id, outcome, tests: 0, checked: 0, failed: Vec::new() }
    }
}

/// What came of a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Tests checked it, and nothing breaks it.
    Pass,
    /// Something breaks it: an output that it is about is wrong.
    Fail,
    /// The program does otherwise than we decided, where the document is silent.
    Differs,
    /// No test checked it: the program does not show all that it is about, or cannot be asked for it.
    NotChecked,
}

impl Outcome {
    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Differs => "differs",
            Self::NotChecked => "not checked",
        }
    }
}

/// What came of a test that was run.
#[derive(Debug, Default)]
pub(super) struct Ran {
    /// The outputs that all of its answers show.
    pub(super) shown: Keys,
    /// What is wrong, if anything is, and the requirements that are broken by that.
    pub(super) wrong: Option<(WrongAnswers, Vec<String>)>,
}

impl Ran {
    /// Whether the test showed anything of a requirement that it names.
    fn checks(&self, id: &str, edition: &Edition) -> bool {
        let is_shown = || self.shown.has_all(shows(id).and(Keys::of_edition(edition)));
        match &self.wrong {
            Some((_, broken)) if broken.iter().any(|other| other == id) => true,
            // It is about what follows a wrong state, of which the test says nothing.
            Some((wrong, _)) if wrong.loses_the_state => false,
            _ => is_shown(),
        }
    }
}

/// What came of each test: what was shown in those that were run, by their places, and what is wrong in some of them.
pub(super) fn ran(
    tests: &[Test],
    shown: impl Iterator<Item = (usize, Keys)>,
    broken: Vec<(usize, WrongAnswers, Vec<String>)>,
) -> Vec<Option<Ran>> {
    let mut ran: Vec<Option<Ran>> = tests.iter().map(|_| None).collect();
    for (place, shown) in shown {
        if let Some(slot) = ran.get_mut(place) {
            *slot = Some(Ran { shown, wrong: None });
        }
    }
    for (place, wrong, broken) in broken {
        if let Some(Some(ran)) = ran.get_mut(place) {
            ran.wrong = Some((wrong, broken));
        }
    }
    ran
}

/// The requirements that tests name, and those that are broken besides, in the order of the document.
///
/// `ran` tells what came of each test, if it was run; `random` names the first random scenario that breaks a requirement. Where it
/// is `strict`, a decision of ours fails as the document's requirements do.
pub(super) fn table(
    (edition, strict): (&Edition, bool),
    tests: &[Test],
    ran: &[Option<Ran>],
    random: &[(String, String)],
) -> Vec<Requirement> {
    let mut found: BTreeMap<&str, Requirement> = BTreeMap::new();
    for (test, ran) in tests.iter().zip(ran) {
        for id in test.requirements.iter().filter(|id| !is_of_a_reading(edition, id)) {
            let requirement = found.entry(id).or_insert_with(|| Requirement::new(id));
            requirement.tests += 1;
            requirement.checked += usize::from(ran.as_ref().is_some_and(|ran| ran.checks(id, edition)));
        }
        for id in ran.iter().filter_map(|ran| ran.wrong.as_ref()).flat_map(|(_, broken)| broken) {
            if !is_of_a_reading(edition, id) {
                found.entry(id).or_insert_with(|| Requirement::new(id)).failed.push(test.name.clone());
            }
        }
    }
    for (id, name) in random.iter().filter(|(id, _)| !is_of_a_reading(edition, id)) {
        found.entry(id).or_insert_with(|| Requirement::new(id)).failed.push(name.clone());
    }
    let mut found: Vec<Requirement> = found.into_values().collect();
    for requirement in &mut found {
        requirement.outcome = match (requirement.failed.is_empty(), requirement.checked) {
            (false, _) if !strict && is_decision(&requirement.id) => Outcome::Differs,
            (false, _) => Outcome::Fail,
            (true, 0) => Outcome::NotChecked,
            (true, _) => Outcome::Pass,
        };
    }
    found.sort_by_key(|requirement| order(&requirement.id));
    found
}
