//! Which combination of readings the answers follow, and which readings they mix.

use adsdv_spec::{Choice, Edition, Reading, Readings};

use super::explain::Explain;
use super::set::Set;

/// What is known of how a program answers a question that the document leaves open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Follows {
    /// The question.
    pub reading: Reading,
    /// The answers that are still possible. One: it follows that. Several: what was run does not tell. None: it mixes.
    pub possible: Vec<Choice>,
    /// Each choice that some tests need, if others need another one.
    pub mixes: Vec<Side>,
}

/// Tests that need one choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Side {
    /// The choice without which their answers are wrong.
    pub choice: Choice,
    /// Their names.
    pub tests: Vec<String>,
}

/// Which combination explains the most tests, and how many: all of their answers, and then, lest one wrong output hide which
/// readings are followed, at least the states in them. Of several, the one with the fewest choices that are no default.
pub(super) fn best<'a>(
    explain: &Explain,
    all: impl Iterator<Item = &'a Set>,
    states: impl Iterator<Item = &'a Set>,
) -> (usize, (usize, usize)) {
    let count = |explained: &mut dyn Iterator<Item = &'a Set>| {
        let mut counts = vec![0_usize; explain.readings().len()];
        for member in explained.flat_map(Set::iter) {
            if let Some(count) = counts.get_mut(member) {
                *count += 1;
            }
        }
        counts
    };
    let (mut all, mut states) = (all, states);
    let counts = count(&mut all).into_iter().zip(count(&mut states));
    let best = counts.zip(explain.readings()).enumerate().max_by_key(|(place, (counts, readings))| {
        (*counts, std::cmp::Reverse(explain.unusual(readings)), std::cmp::Reverse(*place))
    });
    best.map_or((0, (0, 0)), |(place, (counts, _))| (place, counts))
}

/// The combinations that explain everything.
pub(super) fn all(explain: &Explain, explained: &[Set]) -> Set {
    explained.iter().fold(explain.all(), |all, set| all.and(set))
}

/// How each question is answered by these combinations.
pub(super) fn follows(edition: &Edition, readings: &[Readings]) -> Vec<Follows> {
    let possible = |reading: Reading| {
        let made = |choice: &Choice| readings.iter().any(|readings| readings.is(*choice));
        reading.choices().iter().copied().filter(made).collect()
    };
    let one = |reading| Follows { reading, possible: possible(reading), mixes: Vec::new() };
    edition.questions().map(one).collect()
}

/// How each question is answered where no combination explains everything: a question of which some tests need one
/// choice and others need another is mixed; of every other, the choices that none of the tests rules out that any
/// combination explains. Tests that are known to be `wrong` whatever the readings say nothing of them.
pub(super) fn mixes(
    edition: &Edition,
    explain: &Explain,
    names: &[String],
    explained: &[Set],
    wrong: &[String],
) -> Vec<Follows> {
    let one = |reading: Reading| {
        let with = |choice: Choice| {
            let mut set = explain.none();
            let members = explain.readings().iter().enumerate().filter(|(_, readings)| readings.is(choice));
            members.for_each(|(place, _)| set.insert(place));
            (choice, set)
        };
        let choices = reading.choices().iter().map(|&choice| with(choice));
        let choices: Vec<(Choice, Set)> = choices.filter(|(_, set)| !set.is_empty()).collect();
        let mut sides: Vec<Side> =
            choices.iter().map(|(choice, _)| Side { choice: *choice, tests: Vec::new() }).collect();
        let mut possible: Vec<Choice> = choices.iter().map(|(choice, _)| *choice).collect();
        let telling =
            names.iter().zip(explained).filter(|(name, set)| !set.is_empty() && !wrong.contains(name));
        for (name, set) in telling {
            let allowed: Vec<Choice> =
                choices.iter().filter(|(_, with)| with.meets(set)).map(|(choice, _)| *choice).collect();
            possible.retain(|choice| allowed.contains(choice));
            if let [only] = allowed.as_slice()
                && let Some(side) = sides.iter_mut().find(|side| side.choice == *only)
            {
                side.tests.push(name.clone());
            }
        }
        sides.retain(|side| !side.tests.is_empty());
        if sides.len() < 2 {
            sides.clear();
        }
        Follows { reading, possible, mixes: sides }
    };
    edition.questions().map(one).collect()
}
