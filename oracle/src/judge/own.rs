//! Rules of the user's own, followed beside the document: by what the judge knows, at the time that it gives each frame.

use adsdv_spec::Reading;

use super::book::Book;
use super::estimator::base::Estimator;
use super::sampler::places::slot_of;
use super::sampler::slot::Slot;
use crate::rules::{GoHidden, RuleErrors, RuleFile, RuleReport, Runner};

/// The rules that are followed, if there are any.
#[derive(Debug, Default)]
pub(super) struct Own {
    runner: Option<Box<Runner>>,
    /// What became of them, at the end.
    pub(super) reports: Vec<RuleReport>,
}

impl Own {
    pub(super) fn follow(&mut self, rules: &RuleFile, est: &Estimator) -> Result<(), RuleErrors> {
        self.runner = Some(Box::new(Runner::new(rules, &est.edition)?));
        Ok(())
    }

    /// Messages have become too old, or time alone has made something else known.
    pub(super) fn aged(&mut self, est: &Estimator) {
        if let Some(runner) = &mut self.runner {
            runner.aged(est.now, est.known, |id| shown(est, id).is_some());
        }
    }

    /// A frame has been judged.
    #[inline]
    pub(super) fn judged(&mut self, est: &Estimator, book: &mut Book) {
        if let Some(runner) = &mut self.runner {
            // What the frame before showed is over, and what was so up to this one is known by it alone.
            if est.go_rose_at == Some(est.now) {
                runner.go_was_off(est.now);
            }
            runner.shown(est.now, est.known, |id| shown(est, id));
            runner.news().into_iter().for_each(|finding| book.found(finding));
        }
    }

    /// Time has passed without a frame.
    pub(super) fn passes(&mut self, est: &Estimator, book: &mut Book) {
        if let Some(runner) = &mut self.runner {
            runner.pass(est.now);
            runner.news().into_iter().for_each(|finding| book.found(finding));
        }
    }

    /// There is nothing more to come.
    pub(super) fn end(&mut self, est: &Estimator, book: &mut Book) {
        if let Some(mut runner) = self.runner.take() {
            let hidden = est.go_is_hidden().then(|| GoHidden { settled: est.pinned(Reading::GoSignal) });
            runner.end(est.now, hidden, est.options.complete);
            runner.news().into_iter().for_each(|finding| book.found(finding));
            self.reports = runner.reports();
        }
    }
}

/// What the last frame with this identifier said, and how long it was; `None` if it is too old to count.
fn shown(est: &Estimator, id: u16) -> Option<([u8; 8], usize)> {
    let Slot { word, len, .. } =
        est.sampler.slot(slot_of(id)).filter(|slot| slot.fresh && slot.def.is_some())?;
    Some((word.to_le_bytes(), usize::from(*len)))
}
