//! A place in a line.

use adsdv_oracle::text::{decimal, hex, hex_byte};

/// Where and why a line could not be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Flaw {
    /// Offset in the line, in bytes.
    pub(crate) at: usize,
    /// What should have stood there.
    pub(crate) expected: &'static str,
}

/// A word of a line: bytes without blanks. Empty at the end of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Word<'a> {
    pub(crate) text: &'a [u8],
    /// Offset in the line, in bytes.
    pub(crate) at: usize,
}

impl Word<'_> {
    /// Whether it is that, in upper or lower case.
    #[inline]
    pub(crate) fn is(&self, text: &str) -> bool {
        self.text.eq_ignore_ascii_case(text.as_bytes())
    }

    /// Without the blanks around it.
    #[inline]
    pub(crate) fn trimmed(self) -> Self {
        let text = self.text.trim_ascii_start();
        Self { text: text.trim_ascii_end(), at: self.at + self.text.len() - text.len() }
    }

    /// Says that something else was expected in its place.
    #[cold]
    pub(crate) fn flaw(&self, expected: &'static str) -> Flaw {
        Flaw { at: self.at, expected }
    }
}

/// A place in a line, which words are taken from.
#[derive(Clone, Copy)]
pub(crate) struct Cursor<'a> {
    rest: &'a [u8],
    whole: usize,
}

#[inline]
const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r')
}

impl<'a> Cursor<'a> {
    #[inline]
    pub(crate) fn new(line: &'a [u8]) -> Self {
        Self { rest: line, whole: line.len() }
    }

    /// What follows.
    #[inline]
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// How many bytes have been passed.
    #[inline]
    pub(crate) fn at(&self) -> usize {
        self.whole - self.rest.len()
    }

    /// The next byte.
    #[inline]
    pub(crate) fn peek(&self) -> Option<u8> {
        self.rest.first().copied()
    }

    /// Passes `count` bytes, or what there is of them.
    #[inline]
    pub(crate) fn skip(&mut self, count: usize) {
        self.rest = self.rest.get(count..).unwrap_or_default();
    }

    /// Passes blanks.
    #[inline]
    pub(crate) fn skip_blanks(&mut self) {
        while let [byte, rest @ ..] = self.rest
            && is_blank(*byte)
        {
            self.rest = rest;
        }
    }

    /// Whether nothing follows but blanks.
    #[inline]
    pub(crate) fn is_at_end(&mut self) -> bool {
        self.skip_blanks();
        self.rest.is_empty()
    }

    /// The next word; an empty one at the end.
    #[inline]
    pub(crate) fn word(&mut self) -> Word<'a> {
        self.skip_blanks();
        self.up_to(is_blank)
    }

    /// What stands before the first byte that ends it, or all there is.
    #[inline]
    pub(crate) fn up_to(&mut self, ends: impl Fn(u8) -> bool) -> Word<'a> {
        let at = self.at();
        let len = self.rest.iter().position(|byte| ends(*byte)).unwrap_or(self.rest.len());
        let (text, rest) = self.rest.split_at_checked(len).unwrap_or_default();
        self.rest = rest;
        Word { text, at }
    }

    /// Passes a comma, which has to be next.
    #[inline]
    pub(crate) fn comma(&mut self, expected: &'static str) -> Result<(), Flaw> {
        if self.peek() != Some(b',') {
            return Err(self.flaw(expected));
        }
        self.skip(1);
        Ok(())
    }

    /// What stands behind a comma, which has to be next, up to the one behind that.
    #[inline]
    pub(crate) fn field(&mut self, expected: &'static str) -> Result<Word<'a>, Flaw> {
        self.comma(expected)?;
        Ok(self.up_to(|byte| byte == b','))
    }

    /// Fills `place` with bytes of two hexadecimal digits each, with blanks between them.
    #[inline]
    pub(crate) fn take_hex(&mut self, place: &mut [u8], expected: &'static str) -> Result<(), Flaw> {
        for byte in place {
            // As they are nearly always.
            if let [b' ', high, low, rest @ ..] = self.rest
                && rest.first().is_none_or(|behind| is_blank(*behind))
                && let Some(value) = hex_byte(*high, *low)
            {
                (*byte, self.rest) = (value, rest);
                continue;
            }
            let word = self.word();
            let value = hex(word.text).and_then(|value| u8::try_from(value).ok());
            *byte = value.ok_or_else(|| word.flaw(expected))?;
        }
        Ok(())
    }

    /// Fills `place` with bytes in decimal, with blanks between them.
    pub(crate) fn take_decimal(&mut self, place: &mut [u8], expected: &'static str) -> Result<(), Flaw> {
        for byte in place {
            let word = self.word();
            let value = decimal(word.text).and_then(|value| u8::try_from(value).ok());
            *byte = value.ok_or_else(|| word.flaw(expected))?;
        }
        Ok(())
    }

    /// Says that something else was expected here.
    #[cold]
    pub(crate) fn flaw(&self, expected: &'static str) -> Flaw {
        Flaw { at: self.at(), expected }
    }
}
