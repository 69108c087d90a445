//! Which requirements stand behind what the table cites, and which an edition has in the place of another's.

use adsdv_spec::{Edition, Requirements, Row, Term};

/// The requirements behind an alternative of a row. What stands beside the figure is not the figure's.
pub fn of_term(row: &Row, term: &Term) -> Vec<&'static str> {
    let figures = if term.section == row.section { row.cites.requirements } else { &[] };
    figures.iter().chain(term.cites.requirements).copied().collect()
}

/// What an edition asks for where an earlier one asks for this: the identifiers of `spec/REQUIREMENTS.md`.
///
/// ```
/// use adsdv_oracle::requirements::of_edition;
/// use adsdv_spec::Edition;
///
/// assert_eq!(of_edition(&Edition::V3_0, "HS-9"), ["HS-9"]);
/// assert_eq!(of_edition(&Edition::V4_0, "HS-9"), ["HS-17"]);
/// ```
pub fn of_edition<'a>(edition: &Edition, id: &'a str) -> Vec<&'a str> {
    instead(edition.requirements, id)
}

fn instead<'a>(requirements: &Requirements, id: &'a str) -> Vec<&'a str> {
    let before = requirements.before.map_or_else(|| vec![id], |before| instead(before, id));
    before
        .into_iter()
        .flat_map(|id| requirements.replaced_by(id).map_or_else(|| vec![id], <[_]>::to_vec))
        .collect()
}

/// The default answers to the questions that the edition leaves open.
pub fn of_readings(edition: &Edition) -> Vec<&'static str> {
    edition.questions().flat_map(|reading| of_edition(edition, reading.decision())).collect()
}

/// Whether it is only the default answer to a question that the edition leaves open.
pub fn is_of_a_reading(edition: &Edition, id: &str) -> bool {
    of_readings(edition).contains(&id)
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
pub fn order(id: &str) -> (usize, u32) {
    const PREFIXES: [&str; 14] =
        ["MSG", "ID", "HS", "SM", "RDY", "DRV", "FIN", "FTO", "RTE", "RTO", "DTE", "FTE", "ETO", "IMP"];
    let (prefix, number) = id.split_once('-').unwrap_or((id, ""));
    let place = PREFIXES.iter().position(|known| *known == prefix).unwrap_or(PREFIXES.len());
    (place, number.parse().unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_in_the_place_of_a_replaced_one_is_asked_for() {
        assert_eq!(of_edition(&Edition::V2026, "MSG-24"), ["MSG-105"], "it was MSG-99 in between");
        for edition in Edition::ALL {
            for replaced in edition.requirements.replaced {
                for id in of_edition(edition, replaced.id) {
                    assert!(edition.requirements.has(id), "{}: {} -> {id}", edition.version, replaced.id);
                }
            }
        }
    }
}
