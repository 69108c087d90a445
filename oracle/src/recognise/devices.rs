//! The messages of the vehicle's devices: only the databases of some editions name them.

use std::collections::BTreeMap;

use adsdv_spec::Edition;

use super::fact::{Fact, weight};

/// Which of the devices' messages were seen.
#[derive(Debug)]
pub(super) struct Devices {
    editions: &'static [&'static Edition],
    /// Each message that only is one of a device, by identifier: whether a frame of its length came.
    seen: BTreeMap<u16, bool>,
}

impl Devices {
    pub(super) fn new(editions: &'static [&'static Edition]) -> Self {
        let of_sides = |id: u16| editions.iter().any(|edition| edition.bus.message(id).is_some());
        let ids = editions.iter().flat_map(|edition| edition.bus.devices).map(|message| message.id);
        Self { editions, seen: ids.filter(|&id| !of_sides(id)).map(|id| (id, false)).collect() }
    }

    /// A frame came that is of neither side. One of another length than the device's is of somebody else.
    pub(super) fn frame(&mut self, id: u16, len: usize) {
        let Some(seen) = self.seen.get_mut(&id).filter(|seen| !**seen) else { return };
        let mut messages = self.editions.iter().filter_map(|edition| edition.bus.device(id));
        *seen = messages.any(|message| usize::from(message.len) == len);
    }

    /// All that were seen as one fact: a vehicle of another edition may have devices too, of which its database tells nothing.
    pub(super) fn fact(&self) -> Option<Fact> {
        let ids: Vec<u16> = self.seen.iter().filter(|(_, seen)| **seen).map(|(id, _)| *id).collect();
        let names: Vec<String> = ids.iter().map(|id| format!("{id:03X}h")).collect();
        let text = match names.split_last()? {
            (only, []) => format!("{only} is there"),
            (last, rest) => format!("{} and {last} are there", rest.join(", ")),
        };
        let lacks = |edition: &&Edition| ids.iter().any(|&id| edition.bus.device(id).is_none());
        let instead = self.editions.iter().map(|edition| lacks(edition).then(|| "no such device".to_owned()));
        Some(Fact { text, instead: instead.collect(), weight: weight::DEVICE })
    }
}
