//! Sets of deviations: one more, in the place of others, and those that are the same.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::mutation::{Change, Time};
use adsdv_spec::{AsState, Edition};

use crate::deviation::{Deviation, Remembers};
use crate::stays::Wrong;

/// The set with one more, in the place of those that cannot be beside it. Of two that lead out of a state as soon as an input has
/// a value, the first counts, so that both orders differ.
pub(crate) fn with(set: &[Deviation], one: Deviation) -> Vec<Vec<Deviation>> {
    let set: Vec<Deviation> = set.iter().copied().filter(|other| !other.is_instead_of(&one)).collect();
    let set = set.as_slice();
    let mut sets = vec![[set, &[one]].concat()];
    let leads_from = |of: &Deviation| match *of {
        Deviation::Also { from, .. } => Some(from),
        _ => None,
    };
    let own = leads_from(&one);
    if own.is_some() && set.iter().any(|other| leads_from(other) == own) {
        sets.push([&[one], set].concat());
    }
    sets
}

pub(crate) fn same(one: &[Deviation], other: &[Deviation]) -> bool {
    one.len() == other.len()
        && one.iter().all(|deviation| other.contains(deviation))
        && one
            .iter()
            .filter(|one| matches!(one, Deviation::Also { .. }))
            .eq(other.iter().filter(|one| matches!(one, Deviation::Also { .. })))
}

/// What would make a wrong answer right by showing it.
pub(crate) fn shown_otherwise(wrong: &Wrong) -> Vec<Deviation> {
    let mut all = Vec::new();
    for ((key, _, found), right) in wrong.values.iter().copied().zip(wrong.rights.iter().copied()) {
        let Some(raw) = found else { continue };
        if key != "as_state" {
            all.push(Deviation::Shows { state: wrong.expected, key, raw });
        }
        if key == "shutdown_cause"
            && let (Some(value), AsState::EmergencyBrake) = (right, wrong.found)
            && wrong.from.control.state != wrong.found
            && [value, raw].iter().all(|raw| ShutdownCause::from_raw(*raw).is_some())
        {
            let from = wrong.from.control.state;
            // What counts before it may be given another number itself.
            let greater = (value + 1..).take_while(|raw| ShutdownCause::from_raw(*raw).is_some());
            let greater = greater.filter(|_| value > 0);
            all.extend(greater.map(|raw| Deviation::Prefers { from, value, raw }));
            all.push(Deviation::Causes { from, value, raw });
        }
        if let Some(value) = right.filter(|value| *value != raw) {
            all.push(Deviation::Writes { key, value, raw });
        }
    }
    all
}

/// Those of a set that decide where stays begin and end, and what is remembered there: where two states are shown alike, also what
/// leads to one of them. Sets for which that is the same have the same of them.
pub(crate) fn everywhere(edition: &Edition, set: &[Deviation]) -> Vec<Deviation> {
    let alike = set.iter().any(|one| match *one {
        Deviation::Writes { key: "as_state", raw, .. } => AsState::from_raw(raw).is_some(),
        _ => false,
    });
    let leads =
        |one: &Deviation| matches!(one, Deviation::Changed(Change::RowLeadsTo(..)) | Deviation::Also { .. });
    // Where the cause is shown otherwise, the flags tell which is remembered.
    let by_flags = set.iter().any(Deviation::hides_the_cause);
    let tells = |one: &Deviation| one.tells_what_is_remembered() || by_flags && one.is_about_a_flag();
    // How long a state lasted in all is remembered up to the time that counts.
    let of_all_visits = set.contains(&Deviation::Remembers(Remembers::DwellOfAllVisits));
    let counts = |one: &Deviation| {
        one.state(edition).is_none() && tells(one)
            || alike && leads(one)
            || of_all_visits && matches!(one, Deviation::Changed(Change::Time(Time::ReadyDwell, _)))
    };
    let mut all: Vec<Deviation> = Vec::new();
    for one in set.iter().copied().filter(counts).map(as_it_counts) {
        if !all.contains(&one) {
            all.push(one);
        }
    }
    all
}

/// A cause that is shown as another is not the one that is remembered, whichever and as what.
fn as_it_counts(one: Deviation) -> Deviation {
    match one {
        Deviation::Writes { key: key @ "shutdown_cause", .. } => Deviation::Writes { key, value: 0, raw: 0 },
        other => other,
    }
}
