//! Mutations: an [`Edition`] with one thing changed.
//!
//! They are the yardstick for everything that claims to check a machine against the document: a check that lets a
//! mutant pass, though it behaves otherwise, is incomplete.

use core::fmt;

use crate::atoms::Atom;
use crate::edition::Edition;
use crate::messages::{AsState, SteerAngle, WheelSpeed};
use crate::readings::Choices;
use crate::table::{MAX_ROWS, MAX_TERMS, Row, Table, Term};

/// One change. Rows are numbered as in [`Table::rows`], terms as in [`Row::terms`], both from 0.
///
/// ```
/// use adsdv_spec::{AsState, Control, Inputs, Edition, Machine, Mutation, Readings};
/// let dropped = Mutation::all(&Edition::V3_0).find(|m| m.to_string() == "3.6: dropped").unwrap();
/// let mutant = Machine::new(dropped.apply(&Edition::V3_0), Readings::DEFAULT);
/// let ready = Control { state: AsState::Ready, ..Control::INITIAL };
/// let (after, _) = mutant.step(&ready, &Inputs::default(), 10);
/// assert_eq!(after.state, AsState::Ready); // ASMS is off, and nobody cares
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mutation {
    /// The section of the row that is changed, for the name; empty where no row is.
    section: &'static str,
    /// What is changed.
    pub change: Change,
}

/// What a mutation changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// A row is missing.
    RowDropped(usize),
    /// A row leads to another state.
    RowLeadsTo(usize, AsState),
    /// A row is evaluated before the row that stands before it; both leave the same state.
    RowFirst(usize),
    /// A term of a row is changed.
    Term(usize, usize, TermChange),
    /// A time is longer by so many milliseconds.
    Time(Time, i16),
    /// A threshold is higher by so many raw units.
    Threshold(Threshold, i16),
}

/// What is changed of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermChange {
    /// It is missing.
    Dropped,
    /// One of its conditions is missing.
    LiteralDropped(Atom),
    /// One of its conditions is turned round.
    LiteralFlipped(Atom),
    /// It names no fault.
    FaultDropped,
    /// It is there whatever the readings are.
    InEveryReading,
}

/// A time of [`Timing`](crate::Timing).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Time {
    /// `ready_dwell_ms`.
    ReadyDwell,
    /// `ebs_timer_ms`.
    EbsTimer,
    /// `handshake_ms`.
    Handshake,
}

/// A threshold of [`Thresholds`](crate::Thresholds).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Threshold {
    /// `wheel_speed`.
    WheelSpeed,
    /// `straight`.
    Straight,
    /// `missed_ms`, where the edition has it.
    Missed,
}

impl Mutation {
    /// Every mutation of an edition, times and thresholds by one unit. A threshold for which no row asks has none: nothing would
    /// change.
    pub fn all(edition: &Edition) -> impl Iterator<Item = Self> {
        let rows = edition.rules.table.rows();
        let by_row = rows.iter().enumerate().flat_map(move |(row, Row { section, .. })| {
            changes_of_row(rows, row).map(move |change| Self { section, change })
        });
        let missed = edition.rules.thresholds.missed_ms.map(|_| Threshold::Missed);
        let constants = [-1, 1].into_iter().flat_map(move |by| {
            let times = [Time::ReadyDwell, Time::EbsTimer, Time::Handshake];
            let thresholds = [Threshold::WheelSpeed, Threshold::Straight].into_iter();
            let thresholds =
                thresholds.chain(missed).filter(move |threshold| threshold.is_asked_for_by(rows));
            let times = times.into_iter().map(move |time| Change::Time(time, by));
            times.chain(thresholds.map(move |threshold| Change::Threshold(threshold, by)))
        });
        by_row.chain(constants.map(|change| Self { section: "", change }))
    }

    /// The edition with the change.
    #[must_use]
    pub fn apply(&self, edition: &Edition) -> Edition {
        self.change.apply(edition)
    }
}

impl Threshold {
    /// Whether a condition of some row depends on it.
    fn is_asked_for_by(self, rows: &[Row]) -> bool {
        let conditions: &[Atom] = match self {
            Self::WheelSpeed => &[Atom::Moving, Atom::AtRest],
            Self::Straight => &[Atom::SteerStraight],
            Self::Missed => &[Atom::AiCommsLost],
        };
        let mut literals = rows.iter().flat_map(Row::terms).flat_map(Term::literals);
        literals.any(|(atom, _)| conditions.contains(&atom))
    }
}

impl Change {
    /// The edition with the change. What the change speaks of and the edition does not have stays as it is.
    #[must_use]
    pub fn apply(&self, edition: &Edition) -> Edition {
        let mut mutant = *edition;
        match *self {
            Change::RowDropped(row) => mutant.rules.table = with_row(&mutant.rules.table, row, |_| None),
            Change::RowLeadsTo(row, to) => {
                let leading =
                    |row: &Row| Some(Row::new(row.from, to, row.section, row.terms()).cites(row.cites));
                mutant.rules.table = with_row(&mutant.rules.table, row, leading);
            }
            Change::RowFirst(row) => mutant.rules.table = with_row_first(&mutant.rules.table, row),
            Change::Term(row, term, change) => {
                mutant.rules.table =
                    with_row(&mutant.rules.table, row, |row| Some(with_term(row, term, change)));
            }
            Change::Time(time, by) => {
                let timing = &mut mutant.rules.timing;
                let time = match time {
                    Time::ReadyDwell => &mut timing.ready_dwell_ms,
                    Time::EbsTimer => &mut timing.ebs_timer_ms,
                    Time::Handshake => &mut timing.handshake_ms,
                };
                *time = time.saturating_add_signed(by);
            }
            Change::Threshold(threshold, by) => {
                let thresholds = &mut mutant.rules.thresholds;
                match threshold {
                    Threshold::WheelSpeed => {
                        let raw = thresholds.wheel_speed.raw() + i32::from(by);
                        thresholds.wheel_speed = WheelSpeed::clamped(raw);
                    }
                    Threshold::Straight => {
                        let raw = thresholds.straight.raw() + i32::from(by);
                        thresholds.straight = SteerAngle::clamped(raw);
                    }
                    Threshold::Missed => {
                        thresholds.missed_ms = thresholds.missed_ms.map(|ms| ms.saturating_add_signed(by));
                    }
                }
            }
        }
        mutant
    }
}

/// Every change of one row.
fn changes_of_row(rows: &[Row], index: usize) -> impl Iterator<Item = Change> {
    let row = rows.get(index);
    let terms = row.map_or(&[][..], Row::terms).iter().enumerate();
    let terms = terms.flat_map(move |(place, term)| {
        changes_of_term(term).map(move |change| Change::Term(index, place, change))
    });
    let other = AsState::ALL.into_iter().filter(move |&to| row.is_some_and(|row| row.to != to));
    let before = index.checked_sub(1).and_then(|before| rows.get(before));
    let swapped = before.zip(row).is_some_and(|(before, row)| before.from == row.from);
    core::iter::once(Change::RowDropped(index))
        .chain(terms)
        .chain(other.map(move |to| Change::RowLeadsTo(index, to)))
        .chain(swapped.then_some(Change::RowFirst(index)))
}

/// Every change of one term.
fn changes_of_term(term: &Term) -> impl Iterator<Item = TermChange> {
    let literals = term
        .literals()
        .flat_map(|(atom, _)| [TermChange::LiteralDropped(atom), TermChange::LiteralFlipped(atom)]);
    core::iter::once(TermChange::Dropped)
        .chain(literals)
        .chain(term.fault.map(|_| TermChange::FaultDropped))
        .chain((!term.readings.is_empty()).then_some(TermChange::InEveryReading))
}

/// A table with one row changed, or without it.
fn with_row(table: &Table, index: usize, change: impl Fn(&Row) -> Option<Row>) -> Table {
    let mut rows = [Row::EMPTY; MAX_ROWS];
    let changed = table.rows().iter().enumerate();
    let changed = changed.filter_map(|(place, row)| if place == index { change(row) } else { Some(*row) });
    let len = rows.iter_mut().zip(changed).map(|(slot, row)| *slot = row).count();
    Table::new(rows.split_at(len).0)
}

/// A table with a row before the one that stands before it.
fn with_row_first(table: &Table, index: usize) -> Table {
    let mut mutant = *table;
    if let Some(before) = index.checked_sub(1).filter(|_| index < table.rows().len()) {
        mutant.swap(before, index);
    }
    mutant
}

/// A row with one term changed, or without it.
fn with_term(row: &Row, index: usize, change: TermChange) -> Row {
    let mut terms = [Term::EMPTY; MAX_TERMS];
    let changed = row.terms().iter().enumerate();
    let changed = changed
        .filter_map(|(place, term)| if place == index { changed_term(term, change) } else { Some(*term) });
    let len = terms.iter_mut().zip(changed).map(|(slot, term)| *slot = term).count();
    Row::new(row.from, row.to, row.section, terms.split_at(len).0).cites(row.cites)
}

fn changed_term(term: &Term, change: TermChange) -> Option<Term> {
    let without = |atom| Term { on: term.on.without(atom), off: term.off.without(atom), ..*term };
    match change {
        TermChange::Dropped => None,
        TermChange::LiteralDropped(atom) => Some(without(atom)),
        TermChange::LiteralFlipped(atom) if term.on.has(atom) => {
            Some(Term { off: term.off.with(atom), ..without(atom) })
        }
        TermChange::LiteralFlipped(atom) => Some(Term { on: term.on.with(atom), ..without(atom) }),
        TermChange::FaultDropped => Some(Term { fault: None, ..*term }),
        TermChange::InEveryReading => Some(Term { readings: Choices::NONE, ..*term }),
    }
}

/// Such as `3.7 term 1: go-on flipped` or `EBS timer +1`.
impl fmt::Display for Mutation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let section = self.section;
        match self.change {
            Change::RowDropped(_) => write!(f, "{section}: dropped"),
            Change::RowLeadsTo(_, to) => write!(f, "{section}: leads to {to}"),
            Change::RowFirst(_) => write!(f, "{section}: one place earlier"),
            Change::Term(_, term, change) => write!(f, "{section} term {term}: {change}"),
            Change::Time(time, by) => write!(f, "{time} {by:+}"),
            Change::Threshold(threshold, by) => write!(f, "{threshold} {by:+}"),
        }
    }
}

impl fmt::Display for TermChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dropped => f.write_str("dropped"),
            Self::LiteralDropped(atom) => write!(f, "{atom} dropped"),
            Self::LiteralFlipped(atom) => write!(f, "{atom} flipped"),
            Self::FaultDropped => f.write_str("fault dropped"),
            Self::InEveryReading => f.write_str("in every reading"),
        }
    }
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ReadyDwell => "ready dwell",
            Self::EbsTimer => "EBS timer",
            Self::Handshake => "handshake",
        })
    }
}

impl fmt::Display for Threshold {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::WheelSpeed => "wheel speed",
            Self::Straight => "straight",
            Self::Missed => "missed message",
        })
    }
}
