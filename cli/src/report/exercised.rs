//! What the recording exercised: in numbers, what was not there at all, and what was required and is missing.

use std::fmt::{self, Write as _};

use adsdv_oracle::judge::{Exercised, Report, Required, Standing};

use super::style::{self, Styled};
use crate::layout::wrapped;

/// What the last line says where something is.
const MISSING: &str = "required and missing";

/// The line with the numbers of requirements.
pub(super) fn write(out: &mut String, exercised: &Exercised) -> fmt::Result {
    let counts: Vec<String> = Standing::ALL
        .iter()
        .map(|&standing| format!("{} {}", exercised.count(standing), standing.name()))
        .collect();
    writeln!(out, "requirements that a log can show: {}", counts.join(", "))
}

/// What the verdict says of what was not there, behind its word; nothing where all was.
pub(super) fn reservation(exercised: &Exercised) -> String {
    let lacks: Vec<&str> = exercised.lacks().iter().map(|lack| lack.text()).collect();
    if lacks.is_empty() { String::new() } else { format!(", as far as it goes: {}", lacks.join(", ")) }
}

/// What was required, and is missing.
pub(super) fn missing(out: &mut String, name: &str, report: &Report, required: &[Required], width: usize) {
    let missing = required.iter().filter(|one| !report.exercised.meets(**one));
    let texts: Vec<String> = missing.map(|one| format!("{one} ({})", one.missing())).collect();
    if texts.is_empty() {
        return;
    }
    let mut lines = String::new();
    wrapped(&mut lines, format!("{name}: {MISSING}: {}", texts.join(", ")).split(' '), 0, width);
    // Styled once it is wrapped, for the escapes take no room.
    out.push_str(&lines.replacen(MISSING, &Styled(style::BAD, MISSING).to_string(), 1));
}
