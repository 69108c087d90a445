//! A part of a stream of bytes, in a buffer that never grows.

use std::io::{self, Read};

/// How much is held. A container of Vector's tools unpacks to 128 KiB.
const SIZE: usize = 256 * 1024;
/// Unread bytes are moved to the front when less room than this is left behind them.
const ROOM: usize = 64 * 1024;

/// What has come of a stream, and was not taken yet.
pub(super) struct Window {
    data: Box<[u8]>,
    /// What was taken, and may be wanted once more.
    kept: usize,
    start: usize,
    end: usize,
}

impl Window {
    pub(super) fn new() -> Self {
        Self { data: vec![0; SIZE].into_boxed_slice(), kept: 0, start: 0, end: 0 }
    }

    /// What is there to be taken.
    pub(super) fn bytes(&self) -> &[u8] {
        self.data.get(self.start..self.end).unwrap_or_default()
    }

    /// How much is there to be taken.
    pub(super) const fn len(&self) -> usize {
        self.end - self.start
    }

    /// Takes so many bytes, or all where there are fewer.
    pub(super) fn skip(&mut self, count: usize) {
        self.start = self.start.saturating_add(count).min(self.end);
        self.kept = self.start;
    }

    /// Takes so many bytes, and keeps them for [`Self::take_back`] until others are taken.
    pub(super) fn skip_and_keep(&mut self, count: usize) {
        self.kept = self.start;
        self.start = self.start.saturating_add(count).min(self.end);
    }

    /// Puts back what was kept; whether there was any.
    pub(super) fn take_back(&mut self) -> bool {
        let any = self.kept < self.start;
        self.start = self.kept;
        any
    }

    /// Room behind what is there; there is some if fewer than [`ROOM`] bytes are kept and there.
    pub(super) fn room(&mut self) -> &mut [u8] {
        if self.data.len() - self.end < ROOM {
            self.data.copy_within(self.kept..self.end, 0);
            self.start -= self.kept;
            self.end -= self.kept;
            self.kept = 0;
        }
        self.data.get_mut(self.end..).unwrap_or_default()
    }

    /// So many bytes have been put into the room.
    pub(super) fn add(&mut self, count: usize) {
        self.end = self.end.saturating_add(count).min(self.data.len());
    }

    /// Reads until so many bytes are there, fewer than [`ROOM`]; `false` if the source ends before that.
    pub(super) fn fill(&mut self, source: &mut impl Read, count: usize) -> io::Result<bool> {
        while self.len() < count {
            match source.read(self.room()) {
                Ok(0) => return Ok(false),
                Ok(more) => self.add(more),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_in_order_through_a_buffer_that_does_not_grow() {
        let bytes: Vec<u8> = (0..251).cycle().take(3 * SIZE).collect();
        let (mut source, mut window, mut seen) = (bytes.as_slice(), Window::new(), Vec::new());
        loop {
            let whole = window.fill(&mut source, 4000).expect("it can be read");
            seen.extend_from_slice(window.bytes().get(..4000).unwrap_or(window.bytes()));
            window.skip(4000);
            if !whole && window.len() == 0 {
                break;
            }
        }
        assert!(seen == bytes, "the same bytes");
        assert_eq!(window.data.len(), SIZE);
    }

    #[test]
    fn what_was_kept_can_be_taken_once_more_after_more_was_read() {
        let bytes = vec![7; 2 * SIZE];
        let (mut source, mut window) = (bytes.as_slice(), Window::new());
        window.fill(&mut source, 10).expect("it can be read");
        window.skip(window.len() - 10);
        window.skip_and_keep(6);
        window.fill(&mut source, 5000).expect("it can be read");
        let there = window.len();
        assert!(window.take_back() && window.len() == there + 6);
        assert!(!window.take_back());
    }
}
