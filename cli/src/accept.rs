//! `--accept`: what is known to be wrong, each thing with the reason why it is accepted.
//!
//! A line of the file is an id, and behind it the reason. What stands behind a `#` at the beginning of a line is a remark, and
//! empty lines are passed over.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::error::Error;

/// What a command accepts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Acceptable {
    /// The command.
    pub(crate) command: &'static str,
    /// What the ids stand for, in the plural.
    pub(crate) things: &'static str,
    /// A line of a file.
    pub(crate) example: &'static str,
}

impl Acceptable {
    /// What a file looks like, for who gave something else.
    fn looks(&self) -> String {
        format!("a line is an id and a reason: {}; --write-accept writes such a file", self.example)
    }
}

/// What is accepted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Accepted(Vec<Entry>);

/// One thing that is accepted.
#[derive(Clone, Debug)]
struct Entry {
    id: String,
    reason: String,
}

impl Accepted {
    /// Reads a file.
    pub(crate) fn read(path: &Path, what: &Acceptable) -> Result<Self, Error> {
        let name = path.display().to_string();
        let text = fs::read_to_string(path).map_err(|error| Error {
            what: name.clone(),
            why: format!("cannot read the accepted {}: {error}", what.things),
            hint: what.looks(),
        })?;
        Self::parse(&text).map_err(|(line, why)| Error {
            what: format!("{name}, line {line}"),
            why,
            hint: what.looks(),
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

    /// Why something is accepted, if it is.
    pub(crate) fn reason(&self, id: &str) -> Option<&str> {
        Some(&self.0.iter().find(|entry| entry.id == id)?.reason)
    }

    /// The ids that are none of these.
    pub(crate) fn unused(&self, ids: &[String]) -> Vec<&str> {
        let left = self.0.iter().filter(|entry| !ids.contains(&entry.id));
        left.map(|entry| entry.id.as_str()).collect()
    }

    /// Writes a file that accepts these, each an id and what that is; the reasons that are known stay.
    pub(crate) fn write(
        &self,
        path: &Path,
        what: &Acceptable,
        wrong: impl IntoIterator<Item = (String, String)>,
    ) -> Result<(), Error> {
        let Acceptable { command, things, .. } = what;
        let (first, rest) = things.split_at_checked(1).unwrap_or((things, ""));
        let mut text = format!(
            "# {}{rest} that are known: an id, and why it is accepted. For adsdv {command} --accept.\n",
            first.to_uppercase()
        );
        for (id, words) in wrong {
            let reason = self.reason(&id).unwrap_or("no reason given yet");
            // Writing to a string does not fail.
            let _ = write!(text, "\n# {words}\n{id}  {reason}\n");
        }
        fs::write(path, text).map_err(|error| Error {
            what: path.display().to_string(),
            why: format!("cannot write the accepted {things}: {error}"),
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
