//! Why a database cannot be used.

use std::fmt;

/// Why a database cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DbcError {
    /// The line where it goes wrong, from 1; `None` where that is not one line.
    pub line: Option<usize>,
    /// What is wrong there.
    pub what: String,
}

impl DbcError {
    pub(super) fn of_all(what: &str) -> Self {
        Self { line: None, what: what.to_owned() }
    }

    pub(super) fn at(line: Option<usize>, what: String) -> Self {
        Self { line, what }
    }

    /// The parser's error. What it expected are the names of its own rules, so that what stands there has to do.
    pub(super) fn parse(text: &str, error: &can_dbc::DbcError) -> Self {
        let can_dbc::DbcError::Pest(error) = error else {
            return Self { line: None, what: error.to_string() };
        };
        let (line, column) = match error.line_col {
            pest::error::LineColLocation::Pos(place) | pest::error::LineColLocation::Span(place, _) => place,
        };
        let found = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
        let found: String = found.chars().skip(column.saturating_sub(1)).take(24).collect();
        let found = if found.is_empty() { "the end of the line".to_owned() } else { format!("{found:?}") };
        Self { line: Some(line), what: format!("column {column}: cannot read on at {found}") }
    }
}

impl fmt::Display for DbcError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        f.write_str(&self.what)
    }
}

impl std::error::Error for DbcError {}
