//! Which requirements stand behind a condition and two rows at once: what the table cites.

use adsdv_oracle::requirements::of_term;
use adsdv_spec::{Atom, Row, Term};

/// The requirements behind one condition of an alternative: those of the alternative where it has none of its own.
pub(super) fn of_condition(row: &Row, term: &Term, atom: Atom) -> Vec<&'static str> {
    term.requirements_of(atom).map_or_else(|| of_term(row, term), <[_]>::to_vec)
}

/// The requirements behind two rows that hold at once, the earlier one first.
pub(super) fn of_pair(one: &Row, other: &Row) -> Vec<&'static str> {
    let all = [one.cites.requirements, other.cites.requirements, one.cites.order];
    all.into_iter().flatten().copied().collect()
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;

    use crate::suite;

    /// A further edition as well has those of the edition that it is written as the difference to.
    #[test]
    fn tests_name_what_their_edition_asks_for() {
        let further = Edition { version: "further", ..Edition::V4_0 };
        for edition in Edition::ALL.iter().copied().chain([&further]) {
            for test in suite::generate(edition) {
                let other = test.requirements.iter().find(|id| !edition.requirements.has(id));
                assert_eq!(other, None, "{}: {}", edition.version, test.name);
            }
            for untested in suite::untested(edition) {
                assert!(edition.requirements.has(&untested.id), "{}: {}", edition.version, untested.id);
            }
        }
        assert_eq!(suite::untested(&further).count(), suite::untested(&Edition::V4_0).count());
    }
}
