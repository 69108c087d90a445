//! What is wrong with a citation: where, what was given, and what is expected.

use std::fmt;

/// Something wrong in a line of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Mistake {
    path: String,
    line: usize,
    given: String,
    expected: String,
}

impl Mistake {
    /// What was given, and what is wrong with it; then what is expected instead.
    pub(crate) fn new(given: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { path: String::new(), line: 0, given: given.into(), expected: expected.into() }
    }

    /// In this line of its file.
    pub(crate) fn in_line(self, line: usize) -> Self {
        Self { line, ..self }
    }

    /// In this file.
    pub(crate) fn at(self, path: &str) -> Self {
        Self { path: path.to_owned(), ..self }
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, line, given, expected } = self;
        write!(f, "{path}:{line}: {given}; expected {expected}")
    }
}
