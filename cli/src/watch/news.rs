//! What is new is printed, as the judge is certain of it.

use adsdv_oracle::log::LogJudge;
use adsdv_oracle::rules::RuleFile;

use super::lines::Lines;
use super::waits::Waits;

/// What has been said so far.
pub(super) struct News {
    pub(super) lines: Lines,
    waits: Waits,
    /// The user's own rules, which the edition that is recognised has to have.
    rules: Option<RuleFile>,
    /// Which edition was recognised has been said.
    pub(super) is_recognised: bool,
}

impl News {
    pub(super) fn new(lines: Lines, rules: Option<RuleFile>) -> Self {
        Self { lines, waits: Waits::default(), rules, is_recognised: false }
    }

    /// Which edition was recognised, and what was found since it was last asked.
    pub(super) fn print(&mut self, judge: &mut LogJudge) {
        if let Some(recognised) = judge.recognised().filter(|_| !self.is_recognised) {
            self.is_recognised = true;
            self.lines.recognised(recognised);
            if self.rules.as_ref().is_some_and(|rules| rules.check(recognised.edition).is_err()) {
                // The end tells why.
                self.lines.end();
            }
        }
        let news = judge.news();
        self.lines.news(&judge.edition().rules, news);
    }

    /// What the car waits for now, where that is something else than before.
    pub(super) fn print_waits(&mut self, judge: &LogJudge) {
        let waits = judge.waits();
        let news = waits.and_then(|(t, stay)| Some((t, self.waits.news(&judge.edition().rules, t, stay)?)));
        if let Some((t, text)) = news {
            self.lines.waits(t, &text);
        }
    }
}
