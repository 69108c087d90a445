//! What a scenario expects of the AI Computer, each beside its requirement, and how it is followed.

use adsdv_spec::Edition;

use crate::look::Look;

/// Something that is expected of an AI Computer.
#[derive(Clone, Copy, Debug)]
pub struct Expectation {
    /// The requirements that it is against if it is not met; of those, the ones that the edition has.
    pub against: &'static [&'static str],
    /// Where that stands.
    pub section: &'static str,
    /// What is seen if it is not met, in a few words; what the AI Computer says follows.
    pub seen: &'static str,
    /// What was expected.
    pub expected: &'static str,
    /// What it is.
    pub kind: Kind,
}

/// Something that is so at a cycle, or is not.
pub type Condition = fn(&Look) -> bool;

/// The kinds of expectations.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// While one thing lasts, another comes in time.
    Comes {
        /// While this is so,
        when: Condition,
        /// this is once so
        then: Condition,
        /// in this time.
        within: Within,
    },
    /// Something ends in time. It counts as exercised only if it came to its end and was seen at all.
    Ends {
        /// This is never so
        what: Condition,
        /// for longer than this.
        within: Within,
    },
    /// Something never is so.
    Never {
        /// While this is so,
        when: Condition,
        /// this never is.
        what: Condition,
    },
}

/// How long something may take.
#[derive(Clone, Copy, Debug)]
pub enum Within {
    /// So many milliseconds.
    Ms(u64),
    /// What the edition gives for an answer to the handshake.
    Answer,
    /// What the examiner gives for a mission.
    Mission,
}

impl Within {
    pub(crate) fn ms(self, edition: &Edition, mission_ms: u64) -> u64 {
        match self {
            Self::Ms(ms) => ms,
            Self::Answer => edition.rules.timing.handshake_ms.into(),
            Self::Mission => mission_ms,
        }
    }
}

/// An expectation that is followed through a scenario.
#[derive(Clone, Debug)]
pub(crate) struct Followed {
    pub(crate) expectation: &'static Expectation,
    /// Since when it waits.
    since: Option<u64>,
    met: bool,
    /// What it is about has happened, well or not.
    pub(crate) exercised: bool,
    /// When it was not met, and how that looked.
    pub(crate) failed: Option<(u64, String)>,
}

impl Followed {
    pub(crate) fn new(expectation: &'static Expectation) -> Self {
        Self { expectation, since: None, met: false, exercised: false, failed: None }
    }

    pub(crate) fn look(&mut self, look: &Look, edition: &Edition, mission_ms: u64) {
        if self.failed.is_some() {
            return;
        }
        match self.expectation.kind {
            Kind::Comes { when, then, within } => {
                if !when(look) {
                    (self.since, self.met) = (None, false);
                    return;
                }
                let since = *self.since.get_or_insert(look.time_ms);
                if then(look) {
                    (self.met, self.exercised) = (true, true);
                }
                let limit = within.ms(edition, mission_ms);
                if !self.met && look.time_ms.saturating_sub(since) >= limit {
                    self.fail(look, Some(limit));
                }
            }
            Kind::Ends { what, within } => {
                if !what(look) {
                    self.exercised |= self.since.take().is_some();
                    return;
                }
                let since = *self.since.get_or_insert(look.time_ms);
                let limit = within.ms(edition, mission_ms);
                if look.time_ms.saturating_sub(since) > limit + look.jitter_ms {
                    self.fail(look, Some(limit));
                }
            }
            Kind::Never { when, what } => {
                if when(look) {
                    self.exercised = true;
                    if what(look) {
                        self.fail(look, None);
                    }
                }
            }
        }
    }

    fn fail(&mut self, look: &Look, limit: Option<u64>) {
        self.exercised = true;
        let Expectation { seen, .. } = self.expectation;
        let after = limit.map_or(String::new(), |ms| format!(" after {ms} ms"));
        self.failed = Some((look.time_ms, format!("{seen}{after} ({})", look.words())));
    }
}
