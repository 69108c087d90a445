//! What a program may do otherwise than the document says.

use adsdv_spec::mutation::{Change, TermChange, Threshold, Time};
use adsdv_spec::{AsState, Edition};

/// One thing that a program does otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deviation {
    /// Something of Figure 2, of the times or of the thresholds is another.
    Changed(Change),
    /// An arrow is taken only where an input has this value, or only where it has not.
    Needs {
        /// Where the arrow begins.
        from: AsState,
        /// Where it leads.
        to: AsState,
        /// The key of the input, as in the protocol.
        key: &'static str,
        /// Its raw value.
        raw: i32,
        /// Whether it has to be that value.
        is: bool,
    },
    /// A state is left as soon as an input has this value, where no arrow of the document is open.
    Also {
        /// The state.
        from: AsState,
        /// Where it goes.
        to: AsState,
        /// The key of the input.
        key: &'static str,
        /// Its raw value.
        raw: i32,
    },
    /// An arrow is taken so many steps after it could be.
    Late {
        /// Where the arrow begins.
        from: AsState,
        /// Where it leads.
        to: AsState,
        /// How many steps.
        steps: u8,
    },
    /// Whether the vehicle moves is told by other wheels.
    Wheels(Wheels),
    /// "Go" counts while it is on, and not only when it is switched on.
    GoLevel,
    /// An edge of "Go" is lost in a step in which the AI Computer's handshake bit is not the VCU's.
    GoNeedsHandshake,
    /// An output has this value in a state, whatever it should be.
    Shows {
        /// The state.
        state: AsState,
        /// The key of the output.
        key: &'static str,
        /// Its raw value.
        raw: i32,
    },
}

/// The wheels that tell whether the vehicle moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wheels {
    /// It moves only if all wheels turn.
    All,
    /// Only this wheel counts, in the order of the message.
    Only(u8),
}

impl Deviation {
    /// Every deviation from an edition that is looked for, with a few numbers for those that have one.
    pub fn every(edition: &Edition) -> Vec<Self> {
        let mut all = crate::candidates::all(edition);
        let times =
            [Time::ReadyDwell, Time::EbsTimer, Time::Handshake].map(|time| move |by| Change::Time(time, by));
        all.extend(times.iter().flat_map(|time| [-7, 1, 450].map(|by| Self::Changed(time(by)))));
        let missed = edition.rules.thresholds.missed_ms.map(|_| Threshold::Missed);
        let thresholds = [Threshold::WheelSpeed, Threshold::Straight].into_iter().chain(missed);
        all.extend(
            thresholds.flat_map(|one| [-3, 1, 20].map(|by| Self::Changed(Change::Threshold(one, by)))),
        );
        all
    }
}

/// The edition with all changes of its rules. A change names rows and terms by their places, so that what moves them comes last.
pub(crate) fn changed(edition: &Edition, deviations: &[Deviation]) -> Edition {
    let mut changes: Vec<Change> = deviations
        .iter()
        .filter_map(|deviation| match deviation {
            Deviation::Changed(change) => Some(*change),
            _ => None,
        })
        .collect();
    changes.sort_by_key(|change| match *change {
        Change::RowLeadsTo(..) | Change::Time(..) | Change::Threshold(..) => (0, 0, 0),
        Change::Term(row, term, TermChange::Dropped) => (2, row, usize::MAX - term),
        Change::Term(row, term, _) => (1, row, term),
        Change::RowFirst(row) => (3, row, 0),
        Change::RowDropped(row) => (4, usize::MAX - row, 0),
    });
    { changes }.iter().fold(*edition, |edition, change| change.apply(&edition))
}
