//! Asks, explains, and asks again with what was learnt.

use adsdv_oracle::conform::ProgramError;
use adsdv_spec::Edition;

use crate::deviation::Deviation;
use crate::experiments;
use crate::fit::{alternatives, fit};
use crate::model::Model;
use crate::record::Record;
use crate::subject::Subject;
use crate::turn;

/// No more rounds of experiments than these: each begins with what the one before has found.
const ROUNDS: u64 = 8;
/// So many experiments that tell one explanation from another are made.
const SEPARATING: usize = 8;

/// What a program does otherwise.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The deviations, in the order in which they were found.
    pub deviations: Vec<Deviation>,
    /// What was asked and answered, and none of them explains.
    pub unexplained: Vec<Record>,
    /// How many experiments there were.
    pub experiments: usize,
}

/// What a program answers to the experiments that a model leads to.
pub fn records(subject: &mut dyn Subject, model: &Model) -> Result<Vec<Record>, ProgramError> {
    experiments::all(subject, model, 0)
}

/// Finds out what a program does otherwise than an edition says.
pub fn diagnose(subject: &mut dyn Subject, edition: &Edition) -> Result<Diagnosis, ProgramError> {
    let mut deviations: Vec<Deviation> = Vec::new();
    let mut records: Vec<Record> = Vec::new();
    for round in 0..ROUNDS {
        let model = Model::new(edition, &deviations);
        let before = records.len();
        records.extend(experiments::all(subject, &model, round)?);
        let news = |records: &[Record]| records.iter().any(|record| !record.is_explained(&model));
        let measured = if records.get(before..).is_some_and(news) {
            turn::all(subject, &model)?
        } else {
            records.extend(separating(subject, edition, &records, &deviations)?);
            if !records.get(before..).is_some_and(news) {
                break;
            }
            Vec::new()
        };
        let found = fit(edition, &records, deviations.clone(), &measured);
        if found == deviations {
            break;
        }
        deviations = found;
    }
    let model = Model::new(edition, &deviations);
    let experiments = records.len();
    let unexplained = records.into_iter().filter(|record| !record.is_explained(&model)).collect();
    Ok(Diagnosis { deviations, unexplained, experiments })
}

/// What a program answers where deviations that explain as much would do otherwise.
fn separating(
    subject: &mut dyn Subject,
    edition: &Edition,
    records: &[Record],
    deviations: &[Deviation],
) -> Result<Vec<Record>, ProgramError> {
    let model = Model::new(edition, deviations);
    let mut asked = Vec::new();
    for alike in alternatives(edition, records, deviations, &[]) {
        let other = Model::new(edition, &alike);
        let told = experiments::all(&mut other.clone().running(), &other, 0)?;
        let differ = told.iter().filter(|record| !record.is_explained(&model));
        for record in differ.take(SEPARATING) {
            asked.push(Record::of(subject, &record.steps)?);
        }
    }
    Ok(asked)
}
