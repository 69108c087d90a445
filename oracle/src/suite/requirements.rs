//! Which requirements stand behind a row, a condition and two rows at once: what the table cites.

use adsdv_spec::{Atom, Reading, Row, Term};

/// The requirements behind an alternative of a row. What stands beside the figure is not the figure's.
pub(super) fn of_term(row: &Row, term: &Term) -> Vec<&'static str> {
    let figures = if term.section == row.section { row.cites.requirements } else { &[] };
    figures.iter().chain(term.cites.requirements).copied().collect()
}

/// The requirements behind one condition of an alternative: those of the alternative where it has none of its own.
pub(super) fn of_condition(row: &Row, term: &Term, atom: Atom) -> Vec<&'static str> {
    term.requirements_of(atom).map_or_else(|| of_term(row, term), <[_]>::to_vec)
}

/// The requirements behind two rows that hold at once, the earlier one first.
pub(super) fn of_pair(one: &Row, other: &Row) -> Vec<&'static str> {
    let all = [one.cites.requirements, other.cites.requirements, one.cites.order];
    all.into_iter().flatten().copied().collect()
}

/// Whether it is only the default answer to a question that the document leaves open.
pub(crate) fn is_of_a_reading(id: &str) -> bool {
    Reading::ALL.iter().any(|reading| reading.decision() == id)
}
