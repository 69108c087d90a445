//! What comes again and again, and is told now and then.

use std::mem::{Discriminant, discriminant};

use crate::bus::Disturbance;

/// It is told once in so many milliseconds. It is counted every time.
pub(super) const TOLD_EVERY_MS: u64 = 1000;

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
    /// What is told of how the bus stands.
    pub(super) fn of(trouble: Option<&Disturbance>) -> Self {
        trouble.map_or(Self::Up, |trouble| Self::Disturbance(discriminant(trouble)))
    }
}

/// When each was told last. There are as many as notes, which are few.
#[derive(Clone, Debug, Default)]
pub(super) struct LastNotes(Vec<(Note, u64)>);

impl LastNotes {
    /// Whether it is time to tell this, which then counts as told. The time is in milliseconds.
    pub(super) fn may(&mut self, note: Note, now: u64) -> bool {
        match self.0.iter_mut().find(|(told, _)| *told == note) {
            Some((_, last)) if now < last.saturating_add(TOLD_EVERY_MS) => return false,
            Some((_, last)) => *last = now,
            None => self.0.push((note, now)),
        }
        true
    }
}
