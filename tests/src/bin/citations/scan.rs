//! The citations of a source, as they are written.
//!
//! - `//= HS-4, HS-6`, on a line of its own or behind code;
//! - in a doc comment, `/// Requirements: HS-4, HS-6.`, over as many lines as it takes to the full stop;
//! - in data, `requirements: &["HS-4", "HS-6"]`, and in a row of a table, `cites ["HS-4", "HS-6"]`, over as many lines as it
//!   takes.

use crate::mistake::Mistake;

/// How a citation is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Comment,
    Doc,
    Data,
}

impl Form {
    /// As it looks.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Comment => "`//=`",
            Self::Doc => "`/// Requirements:`",
            Self::Data => "`requirements: &[..]`",
        }
    }
}

/// A citation: a list of identifiers, not read yet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Written {
    pub(crate) ids: String,
    pub(crate) form: Form,
    /// The line that it begins in.
    pub(crate) line: usize,
    /// It is in the file's module of unit tests, which is its last.
    pub(crate) in_tests: bool,
}

/// Every citation of a source, in order.
pub(crate) fn citations(text: &str) -> Vec<Result<Written, Mistake>> {
    let lines: Vec<&str> = text.lines().collect();
    let mut in_tests = false;
    let mut found: Vec<Result<Written, Mistake>> = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let rest = lines.get(at + 1..).unwrap_or_default();
        in_tests |= line.trim() == "#[cfg(test)]" && rest.first().is_some_and(|next| is_module(next));
        let number = at + 1;
        match begins(line, rest) {
            // A list of data that is empty cites nothing.
            Some((Form::Data, Ok(ids))) if ids.is_empty() => {}
            Some((form, Ok(ids))) => found.push(Ok(Written { ids, form, line: number, in_tests })),
            Some((_, Err(trouble))) => found.push(Err(trouble.in_line(number))),
            None => {}
        }
    }
    found
}

fn is_module(line: &str) -> bool {
    let line = line.trim_start();
    line.starts_with("mod ") || line.starts_with("pub") && line.contains(" mod ")
}

/// The citation that begins in a line: its form, and its list, for which the lines behind it may be needed.
fn begins(line: &str, rest: &[&str]) -> Option<(Form, Result<String, Mistake>)> {
    if let Some(ids) = line.trim_start().strip_prefix(DOC) {
        return Some((Form::Doc, doc(ids, rest)));
    }
    // What is in a comment already is talk about citations.
    let behind_code = |mark| line.split_once(mark).filter(|(code, _)| !code.contains("//"));
    if let Some((_, ids)) = behind_code(COMMENT) {
        return Some((Form::Comment, Ok(ids.trim().to_owned())));
    }
    let (_, ids) = behind_code(DATA).or_else(|| {
        // What is cited by a macro's rule is what its rows cite.
        behind_code(ROW).filter(|(_, ids)| ids.starts_with('"'))
    })?;
    Some((Form::Data, data(ids, rest)))
}

const DOC: &str = "/// Requirements:";
const COMMENT: &str = "//=";
const DATA: &str = "requirements: &[";
const ROW: &str = "cites [";

fn doc(first: &str, rest: &[&str]) -> Result<String, Mistake> {
    let mut ids = first.trim().to_owned();
    let mut rest = rest.iter();
    while !ids.ends_with('.') {
        let next = rest.next().and_then(|line| line.trim_start().strip_prefix("///"));
        let Some(next) = next.map(str::trim).filter(|next| !next.is_empty()) else {
            return Err(Mistake::new(
                format!("{ids:?} does not end"),
                "a full stop behind the last identifier",
            ));
        };
        ids = format!("{ids} {next}");
    }
    ids.pop();
    Ok(ids.trim().to_owned())
}

fn data(first: &str, rest: &[&str]) -> Result<String, Mistake> {
    let mut text = first.to_owned();
    let mut rest = rest.iter();
    let list = loop {
        if let Some((list, _)) = text.split_once(']') {
            break list;
        }
        match rest.next() {
            Some(line) => text.push_str(line),
            None => return Err(Mistake::new("a list that does not end", "`]` behind the last identifier")),
        }
    };
    let quoted: Option<Vec<&str>> = list
        .split(',')
        .map(str::trim)
        .filter(|item| !item.is_empty())
        .map(|item| item.strip_prefix('"')?.strip_suffix('"'))
        .collect();
    let expected = "identifiers in quotes, as in `&[\"HS-4\", \"HS-6\"]`";
    Ok(quoted.ok_or_else(|| Mistake::new(format!("[{}]", list.trim()), expected))?.join(", "))
}

#[cfg(test)]
mod tests {
    use super::Form::{Comment, Data, Doc};
    use super::{Form, citations};

    fn scanned(text: &str) -> Vec<(Form, usize, String)> {
        let found = citations(text).into_iter();
        found
            .map(|written| {
                let written = written.expect("well written");
                (written.form, written.line, written.ids)
            })
            .collect()
    }

    #[test]
    fn comments_alone_and_behind_code() {
        let text = "fn f() {\n    //= HS-4, HS-6\n    0x080..=0x084, //= ID-2\n    // no //= HS-4\n}\n/// as in `//= HS-4`\n";
        assert_eq!(
            scanned(text),
            [(Comment, 2, "HS-4, HS-6".to_owned()), (Comment, 3, "ID-2".to_owned())],
            "and none inside another comment"
        );
    }

    #[test]
    fn doc_comments_end_with_a_full_stop() {
        let text = "    /// It holds.\n    ///\n    /// Requirements: RTE-1 to RTE-8,\n    /// SM-12.\n    fn f() {}\n";
        assert_eq!(scanned(text), [(Doc, 3, "RTE-1 to RTE-8, SM-12".to_owned())]);
        for endless in ["/// Requirements: HS-4\nfn f() {}\n", "/// Requirements: HS-4\n///\n/// More.\n"] {
            let error = citations(endless).remove(0).expect_err("no full stop").at("a.rs").to_string();
            assert_eq!(
                error,
                "a.rs:1: \"HS-4\" does not end; expected a full stop behind the last identifier"
            );
        }
    }

    #[test]
    fn data_over_several_lines() {
        let text = "requirements: &[\"HS-9\"],\n  requirements: &[\n    \"SM-9\", \"SM-11\",\n    \"FTO-1\",\n  ],\n";
        assert_eq!(scanned(text), [(Data, 1, "HS-9".to_owned()), (Data, 2, "SM-9, SM-11, FTO-1".to_owned())]);
        assert_eq!(scanned("requirements: &[],\npub requirements: &'static [&'static str],\n"), []);
        assert!(citations("requirements: &[HS_9],\n").remove(0).is_err(), "not quoted");
        assert!(citations("requirements: &[\"HS-9\",\n").remove(0).is_err(), "no end");
    }

    #[test]
    fn rows_of_tables() {
        let text =
            "handshake: bool, cites [\"MSG-6\", \"HS-2\"];\n($field:ident, cites [$($cited:literal),+];)\n";
        assert_eq!(scanned(text), [(Form::Data, 1, "MSG-6, HS-2".to_owned())]);
    }

    #[test]
    fn a_module_of_unit_tests_goes_to_the_end_of_the_file() {
        let text = "#[cfg(test)]\nuse x;\n//= HS-4\n#[cfg(test)]\nmod tests {\n    //= HS-6\n}\n";
        let in_tests: Vec<_> =
            citations(text).into_iter().map(|written| written.expect("well written").in_tests).collect();
        assert_eq!(in_tests, [false, true]);
    }
}
