//! The few styles of a report. The words tell everything as well: color only helps the eye.

use std::fmt;

use adsdv_oracle::judge::Severity;
use anstyle::{AnsiColor, Style};

/// A heading.
pub(crate) const HEADING: Style = Style::new().bold();
/// A violation.
pub(crate) const BAD: Style = AnsiColor::Red.on_default().bold();
/// A warning, or what is not certain.
pub(crate) const CARE: Style = AnsiColor::Yellow.on_default();
/// All is well.
pub(crate) const GOOD: Style = AnsiColor::Green.on_default().bold();
/// Not important.
pub(crate) const QUIET: Style = Style::new().dimmed();

/// The style of a severity.
pub(crate) const fn of(severity: Severity) -> Style {
    match severity {
        Severity::Violation => BAD,
        Severity::Warning => CARE,
        Severity::Note => QUIET,
    }
}

/// Text in a style. Padding given in the format counts for the text, not for its escapes.
#[derive(Debug)]
pub(crate) struct Styled<T>(pub(crate) Style, pub(crate) T);

impl<T: fmt::Display> fmt::Display for Styled<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)?;
        self.1.fmt(f)?;
        write!(f, "{:#}", self.0)
    }
}
