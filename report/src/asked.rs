//! How a log is asked to be judged: by which edition, and with which readings pinned. The command and the page ask alike.

use std::fmt;

use adsdv_oracle::candump::Entries;
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{Judged, LogError, LogOptions, LogProgress, judge_by};
use adsdv_spec::{Choice, Choices, Edition};

/// How a log is asked to be judged.
///
/// ```
/// use adsdv_oracle::candump::Reader;
/// use adsdv_report::Asked;
///
/// let log = "(1.0) can0 511#0000000000000000\n(1.01) can0 520#0000010000000000\n";
/// let asked = Asked::new(None, &[])?;
/// let judged = asked.judge(Reader::new(log.as_bytes()), |_| {})?;
/// assert_eq!(judged.recognised.edition.version, "3.0");
/// assert!(asked.under(judged.recognised.edition)?.is_as_usual());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Asked {
    /// What the judge may assume, the interface, and rules of the user's own. Where the edition is recognised, that of the judge is the
    /// one for a log that does not tell.
    pub options: LogOptions,
    /// The log is to tell the edition.
    pub by_log: bool,
    /// The readings that are pinned.
    pub pins: Vec<Choice>,
}

impl Asked {
    /// By this edition, or by the one that the log tells.
    ///
    /// # Errors
    ///
    /// Fails if two pins contradict each other, or one the edition.
    pub fn new(edition: Option<&'static Edition>, pins: &[Choice]) -> Result<Self, PinError> {
        let by_log = edition.is_none();
        let edition = edition.unwrap_or(Edition::DEFAULT);
        let readings = if by_log { possible_in_some(edition, pins) } else { possible(edition, pins) }?;
        let judge = JudgeOptions { readings, ..JudgeOptions::of(edition) };
        let options = LogOptions { judge, ..LogOptions::default() };
        Ok(Self { options, by_log, pins: pins.to_vec() })
    }

    /// Judges a log so.
    ///
    /// # Errors
    ///
    /// Fails if the log cannot be read to its end, or there is nothing in it to judge.
    pub fn judge(
        &self,
        entries: impl Entries,
        progress: impl FnMut(LogProgress),
    ) -> Result<Judged, LogError> {
        judge_by(entries, &self.options, self.by_log, progress)
    }

    /// The same by the edition that a log told, if that has the readings that are pinned.
    ///
    /// # Errors
    ///
    /// Fails if a pin is no answer in that edition.
    pub fn under(&self, edition: &'static Edition) -> Result<Self, PinError> {
        possible(edition, &self.pins)?;
        let judge = self.options.judge.under(edition);
        let options = LogOptions { judge, ..self.options.clone() };
        Ok(Self { options, by_log: self.by_log, pins: self.pins.clone() })
    }

    /// How it is judged, where that is not as usual: a line each.
    pub fn settings(&self) -> Vec<String> {
        settings(&self.options, &self.pins)
    }

    /// Nobody asked for anything.
    pub fn is_as_usual(&self) -> bool {
        self.settings().is_empty()
    }
}

/// How a log is judged, where that is not as usual: a line each.
pub fn settings(options: &LogOptions, pins: &[Choice]) -> Vec<String> {
    let (judge, default) = (options.judge, JudgeOptions::of(options.judge.edition));
    let mut lines = Vec::new();
    lines.extend(options.interface.as_ref().map(|interface| format!("interface {interface}")));
    if (judge.window_ms, judge.deadline_ms) != (default.window_ms, default.deadline_ms) {
        lines.push(format!("window {} ms, deadline {} ms", judge.window_ms, judge.deadline_ms));
    }
    if judge.complete {
        lines.push("complete: no frame is missing".to_owned());
    }
    lines.extend(pins.iter().map(|pin| format!("reading {pin}: {}", pin.text())));
    lines
}

/// Why a reading cannot be pinned so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PinError {
    /// The edition does not leave this answer.
    NoAnswer {
        /// What was pinned.
        pin: Choice,
        /// The edition.
        edition: &'static str,
        /// The answers that it leaves.
        leaves: Vec<Choice>,
    },
    /// Another pin says otherwise.
    Twice {
        /// What was pinned.
        pin: Choice,
        /// And what before it.
        other: Choice,
    },
}

impl PinError {
    /// What was pinned.
    pub const fn pin(&self) -> Choice {
        match self {
            Self::NoAnswer { pin, .. } | Self::Twice { pin, .. } => *pin,
        }
    }
}

impl fmt::Display for PinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAnswer { pin, edition, leaves } => {
                let ids: Vec<&str> = leaves.iter().map(|choice| choice.id()).collect();
                let (id, all) = (pin.reading().id(), ids.join(" or "));
                write!(f, "is no answer in edition {edition}; expected {id}={all}")
            }
            Self::Twice { pin, other } => {
                write!(f, "{} is already pinned to {}", pin.reading().id(), other.id())
            }
        }
    }
}

impl std::error::Error for PinError {}

/// The choices of an edition that remain possible for a judge.
///
/// # Errors
///
/// As [`agree`].
pub fn possible(edition: &Edition, pins: &[Choice]) -> Result<Choices, PinError> {
    agree(edition, pins)?;
    Ok(pins.iter().copied().fold(edition.choices, Choices::pin))
}

/// The choices that remain possible for a judge who has yet to recognise the edition: each pin has to be an answer in one
/// edition at least. Whether it is one in the edition that is recognised, [`possible`] tells.
///
/// # Errors
///
/// Fails if two pins contradict each other, or one is an answer in no edition.
pub fn possible_in_some(default: &Edition, pins: &[Choice]) -> Result<Choices, PinError> {
    match Edition::ALL.iter().find(|edition| agree(edition, pins).is_ok()) {
        Some(_) => Ok(pins.iter().copied().fold(default.choices, Choices::pin)),
        None => possible(default, pins),
    }
}

/// Fails where two pins contradict each other, or one the edition.
///
/// # Errors
///
/// Fails if they do not, and names the pin that is to go.
pub fn agree(edition: &Edition, pins: &[Choice]) -> Result<(), PinError> {
    for (index, &pin) in pins.iter().enumerate() {
        if !edition.choices.has(pin) {
            let leaves = edition.choices.of_reading(pin.reading()).collect();
            return Err(PinError::NoAnswer { pin, edition: edition.version, leaves });
        }
        let mut before = pins.iter().take(index);
        if let Some(&other) = before.find(|other| other.reading() == pin.reading() && **other != pin) {
            return Err(PinError::Twice { pin, other });
        }
    }
    Ok(())
}
