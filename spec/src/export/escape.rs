//! Text from the tables inside the quotes and cells of a format.

use core::fmt::{self, Write};

/// What stands for a character in a format; `None` if the character stands for itself.
pub(super) type Escape = fn(char) -> Option<&'static str>;

/// Displays a value with the characters replaced that would mean something else in the format.
pub(super) struct Escaped<T>(pub(super) T, pub(super) Escape);

impl<T: fmt::Display> fmt::Display for Escaped<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(Escaping { out: f, escape: self.1 }, "{}", self.0)
    }
}

struct Escaping<'a, 'f> {
    out: &'a mut fmt::Formatter<'f>,
    escape: Escape,
}

impl Write for Escaping<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for character in text.chars() {
            match (self.escape)(character) {
                Some(replacement) => self.out.write_str(replacement)?,
                None => self.out.write_char(character)?,
            }
        }
        Ok(())
    }
}
