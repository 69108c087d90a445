//! A place in a line, from which what stands there is taken.

use super::error::Flaw;

/// A place in a line.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    rest: &'a [u8],
    whole: usize,
}

impl<'a> Cursor<'a> {
    #[inline]
    pub(super) fn new(line: &'a [u8]) -> Self {
        Self { rest: line, whole: line.len() }
    }

    /// What follows.
    #[inline]
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next byte.
    #[inline]
    pub(super) fn peek(&self) -> Option<u8> {
        self.rest.first().copied()
    }

    /// Passes `count` bytes, or what there is of them.
    #[inline]
    pub(super) fn skip(&mut self, count: usize) {
        self.rest = self.rest.get(count..).unwrap_or_default();
    }

    /// Passes `byte` if it comes next, and tells whether it did.
    #[inline]
    pub(super) fn skip_if(&mut self, byte: u8) -> bool {
        let found = self.peek() == Some(byte);
        if found {
            self.skip(1);
        }
        found
    }

    /// Passes spaces, and tells whether there were any.
    #[inline]
    pub(super) fn skip_blanks(&mut self) -> bool {
        let mut any = false;
        while self.peek().is_some_and(is_blank_byte) {
            self.skip(1);
            any = true;
        }
        any
    }

    /// Says that something else was expected here.
    #[cold]
    pub(super) fn flaw(&self, expected: &'static str) -> Flaw {
        self.flaw_after(0, expected)
    }

    /// Says that something else was expected `offset` bytes from here.
    #[cold]
    pub(super) fn flaw_after(&self, offset: usize, expected: &'static str) -> Flaw {
        Flaw { at: self.whole - self.rest.len() + offset, expected }
    }
}

/// Whether a line holds nothing at all, which is no error.
#[inline]
pub(super) fn is_blank(line: &[u8]) -> bool {
    line.iter().all(|byte| is_blank_byte(*byte))
}

/// Between words; a carriage return counts, so that lines may end in CR LF.
#[inline]
fn is_blank_byte(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blank_lines_are_blank() {
        assert!(is_blank(b"") && is_blank(b"\r") && is_blank(b" \t \r"));
        assert!(!is_blank(b" (") && !is_blank(b"\0"));
    }
}
