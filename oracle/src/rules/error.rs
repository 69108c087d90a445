//! A mistake in a file of rules, and where it is.

use std::fmt;

/// A mistake in a file of rules: one of its [`RuleErrors`](super::RuleErrors).
///
/// ```
/// use adsdv_oracle::rules::RuleFile;
///
/// let errors = "# ours\nready: after Go on, AS_STATE == AS_DRIVING".parse::<RuleFile>().unwrap_err();
/// assert_eq!(errors.first().to_string(), "line 2, column 43: found the end of the line; expected within, for or until");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleError {
    /// The line, from 1.
    pub line: usize,
    /// The character in it where the trouble begins, from 1.
    pub column: usize,
    /// How many characters are meant, at least 1.
    pub width: usize,
    /// The line itself, with a blank for each control character; not all of one that is too long.
    pub text: String,
    /// What was given, and what was expected.
    pub why: String,
}

impl fmt::Display for RuleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}", self.line, self.column, self.why)
    }
}

impl std::error::Error for RuleError {}

/// Characters of a line: the first, from 0, and how many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: usize,
    pub(super) width: usize,
}

impl Span {
    /// From the start of this one to the end of another.
    pub(super) const fn to(self, end: Self) -> Self {
        Self { start: self.start, width: (end.start + end.width).saturating_sub(self.start) }
    }
}

/// What is wrong with a line, and where in it.
#[derive(Clone, Debug)]
pub(super) struct SpannedError {
    pub(super) span: Span,
    pub(super) why: String,
}

impl SpannedError {
    pub(super) fn new(span: Span, why: impl Into<String>) -> Self {
        Self { span, why: why.into() }
    }

    /// The same in this line, whose number counts from 1.
    pub(super) fn in_line(self, line: usize, text: &str) -> RuleError {
        let shown = text.chars().take(super::limits::CHARACTERS);
        let text = shown.map(|c| if c.is_control() { ' ' } else { c }).collect();
        let Self { span, why } = self;
        RuleError { line, column: span.start + 1, width: span.width.max(1), text, why }
    }
}
