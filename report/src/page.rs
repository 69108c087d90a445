//! The page of a judged recording, and its data.

use std::collections::BTreeMap;

use adsdv_oracle::judge::Report;
use adsdv_spec::{AsState, Assi, Edition, requirement};
use serde::Serialize;
use serde_json::value::RawValue;

use crate::answers::answers;
use crate::catalog::{MessageJson, messages};
use crate::chunks::{ChunkJson, chunks};
use crate::facts::{DecidedJson, Facts, decided};
use crate::lanes::{LaneJson, gaps, lanes};
use crate::overview::{OverviewJson, overview};
use crate::plots::{PlotJson, plots};
use crate::questions::{AnswerJson, questions};
use crate::recording::Recording;
use crate::summary::{SummaryJson, summary};
use crate::template::{filled, harmless};
use crate::time::micros;

/// The page without data, as `page/` builds it.
pub(crate) const TEMPLATE: &str = include_str!("../page/dist/page.html");

/// A judged recording, as a page is made of it.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// What the user calls the log.
    pub name: &'a str,
    /// How it was judged, where that is not as usual: a line each.
    pub settings: &'a [String],
    /// The report as `adsdv check --json` prints it: its numbers are those on the page.
    pub check: &'a str,
    /// The edition that it was judged by.
    pub edition: &'static Edition,
    /// The report.
    pub report: &'a Report,
    /// What was recorded.
    pub recording: &'a Recording,
}

/// Why there is no page: what was given as the report in JSON is none.
pub type PageError = serde_json::Error;

#[derive(Serialize)]
struct DataJson<'a> {
    name: &'a str,
    version: &'static str,
    settings: &'a [String],
    check: &'a RawValue,
    summary: SummaryJson,
    questions: Vec<AnswerJson>,
    transitions: Vec<DecisionJson>,
    /// What the light of each state shows.
    lights: Vec<(&'static str, String)>,
    /// The sentences of the requirements that are named.
    requirements: BTreeMap<&'a str, &'static str>,
    messages: Vec<MessageJson>,
    lanes: Vec<LaneJson>,
    gaps: Vec<(i64, i64)>,
    drops: Vec<(i64, u64)>,
    interface: Option<&'a str>,
    others: u64,
    /// When the last frame came, in microseconds.
    end: i64,
    plots: Vec<PlotJson>,
    overview: OverviewJson,
    chunks: Vec<ChunkJson>,
}

/// What `--json` does not say of a transition: the conditions that decided.
#[derive(Serialize)]
struct DecisionJson {
    decided: Vec<DecidedJson>,
    or: Vec<String>,
}

impl Subject<'_> {
    /// The page, which needs nothing else: a browser opens it from a file or a mail.
    ///
    /// # Errors
    ///
    /// As [`data`](Self::data).
    pub fn html(&self) -> Result<String, PageError> {
        Ok(filled(TEMPLATE, &self.data()?))
    }

    /// The data of the page, as one JSON object in which no `<` can end the script that it stands in.
    ///
    /// # Errors
    ///
    /// Fails if the report cannot be written as JSON.
    pub fn data(&self) -> Result<String, PageError> {
        let Self { name, settings, edition, report, recording, .. } = *self;
        let facts = Facts { edition, report, recording };
        let (bus, rules) = (&edition.bus, &edition.rules);
        let answers = answers(recording, bus, report);
        let plots = plots(edition);
        let data = DataJson {
            name,
            version: env!("CARGO_PKG_VERSION"),
            settings,
            check: serde_json::from_str(self.check)?,
            summary: summary(&facts),
            questions: questions(&facts),
            transitions: report
                .transitions
                .iter()
                .map(|one| DecisionJson { decided: decided(rules, one), or: one.others(rules) })
                .collect(),
            lights: AsState::ALL.iter().map(|state| (state.name(), Assi::of(*state).to_string())).collect(),
            requirements: self.requirements(),
            messages: messages(edition),
            lanes: lanes(recording, bus),
            gaps: gaps(recording, bus),
            drops: recording.drops.iter().map(|lost| (micros(lost.t_ns), lost.count)).collect(),
            interface: recording.interface.as_deref(),
            others: recording.others,
            end: micros(recording.end_ns),
            overview: overview(recording, &answers, bus, &plots),
            plots,
            chunks: chunks(recording, &answers),
        };
        Ok(harmless(&serde_json::to_string(&data)?))
    }

    /// The requirements that the report names.
    fn requirements(&self) -> BTreeMap<&'static str, &'static str> {
        let report = self.report;
        let of_findings = report.findings.iter().flat_map(|one| one.requirements.iter());
        let of_margins = report.margins.iter().flat_map(|one| one.requirements.iter());
        let arrows = report.stays.iter().flat_map(|stay| &stay.arrows);
        let of_arrows = arrows.flat_map(|arrow| arrow.requirements.iter());
        let exercised = report.exercised.requirements.iter().map(|one| &one.id);
        let all = of_findings.chain(of_margins).chain(of_arrows).chain(exercised);
        all.filter_map(|id| Some((*id, requirement(id)?))).collect()
    }
}
