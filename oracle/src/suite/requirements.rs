//! Which requirements stand behind a row, a condition and two rows at once: what the table cites. And those that an edition
//! has in the place of another's.

use adsdv_spec::{Atom, Edition, Row, Term};

/// The requirements behind an alternative of a row. What stands beside the figure is not the figure's.
pub(crate) fn of_term(row: &Row, term: &Term) -> Vec<&'static str> {
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

/// Since version 4.0.
const SINCE_4_0: &[&str] = &["4.0", "2026"];
/// Since the database of 2026.
const SINCE_2026: &[&str] = &["2026"];

/// What editions ask for instead of a requirement of an earlier one: the same with another number in it, or what they have made
/// of it. Where it is nothing at all, they do not ask for it.
const INSTEAD: &[(&[&str], &str, &[&str])] = &[
    (SINCE_4_0, "HS-9", &["HS-17"]),
    (SINCE_4_0, "HS-13", &[]),
    (SINCE_4_0, "HS-16", &["HS-19"]),
    (SINCE_4_0, "DTE-4", &["DTE-7"]),
    (SINCE_4_0, "D-2", &["D-65"]),
    (SINCE_4_0, "D-9", &["D-62"]),
    (SINCE_4_0, "D-10", &["D-63"]),
    (SINCE_4_0, "D-27", &["D-27", "IMP-9"]),
    (SINCE_2026, "D-53", &["D-67"]),
];

/// What an edition asks for where an earlier one asks for this: the identifiers of `spec/REQUIREMENTS.md`.
///
/// ```
/// use adsdv_oracle::suite::of_edition;
/// use adsdv_spec::Edition;
///
/// assert_eq!(of_edition(&Edition::V3_0, "HS-9"), ["HS-9"]);
/// assert_eq!(of_edition(&Edition::V4_0, "HS-9"), ["HS-17"]);
/// ```
pub fn of_edition<'a>(edition: &Edition, id: &'a str) -> Vec<&'a str> {
    let instead = INSTEAD.iter().find(|(editions, old, _)| *old == id && editions.contains(&edition.version));
    instead.map_or_else(|| vec![id], |(.., ids)| ids.to_vec())
}

/// Whether it is only the default answer to a question that the edition leaves open.
pub(crate) fn is_of_a_reading(edition: &Edition, id: &str) -> bool {
    edition.questions().any(|reading| of_edition(edition, reading.decision()).contains(&id))
}

/// Whether it is a decision of ours, where the document is silent or contradicts itself: what stands under "Decisions" in
/// `spec/REQUIREMENTS.md`.
pub fn is_decision(id: &str) -> bool {
    id.starts_with("D-")
}

/// Whether there are any, and all of them are such decisions: what is against no more than that is no failure.
pub fn are_decisions(ids: &[impl AsRef<str>]) -> bool {
    !ids.is_empty() && ids.iter().all(|id| is_decision(id.as_ref()))
}

/// The place of a requirement in the document: by prefix, and within it by number.
pub(crate) fn order(id: &str) -> (usize, u32) {
    const PREFIXES: [&str; 14] =
        ["MSG", "ID", "HS", "SM", "RDY", "DRV", "FIN", "FTO", "RTE", "RTO", "DTE", "FTE", "ETO", "IMP"];
    let (prefix, number) = id.split_once('-').unwrap_or((id, ""));
    let place = PREFIXES.iter().position(|known| *known == prefix).unwrap_or(PREFIXES.len());
    (place, number.parse().unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::suite;

    /// What a line says is of use: some edition asks for the old requirement, and each that it names for the new ones.
    #[test]
    fn what_is_replaced_is_named_by_tests_and_so_is_what_stands_instead() {
        let named = |edition: &Edition| -> HashSet<String> {
            suite::generate(edition).into_iter().flat_map(|test| test.requirements).collect()
        };
        let all: Vec<(&str, HashSet<String>)> =
            Edition::ALL.iter().map(|edition| (edition.version, named(edition))).collect();
        for (editions, old, new) in INSTEAD {
            let others = all.iter().filter(|(version, _)| !editions.contains(version));
            assert!(others.into_iter().any(|(_, named)| named.contains(*old)), "{old}");
            for version in *editions {
                let (_, named) = all.iter().find(|(known, _)| known == version).expect("an edition");
                assert!(new.iter().all(|id| named.contains(*id)), "{version}: {old}");
                assert_eq!(named.contains(*old), new.contains(old), "{version}: {old}");
            }
        }
    }
}
