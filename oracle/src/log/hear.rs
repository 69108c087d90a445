//! As long as the frames are to tell the edition: what came waits, and is judged once that is decided.

use super::LogJudge;
use crate::candump::Dropped;
use crate::judge::{Judge, Rule};
use crate::recognise::{Held, Recognised};

impl LogJudge {
    /// Something came while it is not known yet by which edition to judge.
    #[cold]
    pub(super) fn hear(&mut self, held: Held) {
        if self.hearing.as_mut().is_some_and(|hearing| hearing.hear(held)) {
            self.decide();
        }
    }

    /// Whether it is still not known, when it is this time, by which edition to judge.
    #[cold]
    pub(super) fn still_hears(&mut self, time_ns: i64) -> bool {
        if self.hearing.as_mut().is_some_and(|hearing| hearing.is_enough_before(time_ns)) {
            self.decide();
        }
        self.hearing.is_some()
    }

    /// Judges by the edition that was recognised, from the first frame on.
    ///
    /// It is decided by what has come so far, where that is not done yet. Nobody has to ask for it but who wants to know the
    /// edition before the end of frames that are few.
    pub fn decide(&mut self) {
        let Some(hearing) = self.hearing.take() else { return };
        let (recognised, held, later) = hearing.end();
        self.options.judge = self.options.judge.under(recognised.edition);
        self.judge = Judge::new(self.options.judge);
        self.follow();
        // What does not fit the edition is in the note on how it was recognised.
        self.judge.knows_what_is_absent();
        if !recognised.certain || !recognised.against.is_empty() {
            self.note_edition(&recognised.to_string());
        }
        self.recognised = Some(recognised);
        for held in held {
            match held {
                Held::Frame(frame) => self.frame(&frame.record()),
                Held::TimePasses(time_ns) => self.time_passes(time_ns),
                Held::Lost(count) => self.lost(count),
                Held::Dropped { line, interface, count, total } => {
                    self.dropped(&Dropped { line, interface: &interface, count, total });
                }
                Held::Broken(error) => self.broken(error),
            }
        }
        self.later = Some(later);
    }

    pub(super) fn note_edition(&mut self, what: &str) {
        self.judge.note_log(Rule::Edition, format!("judged by {what}"));
    }

    /// A frame that came later fits another edition better.
    #[cold]
    pub(super) fn fits_another(&mut self, other: &Recognised) {
        let version = self.judge.edition().version;
        self.note_edition(&format!(
            "version {version} all the same, but from here on the frames fit {other}"
        ));
    }
}
