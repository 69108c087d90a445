//! `--require WHAT`: what a log is to show.

use adsdv_oracle::judge::{Report, Required};
use adsdv_spec::Edition;

use crate::error::Error;
use crate::status::Status;

/// Fails where a log of this edition cannot show it.
pub(crate) fn possible(edition: &Edition, required: &[Required]) -> Result<(), Error> {
    let impossible = required.iter().find_map(|one| Some((one, one.is_shown_in(edition).err()?)));
    impossible.map_or(Ok(()), |(one, error)| {
        Err(Error {
            what: format!("--require {one}"),
            why: error.to_string(),
            hint: format!("the log is judged by edition {}; --edition names another", edition.version),
        })
    })
}

/// How the command ends: a log that does not show what was required is no log of what was to be judged.
pub(crate) fn status(report: &Report, required: &[Required]) -> Status {
    let all = required.iter().all(|one| report.exercised.meets(*one));
    if all { report.verdict().into() } else { Status::Violates }
}
