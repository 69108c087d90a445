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
    use super::{Citation, annotations};
    use crate::kind::Kind;
    use crate::requirements::{Requirements, tests::SMALL};

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
//# - **DRV-10** The AI Computer SHOULD set DIRECTION_REQUEST to FORWARD (3.2).

";
        assert_eq!(
            files.into_iter().collect::<Vec<_>>(),
            [("proof/proofs/src/kani/go.rs.txt".into(), expected.into())]
        );
    }
}
