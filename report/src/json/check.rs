//! A report, whole.

use adsdv_oracle::judge::{Report, Required, Transition};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::Edition;
use serde::Serialize;

use super::SCHEMA;
use super::exercised::{ExercisedJson, MarginJson, RequiredJson};
use super::finding::FindingJson;
use super::number::seconds;
use super::recognised::RecognisedJson;
use super::response::ResponseJson;
use super::rules::RuleJson;
use super::stays::{GoPressJson, StayJson};

/// A report as `adsdv check --json` prints it.
#[derive(Serialize)]
pub struct CheckJson<'a> {
    schema: u32,
    /// Its name, where it is one of several.
    #[serde(skip_serializing_if = "Option::is_none")]
    log: Option<&'a str>,
    edition: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    recognised: Option<RecognisedJson<'a>>,
    frames: u64,
    duration_s: f64,
    transitions: Vec<TransitionJson>,
    findings: Vec<FindingJson<'a>>,
    stays: Vec<StayJson>,
    go_presses: Vec<GoPressJson>,
    margins: Vec<MarginJson>,
    handshake_response_ms: Option<ResponseJson>,
    exercised: ExercisedJson,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rules: Vec<RuleJson<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    required: Vec<RequiredJson>,
    verdict: &'static str,
}

#[derive(Serialize)]
struct TransitionJson {
    t: f64,
    from: &'static str,
    to: &'static str,
    section: &'static str,
    justified: &'static str,
}

impl<'a> CheckJson<'a> {
    /// A report by an edition, with by what it was recognised, where it was.
    pub fn new(edition: &Edition, recognised: Option<&'a Recognised>, report: &'a Report) -> Self {
        Self {
            schema: SCHEMA,
            log: None,
            edition: edition.version,
            recognised: recognised.map(RecognisedJson::of),
            frames: report.frames,
            duration_s: seconds(report.duration_ns),
            transitions: report.transitions.iter().map(TransitionJson::from).collect(),
            findings: report.findings.iter().map(FindingJson::from).collect(),
            stays: report.stays.iter().map(|stay| StayJson::of(&edition.rules, stay)).collect(),
            go_presses: report
                .go_presses
                .iter()
                .map(|press| GoPressJson::of(&edition.rules, press))
                .collect(),
            margins: report.margins.iter().map(MarginJson::from).collect(),
            handshake_response_ms: ResponseJson::of(&report.responses),
            exercised: ExercisedJson::from(&report.exercised),
            rules: report.rules.iter().map(RuleJson::from).collect(),
            required: Vec::new(),
            verdict: report.verdict().name(),
        }
    }

    /// The same, of one of several logs.
    #[must_use]
    pub fn of_log(self, log: Option<&'a str>) -> Self {
        Self { log, ..self }
    }

    /// The same, with whether it has what was required.
    #[must_use]
    pub fn requiring(self, required: &[Required], report: &Report) -> Self {
        Self { required: RequiredJson::all(required, report), ..self }
    }
}

impl From<&Transition> for TransitionJson {
    fn from(transition: &Transition) -> Self {
        Self {
            t: seconds(transition.t_ns),
            from: transition.from.name(),
            to: transition.to.name(),
            section: transition.section,
            justified: transition.justified.name(),
        }
    }
}
