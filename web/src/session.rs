//! A page and what it asks.

use std::io::Read;

use serde::{Deserialize, Serialize};

use crate::about::AboutJson;
use crate::drive::Drive;
use crate::error::Refusal;
use crate::examples;
use crate::live::Live;
use crate::logs::{self, LogAsked};

/// What a page asks.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
enum Request {
    /// What there is to choose from.
    About,
    /// Judges the log that the page gives.
    Judge {
        name: String,
        #[serde(default)]
        edition: Option<String>,
        #[serde(default)]
        readings: Vec<String>,
        #[serde(default)]
        brief: bool,
    },
    /// The log of an example.
    Example { id: String },
    /// Begins with a new car.
    Begin {
        #[serde(default)]
        edition: Option<String>,
        #[serde(default)]
        readings: Vec<String>,
        /// The name of a scenario that is played.
        #[serde(default)]
        scenario: Option<String>,
    },
    /// The operator does something.
    Act { action: String },
    /// The AI Computer makes a mistake, or no longer does.
    Slip { slip: String, on: bool },
    /// Time goes on.
    Run { ms: u32 },
    /// The log of the drive so far.
    DriveLog,
    /// Begins to hear a bus.
    Listen {
        #[serde(default)]
        edition: Option<String>,
        #[serde(default)]
        readings: Vec<String>,
    },
    /// Lines that came from it, of which so many before were lost.
    Hear {
        lines: String,
        #[serde(default)]
        lost: u64,
    },
    /// Nothing comes any more.
    HeardAll,
}

/// What comes back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// JSON, or the text of a log.
    Text(String),
    /// JSON with `what`, `why` and `hint`.
    Refused(String),
}

/// What one page has begun.
///
/// ```
/// use adsdv_web::{Answer, Session};
///
/// let log: &[u8] = b"(1.0) can0 520#0000010000000000\n(1.01) can0 520#0000020000000000\n";
/// let request = r#"{"do": "judge", "name": "run.log", "brief": true}"#;
/// let Answer::Text(answer) = Session::default().answer(request, log) else { panic!("it is refused") };
/// assert!(answer.starts_with(r#"{"format":"candump","edition":"3.0","recognised":true,"verdict":""#), "{answer}");
/// ```
#[derive(Debug, Default)]
pub struct Session {
    drive: Option<Drive>,
    live: Option<Live>,
}

impl Session {
    /// Answers a request; `log` is the log that it is about, if it is about one.
    pub fn answer(&mut self, request: &str, log: impl Read + Send + 'static) -> Answer {
        match self.tried(request, Box::new(log)) {
            Ok(text) => Answer::Text(text),
            Err(refusal) => Answer::Refused(json(&refusal).unwrap_or_default()),
        }
    }

    fn tried(&mut self, request: &str, log: Box<dyn Read + Send>) -> Result<String, Refusal> {
        let request =
            serde_json::from_str(request).map_err(|error| Refusal::of_request(error.to_string()))?;
        match request {
            Request::About => json(&AboutJson::new()),
            Request::Judge { name, edition, readings, brief } => {
                json(&logs::judge(&LogAsked { name, edition, readings, brief }, log)?)
            }
            Request::Example { id } => examples::log(&id),
            Request::Begin { edition, readings, scenario } => {
                let text = scenario.as_deref().map(scenario_text).transpose()?;
                let drive = self.drive.insert(Drive::begin(edition.as_deref(), &readings, text)?);
                json(&drive.begun())
            }
            Request::Act { action } => {
                self.drive()?.act(&action)?;
                Ok("{}".to_owned())
            }
            Request::Slip { slip, on } => {
                self.drive()?.slip_named(&slip, on)?;
                Ok("{}".to_owned())
            }
            Request::Run { ms } => json(&self.drive()?.run(ms)),
            Request::DriveLog => Ok(self.drive()?.log()),
            Request::Listen { edition, readings } => {
                self.live = Some(Live::begin(edition.as_deref(), &readings)?);
                Ok("{}".to_owned())
            }
            Request::Hear { lines, lost } => json(&self.live()?.hear(&lines, lost)?),
            Request::HeardAll => json(&self.live()?.end()),
        }
    }

    fn live(&mut self) -> Result<&mut Live, Refusal> {
        self.live.as_mut().ok_or_else(|| Refusal::of_request("no bus is heard yet"))
    }

    fn drive(&mut self) -> Result<&mut Drive, Refusal> {
        self.drive.as_mut().ok_or_else(|| Refusal::of_request("there is no car yet"))
    }
}

fn scenario_text(name: &str) -> Result<&'static str, Refusal> {
    adsdv_can::scenario::Scenario::sample(name)
        .ok_or_else(|| Refusal::of_request(format!("there is no scenario {name:?}")))
}

fn json(value: &impl Serialize) -> Result<String, Refusal> {
    serde_json::to_string(value).map_err(|error| Refusal::of_request(error.to_string()))
}
