//! The outcome for a program. Its form is described by `schema/verify.schema.json`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::counterexample::Failure;
use super::outcome::{Checked, Claim, Explored, Outcome};
use crate::json::{SCHEMA, line};

/// The outcome as one JSON object on one line.
pub(super) fn text(outcome: &Outcome, failures: &[Failure]) -> String {
    let readings = outcome.machine.readings();
    line(&VerifyJson {
        schema: SCHEMA,
        edition: outcome.machine.edition().version,
        readings: outcome
            .machine
            .edition()
            .questions()
            .map(|reading| (reading.id(), readings.choice(reading).id()))
            .collect(),
        models: outcome.models.iter().map(|model| ModelJson::of(model, failures)).collect(),
        dead_parts: outcome.dead().map(ToString::to_string).collect(),
        moot_parts: outcome
            .moot()
            .map(|(part, choice)| MootPartJson { part: part.to_string(), decides_with: choice.to_string() })
            .collect(),
        holds: outcome.holds(),
    })
}

#[derive(Serialize)]
struct VerifyJson<'a> {
    schema: u32,
    edition: &'static str,
    readings: BTreeMap<&'static str, &'static str>,
    models: Vec<ModelJson<'a>>,
    dead_parts: Vec<String>,
    moot_parts: Vec<MootPartJson>,
    holds: bool,
}

#[derive(Serialize)]
struct MootPartJson {
    part: String,
    decides_with: String,
}

#[derive(Serialize)]
struct ModelJson<'a> {
    name: &'a str,
    states: u64,
    transitions: u64,
    depth: usize,
    seconds: f64,
    complete: bool,
    properties: Vec<PropertyJson<'a>>,
}

#[derive(Serialize)]
struct PropertyJson<'a> {
    name: &'a str,
    statement: &'a str,
    requirements: &'a [&'static str],
    claim: &'static str,
    holds: bool,
    steps: Option<usize>,
    log: Option<String>,
}

impl<'a> ModelJson<'a> {
    fn of(model: &'a Explored, failures: &[Failure]) -> Self {
        Self {
            name: model.name,
            states: model.states,
            transitions: model.transitions,
            depth: model.depth,
            seconds: model.time.as_secs_f64(),
            complete: model.complete,
            properties: model.results.iter().map(|result| PropertyJson::of(result, failures)).collect(),
        }
    }
}

impl<'a> PropertyJson<'a> {
    fn of(result: &'a Checked, failures: &[Failure]) -> Self {
        let failure = failures.iter().find(|failure| failure.name == result.name && !result.holds);
        Self {
            name: result.name,
            statement: &result.statement,
            requirements: &result.requirements,
            claim: match result.claim {
                Claim::Always => "always",
                Claim::Eventually => "eventually",
                Claim::Sometimes => "sometimes",
            },
            holds: result.holds,
            steps: result.steps,
            log: failure.map(|failure| failure.log.display().to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use adsdv_spec::Edition;
    use serde_json::Value;

    use super::super::outcome::well_behaved;
    use super::*;

    /// A closed model is reported as the open one is, with what is to hold in the end beside what holds always.
    #[test]
    fn every_property_of_a_closed_model_is_reported() {
        let schema = serde_json::from_str(include_str!("../../schema/verify.schema.json")).expect("JSON");
        let schema = jsonschema::validator_for(&schema).expect("a schema");
        for edition in Edition::ALL {
            let machine = adsdv_spec::Machine::new(**edition, edition.readings);
            let models = vec![well_behaved(&machine, 1)];
            let outcome = Outcome { machine, models, parts: Vec::new() };
            let json: Value = serde_json::from_str(&text(&outcome, &[])).expect("JSON");
            assert!(schema.is_valid(&json), "{json}");
            let (written, model) = (&json["models"][0], &outcome.models[0]);
            assert_eq!((&written["name"], &written["complete"]), (&model.name.into(), &true.into()));
            assert_eq!(
                (&written["states"], &written["transitions"]),
                (&model.states.into(), &model.transitions.into())
            );
            let properties = written["properties"].as_array().expect("an array");
            assert_eq!(properties.len(), model.results.len());
            for (property, result) in properties.iter().zip(&model.results) {
                assert_eq!((&property["name"], &property["log"]), (&result.name.into(), &Value::Null));
                assert_eq!(
                    (&property["holds"], &property["steps"]),
                    (&result.holds.into(), &result.steps.into())
                );
            }
            let claims: BTreeSet<_> =
                properties.iter().filter_map(|property| property["claim"].as_str()).collect();
            assert_eq!(claims, ["always", "eventually", "sometimes"].into());
        }
    }
}
