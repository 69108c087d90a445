//! What comes again and again, and is reported now and then.

use std::mem::{Discriminant, discriminant};

use crate::bus::Disturbance;

/// It is reported once in so many milliseconds. It is counted every time.
pub(super) const REPORT_EVERY_MS: u64 = 1000;

/// What comes again and again, and of which identifier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Note {
    Refused(u16),
    Foreign,
    Error,
    Late,
    Dropped,
    Up,
    Disturbance(Discriminant<Disturbance>),
}

impl Note {
    /// The note that says how the bus stands.
    pub(super) fn of(trouble: Option<&Disturbance>) -> Self {
        trouble.map_or(Self::Up, |trouble| Self::Disturbance(discriminant(trouble)))
    }
}

/// When each was reported last. There are as many as notes, which are few.
#[derive(Clone, Debug, Default)]
pub(super) struct LastNotes(Vec<(Note, u64)>);

impl LastNotes {
    /// Whether it is time to report this, which then counts as reported. The time is in milliseconds.
    pub(super) fn may(&mut self, note: Note, now: u64) -> bool {
        match self.0.iter_mut().find(|(noted, _)| *noted == note) {
            Some((_, last)) if now < last.saturating_add(REPORT_EVERY_MS) => return false,
            Some((_, last)) => *last = now,
            None => self.0.push((note, now)),
        }
        true
    }
}
