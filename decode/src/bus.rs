//! The one interface that formats without a column for it are about.

use crate::{Frame, Origin};

/// The first interface that carries a message of the edition: the one that the judge would judge.
#[derive(Debug, Default)]
pub(crate) struct Bus {
    name: Option<String>,
}

impl Bus {
    /// Its name, as soon as it is known.
    pub(crate) fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Whether the frame is on it. One that comes before it is known decides if it is of the edition, and is on it otherwise.
    pub(crate) fn has(&mut self, frame: &Frame<'_>) -> bool {
        if let Some(name) = &self.name {
            return *name == frame.record.interface;
        }
        if frame.message.is_some_and(|(_, message)| message.origin == Origin::Edition) {
            self.name = Some(frame.record.interface.to_owned());
        }
        true
    }
}
