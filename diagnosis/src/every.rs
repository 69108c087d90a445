//! Every deviation that there is, with a few numbers in the place of all.

use adsdv_conform::protocol::{Domain, Protocol, ShownField};
use adsdv_spec::mutation::{Change, Threshold, Time};
use adsdv_spec::{AsState, Atom, Edition};

use crate::candidates;
use crate::deviation::Deviation;
use crate::interface::Interface;

impl Deviation {
    /// Every deviation from an edition that is looked for, with a few numbers for those that have one.
    pub fn every(edition: &Edition) -> Vec<Self> {
        let mut all = candidates::all(edition, &Interface::default());
        let times =
            [Time::ReadyDwell, Time::EbsTimer, Time::Handshake].map(|time| move |by| Change::Time(time, by));
        all.extend(times.iter().flat_map(|time| [-7, 1, 450].map(|by| Self::Changed(time(by)))));
        let missed = edition.rules.thresholds.missed_ms.map(|_| Threshold::Missed);
        // Where no row asks for straight wheels nothing is against their limit.
        let straight = edition.scope().has(Atom::SteerStraight).then_some(Threshold::Straight);
        let thresholds = [Threshold::WheelSpeed].into_iter().chain(straight).chain(missed);
        all.extend(
            thresholds.flat_map(|one| [-3, 1, 20].map(|by| Self::Changed(Change::Threshold(one, by)))),
        );
        let protocol = Protocol::of(edition);
        all.extend(protocol.shown().flat_map(|(field, domain)| wrongly_shown(field, domain)));
        let causes = protocol.shown().find(|(field, _)| field.key == "shutdown_cause");
        if let Some((_, Domain::Names(causes))) = causes {
            let pairs = || causes.iter().flat_map(|(one, _)| causes.iter().map(|(other, _)| (*one, *other)));
            let begins = [AsState::Ready, AsState::Driving, AsState::Finished];
            all.extend(begins.iter().flat_map(|&from| {
                let others = pairs().filter(|(value, raw)| value != raw && *value != 0);
                others.map(move |(value, raw)| Self::Causes { from, value, raw })
            }));
            all.extend(begins.iter().flat_map(|&from| {
                let greater = pairs().filter(|(value, raw)| 0 < *value && value < raw);
                greater.map(move |(value, raw)| Self::Prefers { from, value, raw })
            }));
        }
        all
    }
}

/// An output with each value that is wrong: in each state, and in the place of each value. A state that is shown wrongly is one
/// in the place of another; of numbers a few do.
fn wrongly_shown(field: &ShownField, domain: Domain) -> Vec<Deviation> {
    let key = field.key;
    let values: Vec<i32> = match domain {
        Domain::Flag => vec![0, 1],
        Domain::Names(names) => names.iter().map(|(raw, _)| *raw).collect(),
        Domain::Number { .. } => vec![0, 7],
    };
    let outside = match domain {
        Domain::Names(_) => values.iter().max().map(|most| most + 1),
        _ => None,
    };
    let raws = || values.iter().copied().chain(outside);
    let in_a_state = AsState::ALL
        .into_iter()
        .filter(|_| key != "as_state")
        .flat_map(|state| raws().map(move |raw| Deviation::Shows { state, key, raw }));
    let replaced = values.iter().filter(|_| !matches!(domain, Domain::Number { .. })).flat_map(|&value| {
        raws().filter(move |raw| *raw != value).map(move |raw| Deviation::Writes { key, value, raw })
    });
    in_a_state.chain(replaced).collect()
}
