//! What the program does otherwise, as `--json` writes it.

use std::collections::BTreeMap;

use adsdv_diagnosis::{Arrow, Deviation, Example};
use adsdv_spec::Machine;
use serde::Serialize;

use super::DiagnosedProgram;
use crate::conform::figure::mark;

/// All of it.
#[derive(Serialize)]
pub(in crate::conform) struct DiagnosisJson<'a> {
    experiments: usize,
    deviations: Vec<DeviationJson<'a>>,
    readings: BTreeMap<&'static str, &'static str>,
    figure: Vec<ArrowJson<'a>>,
    unexplained: usize,
    left_out: &'a [&'static str],
    cut: bool,
    unused: Vec<&'a str>,
}

#[derive(Serialize)]
struct DeviationJson<'a> {
    id: String,
    text: String,
    requirements: Vec<&'static str>,
    observed: bool,
    accepted: Option<&'a str>,
    example: Option<ExampleJson>,
}

#[derive(Serialize)]
struct ExampleJson {
    differences: Vec<String>,
    beside: Vec<String>,
    test: String,
}

#[derive(Serialize)]
struct ArrowJson<'a> {
    from: &'static str,
    to: &'static str,
    section: Option<&'static str>,
    guard: &'a [String],
    otherwise: &'a [String],
    missing: bool,
    not_shown: bool,
}

impl<'a> From<&'a DiagnosedProgram> for DiagnosisJson<'a> {
    fn from(program: &'a DiagnosedProgram) -> Self {
        let DiagnosedProgram { edition, found, accepted, .. } = program;
        let machine = Machine::new(*edition, edition.readings);
        let one = |(deviation, example): (&Deviation, &Option<Example>)| {
            let id = deviation.id(edition);
            DeviationJson {
                text: deviation.text(edition).to_string(),
                requirements: deviation.requirements(edition),
                observed: program.is_observed(*deviation),
                accepted: accepted.reason(&id),
                example: example.as_ref().map(|example| ExampleJson {
                    differences: example.differences.iter().map(ToString::to_string).collect(),
                    beside: example.beside.iter().map(|other| other.id(edition)).collect(),
                    test: example.scenario.to_line(&id, &machine).to_string(),
                }),
                id,
            }
        };
        let arrow = |arrow: &'a Arrow| ArrowJson {
            from: arrow.from.name(),
            to: arrow.to.name(),
            section: arrow.section,
            guard: &arrow.guard,
            otherwise: &arrow.otherwise,
            missing: mark(arrow) == adsdv_spec::export::Mark::Missing,
            not_shown: arrow.not_shown,
        };
        Self {
            experiments: found.experiments,
            deviations: found.deviations.iter().zip(&program.examples).map(one).collect(),
            readings: found.readings.iter().map(|choice| (choice.reading().id(), choice.id())).collect(),
            figure: program.figure.iter().map(arrow).collect(),
            unexplained: found.unexplained.len(),
            left_out: &found.left_out,
            cut: found.cut,
            unused: program.unused(),
        }
    }
}
