//! The end of a log: what is said of it as a whole.

use super::{LogError, LogJudge, counted};
use crate::judge::{Finding, Report, Rule};

/// So many frames may be of one moment in a log whose times are coarse.
const TIMELESS: u64 = 100;

impl LogJudge {
    /// The end of the log, which had so many lines: settles what is still open.
    ///
    /// # Errors
    ///
    /// Fails if there is nothing to judge, because no frame came or none on the interface that was asked for, or if the edition has not
    /// all that the rules of the user's own name.
    pub fn finish(self, lines: u64) -> Result<Report, LogError> {
        self.finish_with_news(lines).map(|(report, _)| report)
    }

    /// The same, with the findings that are new since they were last asked for: see [`LogJudge::news`].
    ///
    /// ```
    /// use adsdv_oracle::candump::{FrameKind, Record};
    /// use adsdv_oracle::log::{LogJudge, LogOptions};
    ///
    /// let mut judge = LogJudge::new(LogOptions::default());
    /// judge.frame(&Record {
    ///     line: 1, time_ns: 0, interface: "can0", kind: FrameKind::Standard, id: 0x520, data: &[0; 8], direction: None,
    ///     terminated: true,
    /// });
    /// let known = judge.news().1.len();
    /// let (report, findings) = judge.finish_with_news(1)?;
    /// assert!(!findings.is_empty(), "messages are missing, which only the end shows");
    /// assert_eq!(known + findings.len(), report.findings.len());
    /// # Ok::<(), adsdv_oracle::log::LogError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`finish`](Self::finish).
    pub fn finish_with_news(mut self, lines: u64) -> Result<(Report, Vec<Finding>), LogError> {
        self.decide();
        if self.frames == 0 {
            return Err(LogError::NoFrame { lines, first: self.first_broken });
        }
        if let (0, Some(wanted)) = (self.on_interface, &self.options.interface) {
            let found = self
                .passed_over
                .keys()
                .filter_map(|reason| reason.strip_prefix("on interface "))
                .map(str::to_owned)
                .collect();
            return Err(LogError::NoSuchInterface { wanted: wanted.clone(), found });
        }
        self.judge.end();
        if let Some(error) = self.impossible {
            return Err(LogError::Rules(*error));
        }
        for (reason, count) in &self.passed_over {
            self.judge
                .note_log(Rule::NotJudged, format!("{} {reason}, not judged", counted(*count, "frame")));
        }
        let named = self.options.interface.is_some();
        for interface in std::mem::take(&mut self.neglected).into_iter().filter(|_| !named) {
            let message = format!(
                "{interface} carries messages of the document, too, and was not judged; --interface {interface} judges it"
            );
            self.warn(Rule::NotJudged, message);
        }
        if self.frames > TIMELESS && self.judge.now_ns() == 0 {
            let message = format!(
                "no time passes in {} frames, so that nothing was judged that takes time; expected the time of each frame, as candump -L writes it",
                self.frames
            );
            self.warn(Rule::NotJudged, message);
        }
        Ok(self.judge.finish_with_news())
    }
}
