//! The bus: real frames that have been sent and have not arrived yet.

use adsdv_spec::AiMessages;
use adsdv_spec::messages::Frame;

/// How many messages a sender has that matter to the other one: those of the AI Computer, and as many of the VCU, which are
/// 520h, 521h, 522h, 524h and 525h.
const MESSAGES: usize = AiMessages::IDS.len();

/// Both directions of the bus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bus {
    /// Frames of the VCU.
    pub to_ai: WaitingFrames,
    /// Frames of the AI Computer.
    pub to_vcu: WaitingFrames,
}

/// The frames of one sender that wait on the bus: one for each identifier, the lowest first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct WaitingFrames {
    waiting: [Option<Frame>; MESSAGES],
    /// Frames have been waiting since before the VCU's last step.
    old: bool,
}

impl WaitingFrames {
    /// Sends frames, one for each identifier: they replace those that wait. Frames without news are left out.
    pub(super) fn send(&mut self, frames: [Option<Frame>; MESSAGES], is_news: impl Fn(&Frame) -> bool) {
        self.waiting = frames.map(|frame| frame.filter(&is_news));
        self.old &= !self.is_empty();
    }

    /// Takes the frame that arrives next.
    pub(super) fn next(&mut self) -> Option<Frame> {
        let frame = self.waiting.iter_mut().find_map(Option::take);
        self.old &= !self.is_empty();
        frame
    }

    /// A cycle of the VCU ends: what waits now has to arrive before the next one does.
    pub(super) fn a_cycle_ends(&mut self) {
        self.old = !self.is_empty();
    }

    /// Whether something has to arrive before the VCU's next step.
    pub const fn is_overdue(&self) -> bool {
        self.old
    }

    /// Whether nothing waits.
    pub fn is_empty(&self) -> bool {
        self.waiting.iter().all(Option::is_none)
    }

    /// What waits, for each identifier.
    pub(super) const fn each(&self) -> [Option<Frame>; MESSAGES] {
        self.waiting
    }

    /// The frames that wait, in the order in which they arrive.
    pub fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.waiting.iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::{Frame, MESSAGES, WaitingFrames};

    fn frames(byte: u8) -> [Frame; MESSAGES] {
        [0x520, 0x521, 0x522, 0x524, 0x525].map(|id| Frame::new(id, &[byte]).expect("a frame"))
    }

    #[test]
    fn the_lowest_identifier_arrives_first_and_newer_frames_replace_older_ones() {
        let mut line = WaitingFrames::default();
        line.send(frames(1).map(Some), |frame| frame.id != 0x521);
        assert_eq!(line.next().map(|frame| frame.id), Some(0x520));
        line.send(frames(2).map(Some), |frame| frame.id == 0x524);
        assert_eq!(
            (line.next(), line.next()),
            (Some(frames(2)[3]), None),
            "what is no news any more is gone"
        );
    }

    #[test]
    fn what_waits_when_a_cycle_ends_has_to_arrive_before_the_next_one_does() {
        let mut line = WaitingFrames::default();
        line.a_cycle_ends();
        line.send(frames(1).map(Some), |frame| frame.id == 0x520);
        assert!(!line.is_overdue(), "it was sent in this cycle");
        line.a_cycle_ends();
        line.send(frames(2).map(Some), |frame| frame.id == 0x520);
        assert!(line.is_overdue(), "a newer frame does not take more time");
        line.next();
        assert!(!line.is_overdue() && line.is_empty());
    }
}
