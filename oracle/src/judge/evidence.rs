//! The frames that show a finding.

use adsdv_spec::Atoms;

use super::finding::Evidence;
use super::sampler::Sampler;
use super::sampler::places::{COUNT, STATUS};
use super::sampler::slot::Slot;

/// When the last frame of each message came, up to some time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frames([Option<i64>; COUNT]);

impl Sampler {
    /// The last frames up to now.
    pub(super) fn frames(&self) -> Frames {
        Frames(std::array::from_fn(|index| self.last(index)))
    }

    /// Of these frames those that decide conditions, and 520h, which shows the state.
    pub(super) fn deciding_frames(&self, frames: &Frames, atoms: Atoms) -> Vec<Evidence> {
        self.evidence(self.deciding_slots(atoms).map(|(index, _)| (index, frames)))
    }

    /// The last frames of these messages, in order of time.
    pub(super) fn last_frames(&self, indexes: &[usize]) -> Vec<Evidence> {
        let now = self.frames();
        self.evidence(indexes.iter().map(|&index| (index, &now)))
    }

    /// Of these frames those of these messages, in order of time.
    pub(super) fn frames_of(&self, frames: &Frames, indexes: &[usize]) -> Vec<Evidence> {
        self.evidence(indexes.iter().map(|&index| (index, frames)))
    }

    fn evidence<'a>(&self, these: impl Iterator<Item = (usize, &'a Frames)>) -> Vec<Evidence> {
        let one = |(index, Frames(frames)): (usize, &Frames)| {
            Some(Evidence { t_ns: (*frames.get(index)?)?, id: self.id(index)? })
        };
        let mut evidence: Vec<Evidence> = these.filter_map(one).collect();
        evidence.sort_by_key(|frame| (frame.t_ns, frame.id));
        evidence
    }

    /// The messages that decide these conditions, and 520h, which shows the state.
    pub(super) fn deciding_slots(&self, atoms: Atoms) -> impl Iterator<Item = (usize, &Slot)> {
        let slots = self.slots.iter().enumerate();
        slots.filter(move |&(index, _)| index == STATUS || !self.scope(index).intersection(atoms).is_empty())
    }
}
