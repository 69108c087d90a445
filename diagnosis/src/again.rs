//! What was asked, asked again: a program whose answers are others then goes by chance or by a clock, or keeps something over a reset.

use adsdv_conform::ProgramError;

use crate::record::{Record, Records};
use crate::subject::Subject;

/// So many of the first records are asked again: what changes with time has changed since.
const OF_FIRST: usize = 1000;
/// So many of all records are asked again.
const OF_ALL: usize = 150;
/// So many of those that are not explained are asked again.
const UNEXPLAINED: usize = 50;

/// Whether a program answers alike what it is asked again.
pub(crate) fn is_alike(
    subject: &mut dyn Subject,
    records: &Records,
    unexplained: &[Record],
) -> Result<bool, ProgramError> {
    let kept = records.kept();
    let every = kept.len().div_ceil(OF_ALL).max(1);
    let first = kept.iter().take(OF_FIRST);
    for record in first.chain(kept.iter().step_by(every)) {
        let again = Record::of(subject, &record.steps)?;
        if !again.replies.iter().eq(record.replies.iter().map(AsRef::as_ref)) {
            return Ok(false);
        }
    }
    for record in unexplained.iter().take(UNEXPLAINED) {
        if Record::of(subject, &record.steps)?.replies != record.replies {
            return Ok(false);
        }
    }
    Ok(true)
}
