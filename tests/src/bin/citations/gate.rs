//! The gate: in each edition that the code has, every requirement has an implementation, a proof and a test.
//!
//! The requirements of an edition that the code does not have yet wait for it: they are counted, and nothing is asked of them.
//! With the edition in `Edition::ALL` the gate asks for all of them, without a change here.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde_json::Value;

use crate::annotate::Citation;
use crate::kind::Kind;
use crate::requirements::{Requirement, Requirements};

/// What the requirements have and lack, edition by edition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Verdict {
    editions: Vec<OfEdition>,
}

/// What the requirements of one edition have and lack.
#[derive(Clone, Debug, PartialEq, Eq)]
struct OfEdition {
    edition: String,
    /// The code has the edition. Where it does not, these are the requirements that hold in no edition that it has.
    in_code: bool,
    requirements: usize,
    /// The kinds that a requirement lacks, by its identifier.
    lacking: Vec<(String, Vec<Kind>)>,
}

impl Verdict {
    /// What these citations come to, for the editions that the code has. What stands in the folder of an edition counts for
    /// that one and those after it, which begin with what is there.
    pub(crate) fn of_citations(
        citations: &[Citation<'_>],
        requirements: &Requirements,
        code: &[&str],
    ) -> Self {
        let place = |edition: &str| requirements.editions().iter().position(|other| other == edition);
        let cited: BTreeSet<_> = citations
            .iter()
            .map(|cited| {
                let first = cited.folder().and_then(|edition| place(&edition)).unwrap_or_default();
                (&cited.requirement.id, cited.kind, first)
            })
            .collect();
        Self::new(requirements, code, |requirement, edition, kind| {
            let last = place(edition).unwrap_or_default();
            !(0..=last).any(|first| cited.contains(&(&requirement.id, kind, first)))
        })
    }

    fn new(
        requirements: &Requirements,
        code: &[&str],
        lacks: impl Fn(&Requirement, &str, Kind) -> bool,
    ) -> Self {
        let of_edition = |edition: &String| {
            let in_code = code.contains(&edition.as_str());
            let is_asked = |requirement: &&Requirement| {
                requirement.holds_in(edition)
                    && (in_code || !code.iter().any(|other| requirement.holds_in(other)))
            };
            let asked: Vec<_> = requirements.in_force().filter(is_asked).collect();
            let lacking = asked.iter().map(|requirement| {
                let kinds = Kind::ALL.into_iter().filter(|&kind| lacks(requirement, edition, kind));
                (requirement.id.to_string(), kinds.collect::<Vec<_>>())
            });
            OfEdition {
                edition: edition.clone(),
                in_code,
                requirements: asked.len(),
                lacking: lacking.filter(|(_, kinds)| !kinds.is_empty()).collect(),
            }
        };
        Self { editions: requirements.editions().iter().map(of_edition).collect() }
    }

    /// What duvet reports. The report has to be about these requirements, all of them. It does not tell where a citation stands,
    /// so that one for any edition is one for each.
    pub(crate) fn of_report(json: &str, requirements: &Requirements, code: &[&str]) -> Result<Self, String> {
        let report: Value = serde_json::from_str(json).map_err(|error| error.to_string())?;
        let annotations = report["annotations"].as_array().ok_or("no list of annotations")?;
        let mut sentences: BTreeMap<&str, _> =
            requirements.in_force().map(|requirement| (requirement.line.as_str(), &requirement.id)).collect();
        let mut lacking = BTreeSet::new();
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
            lacking.extend(Kind::ALL.into_iter().filter(lacks).map(|kind| (id, kind)));
        }
        match sentences.first_key_value() {
            Some((_, id)) => Err(format!("{id} is not in the report; run `duvet report` again")),
            None => Ok(Self::new(requirements, code, |requirement, _, kind| {
                lacking.contains(&(&requirement.id, kind))
            })),
        }
    }

    /// Whether no requirement of an edition that the code has lacks anything.
    pub(crate) fn is_complete(&self) -> bool {
        self.editions.iter().all(|of_edition| !of_edition.in_code || of_edition.lacking.is_empty())
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for OfEdition { edition, lacking, .. } in self.editions.iter().filter(|of_edition| of_edition.in_code)
        {
            for (id, kinds) in lacking {
                let kinds: Vec<_> = kinds.iter().map(|kind| kind.name()).collect();
                writeln!(f, "{id} lacks in {edition}: {}", kinds.join(", "))?;
            }
        }
        for (place, OfEdition { edition, in_code, requirements, lacking }) in self.editions.iter().enumerate()
        {
            let line_end = if place == 0 { "" } else { "\n" };
            let complete = requirements - lacking.len();
            write!(f, "{line_end}{edition}: ")?;
            if !in_code {
                write!(f, "the code does not have this edition yet; of what holds in no other, ")?;
            }
            write!(
                f,
                "{complete} of {requirements} requirements have an implementation, a proof and a test"
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict;
    use crate::annotate::Citation;
    use crate::kind::Kind;
    use crate::requirements::{Requirements, tests::SMALL};

    /// The line about an edition that the code does not have, and none of whose own requirements has anything.
    const WAITING: &str = "4.0: the code does not have this edition yet; of what holds in no other, 0 of 1 requirements \
                           have an implementation, a proof and a test";

    /// A report in which HS-4 and DRV-10 have everything, HS-6 has this, and HS-17 nothing.
    fn report(status: &str) -> String {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let spec = |id: &str| {
            let cited = requirements.list(id).expect("it is there");
            format!(r#"{{"type":"SPEC","comment":"{}\n"}}"#, cited[0].line)
        };
        let all = r#"{"spec":70,"citation":70,"implication":70,"test":70,"related":[1]}"#;
        format!(
            r#"{{"annotations":[{},{{"type":"CITATION"}},{},{},{}],"statuses":{{"0":{all},"2":{status},"3":{all}}}}}"#,
            spec("HS-4"),
            spec("HS-6"),
            spec("DRV-10"),
            spec("HS-17"),
        )
    }

    fn read(json: &str, code: &[&str]) -> Result<Verdict, String> {
        Verdict::of_report(json, &Requirements::parse(SMALL).expect("well written"), code)
    }

    #[test]
    fn all_is_well() {
        let verdict = read(&report(r#"{"spec":50,"citation":50,"implication":50,"test":50}"#), &["3.0"])
            .expect("a report");
        assert!(verdict.is_complete());
        let expected =
            format!("3.0: 3 of 3 requirements have an implementation, a proof and a test\n{WAITING}");
        assert_eq!(verdict.to_string(), expected);
    }

    #[test]
    fn what_is_missing_is_named() {
        for (status, lacks) in [
            (r#"{"spec":50,"implication":50,"test":50}"#, "HS-6 lacks in 3.0: implementation"),
            (r#"{"spec":50,"citation":50,"test":50}"#, "HS-6 lacks in 3.0: proof"),
            (r#"{"spec":50,"citation":50,"implication":50,"test":49}"#, "HS-6 lacks in 3.0: test"),
            (r#"{"spec":50,"incomplete":50}"#, "HS-6 lacks in 3.0: implementation, proof, test"),
            ("null", "HS-6 lacks in 3.0: implementation, proof, test"),
        ] {
            let verdict = read(&report(status), &["3.0"]).expect("a report");
            assert!(!verdict.is_complete());
            let expected = format!(
                "{lacks}\n3.0: 2 of 3 requirements have an implementation, a proof and a test\n{WAITING}"
            );
            assert_eq!(verdict.to_string(), expected);
        }
    }

    #[test]
    fn an_edition_that_the_code_has_waits_no_longer() {
        let report = report(r#"{"spec":50,"citation":50,"implication":50,"test":50}"#);
        let verdict = read(&report, &["3.0", "4.0"]).expect("a report");
        assert!(!verdict.is_complete());
        assert_eq!(
            verdict.to_string(),
            "HS-17 lacks in 4.0: implementation, proof, test\n\
             3.0: 3 of 3 requirements have an implementation, a proof and a test\n\
             4.0: 2 of 3 requirements have an implementation, a proof and a test"
        );
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
        for code in [&["3.0"][..], &["3.0", "4.0"], &["4.0"]] {
            let verdict = Verdict::of_citations(&citations, &requirements, code);
            assert_eq!(Ok(&verdict), read(&report(r#"{"spec":50,"implication":50}"#), code).as_ref());
        }
        citations.extend(of(&Kind::ALL, cited[1]));
        assert!(Verdict::of_citations(&citations, &requirements, &["3.0"]).is_complete());
        assert!(!Verdict::of_citations(&citations, &requirements, &["3.0", "4.0"]).is_complete());
    }

    #[test]
    fn the_folder_of_an_edition_is_none_of_an_older_one() {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let cited = requirements.list("HS-4, HS-6, HS-17, DRV-10").expect("they are there");
        for (folder, lacking) in [("v3_0", None), ("v4_0", Some("HS-4 lacks in 3.0: implementation"))] {
            let citations = cited.iter().flat_map(|&requirement| {
                Kind::ALL.into_iter().map(move |kind| {
                    let here = requirement.id.to_string() == "HS-4" && kind == Kind::Implementation;
                    let path =
                        if here { format!("spec/src/editions/{folder}/mod.rs") } else { "a.rs".to_owned() };
                    Citation { kind, requirement, path, line: 1 }
                })
            });
            let citations: Vec<_> = citations.collect();
            let verdict = Verdict::of_citations(&citations, &requirements, &["3.0", "4.0"]).to_string();
            assert_eq!(verdict.lines().find(|line| line.contains("lacks")), lacking);
        }
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
            let error = read(&other, &["3.0"]).expect_err(part);
            assert!(error.contains(part), "{error}");
        }
    }
}
