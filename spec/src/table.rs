//! Figure 2 as a table: one row for each arrow.
//!
//! Hold an edition's table ([`Rules::table`](crate::Rules::table)) against its figure. A row names where an arrow starts and ends and the section of the document
//! that describes it; its guard is an OR of [`Term`]s, each an AND of literals: [`Atom`]s that must be on or off. A term
//! that only some [`readings`](crate::readings) of the document have names the choices it needs. Rows of one state
//! stand in the order in which they are evaluated; [`Priority`] says which readings change that order.

use crate::Fault;
use crate::atoms::{Atom, Atoms};
use crate::messages::AsState;
use crate::readings::{Choice, Choices};

/// The most rows a [`Table`] holds.
pub const MAX_ROWS: usize = 12;
/// The most terms a [`Row`] holds.
pub const MAX_TERMS: usize = 12;

/// What stands behind something of a table: identifiers of `REQUIREMENTS.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Cites {
    /// Its own.
    pub requirements: &'static [&'static str],
    /// Of a term: those behind single conditions, where they have some of their own.
    pub conditions: &'static [CitesOfCondition],
    /// Of a row: those behind its being evaluated before the rows below it.
    pub order: &'static [&'static str],
}

/// What stands behind a condition of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CitesOfCondition {
    /// The condition.
    pub atom: Atom,
    /// The identifiers.
    pub requirements: &'static [&'static str],
}

impl Cites {
    /// Nothing.
    pub const NONE: Self = Self { requirements: &[], conditions: &[], order: &[] };
}

/// One alternative of a guard: all `on` hold and none of `off` does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Term {
    /// The atoms that must hold.
    pub on: Atoms,
    /// The atoms that must not hold.
    pub off: Atoms,
    /// The choices of readings without which the term is not there; none: it always is.
    pub readings: Choices,
    /// The fault that 520h reports when this term leads to `EMERGENCY_BRAKE`; `None` where the faults of the
    /// inputs say it themselves.
    pub fault: Option<Fault>,
    /// The section of the document that this alternative comes from.
    pub section: &'static str,
    /// The requirements behind it.
    pub cites: &'static Cites,
}

impl Term {
    pub(crate) const EMPTY: Self = Self {
        on: Atoms::NONE,
        off: Atoms::NONE,
        readings: Choices::NONE,
        fault: None,
        section: "",
        cites: &Cites::NONE,
    };

    /// A term that holds when all of these atoms do.
    pub const fn on(section: &'static str, atoms: &[Atom]) -> Self {
        Self { on: Atoms::of(atoms), section, ..Self::EMPTY }
    }

    /// A term that holds when none of these atoms does.
    pub const fn off(section: &'static str, atoms: &[Atom]) -> Self {
        Self { off: Atoms::of(atoms), section, ..Self::EMPTY }
    }

    /// With atoms that must not hold.
    #[must_use]
    pub const fn and_off(self, atoms: &[Atom]) -> Self {
        Self { off: Atoms::of(atoms), ..self }
    }

    /// With the fault that this term is reported as.
    #[must_use]
    pub const fn fault(self, fault: Fault) -> Self {
        Self { fault: Some(fault), ..self }
    }

    /// With the requirements behind it.
    #[must_use]
    pub const fn cites(self, cites: &'static Cites) -> Self {
        Self { cites, ..self }
    }

    /// The requirements behind one of its conditions; `None` if it has none of its own.
    pub fn requirements_of(&self, atom: Atom) -> Option<&'static [&'static str]> {
        self.cites.conditions.iter().find(|one| one.atom == atom).map(|one| one.requirements)
    }

    /// Only where this choice is made.
    #[must_use]
    pub const fn reading(self, choice: Choice) -> Self {
        Self { readings: Choices::NONE.with(choice), ..self }
    }

    /// Whether the term holds as far as is known: false as soon as one condition is known to fail.
    pub const fn truth(&self, known: crate::Knowledge) -> crate::Truth {
        known.all_hold(self.on, self.off)
    }

    /// The literals of the term: each atom with the value it must have.
    pub fn literals(&self) -> impl Iterator<Item = (Atom, bool)> {
        let (on, both) = (self.on, self.on.union(self.off));
        both.iter().map(move |atom| (atom, on.has(atom)))
    }
}

/// So many terms or rows, which have to fit when they are compiled.
struct Count<const N: usize>;

impl<const N: usize> Count<N> {
    const TERMS: () = assert!(N <= MAX_TERMS, "the row has more terms than a Row holds: raise MAX_TERMS");
    const ROWS: () = assert!(N <= MAX_ROWS, "the figure has more rows than a Table holds: raise MAX_ROWS");
}

/// One arrow of Figure 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Where the arrow starts.
    pub from: AsState,
    /// Where it ends.
    pub to: AsState,
    /// The section of the document that describes it.
    pub section: &'static str,
    /// The requirements behind it: the figure's own, and those of the text.
    pub cites: &'static Cites,
    terms: [Term; MAX_TERMS],
    len: u8,
}

impl Row {
    pub(crate) const EMPTY: Self = Self {
        from: AsState::Off,
        to: AsState::Off,
        section: "",
        cites: &Cites::NONE,
        terms: [Term::EMPTY; MAX_TERMS],
        len: 0,
    };

    /// A row that is written down with its terms. More than [`MAX_TERMS`] do not compile.
    pub const fn of<const N: usize>(
        from: AsState,
        to: AsState,
        section: &'static str,
        terms: &[Term; N],
    ) -> Self {
        let () = Count::<N>::TERMS;
        Self::new(from, to, section, terms)
    }

    /// A row with terms that are known when the program runs. Only the first [`MAX_TERMS`] count.
    pub const fn new(from: AsState, to: AsState, section: &'static str, terms: &[Term]) -> Self {
        let mut row = Self { from, to, section, ..Self::EMPTY };
        let mut i = 0;
        while i < terms.len() && i < MAX_TERMS {
            row.terms[i] = terms[i];
            i += 1;
        }
        row.len = i as u8;
        row
    }

    /// With the requirements behind it.
    #[must_use]
    pub const fn cites(self, cites: &'static Cites) -> Self {
        Self { cites, ..self }
    }

    /// The alternatives of the guard.
    pub const fn terms(&self) -> &[Term] {
        self.terms.split_at(self.len as usize).0
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Row {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut row = serializer.serialize_struct("Row", 5)?;
        row.serialize_field("from", &self.from)?;
        row.serialize_field("to", &self.to)?;
        row.serialize_field("section", self.section)?;
        row.serialize_field("cites", self.cites)?;
        row.serialize_field("terms", self.terms())?;
        row.end()
    }
}

/// The rows of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Table {
    rows: [Row; MAX_ROWS],
    len: u8,
}

impl Table {
    /// A table that is written down with its rows, in the order of evaluation. More than [`MAX_ROWS`] do not compile.
    pub const fn of<const N: usize>(rows: &[Row; N]) -> Self {
        let () = Count::<N>::ROWS;
        Self::new(rows)
    }

    /// A table of rows that are known when the program runs, in the order of evaluation. Only the first [`MAX_ROWS`]
    /// count.
    pub const fn new(rows: &[Row]) -> Self {
        let mut table = Self { rows: [Row::EMPTY; MAX_ROWS], len: 0 };
        let mut i = 0;
        while i < rows.len() && i < MAX_ROWS {
            table.rows[i] = rows[i];
            i += 1;
        }
        table.len = i as u8;
        table
    }

    /// The table with another row for an arrow that it has; the row's place stays.
    ///
    /// A row for an arrow that the table does not have does not compile.
    pub(crate) const fn with(self, row: &Row) -> Self {
        let mut table = self;
        let mut i = 0;
        while !(table.rows[i].from as u8 == row.from as u8 && table.rows[i].to as u8 == row.to as u8) {
            i += 1;
            assert!(i < self.len as usize, "the table has no such arrow");
        }
        table.rows[i] = *row;
        table
    }

    /// The table with two of its rows in each other's place.
    pub(crate) fn swap(&mut self, a: usize, b: usize) {
        self.rows.swap(a, b);
    }

    /// The rows.
    pub const fn rows(&self) -> &[Row] {
        self.rows.split_at(self.len as usize).0
    }
}

/// As the list of its rows.
#[cfg(feature = "serde")]
impl serde::Serialize for Table {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.rows().serialize(serializer)
    }
}

/// A reading that changes which arrow of a state is evaluated first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Priority {
    /// The choice that changes the order.
    pub choice: Choice,
    /// The state that the arrows leave.
    pub from: AsState,
    /// Where the arrow ends that now comes before all others of the state.
    pub first: AsState,
}

#[cfg(test)]
mod tests {
    use super::{Row, Term};
    use crate::Edition;
    use crate::messages::AsState;

    #[test]
    fn a_row_takes_the_place_of_that_of_its_arrow() {
        let table = Edition::V3_0.rules.table;
        for (place, row) in table.rows().iter().enumerate() {
            let other = Row::new(row.from, row.to, "9", &row.terms()[..1]);
            let changed = table.with(&other);
            for (index, (was, is)) in table.rows().iter().zip(changed.rows()).enumerate() {
                assert_eq!(is, if index == place { &other } else { was });
            }
        }
    }

    #[test]
    #[should_panic(expected = "no such arrow")]
    fn a_row_of_an_arrow_that_there_is_not_does_not_compile() {
        let row = Row::new(AsState::Off, AsState::Driving, "9", &[Term::on("9", &[])]);
        let _ = Edition::V3_0.rules.table.with(&row);
    }
}
