//! By which edition, and with which readings.

use adsdv_spec::{Choice, Edition};

use crate::error::Refusal;

/// An edition by its version; `None` where the log is to tell it.
pub(crate) fn edition(version: Option<&str>) -> Result<Option<&'static Edition>, Refusal> {
    let Some(version) = version else { return Ok(None) };
    let versions = || Edition::ALL.iter().map(|edition| edition.version).collect::<Vec<_>>().join(", ");
    Edition::find(version).map(Some).ok_or_else(|| {
        Refusal::of_request(format!("there is no edition {version:?}; expected one of {}", versions()))
    })
}

/// Readings, each as `reading=choice`.
pub(crate) fn readings(texts: &[String]) -> Result<Vec<Choice>, Refusal> {
    let one = |text: &String| {
        let (reading, choice) = text.split_once('=').unwrap_or((text, ""));
        Choice::find(reading, choice).ok_or_else(|| {
            Refusal::of_request(format!(
                "there is no reading {text:?}; expected one such as {}",
                Choice::GoRaw
            ))
        })
    };
    texts.iter().map(one).collect()
}
