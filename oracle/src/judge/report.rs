//! The report: all that the judge has to say about a log.

use adsdv_spec::{AsState, Knowledge, Term, Truth};

use super::exercised::Exercised;
use super::finding::{Finding, Severity};
use super::margins::Margin;
use super::response::ResponseTimes;
use crate::rules::RuleReport;
use crate::why::{GoPress, Stay};

/// A change of `AS_STATE` that was seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// When, in nanoseconds since the first frame.
    pub t_ns: i64,
    /// The state before.
    pub from: AsState,
    /// The state after.
    pub to: AsState,
    /// The section that describes the arrow; `Figure 2` where there is none.
    pub section: &'static str,
    /// Whether the guard held.
    pub justified: Truth,
    /// The alternative of the guard that decided, or may have, and what was known of its conditions.
    pub decided: Option<(Term, Knowledge)>,
    /// Whether the remote control shows that its E-stop was pressed, and that may have decided.
    pub remote_estop: bool,
    /// Alternatives that may have decided instead: the VCU reports them as the very same fault, so that a log cannot tell.
    pub or: Vec<(Term, Knowledge)>,
}

/// Whether the log keeps to the document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No violation was found.
    Conforms,
    /// At least one violation was found.
    Violates,
}

impl Verdict {
    /// `conforms` or `violates`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Conforms => "conforms",
            Self::Violates => "violates",
        }
    }
}

/// Everything that the judge has to say about a log.
#[derive(Clone, Debug)]
pub struct Report {
    /// How many frames could be read.
    pub frames: u64,
    /// The time from the first frame to the last, in nanoseconds; on a live bus, where time passes without frames, to the last
    /// that is reported if that is later.
    pub duration_ns: i64,
    /// The transitions seen, in order.
    pub transitions: Vec<Transition>,
    /// The findings, in order of time.
    pub findings: Vec<Finding>,
    /// How fast the AI Computer answered the handshake.
    pub responses: ResponseTimes,
    /// The states that the VCU was in, in order, with what blocked their arrows.
    pub stays: Vec<Stay>,
    /// "Go" that was pressed in vain.
    pub go_presses: Vec<GoPress>,
    /// How close the run came to its limits: the closest first, those of a cycle last.
    pub margins: Vec<Margin>,
    /// What the recording exercised.
    pub exercised: Exercised,
    /// What became of the rules of the user's own, in their order.
    pub rules: Vec<RuleReport>,
}

impl Report {
    /// Whether the log keeps to the document.
    pub fn verdict(&self) -> Verdict {
        if self.count(Severity::Violation) == 0 { Verdict::Conforms } else { Verdict::Violates }
    }

    /// How many findings of a severity there are.
    pub fn count(&self, severity: Severity) -> usize {
        self.findings.iter().filter(|finding| finding.severity == severity).count()
    }
}
