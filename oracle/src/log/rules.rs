//! Rules of the user's own: the judge follows them as soon as the edition is known.

use super::LogJudge;

impl LogJudge {
    /// Begins to follow the rules, under the edition that is judged by. While that is still to be recognised, nothing comes.
    pub(super) fn follow(&mut self) {
        let rules = self.options.rules.as_ref();
        self.impossible = rules.and_then(|rules| self.judge.follow(rules).err()).map(Box::new);
    }

    /// What is wrong with the rules under the edition that is judged by, once that is known: nothing more has to be read.
    pub(super) fn rules_are_impossible(&self) -> bool {
        self.hearing.is_none() && self.impossible.is_some()
    }
}
