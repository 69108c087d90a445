//! What a program may do otherwise than the document says.

use adsdv_spec::mutation::{Change, TermChange, Time};
use adsdv_spec::table::{Row, Table, Term};
use adsdv_spec::{AsState, Choice, Edition, Fault, Reading, Readings};

/// How late an arrow may be, in steps.
pub(crate) const LATEST: u8 = 3;

/// One thing that a program does otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deviation {
    /// Something of Figure 2, of the times or of the thresholds is another.
    Changed(Change),
    /// Two alternatives of an arrow have to hold at once: all instead of any.
    Joined {
        /// The row, as in [`Table::rows`].
        row: usize,
        /// The one alternative, as in [`Row::terms`].
        one: usize,
        /// The other, which comes behind it.
        other: usize,
    },
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
    /// The state machine does not see an input: for it, the input is always at its default.
    Ignores {
        /// The key of the input.
        key: &'static str,
    },
    /// The shutdown circuit is open while an input has this value.
    Opens {
        /// The key of the input.
        key: &'static str,
        /// Its raw value.
        raw: i32,
    },
    /// Other wheels decide whether the vehicle moves.
    Wheels(Wheels),
    /// "Go" counts while it is on, and not only when it is switched on.
    GoLevel,
    /// An edge of "Go" is lost in a step in which the AI Computer's handshake bit is not the VCU's.
    GoNeedsHandshake,
    /// Something is remembered otherwise.
    Remembers(Remembers),
    /// The cause of an emergency that begins in a state is another than it should be.
    Causes {
        /// The state in which the emergency begins.
        from: AsState,
        /// The raw SHUTDOWN_CAUSE that it should have.
        value: i32,
        /// The raw SHUTDOWN_CAUSE that it has instead.
        raw: i32,
    },
    /// Of two causes of an emergency that begins in a state, the one with the greater number counts.
    Prefers {
        /// The state in which the emergency begins.
        from: AsState,
        /// The raw SHUTDOWN_CAUSE that it should have.
        value: i32,
        /// The greater one that it has where this arises as well.
        raw: i32,
    },
    /// A question that the document leaves open is answered so, and not by default: an observation, and no mistake.
    Reads(Choice),
    /// An output has this value in a state, whatever it should be.
    Shows {
        /// The state.
        state: AsState,
        /// The key of the output.
        key: &'static str,
        /// Its raw value.
        raw: i32,
    },
    /// An output has another value in the place of one of its values, in any state: another number in an enumeration, or one
    /// that is not in it.
    Writes {
        /// The key of the output.
        key: &'static str,
        /// The raw value that it should have.
        value: i32,
        /// The raw value that it has instead.
        raw: i32,
    },
}

/// What is remembered otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remembers {
    /// The cause of an emergency is forgotten when EMERGENCY_BRAKE is left.
    CauseUntilLeft,
    /// The cause of an emergency is that of the latest fault that opens the shutdown circuit, and not of the first.
    LatestCause,
    /// The time in AS_READY goes on where it was when AS_READY was left, and does not begin again.
    DwellOfAllVisits,
    /// The EBS timer runs only while the AS master switch is off, and begins again when it is switched on.
    TimerWhileAsmsOff,
    /// "Go" that was seen off counts as seen off for as long as AS_READY lasts.
    GoSeenOff,
    /// AI_COMMS_LOST, once it is raised, stays while the handshake is performed.
    CommsLost,
    /// AI_COMMS_LOST, once it is raised, stays until the power goes off, also where the handshake rests.
    CommsLostForGood,
    /// The handshake stands still while the tractive system is off, and goes on from there; it does not rest.
    Handshake,
    /// The bit of the handshake stays as it was while the tractive system is off; what comes then begins as it should.
    HandshakeBit,
    /// The handshake begins with the bit 1 whatever the AI Computer's bit is, which is not looked at in that step.
    HandshakeBeginsWithOne,
    /// A flag of a fault ends with the fault, also while SHUTDOWN_CAUSE names it.
    LiveFlags,
    /// The step in which the handshake begins counts as time without an answer.
    TimeBeforeHandshake,
}

impl Remembers {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::CauseUntilLeft,
        Self::LatestCause,
        Self::DwellOfAllVisits,
        Self::TimerWhileAsmsOff,
        Self::GoSeenOff,
        Self::CommsLost,
        Self::CommsLostForGood,
        Self::Handshake,
        Self::HandshakeBit,
        Self::HandshakeBeginsWithOne,
        Self::LiveFlags,
        Self::TimeBeforeHandshake,
    ];

    /// Whether both are about the same thing in the same situation.
    fn is_instead_of(self, other: Self) -> bool {
        let either = |one, two| self == one && other == two || self == two && other == one;
        self == other
            || either(Self::Handshake, Self::HandshakeBit)
            || either(Self::CommsLost, Self::CommsLostForGood)
    }
}

/// The wheels that tell whether the vehicle moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wheels {
    /// It moves only if all wheels turn.
    All,
    /// Only this wheel counts, in the order of the message.
    Only(u8),
    /// Only the front wheels count.
    Front,
    /// Only the rear wheels count.
    Rear,
    /// The mean of all wheels counts, in whole rpm.
    Mean,
}

impl Wheels {
    /// All of them.
    pub const EACH: [Self; 8] = [
        Self::All,
        Self::Only(0),
        Self::Only(1),
        Self::Only(2),
        Self::Only(3),
        Self::Front,
        Self::Rear,
        Self::Mean,
    ];

    /// The speed that counts, of these in the order of the message.
    pub(crate) fn counted(self, speeds: [i32; 4]) -> i32 {
        let [front_left, front_right, rear_left, rear_right] = speeds;
        match self {
            Self::All => speeds.into_iter().min().unwrap_or_default(),
            Self::Only(wheel) => speeds.get(usize::from(wheel)).copied().unwrap_or_default(),
            Self::Front => front_left.max(front_right),
            Self::Rear => rear_left.max(rear_right),
            Self::Mean => speeds.into_iter().sum::<i32>() / 4,
        }
    }

    /// Whether it looks at a wheel, by its place in the message.
    pub(crate) fn looks_at(self, wheel: usize) -> bool {
        match self {
            Self::All | Self::Mean => true,
            Self::Only(own) => usize::from(own) == wheel,
            Self::Front => wheel < 2,
            Self::Rear => wheel >= 2,
        }
    }
}

impl Deviation {
    /// Whether it changes what is remembered by what is shown. Of outputs only a few tell that.
    pub(crate) fn tells_what_is_remembered(&self) -> bool {
        match *self {
            Self::Shows { key, .. } | Self::Writes { key, .. } => {
                matches!(key, "as_state" | "shutdown_cause")
            }
            _ => true,
        }
    }

    /// Whether the cause that is shown in an emergency is not the one that is remembered.
    pub(crate) fn hides_the_cause(&self) -> bool {
        match *self {
            Self::Shows { state, key, .. } => state == AsState::EmergencyBrake && key == "shutdown_cause",
            Self::Writes { key, .. } => key == "shutdown_cause",
            _ => false,
        }
    }

    /// Whether it is about what the flag of a fault shows.
    pub(crate) fn is_about_a_flag(&self) -> bool {
        match *self {
            Self::Shows { key, .. } | Self::Writes { key, .. } => {
                Fault::ALL.iter().any(|fault| fault.flag().eq_ignore_ascii_case(key))
            }
            _ => false,
        }
    }

    /// Whether it changes what is shown where the states are as they should be.
    pub(crate) const fn is_about_outputs(&self) -> bool {
        matches!(
            self,
            Self::Changed(Change::Term(_, _, TermChange::FaultDropped))
                | Self::Remembers(_)
                | Self::Causes { .. }
                | Self::Prefers { .. }
                | Self::Shows { .. }
                | Self::Writes { .. }
        )
    }

    /// The arrow that it is about, of the document or of its own.
    pub(crate) fn arrow(&self, edition: &Edition) -> Option<(AsState, AsState)> {
        match *self {
            Self::Changed(
                Change::RowDropped(row)
                | Change::RowLeadsTo(row, _)
                | Change::RowFirst(row)
                | Change::Term(row, ..),
            )
            | Self::Joined { row, .. } => edition.rules.table.rows().get(row).map(|row| (row.from, row.to)),
            Self::Needs { from, to, .. } | Self::Also { from, to, .. } | Self::Late { from, to, .. } => {
                Some((from, to))
            }
            Self::Causes { from, .. } | Self::Prefers { from, .. } => Some((from, AsState::EmergencyBrake)),
            _ => None,
        }
    }

    /// Whether both are about the same number, value, or way of an arrow, so that only one of them can be.
    pub(crate) fn is_instead_of(&self, other: &Self) -> bool {
        match (*self, *other) {
            (Self::Changed(Change::Time(one, _)), Self::Changed(Change::Time(other, _))) => one == other,
            (Self::Changed(Change::Threshold(one, _)), Self::Changed(Change::Threshold(other, _))) => {
                one == other
            }
            (Self::Changed(Change::RowLeadsTo(one, _)), Self::Changed(Change::RowLeadsTo(other, _))) => {
                one == other
            }
            (Self::Late { from, to, .. }, Self::Late { from: other, to: leads, .. }) => {
                (from, to) == (other, leads)
            }
            (Self::Shows { state, key, .. }, Self::Shows { state: other, key: field, .. }) => {
                (state, key) == (other, field)
            }
            (Self::Writes { key, value, .. }, Self::Writes { key: field, value: other, .. }) => {
                (key, value) == (field, other)
            }
            (Self::Causes { from, value, .. }, Self::Causes { from: other, value: of, .. }) => {
                (from, value) == (other, of)
            }
            (Self::Reads(one), Self::Reads(other)) => one.reading() == other.reading(),
            (Self::Wheels(_), Self::Wheels(_)) => true,
            // What is seen nowhere is not needed anywhere.
            (Self::Ignores { key }, Self::Needs { key: other, .. })
            | (Self::Needs { key, .. }, Self::Ignores { key: other }) => key == other,
            (Self::Remembers(one), Self::Remembers(other)) => one.is_instead_of(other),
            _ => false,
        }
    }

    /// Whether it is about what is remembered while a time passes, so that what this time is depends on it.
    pub(crate) fn is_measured_with(&self, time: &Self) -> bool {
        let Self::Changed(Change::Time(time, _)) = time else { return false };
        match time {
            Time::ReadyDwell => match self {
                Self::Reads(choice) => choice.reading() == Reading::GoEdge,
                Self::GoLevel | Self::GoNeedsHandshake => true,
                Self::Remembers(what) => {
                    matches!(what, Remembers::DwellOfAllVisits | Remembers::GoSeenOff)
                }
                _ => false,
            },
            Time::EbsTimer => *self == Self::Remembers(Remembers::TimerWhileAsmsOff),
            Time::Handshake => matches!(
                self,
                Self::Remembers(
                    Remembers::CommsLost
                        | Remembers::CommsLostForGood
                        | Remembers::Handshake
                        | Remembers::HandshakeBit
                        | Remembers::HandshakeBeginsWithOne
                        | Remembers::TimeBeforeHandshake
                )
            ),
        }
    }

    /// Whether it only makes that an arrow is taken less often.
    pub(crate) const fn takes_away(&self) -> bool {
        matches!(
            self,
            Self::Changed(Change::RowDropped(_) | Change::Term(_, _, TermChange::Dropped))
                | Self::Joined { .. }
                | Self::Needs { .. }
        )
    }

    /// The state in which alone it makes a difference; `None` if that may be any. What an output shows counts as of any.
    pub(crate) fn state(&self, edition: &Edition) -> Option<AsState> {
        match *self {
            Self::Reads(choice) => match choice.reading() {
                Reading::ReadyPriority | Reading::GoEdge => Some(AsState::Ready),
                Reading::DrivingPriority => Some(AsState::Driving),
                Reading::FinishedPriority => Some(AsState::Finished),
                _ => None,
            },
            Self::Changed(Change::Time(Time::ReadyDwell, _))
            | Self::GoLevel
            | Self::GoNeedsHandshake
            | Self::Remembers(Remembers::DwellOfAllVisits | Remembers::GoSeenOff) => Some(AsState::Ready),
            Self::Changed(Change::Time(Time::EbsTimer, _)) => Some(AsState::EmergencyBrake),
            _ => self.arrow(edition).map(|(from, _)| from),
        }
    }

    /// The answer to a question that the document leaves open, if it is one.
    pub const fn choice(&self) -> Option<Choice> {
        match *self {
            Self::Reads(choice) => Some(choice),
            _ => None,
        }
    }
}

/// The edition with all changes of its rules. A change names rows and terms by their places in the document, so that what moves
/// them comes last.
pub(crate) fn changed(edition: &Edition, deviations: &[Deviation]) -> Edition {
    enum OfRules {
        Change(Change),
        Joined(usize, usize, usize),
    }
    let choices = deviations.iter().filter_map(Deviation::choice);
    let edition = &Edition { readings: choices.fold(edition.readings, Readings::with), ..*edition };
    let mut changes: Vec<((u8, usize, usize), OfRules)> = deviations
        .iter()
        .filter_map(|deviation| match *deviation {
            Deviation::Changed(change) => {
                let order = match change {
                    Change::RowLeadsTo(..) | Change::Time(..) | Change::Threshold(..) => (0, 0, 0),
                    Change::Term(row, term, TermChange::Dropped) => (3, row, usize::MAX - term),
                    Change::Term(row, term, _) => (1, row, term),
                    Change::RowFirst(_) | Change::RowDropped(_) => return None,
                };
                Some((order, OfRules::Change(change)))
            }
            Deviation::Joined { row, one, other } => Some(((2, row, one), OfRules::Joined(row, one, other))),
            _ => None,
        })
        .collect();
    changes.sort_by_key(|(order, _)| *order);
    let edition = changes.iter().fold(*edition, |edition, (_, change)| match change {
        OfRules::Change(change) => change.apply(&edition),
        OfRules::Joined(row, one, other) => joined(&edition, *row, *one, *other),
    });
    in_order(&edition, deviations)
}

/// The edition with the rows that come first before those that they stand behind in the document, and without those that are
/// dropped.
fn in_order(edition: &Edition, deviations: &[Deviation]) -> Edition {
    let rows = edition.rules.table.rows();
    let mut order: Vec<usize> = (0..rows.len()).collect();
    let firsts = |place: &usize| deviations.contains(&Deviation::Changed(Change::RowFirst(*place)));
    for row in (1..rows.len()).filter(firsts) {
        order.retain(|own| *own != row);
        let before = order.iter().position(|own| *own + 1 == row).unwrap_or(order.len());
        order.insert(before, row);
    }
    order.retain(|row| !deviations.contains(&Deviation::Changed(Change::RowDropped(*row))));
    if order.iter().copied().eq(0..rows.len()) {
        return *edition;
    }
    let rows: Vec<Row> = order.iter().filter_map(|row| rows.get(*row).copied()).collect();
    edition.with_table(Table::new(&rows))
}

/// The edition with two alternatives of a row that have to hold at once. Both places stay, so that others are named as before: the
/// one is both, and so is the other.
fn joined(edition: &Edition, row: usize, one: usize, other: usize) -> Edition {
    let rows: Vec<Row> = edition.rules.table.rows().to_vec();
    let join = |row: &Row| {
        let terms = row.terms();
        let (Some(first), Some(second)) = (terms.get(one), terms.get(other)) else { return *row };
        let (on, off) = (first.on.union(second.on), first.off.union(second.off));
        let terms: Vec<Term> = terms
            .iter()
            .enumerate()
            .map(
                |(place, term)| {
                    if place == one || place == other { Term { on, off, ..*term } } else { *term }
                },
            )
            .collect();
        Row::new(row.from, row.to, row.section, &terms).cites(row.cites)
    };
    let rows: Vec<Row> =
        rows.iter().enumerate().map(|(place, own)| if place == row { join(own) } else { *own }).collect();
    edition.with_table(Table::new(&rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A deviation names a row by its place in the document, whatever the others do with the rows.
    #[test]
    fn rows_are_named_by_their_places_in_the_document() {
        let edition = &Edition::V3_0;
        let first = |row| Deviation::Changed(Change::RowFirst(row));
        let rows = |deviations: &[Deviation]| changed(edition, deviations).rules.table.rows().to_vec();
        let usual = edition.rules.table.rows();
        let without: Vec<Row> = usual.iter().copied().filter(|row| *row != usual[3]).collect();
        assert_eq!(rows(&[first(3), Deviation::Changed(Change::RowDropped(3))]), without);
        let both = [&usual[..1], &[usual[3], usual[2], usual[1]], &usual[4..]].concat();
        assert_eq!(rows(&[first(3), first(2)]), both);
        assert_eq!(rows(&[first(2), first(3)]), both);
    }
}
