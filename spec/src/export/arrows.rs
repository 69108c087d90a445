//! What the three prints of Figure 2 have in common: which arrows there are, and how a guard reads.

use core::fmt;

use crate::messages::AsState;
use crate::readings::Readings;
use crate::table::{PRIORITIES, Row, Term};
use crate::{Interface, Machine};

/// An arrow that the readings of a machine have.
#[derive(Clone, Copy)]
pub(super) struct Arrow<'a> {
    pub(super) row: &'a Row,
    readings: Readings,
}

/// The arrows of a machine, those of one state in the order in which they are evaluated.
pub(super) fn arrows(machine: &Machine) -> impl Iterator<Item = Arrow<'_>> {
    let readings = machine.readings();
    AsState::ALL.into_iter().flat_map(move |state| {
        let rows = machine.interface().table.rows().iter().filter(move |row| row.from == state);
        let overtakes = move |row: &Row| {
            PRIORITIES.iter().any(|priority| {
                readings.is(priority.choice) && (priority.from, priority.first) == (row.from, row.to)
            })
        };
        let first = rows.clone().filter(move |row| overtakes(row));
        first
            .chain(rows.filter(move |row| !overtakes(row)))
            .map(move |row| Arrow { row, readings })
            .filter(|arrow| arrow.terms().next().is_some())
    })
}

impl<'a> Arrow<'a> {
    /// The alternatives of the guard that the readings have.
    fn terms(self) -> impl Iterator<Item = &'a Term> {
        let choices = self.readings.choices();
        self.row.terms().iter().filter(move |term| term.readings.is_subset(choices))
    }

    /// The guard in the words of the figure, one line for each alternative. A line is broken before more
    /// than `wrap` conditions stand in it.
    pub(super) fn guard(self, wrap: usize) -> Guard<'a> {
        Guard { arrow: self, wrap }
    }
}

/// Displays the guard of an arrow; see [`Arrow::guard`].
pub(super) struct Guard<'a> {
    arrow: Arrow<'a>,
    wrap: usize,
}

impl fmt::Display for Guard<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, term) in self.arrow.terms().enumerate() {
            if place > 0 {
                f.write_str("\nor ")?;
            }
            for (place, (atom, value)) in term.conditions().enumerate() {
                f.write_str(match place {
                    0 => "",
                    n if n % self.wrap == 0 => "\nand ",
                    _ => " and ",
                })?;
                f.write_str(atom.text(value))?;
            }
            if term.clause != self.arrow.row.clause {
                write!(f, " ({})", term.clause)?;
            }
        }
        Ok(())
    }
}

/// Displays the label of an arrow in a diagram: its section, then its guard.
pub(super) struct Label<'a> {
    pub(super) arrow: Arrow<'a>,
    pub(super) wrap: usize,
}

impl fmt::Display for Label<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "section {}\n{}", self.arrow.row.clause, self.arrow.guard(self.wrap))
    }
}

/// Displays what a diagram is of: the document's version, and the readings that are not the default.
pub(super) struct Title<'a>(pub(super) &'a Machine);

impl fmt::Display for Title<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Interface { version, .. } = self.0.interface();
        write!(f, "Figure 2 of the ADS-DV Software Interface Specification {version}")?;
        let readings = self.0.readings();
        if readings == Readings::DEFAULT { Ok(()) } else { write!(f, ", read with {readings}") }
    }
}
