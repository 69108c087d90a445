//! Citations in the rendered sources of `cargo doc`: beside each stands what it cites.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

use crate::requirements::Requirements;

/// Puts the sentences into every page of sources below a folder, and tells how many citations there are.
pub(crate) fn fill(folder: &Path, requirements: &Requirements) -> io::Result<usize> {
    let mut cited = 0;
    for entry in fs::read_dir(folder).map_err(|error| named(folder, &error))? {
        let path = entry?.path();
        if path.is_dir() {
            cited += fill(&path, requirements)?;
        } else if path.extension().is_some_and(|extension| extension == "html") {
            let page = fs::read_to_string(&path).map_err(|error| named(&path, &error))?;
            let (filled, count) = with_sentences(&page, requirements);
            cited += count;
            if filled != page {
                fs::write(&path, filled).map_err(|error| named(&path, &error))?;
            }
        }
    }
    Ok(cited)
}

fn named(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}; run cargo doc first", path.display()))
}

/// What stands around a sentence: to the right of the citation, in lines of its own.
const BEGIN: &str = r#"<span class="cited" style="display:inline-block;vertical-align:top;max-width:90ch;padding-left:2ch;white-space:normal">"#;
const END: &str = "</span>";

/// A page with the sentence of each requirement behind its citation, and how many citations it has. One that has its sentences
/// keeps them.
fn with_sentences(page: &str, requirements: &Requirements) -> (String, usize) {
    let (mut filled, mut count) = (String::with_capacity(page.len()), 0);
    for line in page.split_inclusive('\n') {
        let text = line.trim_end_matches('\n');
        let sentences = text.split_once("//= ").and_then(|(_, behind)| {
            let ids = behind.split('<').next().unwrap_or(behind);
            let list = requirements.list(ids.trim()).ok()?;
            count += 1;
            Some((text.len() - behind.len() + ids.len(), list))
        });
        let Some((place, list)) = sentences.filter(|_| !text.contains(BEGIN)) else {
            filled.push_str(line);
            continue;
        };
        let (before, behind) = line.split_at(place);
        filled.push_str(before);
        filled.push_str(BEGIN);
        for (number, requirement) in list.iter().enumerate() {
            let line = requirement.line.trim_start_matches("- ").replace("**", "");
            let between = if number == 0 { "" } else { "<br>" };
            let _ = write!(filled, "{between}{}", escaped(&line));
        }
        filled.push_str(END);
        filled.push_str(behind);
    }
    (filled, count)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::with_sentences;
    use crate::requirements::{Requirements, tests::SMALL};

    #[test]
    fn each_citation_has_its_sentences_once() {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let page = "<pre><a id=1>1</a><span class=\"comment\">//= HS-4\n<a id=2>2</a></span>x <span>//= HS-4, HS-6</span>\n//= HS-99\n";
        let (filled, count) = with_sentences(page, &requirements);
        let sentence = |id: &str| {
            let line = SMALL.lines().find(|line| line.starts_with(&format!("- **{id}** "))).unwrap();
            line.trim_start_matches("- ").replace("**", "")
        };
        let plain = filled.replace(&format!("{}{}", super::BEGIN, sentence("HS-4")), "[4");
        assert!(
            plain.starts_with("<pre><a id=1>1</a><span class=\"comment\">//= HS-4[4</span>\n<a id=2>"),
            "{plain}"
        );
        assert!(
            plain.contains(&format!("//= HS-4, HS-6[4<br>{}</span></span>\n", sentence("HS-6"))),
            "{plain}"
        );
        assert!(plain.ends_with("\n//= HS-99\n"), "{plain}");
        assert_eq!(count, 2);
        assert_eq!(
            with_sentences(&filled, &requirements),
            (filled.clone(), 2),
            "a second time changes nothing"
        );
    }
}
