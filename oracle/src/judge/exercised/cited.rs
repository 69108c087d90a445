//! The requirements that a log can show, from what cites them.

use std::collections::HashSet;

use adsdv_spec::{Actuation, AsState, Edition};

use crate::requirements;

/// That only the arrows of Figure 2 are taken.
pub(in crate::judge) const ONLY_ARROWS: &str = "SM-18"; //= SM-18
/// That the VCU's bit alternates.
pub(in crate::judge) const ALTERNATES: &str = "HS-4"; //= HS-4
/// That the AI Computer answers with the bit that it receives.
pub(in crate::judge) const ANSWERS: &str = "HS-5"; //= HS-5
/// That the VCU holds its bit, 0 and 1, until it is answered, and then changes it.
pub(in crate::judge) const HOLDS: [&str; 2] = ["HS-7", "HS-6"]; //= HS-6, HS-7
/// That the handshake begins with a rising edge, which the AI Computer can answer with one.
pub(in crate::judge) const BEGINS: &str = "HS-12"; //= HS-12
/// That an edge which stays unanswered is a fault, as version 3.0 has it.
pub(in crate::judge) const UNANSWERED: &[&str] = &["HS-9", "HS-16"]; //= HS-9, HS-16, HS-17, HS-19
/// That a message which is missed is one.
pub(in crate::judge) const MISSED: &str = "HS-18"; //= HS-18
/// That FINISHED is declared at rest.
pub(in crate::judge) const FINISHES_AT_REST: &str = "FIN-3"; //= FIN-3

/// What an edition asks for where these are asked for, each once, but for the default answers to open questions.
pub(in crate::judge) fn of_edition(edition: &Edition, ids: &[&'static str]) -> Vec<&'static str> {
    let of_readings = requirements::of_readings(edition);
    let mut seen = HashSet::new();
    let mut all: Vec<_> = ids.iter().flat_map(|id| requirements::of_edition(edition, id)).collect();
    all.retain(|id| edition.requirements.has(id) && !of_readings.contains(id) && seen.insert(*id));
    all
}

/// The requirements of an edition that a log can show, in the order of the document.
pub(super) fn all(edition: &Edition) -> Vec<&'static str> {
    let mut cited = vec![ONLY_ARROWS, ALTERNATES, ANSWERS, BEGINS, FINISHES_AT_REST];
    cited.extend(HOLDS.iter().chain(UNANSWERED));
    if edition.rules.thresholds.missed_ms.is_some() {
        cited.push(MISSED);
    }
    for row in edition.rules.table.rows() {
        cited.extend(row.cites.requirements);
        for term in row.terms().iter().filter(|term| term.readings.is_subset(edition.choices)) {
            cited.extend(term.cites.requirements);
            cited.extend(term.cites.conditions.iter().flat_map(|one| one.requirements));
        }
    }
    cited.extend(edition.faults.iter().map(adsdv_spec::Fault::requirement));
    cited.extend(AsState::ALL.iter().flat_map(|&state| Actuation::requirements(state)));
    let mut all = of_edition(edition, &cited);
    all.sort_by_key(|id| requirements::order(id));
    all
}
