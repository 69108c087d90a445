//! `--accept`: deviations that are known, each with the reason why it is accepted.
//!
//! A line of the file is the id of a deviation, and behind it the reason. What stands behind a `#` at the beginning of a line is a
//! remark, and empty lines are passed over.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use adsdv_diagnosis::Deviation;
use adsdv_spec::Edition;

use crate::error::Error;

/// What a file of accepted deviations looks like, for who gave something else.
const LOOKS: &str = "a line is an id and a reason: ready-dwell:+50ms  the RES needs that long; --write-accept writes such a file";

/// The deviations that are accepted.
#[derive(Clone, Debug, Default)]
pub(super) struct Accepted(Vec<Entry>);

/// A deviation that is accepted.
#[derive(Clone, Debug)]
struct Entry {
    id: String,
    reason: String,
}

impl Accepted {
    /// Reads a file.
    pub(super) fn read(path: &Path) -> Result<Self, Error> {
        let name = path.display().to_string();
        let text = fs::read_to_string(path).map_err(|error| Error {
            what: name.clone(),
            why: format!("cannot read the accepted deviations: {error}"),
            hint: LOOKS.to_owned(),
        })?;
        Self::parse(&text).map_err(|(line, why)| Error {
            what: format!("{name}, line {line}"),
            why,
            hint: LOOKS.to_owned(),
        })
    }

    /// The entries of a text; else the number of the line that is none, and what is wrong with it.
    fn parse(text: &str) -> Result<Self, (usize, String)> {
        let mut entries: Vec<Entry> = Vec::new();
        for (number, line) in (1..).zip(text.lines().map(str::trim)) {
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let shown: String = line.chars().take(60).flat_map(char::escape_debug).collect();
            let Some((id, reason)) = line.split_once(char::is_whitespace) else {
                return Err((
                    number,
                    format!("\"{shown}\" has no reason; expected an id, and why it is accepted"),
                ));
            };
            if entries.iter().any(|entry| entry.id == id) {
                return Err((number, format!("\"{shown}\" is there already; expected each id once")));
            }
            entries.push(Entry { id: id.to_owned(), reason: reason.trim().to_owned() });
        }
        Ok(Self(entries))
    }

    /// Why a deviation is accepted, if it is.
    pub(super) fn reason(&self, id: &str) -> Option<&str> {
        Some(&self.0.iter().find(|entry| entry.id == id)?.reason)
    }

    /// The ids that none of these deviations has any more.
    pub(super) fn unused(&self, ids: &[String]) -> Vec<&str> {
        let left = self.0.iter().filter(|entry| !ids.contains(&entry.id));
        left.map(|entry| entry.id.as_str()).collect()
    }

    /// Writes a file that accepts these deviations; the reasons that are known stay.
    pub(super) fn write(
        &self,
        path: &Path,
        edition: &Edition,
        deviations: &[Deviation],
    ) -> Result<(), Error> {
        let mut text = String::from(
            "# Deviations that are known: an id, and why it is accepted. For adsdv conform --accept.\n",
        );
        for deviation in deviations {
            let id = deviation.id(edition);
            let reason = self.reason(&id).unwrap_or("no reason given yet");
            // Writing to a string does not fail.
            let _ = write!(text, "\n# {}\n{id}  {reason}\n", deviation.text(edition));
        }
        fs::write(path, text).map_err(|error| Error {
            what: path.display().to_string(),
            why: format!("cannot write the accepted deviations: {error}"),
            hint: "name a file that can be written".to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_is_an_id_and_a_reason() {
        let text = "# known\n\nready-dwell:+50ms   the RES needs that long \n\tgo:level because\n";
        let accepted = Accepted::parse(text).expect("it is one");
        assert_eq!(accepted.reason("ready-dwell:+50ms"), Some("the RES needs that long"));
        assert_eq!(accepted.reason("go:level"), Some("because"));
        assert_eq!(accepted.reason("go"), None);
        assert_eq!(accepted.unused(&["go:level".to_owned()]), ["ready-dwell:+50ms"]);
    }

    #[test]
    fn a_line_without_a_reason_or_twice_is_refused() {
        for (text, line, why) in [
            ("\ngo:level\n", 2, "\"go:level\" has no reason"),
            ("a b\na c\n", 2, "\"a c\" is there already"),
            ("\u{1b}[2Jx\n", 1, "has no reason"),
        ] {
            let (number, said) = Accepted::parse(text).expect_err("it is refused");
            assert!(number == line && said.contains(why), "{said}");
            assert!(!said.contains(|c: char| c.is_control()), "{said:?}");
        }
    }
}
