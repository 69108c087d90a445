//! The gate: every requirement has an implementation, a proof and a test.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde_json::Value;

use crate::annotate::Citation;
use crate::kind::Kind;
use crate::requirements::Requirements;

/// What the requirements have and lack.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Verdict {
    requirements: usize,
    /// The kinds that a requirement lacks, by its identifier.
    lacking: Vec<(String, Vec<Kind>)>,
}

impl Verdict {
    /// What these citations come to.
    pub(crate) fn of_citations(citations: &[Citation<'_>], requirements: &Requirements) -> Self {
        let cited: BTreeSet<_> = citations.iter().map(|cited| (&cited.requirement.id, cited.kind)).collect();
        let lacking = requirements.in_force().map(|requirement| {
            let lacks = |kind: &Kind| !cited.contains(&(&requirement.id, *kind));
            (requirement.id.to_string(), Kind::ALL.into_iter().filter(lacks).collect::<Vec<_>>())
        });
        Self {
            requirements: requirements.in_force().count(),
            lacking: lacking.filter(|(_, kinds)| !kinds.is_empty()).collect(),
        }
    }

    /// What duvet reports. The report has to be about these requirements, all of them.
    pub(crate) fn of_report(json: &str, requirements: &Requirements) -> Result<Self, String> {
        let report: Value = serde_json::from_str(json).map_err(|error| error.to_string())?;
        let annotations = report["annotations"].as_array().ok_or("no list of annotations")?;
        let mut sentences: BTreeMap<&str, _> =
            requirements.in_force().map(|requirement| (requirement.line.as_str(), &requirement.id)).collect();
        let mut lacking = Vec::new();
        let count = sentences.len();
        for (number, annotation) in annotations.iter().enumerate() {
            if annotation["type"] != "SPEC" {
                continue;
            }
            let sentence = annotation["comment"].as_str().unwrap_or_default().trim();
            let Some(id) = sentences.remove(sentence) else {
                return Err(format!(
                    "{sentence:?} is no requirement, or there twice; run `duvet report` again"
                ));
            };
            let status = &report["statuses"][number.to_string()];
            let lacks = |kind: &Kind| status["spec"].is_null() || status[kind.reported()] != status["spec"];
            let kinds: Vec<Kind> = Kind::ALL.into_iter().filter(lacks).collect();
            if !kinds.is_empty() {
                lacking.push((id.to_string(), kinds));
            }
        }
        match sentences.first_key_value() {
            Some((_, id)) => Err(format!("{id} is not in the report; run `duvet report` again")),
            None => Ok(Self { requirements: count, lacking }),
        }
    }

    /// Whether no requirement lacks anything.
    pub(crate) fn is_complete(&self) -> bool {
        self.lacking.is_empty()
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (id, kinds) in &self.lacking {
            let kinds: Vec<_> = kinds.iter().map(|kind| kind.name()).collect();
            writeln!(f, "{id} lacks: {}", kinds.join(", "))?;
        }
        let Self { requirements, lacking } = self;
        let complete = requirements - lacking.len();
        write!(f, "{complete} of {requirements} requirements have an implementation, a proof and a test")
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict;
    use crate::annotate::Citation;
    use crate::kind::Kind;
    use crate::requirements::{Requirements, tests::SMALL};

    /// A report in which HS-4 and DRV-10 have everything, and HS-6 has this.
    fn report(status: &str) -> String {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let spec = |id: &str| {
            let cited = requirements.list(id).expect("it is there");
            format!(r#"{{"type":"SPEC","comment":"{}\n"}}"#, cited[0].line)
        };
        let all = r#"{"spec":70,"citation":70,"implication":70,"test":70,"related":[1]}"#;
        format!(
            r#"{{"annotations":[{},{{"type":"CITATION"}},{},{}],"statuses":{{"0":{all},"2":{status},"3":{all}}}}}"#,
            spec("HS-4"),
            spec("HS-6"),
            spec("DRV-10"),
        )
    }

    fn read(json: &str) -> Result<Verdict, String> {
        Verdict::of_report(json, &Requirements::parse(SMALL).expect("well written"))
    }

    #[test]
    fn all_is_well() {
        let verdict =
            read(&report(r#"{"spec":50,"citation":50,"implication":50,"test":50}"#)).expect("a report");
        assert!(verdict.is_complete());
        assert_eq!(verdict.to_string(), "3 of 3 requirements have an implementation, a proof and a test");
    }

    #[test]
    fn what_is_missing_is_named() {
        for (status, lacks) in [
            (r#"{"spec":50,"implication":50,"test":50}"#, "HS-6 lacks: implementation"),
            (r#"{"spec":50,"citation":50,"test":50}"#, "HS-6 lacks: proof"),
            (r#"{"spec":50,"citation":50,"implication":50,"test":49}"#, "HS-6 lacks: test"),
            (r#"{"spec":50,"incomplete":50}"#, "HS-6 lacks: implementation, proof, test"),
            ("null", "HS-6 lacks: implementation, proof, test"),
        ] {
            let verdict = read(&report(status)).expect("a report");
            assert!(!verdict.is_complete());
            let expected = format!("{lacks}\n2 of 3 requirements have an implementation, a proof and a test");
            assert_eq!(verdict.to_string(), expected);
        }
    }

    #[test]
    fn citations_alone_find_the_same() {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let cited = requirements.list("HS-4, HS-6, DRV-10").expect("they are there");
        let of = |kinds: &[Kind], requirement| {
            let cited = |&kind| Citation { kind, requirement, path: "a.rs".to_owned(), line: 1 };
            kinds.iter().map(cited).collect::<Vec<_>>()
        };
        let mut citations = [of(&Kind::ALL, cited[0]), of(&Kind::ALL, cited[2])].concat();
        citations.extend(of(&[Kind::Proof], cited[1]));
        let verdict = Verdict::of_citations(&citations, &requirements);
        assert_eq!(Ok(&verdict), read(&report(r#"{"spec":50,"implication":50}"#)).as_ref());
        citations.extend(of(&Kind::ALL, cited[1]));
        assert!(Verdict::of_citations(&citations, &requirements).is_complete());
    }

    #[test]
    fn a_report_about_something_else_is_refused() {
        let report = report(r#"{"spec":50}"#);
        for (other, part) in [
            ("{".to_owned(), "EOF"),
            ("{}".to_owned(), "no list of annotations"),
            (r#"{"annotations":[]}"#.to_owned(), "DRV-10 is not in the report"),
            (report.replace("HS-6", "HS-7"), "is no requirement"),
            (
                report.replace("**HS-6** The VCU MUST hold its HANDSHAKE bit at 1", "**HS-6** More"),
                "is no requirement",
            ),
        ] {
            let error = read(&other).expect_err(part);
            assert!(error.contains(part), "{error}");
        }
    }
}
