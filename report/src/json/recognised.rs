//! By what an edition was recognised.

use adsdv_oracle::recognise::Recognised;
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct RecognisedJson<'a> {
    certain: bool,
    evidence: &'a [String],
    against: &'a [String],
}

impl<'a> RecognisedJson<'a> {
    pub(super) fn of(recognised: &'a Recognised) -> Self {
        let Recognised { certain, evidence, against, .. } = recognised;
        Self { certain: *certain, evidence, against }
    }
}
