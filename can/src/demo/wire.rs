//! A bus in simulated time: frames take their time, one after the other, and the lowest identifier goes first.

use adsdv_spec::messages::Frame;

/// Who sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// The VCU, or what is on its side of the bus.
    Vcu,
    /// The AI Computer.
    Ai,
}

/// A frame that waits for the bus.
#[derive(Clone, Copy, Debug)]
struct QueuedFrame {
    /// Since when, in nanoseconds.
    since: i64,
    from: Node,
    frame: Frame,
}

/// The bus.
#[derive(Debug)]
pub struct Wire {
    bit_ns: i64,
    waiting: Vec<QueuedFrame>,
    /// When the bus is free again.
    free_at: i64,
}

impl Wire {
    /// A free bus of so many bits per second.
    pub fn new(bit_rate: i64) -> Self {
        let bit_ns = 1_000_000_000_i64.checked_div(bit_rate).unwrap_or_default();
        Self { bit_ns, waiting: Vec::new(), free_at: 0 }
    }

    /// Hands frames over to be sent from this time on.
    pub fn send(&mut self, since: i64, from: Node, frames: Vec<Frame>) {
        self.waiting.extend(frames.into_iter().map(|frame| QueuedFrame { since, from, frame }));
    }

    /// How many frames of a node wait for the bus.
    pub fn waiting(&self, of: Node) -> usize {
        self.waiting.iter().filter(|waiting| waiting.from == of).count()
    }

    /// The next frame that is complete on the bus at `until` at the latest, and when it is.
    ///
    /// Nothing may be sent before `until` afterwards: it might have gone first.
    pub fn complete(&mut self, until: i64) -> Option<(i64, Node, Frame)> {
        let earliest = self.waiting.iter().map(|waiting| waiting.since).min()?;
        let begins = earliest.max(self.free_at);
        let contends = |(_, waiting): &(usize, &QueuedFrame)| waiting.since <= begins;
        // A node that has several frames of one identifier sends the oldest first.
        let waiting = self.waiting.iter().enumerate().filter(contends);
        let (place, next) = waiting.min_by_key(|(_, waiting)| (waiting.frame.id, waiting.since))?;
        let QueuedFrame { from, frame, .. } = *next;
        let ends = begins.saturating_add(i64::from(bits(&frame)) * self.bit_ns);
        if ends > until {
            return None;
        }
        self.waiting.remove(place);
        self.free_at = ends;
        Some((ends, from, frame))
    }
}

/// How many bits a frame takes at most, the pause behind it included (ISO 11898-1): 47 bits that are not data, and in what is
/// stuffed, which is 34 of these and the data, one more for each 4 after the first.
fn bits(frame: &Frame) -> u32 {
    let data = 8 * u32::from(frame.len.min(8));
    47 + data + (34 + data - 1) / 4
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(id: u16, len: usize) -> Frame {
        Frame::new(id, &[0; 8][..len]).expect("a frame")
    }

    #[test]
    fn frames_take_their_time() {
        assert_eq!([0, 1, 8].map(|len| bits(&frame(0x510, len))), [55, 65, 135]);
        let mut wire = Wire::new(500_000);
        wire.send(1000, Node::Vcu, vec![frame(0x520, 8)]);
        assert_eq!(wire.complete(270_999).map(|(t, ..)| t), None);
        assert_eq!(wire.complete(271_000).map(|(t, ..)| t), Some(271_000));
        assert_eq!(wire.complete(i64::MAX).map(|(t, ..)| t), None);
    }

    #[test]
    fn the_lowest_identifier_of_those_that_wait_goes_first() {
        let mut wire = Wire::new(500_000);
        wire.send(0, Node::Vcu, vec![frame(0x526, 8), frame(0x520, 8)]);
        // It comes while another is on the bus.
        wire.send(100, Node::Ai, vec![frame(0x510, 8)]);
        let order: Vec<_> =
            std::iter::from_fn(|| wire.complete(1_000_000)).map(|(t, _, f)| (t, f.id)).collect();
        assert_eq!(order, [(270_000, 0x520), (540_000, 0x510), (810_000, 0x526)]);
    }

    #[test]
    fn two_frames_of_one_identifier_keep_their_order() {
        let mut wire = Wire::new(500_000);
        // Both wait behind another.
        wire.send(0, Node::Ai, vec![frame(0x510, 8)]);
        wire.send(5, Node::Vcu, vec![frame(0x520, 1)]);
        wire.send(10, Node::Vcu, vec![frame(0x520, 2)]);
        let order: Vec<_> = std::iter::from_fn(|| wire.complete(1_000_000)).map(|(_, _, f)| f.len).collect();
        assert_eq!(order, [8, 1, 2]);
    }

    #[test]
    fn frames_that_are_handed_over_together_are_all_sent() {
        let mut wire = Wire::new(500_000);
        wire.send(0, Node::Ai, vec![frame(0x510, 1), frame(0x510, 2), frame(0x510, 3)]);
        assert_eq!((wire.waiting(Node::Ai), wire.waiting(Node::Vcu)), (3, 0));
        let order: Vec<_> = std::iter::from_fn(|| wire.complete(1_000_000)).map(|(_, _, f)| f.len).collect();
        assert_eq!(order, [1, 2, 3]);
    }
}
