//! The specification with one thing changed: a literal, a term, a destination, an order, a time or a threshold.

use adsdv_spec::messages::{AsState, SteerAngle, WheelSpeed};
use adsdv_spec::table::{Row, Table, Term};
use adsdv_spec::{Choices, Interface};

/// A specification with one change, and what was changed.
pub(crate) struct Mutant {
    pub(crate) name: String,
    pub(crate) interface: Interface,
}

/// The mutants that behave like the specification, each with the reason.
pub(crate) const EQUIVALENT: &[(&str, &str)] = &[
    ("3.1 term 0: in every reading", "what asks for both implies what the other two readings ask for"),
    ("3.7 term 4: in every reading", "under the other reading no change of MISSION_STATUS is recorded"),
    ("3.7 term 6: in every reading", "under the other reading no change of DIRECTION_REQUEST is recorded"),
];

/// Every mutant.
pub(crate) fn all() -> impl Iterator<Item = Mutant> {
    let rows = V3_0.table.rows();
    (0..rows.len()).flat_map(row_mutants).chain(swaps()).chain(constants())
}

const V3_0: Interface = Interface::V3_0;

fn with_rows(name: String, change: impl FnOnce(&mut Vec<Row>)) -> Mutant {
    let mut rows = V3_0.table.rows().to_vec();
    change(&mut rows);
    Mutant { name, interface: Interface { table: Table::new(&rows), ..V3_0 } }
}

/// Each term of a row changed, and the row's destination.
fn row_mutants(index: usize) -> impl Iterator<Item = Mutant> {
    let row = V3_0.table.rows()[index];
    let terms = (0..row.terms().len()).flat_map(move |term| term_mutants(index, term));
    let destinations = AsState::ALL.into_iter().filter(move |&to| to != row.to).map(move |to| {
        let name = format!("{}: leads to {to}", row.clause);
        with_rows(name, |rows| rows[index] = Row::new(row.from, to, row.clause, row.terms()))
    });
    terms.chain(destinations)
}

/// A term dropped, each of its literals dropped and flipped, its fault and its reading dropped.
fn term_mutants(row: usize, index: usize) -> Vec<Mutant> {
    let Row { from, to, clause, .. } = V3_0.table.rows()[row];
    let term = V3_0.table.rows()[row].terms()[index];
    let with_term = |what: &str, changed: Option<Term>| {
        with_rows(format!("{clause} term {index}: {what}"), |rows| {
            let mut terms = rows[row].terms().to_vec();
            terms.splice(index..=index, changed);
            rows[row] = Row::new(from, to, clause, &terms);
        })
    };
    let mut mutants = vec![with_term("dropped", None)];
    for (atom, on) in term.conditions() {
        let without = Term { on: term.on.without(atom), off: term.off.without(atom), ..term };
        let flipped = if on {
            Term { off: without.off.with(atom), ..without }
        } else {
            Term { on: without.on.with(atom), ..without }
        };
        mutants.push(with_term(&format!("{atom} dropped"), Some(without)));
        mutants.push(with_term(&format!("{atom} flipped"), Some(flipped)));
    }
    if term.fault.is_some() {
        mutants.push(with_term("fault dropped", Some(Term { fault: None, ..term })));
    }
    if !term.readings.is_empty() {
        mutants.push(with_term("in every reading", Some(Term { readings: Choices::NONE, ..term })));
    }
    mutants
}

/// Each two rows of a state that are evaluated one after the other, the other way round.
fn swaps() -> impl Iterator<Item = Mutant> {
    let rows = V3_0.table.rows();
    let pairs = (1..rows.len()).map(|second| (second - 1, second));
    pairs.filter(|&(first, second)| rows[first].from == rows[second].from).map(|(first, second)| {
        let name = format!("{} before {}", rows[second].clause, rows[first].clause);
        with_rows(name, |rows| rows.swap(first, second))
    })
}

/// Each time and each threshold, one more and one less.
fn constants() -> impl Iterator<Item = Mutant> {
    type Change = fn(&mut Interface, i16);
    let changes: [(&str, Change); 5] = [
        ("ready dwell", |interface, by| add(&mut interface.timing.ready_dwell_ms, by)),
        ("EBS timer", |interface, by| add(&mut interface.timing.ebs_timer_ms, by)),
        ("handshake", |interface, by| add(&mut interface.timing.handshake_ms, by)),
        ("wheel speed", |interface, by| {
            let speed = &mut interface.thresholds.wheel_speed;
            *speed = WheelSpeed::clamped(speed.raw() + i32::from(by));
        }),
        ("straight", |interface, by| {
            let straight = &mut interface.thresholds.straight;
            *straight = SteerAngle::clamped(straight.raw() + i32::from(by));
        }),
    ];
    changes.into_iter().flat_map(|(what, change)| {
        [-1, 1].map(|by| {
            let mut interface = V3_0;
            change(&mut interface, by);
            Mutant { name: format!("{what} {by:+}"), interface }
        })
    })
}

fn add(time_ms: &mut u16, by: i16) {
    *time_ms = time_ms.saturating_add_signed(by);
}
