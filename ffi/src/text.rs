//! Text for C: arrays of `char` with a NUL at the end, written without allocating.

use core::ffi::c_char;
use core::fmt::{self, Write};

/// What is displayed, as an array; as much as fits, cut between characters, and the rest zero.
pub(crate) fn array<const N: usize>(shown: fmt::Arguments<'_>) -> [c_char; N] {
    let mut writer = Writer { text: [0; N], len: 0 };
    // It fails only where there is no more room.
    let _ = writer.write_fmt(shown);
    writer.text
}

/// A short text as an array.
pub(crate) fn short<const N: usize>(text: &str) -> [c_char; N] {
    let mut array = [0; N];
    let room = N.saturating_sub(1);
    for (place, byte) in array.iter_mut().take(room).zip(text.bytes()) {
        *place = c_char::from_ne_bytes([byte]);
    }
    array
}

/// A text that is known when this is compiled, as an array. It does not compile where there is no room for it.
pub(crate) const fn known<const N: usize>(text: &str) -> [c_char; N] {
    assert!(text.len() < N, "there is no room for the text and its NUL");
    let mut array = [0; N];
    let mut i = 0;
    while i < text.len() {
        array[i] = c_char::from_ne_bytes([text.as_bytes()[i]]);
        i += 1;
    }
    array
}

struct Writer<const N: usize> {
    text: [c_char; N],
    len: usize,
}

impl<const N: usize> Write for Writer<N> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for char in text.chars() {
            let mut bytes = [0; 4];
            let bytes = char.encode_utf8(&mut bytes).as_bytes();
            let room = N.saturating_sub(1);
            let end = self.len + bytes.len();
            let Some(places) = self.text.get_mut(self.len..end).filter(|_| end <= room) else {
                // Nothing more is written, not even what is shorter: a text is not continued after a gap.
                self.len = room;
                return Err(fmt::Error);
            };
            for (place, byte) in places.iter_mut().zip(bytes) {
                *place = c_char::from_ne_bytes([*byte]);
            }
            self.len = end;
        }
        Ok(())
    }
}
