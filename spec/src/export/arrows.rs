//! What the three prints of Figure 2 have in common: which arrows there are, and how a guard reads.

use core::fmt;

use crate::machine::Taken;
use crate::messages::AsState;
use crate::table::{Row, Term};
use crate::{Edition, Machine};

/// An arrow that the readings of a machine have.
#[derive(Clone, Copy)]
pub(super) struct ShownArrow<'a> {
    machine: &'a Machine,
    pub(super) row: &'a Row,
    /// The first alternative of the guard.
    first: Taken,
}

/// The arrows of a machine, those of one state in the order in which they are evaluated.
pub(super) fn arrows(machine: &Machine) -> impl Iterator<Item = ShownArrow<'_>> {
    AsState::ALL.into_iter().flat_map(|state| machine.arrows(state)).filter_map(move |first| {
        let row = first.row(&machine.edition().rules.table)?;
        let arrow = ShownArrow { machine, row, first };
        (arrow.alternatives().next() == Some(first)).then_some(arrow)
    })
}

impl<'a> ShownArrow<'a> {
    /// The alternatives of the guard that the machine evaluates.
    fn alternatives(self) -> impl Iterator<Item = Taken> {
        self.machine.arrows(self.row.from).filter(move |taken| taken.row == self.first.row)
    }

    /// The terms of these alternatives.
    fn terms(self) -> impl Iterator<Item = &'a Term> {
        let table = &self.machine.edition().rules.table;
        self.alternatives().filter_map(move |taken| taken.term(table))
    }

    /// The guard in the words of the figure, one line for each alternative. A line is broken before more
    /// than `wrap` conditions stand in it.
    pub(super) fn guard(self, wrap: usize) -> Guard<'a> {
        Guard { arrow: self, wrap }
    }
}

/// Displays the guard of an arrow; see [`ShownArrow::guard`].
#[derive(Clone, Copy)]
pub(super) struct Guard<'a> {
    arrow: ShownArrow<'a>,
    wrap: usize,
}

impl fmt::Display for Guard<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, term) in self.arrow.terms().enumerate() {
            if place > 0 {
                f.write_str("\nor ")?;
            }
            for (place, (atom, value)) in term.literals().enumerate() {
                f.write_str(match place {
                    0 => "",
                    n if n % self.wrap == 0 => "\nand ",
                    _ => " and ",
                })?;
                write!(f, "{}", self.arrow.machine.edition().rules.text(atom, value))?;
            }
            if term.section != self.arrow.row.section {
                write!(f, " ({})", term.section)?;
            }
        }
        Ok(())
    }
}

/// Displays the label of an arrow in a diagram: its section, then its guard.
#[derive(Clone, Copy)]
pub(super) struct Label<'a> {
    pub(super) arrow: ShownArrow<'a>,
    pub(super) wrap: usize,
}

impl fmt::Display for Label<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "section {}\n{}", self.arrow.row.section, self.arrow.guard(self.wrap))
    }
}

/// Displays what a diagram is of: the document's version, and the readings that are not the default.
pub(super) struct Title<'a>(pub(super) &'a Machine);

impl fmt::Display for Title<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Edition { document, readings, .. } = self.0.edition();
        write!(f, "Figure 2 of the {document}")?;
        let others = self.0.readings().choices().difference(readings.choices());
        if others.is_empty() {
            return Ok(());
        }
        f.write_str(", read with ")?;
        crate::named::separated(f, " ", others.iter())
    }
}
