//! Citations as duvet's annotations: one file for each source and kind.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::kind::Kind;
use crate::requirements::Requirement;

/// A citation of one requirement.
#[derive(Clone, Debug)]
pub(crate) struct Citation<'a> {
    pub(crate) kind: Kind,
    pub(crate) requirement: &'a Requirement,
    /// The source, with `/` between folders.
    pub(crate) path: String,
    pub(crate) line: usize,
}

impl Citation<'_> {
    /// The edition in whose folder it stands, if it stands in one.
    pub(crate) fn folder(&self) -> Option<String> {
        folder_of_edition(&self.path)
    }
}

/// The edition in whose folder a source is, such as 3.0 for `spec/src/editions/v3_0/figure2.rs`.
pub(crate) fn folder_of_edition(path: &str) -> Option<String> {
    let (folder, _) = path.strip_prefix("spec/src/editions/v")?.split_once('/')?;
    Some(folder.replace('_', "."))
}

/// The files to write, by their paths: each annotation quotes its requirement, and names the line that cites it.
pub(crate) fn annotations(citations: &[Citation<'_>], requirements: &str) -> BTreeMap<String, String> {
    let mut files: BTreeMap<String, String> = BTreeMap::new();
    for Citation { kind, requirement, path, line } in citations {
        let file = files.entry(format!("{}/{path}.txt", kind.name())).or_default();
        // Writing into a string does not fail.
        let _ = write!(
            file,
            "//= {requirements}#{}\n//= type={}\n//= reason={path}:{line}\n//# {}\n\n",
            requirement.section,
            kind.annotated(),
            requirement.line
        );
    }
    files
}

#[cfg(test)]
mod tests {
    use super::{Citation, annotations, folder_of_edition};
    use crate::kind::Kind;
    use crate::requirements::{Requirements, tests::SMALL};

    #[test]
    fn folders_have_editions() {
        for (path, edition) in [
            ("spec/src/editions/v3_0/figure2.rs", Some("3.0")),
            ("spec/src/editions/v4_0/more/mod.rs", Some("4.0")),
            ("spec/src/editions/fictional.rs", None),
            ("spec/src/editions/v4_0.rs", None),
            ("model/src/editions/v4_0/mod.rs", None),
        ] {
            assert_eq!(folder_of_edition(path).as_deref(), edition, "{path}");
        }
    }

    #[test]
    fn an_annotation_quotes_the_requirement_in_full() {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let cited = requirements.list("HS-4, DRV-10").expect("they are there");
        let path = "proofs/src/kani/go.rs".to_owned();
        let citations: Vec<_> = cited
            .into_iter()
            .map(|requirement| Citation { kind: Kind::Proof, requirement, path: path.clone(), line: 7 })
            .collect();
        let files = annotations(&citations, "spec/REQUIREMENTS.md");
        let expected = "\
//= spec/REQUIREMENTS.md#2-4-handshake
//= type=implication
//= reason=proofs/src/kani/go.rs:7
//# - **HS-4** The VCU MUST let its HANDSHAKE bit alternate between 0 and 1 (2.4).

//= spec/REQUIREMENTS.md#3-2-as-ready-to-as-driving
//= type=implication
//= reason=proofs/src/kani/go.rs:7
//# - **DRV-10** The AI Computer SHOULD set DIRECTION_REQUEST to FORWARD (3.0: 3.2; 4.0: 4).

";
        assert_eq!(
            files.into_iter().collect::<Vec<_>>(),
            [("proof/proofs/src/kani/go.rs.txt".into(), expected.into())]
        );
    }
}
