//! Interfaces with one thing changed, where the change has nothing to work on.

use adsdv_spec::messages::AsState;
use adsdv_spec::mutation::{Change, TermChange, Threshold};
use adsdv_spec::table::MAX_ROWS;
use adsdv_spec::{Atom, Control, Edition, Inputs, Machine, Mutation, Readings};

#[test]
fn a_row_or_a_term_that_is_not_there_cannot_be_changed() {
    let rows = Edition::V3_0.rules.table.rows().len();
    for row in rows..=MAX_ROWS {
        for change in [
            Change::RowDropped(row),
            Change::RowLeadsTo(row, AsState::Off),
            Change::RowFirst(row),
            Change::Term(row, 0, TermChange::Dropped),
        ] {
            assert_eq!(change.apply(&Edition::V3_0), Edition::V3_0, "{change:?}");
        }
    }
    assert_eq!(Change::RowFirst(0).apply(&Edition::V3_0), Edition::V3_0, "none is before the first");
    let terms = Edition::V3_0.rules.table.rows()[0].terms().len();
    let change = Change::Term(0, terms, TermChange::LiteralFlipped(Atom::Asms));
    assert_eq!(change.apply(&Edition::V3_0), Edition::V3_0, "{change:?}");
}

/// A reading lets one row of a state come first. Where the row is missing, the others are what they were.
#[test]
fn a_row_that_is_not_there_overtakes_none() {
    for &priority in Edition::V3_0.rules.priorities {
        let readings = Readings::DEFAULT.with(priority.choice);
        let rows = Edition::V3_0.rules.table.rows();
        let row = rows.iter().position(|row| (row.from, row.to) == (priority.from, priority.first));
        let without = Change::RowDropped(row.expect("the row is there")).apply(&Edition::V3_0);
        let from = Control { state: priority.from, ..Control::INITIAL };
        for inputs in [Inputs::default(), Inputs { tsms: true, ..Inputs::default() }] {
            let (overtaken, _) = Machine::new(without, readings).step(&from, &inputs, 10);
            let (plain, _) = Machine::new(without, Readings::DEFAULT).step(&from, &inputs, 10);
            assert_eq!(overtaken.state, plain.state, "{} from {}", priority.first, priority.from);
        }
    }
}

/// One unit more or less of a threshold for which no row asks would change nothing.
#[test]
fn a_threshold_for_which_no_row_asks_has_no_mutation() {
    let of_thresholds = |edition: &Edition| {
        let mutations: Vec<Mutation> = Mutation::all(edition).collect();
        let thresholds = mutations.into_iter().filter_map(|mutation| match mutation.change {
            Change::Threshold(threshold, 1) => Some(threshold),
            _ => None,
        });
        thresholds.collect::<Vec<Threshold>>()
    };
    let all = [Threshold::WheelSpeed, Threshold::Straight, Threshold::Missed];
    assert_eq!(of_thresholds(&Edition::V4_0), all);
    let rows = Edition::V4_0.rules.table.rows();
    let only = rows.iter().position(|row| row.to == AsState::Driving).expect("only this row asks for it");
    let without = Change::RowDropped(only).apply(&Edition::V4_0);
    assert_eq!(of_thresholds(&without), [Threshold::WheelSpeed, Threshold::Missed]);
}
