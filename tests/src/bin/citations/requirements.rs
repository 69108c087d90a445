//! The requirements, as their file numbers them, and lists of their identifiers.

use std::collections::BTreeMap;
use std::fmt;

use crate::mistake::Mistake;

/// An identifier such as HS-4.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Id {
    prefix: String,
    number: u32,
}

impl Id {
    /// Reads `HS-4`, exactly as it is written.
    fn parse(text: &str) -> Option<Self> {
        let (prefix, number) = text.split_once('-')?;
        let id = Self { prefix: prefix.to_owned(), number: number.parse().ok()? };
        let upper = !prefix.is_empty() && prefix.bytes().all(|byte| byte.is_ascii_uppercase());
        (upper && id.to_string() == text).then_some(id)
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}", self.prefix, self.number)
    }
}

/// One requirement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Requirement {
    pub(crate) id: Id,
    /// The section of the file that it stands in, as duvet names it.
    pub(crate) section: String,
    /// Its line of the file, which annotations quote.
    pub(crate) line: String,
    /// The editions that it holds in: none if it was withdrawn, which takes away its keyword.
    editions: Vec<String>,
}

impl Requirement {
    /// Whether it holds in an edition.
    pub(crate) fn holds_in(&self, edition: &str) -> bool {
        self.editions.iter().any(|other| other == edition)
    }

    /// How binding it is, in its own word; empty if it was withdrawn.
    pub(crate) fn keyword(&self) -> &'static str {
        keyword(&self.line).unwrap_or_default()
    }

    /// It was not withdrawn.
    fn in_force(&self) -> bool {
        !self.editions.is_empty()
    }
}

/// The word that makes a sentence a requirement, if it has one.
fn keyword(sentence: &str) -> Option<&'static str> {
    ["MUST", "SHOULD", "MAY"].into_iter().find(|keyword| sentence.contains(keyword))
}

/// All requirements.
#[derive(Clone, Debug)]
pub(crate) struct Requirements {
    by_id: BTreeMap<Id, Requirement>,
    /// The editions, the oldest first.
    editions: Vec<String>,
}

impl Requirements {
    /// Reads the file: a table of editions, then list items that begin with an identifier in bold, under headings.
    pub(crate) fn parse(text: &str) -> Result<Self, Mistake> {
        let mut section = String::new();
        let mut editions: Vec<String> = Vec::new();
        let mut by_id = BTreeMap::new();
        for (number, line) in (1..).zip(text.lines()) {
            if line.starts_with('#') {
                section = anchor(line.trim_start_matches('#'));
            }
            if section == EDITIONS {
                editions.extend(row_of_edition(line).map(str::to_owned));
            }
            let Some((id, sentence)) = line.strip_prefix("- **").and_then(|rest| rest.split_once("** "))
            else {
                continue;
            };
            let Some(id) = Id::parse(id) else {
                return Err(Mistake::new(format!("{id:?}"), "an identifier such as HS-4").in_line(number));
            };
            let editions = if keyword(sentence).is_some() {
                holds_in(sentence, &editions).map_err(|mistake| mistake.in_line(number))?
            } else {
                Vec::new()
            };
            let requirement =
                Requirement { id: id.clone(), section: section.clone(), line: line.to_owned(), editions };
            if by_id.insert(id.clone(), requirement).is_some() {
                return Err(Mistake::new(format!("{id} again"), "each identifier once").in_line(number));
            }
        }
        Ok(Self { by_id, editions })
    }

    /// The editions, the oldest first.
    pub(crate) fn editions(&self) -> &[String] {
        &self.editions
    }

    /// Those that were not withdrawn.
    pub(crate) fn in_force(&self) -> impl Iterator<Item = &Requirement> {
        self.by_id.values().filter(|requirement| requirement.in_force())
    }

    /// The requirements of a list such as `MSG-16 to MSG-19, HS-4`: each at most once. A range leaves out what was
    /// withdrawn.
    pub(crate) fn list(&self, ids: &str) -> Result<Vec<&Requirement>, Mistake> {
        let mut cited: Vec<&Requirement> = Vec::new();
        for item in ids.split(',').map(str::trim) {
            for requirement in self.item(item)? {
                if cited.contains(&requirement) {
                    return Err(Mistake::new(
                        format!("{} twice", requirement.id),
                        "each identifier of a list once",
                    ));
                }
                cited.push(requirement);
            }
        }
        Ok(cited)
    }

    fn item(&self, item: &str) -> Result<Vec<&Requirement>, Mistake> {
        let Some((first, last)) = item.split_once(" to ") else {
            let requirement = self.get(item)?;
            return if requirement.in_force() {
                Ok(vec![requirement])
            } else {
                Err(Mistake::new(format!("{item:?} is withdrawn"), "a requirement that is in force"))
            };
        };
        let (first, last) = (&self.get(first)?.id, &self.get(last)?.id);
        if first.prefix != last.prefix {
            return Err(Mistake::new(
                format!("{item:?} runs from one prefix to another"),
                "a range within one prefix, such as MSG-16 to MSG-19",
            ));
        }
        if first >= last {
            return Err(Mistake::new(format!("{item:?} runs backwards"), format!("{last} to {first}")));
        }
        Ok(self
            .by_id
            .range(first..=last)
            .map(|(_, requirement)| requirement)
            .filter(|r| r.in_force())
            .collect())
    }

    fn get(&self, id: &str) -> Result<&Requirement, Mistake> {
        let Some(parsed) = Id::parse(id) else {
            return Err(Mistake::new(
                format!("{id:?}"),
                "identifiers alone, as in `HS-4, HS-6` or `MSG-16 to MSG-19`",
            ));
        };
        self.by_id.get(&parsed).ok_or_else(|| {
            Mistake::new(
                format!("{id:?} is no requirement"),
                "an identifier of spec/REQUIREMENTS.md, such as HS-4",
            )
        })
    }
}

/// The section of the file that has the table of editions.
const EDITIONS: &str = "editions";

/// The edition that a row of the table begins with.
fn row_of_edition(line: &str) -> Option<&str> {
    let (edition, _) = line.strip_prefix("| ")?.split_once(" | ")?;
    is_number(edition).then_some(edition)
}

/// The editions that a sentence holds in, by the parentheses at its end: `(2.4)` all of them, `(3.0: 3.7; 4.0: 4)` those that
/// are named.
fn holds_in(sentence: &str, editions: &[String]) -> Result<Vec<String>, Mistake> {
    let expected =
        "places at its end, as in `(2.1, Figure 1)` or, for some editions alone, `(3.0: 2.4; 4.0: 2.4, 4)`";
    let wrong = || Mistake::new(format!("{sentence:?}"), expected);
    let (_, places) =
        sentence.strip_suffix(").").and_then(|rest| rest.rsplit_once(" (")).ok_or_else(wrong)?;
    let are_places = |places: &str| {
        places
            .split(", ")
            .all(|place| is_number(place.strip_prefix("Figure ").unwrap_or(place)))
            .then_some(())
            .ok_or_else(wrong)
    };
    if !places.contains(':') {
        return are_places(places).map(|()| editions.to_vec());
    }
    let mut later = editions.iter();
    let mut named = Vec::new();
    for part in places.split("; ") {
        let (edition, places) = part.split_once(": ").ok_or_else(wrong)?;
        are_places(places)?;
        // Each at most once, and the oldest first.
        named.extend(Some(later.find(|other| *other == edition).ok_or_else(wrong)?.clone()));
    }
    Ok(named)
}

/// Whether it is a number of a section, a figure or an edition, such as 4 or 3.0.
fn is_number(text: &str) -> bool {
    text.split('.').all(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()))
}

/// A heading as duvet makes an anchor of it.
fn anchor(heading: &str) -> String {
    heading.trim().to_lowercase().replace(|c: char| !c.is_ascii_alphanumeric(), "-")
}

#[cfg(test)]
pub(crate) mod tests {
    use super::Requirements;

    /// A small file of requirements.
    pub(crate) const SMALL: &str = "\
# Requirements
- One list item is **one** requirement.
## Editions
| edition | document |
|---|---|
| 3.0 | the old one |
| 4.0 | the new one |
## 2.4 Handshake
- **HS-4** The VCU MUST let its HANDSHAKE bit alternate between 0 and 1 (2.4).
- **HS-5** Withdrawn.
- **HS-6** The VCU MUST hold its HANDSHAKE bit at 1 (3.0: 2.4).
- **HS-17** The VCU MUST wait (4.0: 2.4, Figure 1).
## 3.2 AS_READY to AS_DRIVING
- **DRV-10** The AI Computer SHOULD set DIRECTION_REQUEST to FORWARD (3.0: 3.2; 4.0: 4).
";

    fn list(ids: &str) -> Result<Vec<String>, String> {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let cited = requirements.list(ids);
        cited
            .map(|found| found.iter().map(|requirement| requirement.id.to_string()).collect())
            .map_err(|trouble| trouble.to_string())
    }

    #[test]
    fn the_file_is_read() {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let read: Vec<_> = requirements
            .in_force()
            .map(|r| (r.id.to_string(), r.section.as_str(), r.line.as_str()))
            .collect();
        let lines: Vec<_> = SMALL.lines().collect();
        assert_eq!(
            read,
            [
                ("DRV-10".to_owned(), "3-2-as-ready-to-as-driving", lines[13]),
                ("HS-4".to_owned(), "2-4-handshake", lines[8]),
                ("HS-6".to_owned(), "2-4-handshake", lines[10]),
                ("HS-17".to_owned(), "2-4-handshake", lines[11]),
            ]
        );
        assert!(Requirements::parse(&SMALL.replace("HS-6", "HS-4")).is_err(), "twice");
        assert!(Requirements::parse(&SMALL.replace("HS-6", "HS-06")).is_err(), "badly written");
    }

    #[test]
    fn places_tell_the_editions() {
        let requirements = Requirements::parse(SMALL).expect("well written");
        assert_eq!(requirements.editions(), ["3.0", "4.0"]);
        let of = |edition: &str| -> Vec<_> {
            requirements.in_force().filter(|r| r.holds_in(edition)).map(|r| r.id.to_string()).collect()
        };
        assert_eq!(of("3.0"), ["DRV-10", "HS-4", "HS-6"]);
        assert_eq!(of("4.0"), ["DRV-10", "HS-4", "HS-17"]);
        assert_eq!(of("5.0"), [""; 0]);
    }

    #[test]
    fn places_that_are_none_are_refused() {
        for places in [
            "",
            " ()",
            " (2.4; 3.1)",
            " (2.4,3.1)",
            " (2.)",
            " (the text)",
            " (Figure)",
            " (3.1: 2.4)",
            " (3.0 2.4)",
            " (3.0:2.4)",
            " (3.0: 2.4, 4.0: 4)",
            " (4.0: 4; 3.0: 3.7)",
            " (3.0: 3.7; 3.0: 4)",
            " (3.0: )",
        ] {
            let error = Requirements::parse(&SMALL.replacen(" (2.4)", places, 1)).expect_err(places);
            assert!(error.to_string().contains("expected places at its end"), "{places}: {error}");
        }
    }

    #[test]
    fn the_requirements_of_this_project_are_read() {
        let requirements = Requirements::parse(include_str!("../../../../spec/REQUIREMENTS.md"));
        let requirements = requirements.expect("well written");
        let of = |edition| requirements.in_force().filter(|r| r.holds_in(edition)).count();
        let counts = requirements.editions().iter().map(|edition| (edition.as_str(), of(edition)));
        let counts: Vec<_> = counts.collect();
        let expected = [("3.0", 237), ("4.0", 271), ("2026", 273)];
        assert_eq!(counts, expected, "to be written here, and in the sentence of docs/evidence.md");
        let evidence = include_str!("../../../../docs/evidence.md");
        for (edition, count) in counts {
            let mut said =
                ["version ", "", "the vehicle of "].map(|of| format!("{count} of {of}{edition}")).into_iter();
            assert!(
                said.any(|said| evidence.contains(&said)),
                "docs/evidence.md needs: {count} of {edition}"
            );
        }
    }

    #[test]
    fn each_requirement_of_this_project_has_one_keyword() {
        let requirements = Requirements::parse(include_str!("../../../../spec/REQUIREMENTS.md"));
        for requirement in requirements.expect("well written").in_force() {
            let words = requirement.line.split(' ');
            let keywords: Vec<_> = words.filter(|word| ["MUST", "SHOULD", "MAY"].contains(word)).collect();
            assert_eq!(keywords.len(), 1, "{}", requirement.line);
        }
    }

    #[test]
    fn lists_and_ranges() {
        assert_eq!(list("HS-6"), Ok(vec!["HS-6".to_owned()]));
        assert_eq!(list("DRV-10, HS-4"), Ok(vec!["DRV-10".to_owned(), "HS-4".to_owned()]));
        assert_eq!(list("HS-4 to HS-6"), Ok(vec!["HS-4".to_owned(), "HS-6".to_owned()]), "not the withdrawn");
        assert_eq!(list("HS-6 to HS-17"), Ok(vec!["HS-6".to_owned(), "HS-17".to_owned()]), "of any edition");
    }

    #[test]
    fn bad_lists_are_refused() {
        for (ids, part) in [
            ("HS-7", "is no requirement"),
            ("HS-5", "is withdrawn"),
            ("", "identifiers alone"),
            ("HS-4,", "identifiers alone"),
            ("HS-4 HS-6", "identifiers alone"),
            ("HS-4: the bit", "identifiers alone"),
            ("hs-4", "identifiers alone"),
            ("HS-04", "identifiers alone"),
            ("HS-4 to HS-7", "is no requirement"),
            ("HS-6 to HS-4", "expected HS-4 to HS-6"),
            ("HS-4 to HS-4", "runs backwards"),
            ("HS-4 to DRV-10", "within one prefix"),
            ("HS-4, HS-4", "twice"),
            ("HS-6, HS-4 to HS-6", "twice"),
        ] {
            let error = list(ids).expect_err(ids);
            assert!(error.contains(part), "{ids}: {error}");
        }
    }
}
