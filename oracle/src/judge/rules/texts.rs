//! What is said of guards, in the words of Figure 2.

use adsdv_spec::{AsState, Atoms, Knowledge, Rules, Term, Truth};

use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::readings::{WayOut, row_of};
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::requirements::of_term;

/// What was seen of a transition that is wrong, and what was expected.
pub(super) struct Mismatch {
    pub(super) seen: String,
    pub(super) expected: String,
}

impl Mismatch {
    pub(super) fn stays(seen: String, state: AsState) -> Self {
        Self { seen, expected: format!("{state} to stay") }
    }

    pub(super) fn describe(self, finding: Finding) -> Finding {
        finding.seen(self.seen).expected(self.expected)
    }
}

/// Why a transition was wrong: the condition that failed in each alternative, or the row that comes first.
pub(super) fn unjustified(
    rules: &Rules,
    (from, to): (AsState, AsState),
    terms: &[Term],
    window: Knowledge,
    overtaking: Option<Term>,
) -> Mismatch {
    let fails = terms.iter().all(|term| term.truth(window) == Truth::False);
    if let Some(term) = overtaking.filter(|_| !fails) {
        let conditions = conditions(rules, &term, window);
        let seen = format!("{from} -> {to}, though {conditions}: another arrow comes first");
        return Mismatch { seen, expected: "that one".to_owned() };
    }
    let all = |of: fn(&Term) -> Atoms| terms.iter().fold(Atoms::NONE, |all, term| all.union(of(term)));
    let off = all(|term| term.on).intersection(window.off());
    let on = all(|term| term.off).intersection(window.on());
    let text = |value| move |atom| rules.text(atom, value).to_string();
    let failed: Vec<String> = off.iter().map(text(false)).chain(on.iter().map(text(true))).collect();
    Mismatch::stays(format!("{from} -> {to}, but {}", failed.join(" and ")), from)
}

/// A term's conditions with their values, as far as they are known.
pub(super) fn conditions(rules: &Rules, term: &Term, known: Knowledge) -> String {
    let text = |(atom, value)| match known.of(atom) {
        Truth::Unknown => format!("{} (not certain)", rules.text(atom, value)),
        known => rules.text(atom, known == Truth::True).to_string(),
    };
    term.literals().map(text).collect::<Vec<_>>().join(" and ")
}

/// A state was not left, though a way out has been open since `since`.
pub(super) fn not_left(
    est: &Estimator,
    severity: Severity,
    state: AsState,
    way: &WayOut,
    since: i64,
    so_long: &str,
) -> Finding {
    let WayOut { to, section, term } = way;
    let requirements = row_of(&est.edition, state, *to).map(|row| of_term(row, term)).unwrap_or_default();
    let conditions = conditions(&est.edition.rules, term, Knowledge::exact(term.on));
    Finding::new(severity, Party::Vcu, *section, Rule::Due, since + est.deadline)
        .against(&requirements)
        .seen(format!("{state} was not left, though {conditions}{so_long}"))
        .expected(format!("{state} -> {to}"))
}
