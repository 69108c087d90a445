//! Rules of the user's own, beside the judge: they go by what it knows, at the time that it gives each frame.

use super::{LogError, LogJudge};
use crate::rules::{RuleError, RuleReport, Runner};

/// Who follows the rules.
#[derive(Debug)]
pub(super) enum Followed {
    /// There are none.
    Nothing,
    Rules(Box<Runner>),
    /// The edition has not all that they name.
    Impossible(Box<RuleError>),
}

impl LogJudge {
    /// Begins to follow the rules, under the edition that is judged by. While that is still to be recognised, nothing comes.
    pub(super) fn follow(&mut self) {
        let Some(rules) = &self.options.rules else { return };
        self.rules = match Runner::new(rules, self.options.judge.edition) {
            Ok(runner) => {
                self.judge.keep_seen();
                Followed::Rules(Box::new(runner))
            }
            Err(error) => Followed::Impossible(Box::new(error)),
        };
    }

    /// What is wrong with the rules under the edition that is judged by, once that is known: nothing more has to be read.
    pub(super) fn rules_are_impossible(&self) -> bool {
        self.hearing.is_none() && matches!(self.rules, Followed::Impossible(_))
    }

    /// The judge has seen a frame.
    #[inline]
    pub(super) fn frame_judged(&mut self) {
        if matches!(self.rules, Followed::Rules(_)) {
            self.follow_frame();
        }
    }

    #[inline(never)]
    fn follow_frame(&mut self) {
        let Self { judge, rules: Followed::Rules(runner), .. } = self else { return };
        judge.take_seen().iter().for_each(|seen| runner.aged(seen));
        runner.shown(judge.now_ns(), judge.known(), |id| judge.shown(id));
        runner.news().into_iter().for_each(|finding| judge.found(finding));
    }

    /// The judge was told that time has passed.
    pub(super) fn time_passed(&mut self) {
        let Self { judge, rules: Followed::Rules(runner), .. } = self else { return };
        judge.take_seen().iter().for_each(|seen| runner.aged(seen));
        runner.pass(judge.now_ns());
        runner.news().into_iter().for_each(|finding| judge.found(finding));
    }

    /// The recording is over, and the judge knows it.
    pub(super) fn rules_end(&mut self) -> Result<Vec<RuleReport>, LogError> {
        let Self { judge, rules, .. } = self;
        let mut runner = match std::mem::replace(rules, Followed::Nothing) {
            Followed::Nothing => return Ok(Vec::new()),
            Followed::Impossible(error) => return Err(LogError::Rules(*error)),
            Followed::Rules(runner) => runner,
        };
        runner.end(judge.now_ns());
        runner.news().into_iter().for_each(|finding| judge.found(finding));
        Ok(runner.reports())
    }
}
