//! A frame that the host sent and heard is one frame: where its kernel loops frames back, a recording has them on both topics of a bus.

use std::collections::VecDeque;

use adsdv_oracle::candump::{Direction, FrameKind};

use super::message::McapFrame;

/// Between the two is how long a frame waits for the bus, and for the programs that record it.
const APART_NS: i64 = 100_000_000;
/// So many frames wait for their echo: more than come in that time.
const MOST: usize = 256;

/// A frame that was heard or sent, and whose other side has not come yet.
struct Waiting {
    bus: usize,
    direction: Direction,
    time: i64,
    kind: FrameKind,
    id: u32,
    len: u8,
    data: [u8; 64],
}

/// The frames of the last moments.
#[derive(Default)]
pub(super) struct Echoes(VecDeque<Waiting>);

impl Echoes {
    /// A frame came on a topic of sent or received frames of a bus. Whether it is one that came on the other topic already.
    pub(super) fn has(&mut self, bus: usize, direction: Direction, time: i64, frame: &McapFrame) -> bool {
        while self.0.len() >= MOST
            || self.0.front().is_some_and(|first| time.saturating_sub(first.time) > APART_NS)
        {
            self.0.pop_front();
        }
        let other = self.0.iter().position(|one| {
            (one.id, one.bus, one.kind) == (frame.id, bus, frame.kind)
                && one.direction != direction
                && usize::from(one.len) == frame.len
                && one.data.iter().zip(&frame.data).take(frame.len).all(|(one, other)| one == other)
                && one.time.abs_diff(time) <= APART_NS.unsigned_abs()
        });
        if let Some(other) = other {
            self.0.remove(other);
            return true;
        }
        let McapFrame { kind, id, data, .. } = *frame;
        let len = u8::try_from(frame.len).unwrap_or(u8::MAX);
        self.0.push_back(Waiting { bus, direction, time, kind, id, len, data });
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: i64 = 1_000_000;

    fn frame(id: u32, byte: u8) -> McapFrame {
        McapFrame { id, data: [byte; 64], len: 8, ..McapFrame::NONE }
    }

    #[test]
    fn what_was_sent_and_heard_is_one_frame_whichever_comes_first() {
        let mut echoes = Echoes::default();
        let (rx, tx) = (Direction::Rx, Direction::Tx);
        assert!(!echoes.has(0, tx, 0, &frame(1, 1)));
        assert!(echoes.has(0, rx, MS, &frame(1, 1)));
        assert!(!echoes.has(0, rx, 2 * MS, &frame(1, 1)), "a third is another frame");
        assert!(echoes.has(0, tx, MS, &frame(1, 1)));
        assert!(!echoes.has(0, tx, 3 * MS, &frame(1, 1)));
        assert!(!echoes.has(0, tx, 4 * MS, &frame(1, 1)), "both were sent");
        assert!(echoes.has(0, rx, 4 * MS, &frame(1, 1)) && echoes.has(0, rx, 5 * MS, &frame(1, 1)));
    }

    #[test]
    fn another_bus_identifier_content_or_time_is_another_frame() {
        let sent = || {
            let mut echoes = Echoes::default();
            assert!(!echoes.has(0, Direction::Tx, 0, &frame(1, 1)));
            echoes
        };
        let rx = Direction::Rx;
        assert!(!sent().has(1, rx, 0, &frame(1, 1)));
        assert!(!sent().has(0, rx, 0, &frame(2, 1)));
        assert!(!sent().has(0, rx, 0, &frame(1, 2)));
        assert!(!sent().has(0, rx, 0, &McapFrame { len: 7, ..frame(1, 1) }));
        assert!(!sent().has(0, rx, 0, &McapFrame { kind: FrameKind::Extended, ..frame(1, 1) }));
        assert!(!sent().has(0, rx, APART_NS + 1, &frame(1, 1)));
        assert!(!sent().has(0, rx, -APART_NS - 1, &frame(1, 1)));
        assert!(sent().has(0, rx, APART_NS, &frame(1, 1)) && sent().has(0, rx, -APART_NS, &frame(1, 1)));
    }

    #[test]
    fn no_more_wait_than_there_is_room_for() {
        let mut echoes = Echoes::default();
        for id in 0..1000 {
            assert!(!echoes.has(0, Direction::Tx, 0, &frame(id, 0)));
        }
        assert_eq!(echoes.0.len(), MOST);
        assert!(
            echoes.has(0, Direction::Rx, 0, &frame(999, 0)) && !echoes.has(0, Direction::Rx, 0, &frame(0, 0))
        );
    }
}
