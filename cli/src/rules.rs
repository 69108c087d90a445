//! `--rules FILE`: a team's own rules, judged beside the document. `RULES.md` has the language.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use adsdv_oracle::rules::{RuleError, RuleErrors, RuleFile};
use adsdv_spec::Edition;

use crate::error::Error;

/// No file of rules is longer, in bytes.
const LONGEST: u64 = 1 << 20;
/// So much of a line is shown in front of what is wrong with it, and in all.
const BEFORE: usize = 50;
const SHOWN: usize = 90;

/// The rules of a file, if one is named: such as this edition has, or where a log is to tell which it is, any.
pub(crate) fn read(file: Option<&Path>, edition: &Edition, by_log: bool) -> Result<Option<RuleFile>, Error> {
    let Some(file) = file else { return Ok(None) };
    let edition = (!by_log).then_some(edition);
    RuleFile::read(&text(file)?, edition).map(Some).map_err(|errors| refused(file, &errors))
}

fn text(file: &Path) -> Result<String, Error> {
    let name = || file.display().to_string();
    let failed = |error: &io::Error| {
        let hint = match error.kind() {
            io::ErrorKind::NotFound => "check the path; RULES.md has examples of such a file",
            io::ErrorKind::IsADirectory => "give one of the files in it",
            _ => "name a file that this user may read",
        };
        Error { what: name(), why: format!("cannot read the rules: {error}"), hint: hint.to_owned() }
    };
    let mut bytes = Vec::new();
    let opened = File::open(file).map_err(|error| failed(&error))?;
    opened.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|error| failed(&error))?;
    if bytes.len() as u64 > LONGEST {
        let why = "is longer than 1 MiB; expected a file of rules".to_owned();
        let hint = "give a file with a rule in each line; RULES.md has examples".to_owned();
        return Err(Error { what: name(), why, hint });
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.as_bytes().get(..error.utf8_error().valid_up_to()).unwrap_or_default();
        let before = String::from_utf8_lossy(valid);
        let (line, last) = (before.matches('\n').count() + 1, before.rsplit('\n').next().unwrap_or_default());
        let why = "found bytes that are no text in UTF-8; expected a file of rules".to_owned();
        let text = last.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        refused(file, &RuleError { line, column: last.chars().count() + 1, width: 1, text, why }.into())
    })
}

/// What is wrong with a file: each mistake with its line, and a mark below the place.
pub(crate) fn refused(file: &Path, errors: &RuleErrors) -> Error {
    let mut why = shown(errors.first());
    for error in errors.iter().skip(1) {
        // Writing to a string does not fail.
        let _ = write!(why, "\n{}: {}", place(file, error), shown(error));
    }
    if let Some(more) = errors.and_more() {
        let _ = write!(why, "\n{more}");
    }
    Error {
        what: place(file, errors.first()),
        why,
        hint: "RULES.md has the language; `adsdv dbc --edition VERSION` prints every signal of an edition"
            .to_owned(),
    }
}

/// Where a mistake is, as editors read it.
fn place(file: &Path, error: &RuleError) -> String {
    format!("{}:{}:{}", file.display(), error.line, error.column)
}

/// A mistake, and below it the line with a mark.
fn shown(error: &RuleError) -> String {
    let RuleError { line, column, width, text, why } = error;
    let from = column.saturating_sub(BEFORE);
    let shown: String = text.chars().skip(from).take(SHOWN).collect();
    let (number, at) = (line.to_string(), column.saturating_sub(from + 1));
    let mark = "^".repeat((*width).clamp(1, SHOWN.saturating_sub(at).max(1)));
    let (shown, margin) = (shown.trim_end(), " ".repeat(number.len()));
    format!("{why}\n {number} | {shown}\n {margin} | {}{mark}", " ".repeat(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mark_is_below_what_is_meant_however_long_the_line_is() {
        for before in [0, 1, 48, 49, 50, 51, 300] {
            for behind in [0, 300] {
                let text = format!("{}wrong{}", "-".repeat(before), "-".repeat(behind));
                let error =
                    RuleError { line: 12, column: before + 1, width: 5, text, why: "is wrong".to_owned() };
                let shown = refused(Path::new("a.rules"), &error.into()).to_string();
                let lines: Vec<&str> = shown.lines().collect();
                assert_eq!(lines[0], format!("a.rules:12:{}: is wrong", before + 1));
                let at = lines[1].find("wrong").expect("it is shown");
                assert_eq!((lines[2].find('^'), lines[2].matches('^').count()), (Some(at), 5), "{shown}");
                assert!(lines[1].len() < 100, "{shown}");
            }
        }
    }
}
