//! The parts of a report that say how close the run came, and what it exercised.

use adsdv_oracle::judge::{Exercised, Margin, Report, Required, RequirementStanding};
use serde::Serialize;

use super::number::{rounded, seconds};

#[derive(Serialize)]
pub(super) struct MarginJson {
    what: &'static str,
    message: Option<String>,
    party: &'static str,
    section: &'static str,
    requirements: Vec<&'static str>,
    value: f64,
    limit: f64,
    unit: &'static str,
    basis: &'static str,
    left: f64,
    t: f64,
}

#[derive(Serialize)]
pub(super) struct ExercisedJson {
    ai: bool,
    vcu: bool,
    states: Vec<&'static str>,
    requirements: Vec<RequirementStandingJson>,
}

#[derive(Serialize)]
struct RequirementStandingJson {
    id: &'static str,
    /// The key is older than the name.
    #[serde(rename = "told")]
    standing: &'static str,
}

#[derive(Serialize)]
pub(super) struct RequiredJson {
    what: String,
    met: bool,
}

impl From<&Margin> for MarginJson {
    fn from(margin: &Margin) -> Self {
        Self {
            what: margin.what.id(),
            message: margin.message.map(|id| format!("{id:03X}h")),
            party: margin.party.name(),
            section: margin.section,
            requirements: margin.requirements.clone(),
            value: rounded(margin.value, 1e3),
            limit: rounded(margin.limit, 1e3),
            unit: margin.unit,
            basis: margin.basis.name(),
            left: rounded(margin.left(), 1e6),
            t: seconds(margin.t_ns),
        }
    }
}

impl From<&Exercised> for ExercisedJson {
    fn from(exercised: &Exercised) -> Self {
        Self {
            ai: exercised.ai,
            vcu: exercised.vcu,
            states: exercised.states.iter().map(|state| state.name()).collect(),
            requirements: exercised.requirements.iter().map(RequirementStandingJson::from).collect(),
        }
    }
}

impl From<&RequirementStanding> for RequirementStandingJson {
    fn from(RequirementStanding { id, standing }: &RequirementStanding) -> Self {
        Self { id, standing: standing.name() }
    }
}

impl RequiredJson {
    /// What was asked for, and whether the report has it.
    pub(super) fn all(required: &[Required], report: &Report) -> Vec<Self> {
        let of = |one: &Required| Self { what: one.to_string(), met: report.exercised.meets(*one) };
        required.iter().map(of).collect()
    }
}
