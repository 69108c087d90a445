//! What an AI Computer has sent and done so far: what its requirements were exercised by.

use std::collections::BTreeSet;

use adsdv_spec::Edition;
use adsdv_spec::messages::{AsState, Frame, Node};

use crate::look::Look;

/// The counts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// The identifiers under which it sent something.
    pub(crate) ids: BTreeSet<u16>,
    /// The fields of its messages that were not always 0.
    pub(crate) fields: BTreeSet<&'static str>,
    /// Whether it moved the vehicle in AS_DRIVING.
    pub(crate) moved: bool,
}

impl Tally {
    pub(crate) fn frame(&mut self, edition: &Edition, frame: &Frame) {
        self.ids.insert(frame.id);
        let Some(def) = edition.bus.message(frame.id).filter(|def| def.sender == Node::Ai) else { return };
        let used = def.signals.iter().filter(|signal| signal.raw(frame.data()).is_some_and(|raw| raw != 0));
        self.fields.extend(used.map(|signal| signal.field));
    }

    pub(crate) fn look(&mut self, look: &Look) {
        self.moved |= look.is(AsState::Driving) && look.is_moving();
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.ids.extend(&other.ids);
        self.fields.extend(&other.fields);
        self.moved |= other.moved;
    }
}
