//! The snapshot that duvet writes, held against the sources without duvet.

use std::collections::BTreeSet;
use std::iter;

use crate::annotate::Citation;
use crate::kind::Kind;
use crate::requirements::Requirements;

/// Where the snapshot has a requirement in a line.
const TEXT: &str = "TEXT[";

/// How the snapshot differs from what the sources say: the lines that it should not have, behind a minus, and those that it should,
/// behind a plus.
pub(crate) fn differences(
    snapshot: &str,
    citations: &[Citation<'_>],
    requirements: &Requirements,
) -> Vec<String> {
    let written: BTreeSet<String> =
        snapshot.lines().map(str::trim).filter(|line| line.starts_with(TEXT)).map(str::to_owned).collect();
    let cited: BTreeSet<_> = citations.iter().map(|cited| (&cited.requirement.id, cited.kind)).collect();
    let expected = requirements.in_force().map(|requirement| {
        let kinds = Kind::ALL.into_iter().filter(|&kind| cited.contains(&(&requirement.id, kind)));
        let marks: Vec<_> = iter::once(requirement.keyword()).chain(kinds.map(Kind::annotated)).collect();
        format!("{TEXT}!{}]: {}", marks.join(","), requirement.line)
    });
    let expected: BTreeSet<String> = expected.collect();
    let gone = written.difference(&expected).map(|line| format!("-{line}"));
    gone.chain(expected.difference(&written).map(|line| format!("+{line}"))).collect()
}

#[cfg(test)]
mod tests {
    use super::differences;
    use crate::annotate::Citation;
    use crate::kind::Kind;
    use crate::requirements::{Requirements, tests::SMALL};

    #[test]
    fn what_is_not_as_the_sources_say_is_named_with_what_they_say() {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let line = |id: &str| requirements.list(id).expect("it is there")[0].line.clone();
        let of = |kinds: &[Kind]| {
            let cited = |&kind| Citation {
                kind,
                requirement: requirements.list("HS-4").expect("it is there")[0],
                path: "a.rs".to_owned(),
                line: 1,
            };
            kinds.iter().map(cited).collect::<Vec<_>>()
        };
        let without = |(keyword, id)| format!("    TEXT[!{keyword}]: {}\n", line(id));
        let others = [("MUST", "HS-6"), ("MUST", "HS-17"), ("SHOULD", "DRV-10")].map(without).concat();
        let whole = format!("    TEXT[!MUST,implementation,implication,test]: {}", line("HS-4"));
        let snapshot = format!("SPECIFICATION: [All](all.md)\n  SECTION: [One](#one)\n{whole}\n{others}");
        assert_eq!(differences(&snapshot, &of(&Kind::ALL), &requirements), [""; 0]);
        let lost = format!("+TEXT[!MUST,implementation,test]: {}", line("HS-4"));
        let kinds = [Kind::Implementation, Kind::Test];
        assert_eq!(
            differences(&snapshot, &of(&kinds), &requirements),
            [format!("-{}", whole.trim()), lost.clone()]
        );
        assert_eq!(differences(&others, &of(&kinds), &requirements), [lost]);
    }
}
