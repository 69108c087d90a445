//! The arrows of Figure 2, and the alternatives of their guards.
//!
//! What is compared is the table as the edition's possible answers leave it: an alternative that needs an answer which is not
//! possible is not there, and one whose question is settled needs no answer. The requirements that a row cites are left out:
//! they say where `REQUIREMENTS.md` has it, and not what it says.

use adsdv_spec::table::{Priority, Row, Term};
use adsdv_spec::{AsState, Atom, Atoms, Choices, Edition, Reading, Rules};
use serde::Serialize;
use serde_json::{Value, json};

use super::change::{Change, Pairs, Parts, Property, Sides, changes};

/// An arrow that only one of the editions has, or that is compared.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct ArrowOutline {
    /// The state that it leaves.
    pub(super) state: &'static str,
    /// The state that it leads to.
    pub(super) next: &'static str,
    pub(super) section: &'static str,
    pub(super) alternatives: Vec<Alternative>,
}

/// One alternative of a guard.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Alternative {
    /// All of them have to hold.
    pub(super) conditions: Vec<Condition>,
    /// The section of the document that it comes from.
    pub(super) section: &'static str,
    /// The fault that it is reported as, if it says one itself.
    pub(super) reports: Option<&'static str>,
    /// The answers to open questions without which it is not there.
    pub(super) readings: Vec<String>,
}

/// A condition with the value that it must have. The words have the numbers of the edition, which are compared elsewhere.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Condition {
    atom: &'static str,
    value: bool,
    text: String,
}

impl PartialEq for Condition {
    fn eq(&self, other: &Self) -> bool {
        (self.atom, self.value) == (other.atom, other.value)
    }
}

/// What differs of an arrow.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct ArrowChange {
    pub(super) state: &'static str,
    pub(super) next: &'static str,
    /// Its section, and the order of its alternatives.
    pub(super) changes: Vec<Change>,
    pub(super) alternatives: Parts<Alternative, AlternativeChange>,
}

/// What differs of an alternative with the same conditions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct AlternativeChange {
    pub(super) conditions: Vec<Condition>,
    pub(super) changes: Vec<Change>,
}

/// The arrows of a state, by where they end, in another order of evaluation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct OrderChange {
    pub(super) state: &'static str,
    pub(super) from: Vec<&'static str>,
    pub(super) to: Vec<&'static str>,
}

/// An answer that lets an arrow overtake the others of its state.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct PriorityOutline {
    pub(super) choice: String,
    pub(super) state: &'static str,
    pub(super) first: &'static str,
}

/// By what arrows are compared, but for their ends, by which they are the same, and their alternatives.
pub(super) const OF_AN_ARROW: &[Property<ArrowOutline>] = &[Property {
    name: "section",
    fields: &["section"],
    value: |arrow| json!(arrow.section),
    words: |arrow, _| arrow.section.to_owned(),
}];

/// By what alternatives are compared, but for their conditions, by which they are the same.
pub(super) const OF_AN_ALTERNATIVE: &[Property<Alternative>] = &[
    Property {
        name: "section",
        fields: &["section"],
        value: |one| json!(one.section),
        words: |one, _| one.section.to_owned(),
    },
    Property {
        name: "reports",
        fields: &["reports"],
        value: |one| json!(one.reports),
        words: |one, _| one.reports.unwrap_or_default().to_owned(),
    },
    Property {
        name: "readings",
        fields: &["readings"],
        value: |one| json!(one.readings),
        words: |one, _| match one.readings.as_slice() {
            [] => "always".to_owned(),
            readings => format!("if {}", readings.join(" and ")),
        },
    },
];

/// The arrows that are new, gone or changed, and the states whose arrows are evaluated in another order.
pub(super) fn compare(from: &Edition, to: &Edition) -> (Parts<ArrowOutline, ArrowChange>, Vec<OrderChange>) {
    let (from, to) = (arrows(from), arrows(to));
    let pairs = Pairs::of(&from, &to, &[|one, other| one == other, ArrowOutline::is_same]);
    let owned = |all: &[&ArrowOutline]| all.iter().map(|&arrow| arrow.clone()).collect();
    let parts = Parts {
        sides: Sides { new: owned(&pairs.new), gone: owned(&pairs.gone) },
        changed: pairs.both.iter().filter_map(|(from, to)| ArrowChange::between(from, to)).collect(),
    };
    (parts, AsState::ALL.iter().flat_map(|state| OrderChange::of(*state, &from, &to)).collect())
}

/// The priorities that are new or gone.
pub(super) fn priorities(from: &Edition, to: &Edition) -> Sides<PriorityOutline> {
    let outlines = |edition: &Edition| {
        let possible = edition.rules.priorities.iter().filter(|one| edition.choices.has(one.choice));
        possible.map(PriorityOutline::of).collect::<Vec<_>>()
    };
    Sides::of(&outlines(from), &outlines(to))
}

/// The arrows of an edition that have an alternative.
fn arrows(edition: &Edition) -> Vec<ArrowOutline> {
    let settled = settled(edition);
    let arrow = |row: &Row| ArrowOutline {
        state: row.from.name(),
        next: row.to.name(),
        section: row.section,
        alternatives: row
            .terms()
            .iter()
            .filter(|term| term.readings.is_subset(edition.choices))
            .map(|term| Alternative::of(&edition.rules, term, settled))
            .collect(),
    };
    edition.rules.table.rows().iter().map(arrow).filter(|arrow| !arrow.alternatives.is_empty()).collect()
}

/// The only answers to the questions that are settled.
fn settled(edition: &Edition) -> Choices {
    let open = |reading: &Reading| edition.choices.of_reading(*reading).count() > 1;
    let questions = Reading::ALL.iter().filter(|reading| !open(reading));
    questions.flat_map(|&reading| edition.choices.of_reading(reading)).fold(Choices::NONE, Choices::with)
}

impl ArrowOutline {
    fn is_same(&self, other: &Self) -> bool {
        (self.state, self.next) == (other.state, other.next)
    }
}

impl Alternative {
    /// A further field of a term has to be compared before this compiles.
    fn of(rules: &Rules, term: &Term, settled: Choices) -> Self {
        let Term { on, off, readings, fault, section, cites: _ } = *term;
        Self {
            conditions: conditions(rules, on, off),
            section,
            reports: fault.map(adsdv_spec::Fault::flag),
            readings: readings.difference(settled).iter().map(|choice| choice.to_string()).collect(),
        }
    }

    /// The conditions in the words of the figure.
    pub(super) fn words(&self) -> String {
        in_words(&self.conditions)
    }

    /// All of it.
    pub(super) fn in_full(&self) -> String {
        let reports = self.reports.map(|fault| format!(", reports {fault}")).unwrap_or_default();
        let under =
            self.readings.iter().map(|reading| format!(", if {reading}")).collect::<Vec<_>>().concat();
        format!("{} (section {}{reports}{under})", self.words(), self.section)
    }
}

/// Conditions in the words of the figure.
pub(super) fn in_words(conditions: &[Condition]) -> String {
    conditions.iter().map(|condition| condition.text.as_str()).collect::<Vec<_>>().join(" and ")
}

fn conditions(rules: &Rules, on: Atoms, off: Atoms) -> Vec<Condition> {
    let condition = |(atom, value): (Atom, bool)| Condition {
        atom: atom.id(),
        value,
        text: rules.text(atom, value).to_string(),
    };
    on.union(off).iter().map(|atom| condition((atom, on.has(atom)))).collect()
}

impl ArrowChange {
    fn between(from: &ArrowOutline, to: &ArrowOutline) -> Option<Self> {
        let same: &[fn(&Alternative, &Alternative) -> bool] =
            &[|one, other| one == other, |one, other| one.conditions == other.conditions];
        let pairs = Pairs::of(&from.alternatives, &to.alternatives, same);
        let words = |all: &[&Alternative]| all.iter().map(|one| one.words()).collect::<Vec<_>>();
        let order = pairs.order();
        let order = order.iter().filter_map(|(from, to)| order_of(&words(from), &words(to)));
        let owned = |all: &[&Alternative]| all.iter().map(|&one| one.clone()).collect();
        let alternatives = Parts {
            sides: Sides { new: owned(&pairs.new), gone: owned(&pairs.gone) },
            changed: pairs
                .both
                .iter()
                .filter_map(|(from, to)| AlternativeChange::between(from, to))
                .collect(),
        };
        let changes: Vec<_> = changes(OF_AN_ARROW, from, to).into_iter().chain(order).collect();
        let differs = !changes.is_empty() || !alternatives.is_empty();
        differs.then_some(Self { state: to.state, next: to.next, changes, alternatives })
    }
}

/// The order of alternatives, of which the first that holds says what is reported.
fn order_of(from: &[String], to: &[String]) -> Option<Change> {
    let side = |words: &[String]| (words.iter().map(|one| json!(one)).collect::<Value>(), words.join(", "));
    Change::of("order", side(from), side(to))
}

impl AlternativeChange {
    fn between(from: &Alternative, to: &Alternative) -> Option<Self> {
        let changes = changes(OF_AN_ALTERNATIVE, from, to);
        (!changes.is_empty()).then(|| Self { conditions: to.conditions.clone(), changes })
    }
}

impl OrderChange {
    fn of(state: AsState, from: &[ArrowOutline], to: &[ArrowOutline]) -> Vec<Self> {
        let leaving = |arrows: &[ArrowOutline]| {
            arrows
                .iter()
                .filter(|arrow| arrow.state == state.name())
                .map(|arrow| arrow.next)
                .collect::<Vec<_>>()
        };
        let (from, to) = (leaving(from), leaving(to));
        let names = |all: &[&&'static str]| all.iter().map(|&&name| name).collect();
        let runs = Pairs::of(&from, &to, &[|one, other| one == other]).order();
        runs.iter().map(|(from, to)| Self { state: state.name(), from: names(from), to: names(to) }).collect()
    }
}

impl PriorityOutline {
    /// A further field of a priority has to be compared before this compiles.
    fn of(priority: &Priority) -> Self {
        let Priority { choice, from, first } = *priority;
        Self { choice: choice.to_string(), state: from.name(), first: first.name() }
    }
}
