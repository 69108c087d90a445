//! The deviations that may explain an answer.

use adsdv_oracle::protocol::Domain;
use adsdv_spec::messages::AsState;
use adsdv_spec::mutation::Change;
use adsdv_spec::{Edition, Inputs, Mutation};

use crate::deviation::{Deviation, Wheels};
use crate::experiments::{Dial, dials};
use crate::model::Model;
use crate::record::Record;

/// How late an arrow may be, in steps.
const LATEST: u8 = 3;

/// Every deviation that has no number in it which would have to be measured.
pub(crate) fn all(edition: &Edition) -> Vec<Deviation> {
    let measured = |change: &Change| matches!(change, Change::Time(..) | Change::Threshold(..));
    let changes = Mutation::all(edition).map(|mutation| mutation.change).filter(|change| !measured(change));
    let mut all: Vec<Deviation> = changes.map(Deviation::Changed).collect();
    all.extend([Deviation::GoLevel, Deviation::GoNeedsHandshake, Deviation::Wheels(Wheels::All)]);
    all.extend((0..4).map(|wheel| Deviation::Wheels(Wheels::Only(wheel))));
    let dials = dials(&Model::new(edition, &[]));
    let named: Vec<&Dial> =
        dials.iter().filter(|dial| !matches!(dial.field.domain, Domain::Number { .. })).collect();
    for row in edition.rules.table.rows() {
        let (from, to) = (row.from, row.to);
        all.extend((1..=LATEST).map(|steps| Deviation::Late { from, to, steps }));
        for Dial { field, values } in &named {
            let each = values.iter().flat_map(|&raw| [true, false].map(|is| (raw, is)));
            // Of two values one is what the other is not.
            let each = each.filter(|(_, is)| *is || values.len() > 2);
            all.extend(each.map(|(raw, is)| Deviation::Needs { from, to, key: field.key, raw, is }));
        }
    }
    for from in AsState::ALL {
        for to in AsState::ALL.into_iter().filter(|&to| to != from) {
            for Dial { field, values } in &named {
                let usual = (field.get)(&Inputs::default());
                let others = values.iter().filter(|&&raw| raw != usual);
                all.extend(others.map(|&raw| Deviation::Also { from, to, key: field.key, raw }));
            }
        }
    }
    all
}

/// What would make the first wrong answer right by showing it.
pub(crate) fn shown(record: &Record, model: &Model) -> Option<Deviation> {
    let (place, _, shown) = record.wrong(model)?;
    let differences = record.differences(place, &shown);
    let [difference] = differences.as_slice() else { return None };
    let state = AsState::from_raw(record.replies.get(place)?.get("as_state")?.raw?)?;
    (difference.key != "as_state").then_some(())?;
    Some(Deviation::Shows { state, key: difference.key, raw: difference.found.raw? })
}
