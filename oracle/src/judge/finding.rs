//! What the judge has to say: findings, transitions, and the report that holds them.

use adsdv_spec::{AsState, Knowledge, Term, Truth};

use super::response::ResponseTimes;

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Against the document, under every reading that is not excluded. The log violates.
    Violation,
    /// Not against the document, or only under some readings; worth a look.
    Warning,
    /// A fact about the log.
    Note,
}

impl Severity {
    /// `violation`, `warning` or `note`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Violation => "violation",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

/// Who is at fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Party {
    /// The AI Computer.
    Ai,
    /// The Vehicle Control Unit.
    Vcu,
    /// The log itself, or nobody that it names.
    Log,
}

impl Party {
    /// `AI`, `VCU` or `LOG`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ai => "AI",
            Self::Vcu => "VCU",
            Self::Log => "LOG",
        }
    }
}

impl From<adsdv_spec::messages::Node> for Party {
    fn from(node: adsdv_spec::messages::Node) -> Self {
        match node {
            adsdv_spec::messages::Node::Ai => Self::Ai,
            adsdv_spec::messages::Node::Vcu => Self::Vcu,
        }
    }
}

macro_rules! rules {
    ($($(#[$doc:meta])* $rule:ident = $id:literal;)*) => {
        /// What was checked. The identifiers are stable.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Rule { $($(#[$doc])* $rule,)* }

        impl Rule {
            /// Every rule.
            pub const ALL: &'static [Self] = &[$(Self::$rule),*];

            /// The stable identifier, such as `transition-due`.
            pub const fn id(self) -> &'static str {
                match self { $(Self::$rule => $id,)* }
            }
        }
    };
}

rules! {
    /// A transition happened for which Figure 2 has no arrow.
    NoArrow = "no-such-arrow";
    /// A transition happened though no guard of its arrow could be true.
    Unjustified = "transition-unjustified";
    /// A transition was due and did not happen.
    Due = "transition-due";
    /// A fault flag was raised though its condition did not hold.
    FlagUnfounded = "fault-flag-unfounded";
    /// `AI_ESTOP_REQUEST` was not raised though the AI Computer asked for an emergency stop.
    FlagMissing = "fault-flag-missing";
    /// `FAULT_STATUS` or `WARNING_STATUS` contradicts the flags it sums up.
    StatusSum = "status-flag-sum";
    /// `SHUTDOWN_CAUSE` names a fault whose flag is not raised.
    CauseWithoutFlag = "cause-without-flag";
    /// `SHUTDOWN_CAUSE` names a fault while the Autonomous System goes on.
    CauseWithoutShutdown = "cause-without-shutdown";
    /// `EMERGENCY_BRAKE` without a `SHUTDOWN_CAUSE`.
    CauseMissing = "cause-missing";
    /// `SHUTDOWN_CAUSE` changed after the shutdown.
    CauseChanged = "cause-changed";
    /// The VCU's HANDSHAKE bit did not change though it was answered, or did change though it was not.
    HandshakeEdge = "handshake-edge";
    /// `AI_COMMS_LOST` was not raised in time.
    CommsLostDue = "comms-lost-due";
    /// The AI Computer did not answer the handshake in time.
    HandshakeLate = "handshake-late";
    /// The AI Computer declared FINISHED while the vehicle was moving.
    FinishedMoving = "finished-while-moving";
    /// The AI Computer requested NEUTRAL while the vehicle was moving.
    NeutralMoving = "neutral-while-moving";
    /// The AI Computer asked for torque and for brakes at once.
    BrakeAndTorque = "brake-and-torque";
    /// A message of the AI Computer did not come for too long.
    MessageMissed = "message-missed";
    /// Requests that are not zero hold the vehicle in `AS_READY`.
    ReadyHeld = "ready-held";
    /// A signal has a value outside its range or its enumeration.
    Value = "value-out-of-range";
    /// A signal still has the start value of the CAN database, which its enumeration does not have.
    StartValue = "start-value";
    /// A frame is too short for its signals.
    TooShort = "frame-too-short";
    /// A frame has another length than the CAN database says.
    Length = "frame-length";
    /// The AI Computer sent a reserved identifier, or somebody unknown did.
    Reserved = "reserved-identifier";
    /// A message came from the wrong side.
    Sender = "wrong-sender";
    /// What does not fit the edition that was recognised.
    Edition = "edition";
    /// 502h shows another AS state than 520h.
    AssiDiffers = "assi-differs";
    /// 520h shows another stage of the Emergency Braking System than the state in 524h.
    EbsDiffers = "ebs-differs";
    /// A line of the log could not be read.
    BrokenLine = "broken-line";
    /// The log's time went backwards.
    TimeBackwards = "time-backwards";
    /// The VCU was silent, or frames were lost, so that what happened meanwhile is unknown.
    Gap = "gap";
    /// Messages of one side are missing altogether.
    OneSided = "one-sided";
    /// The log holds frames that are not judged.
    NotJudged = "not-judged";
    /// Findings of one rule beyond the number that is listed.
    Repeated = "repeated";
}

/// One thing that the judge found.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// When, in nanoseconds since the first frame.
    pub t_ns: i64,
    /// How much it weighs.
    pub severity: Severity,
    /// Who is at fault.
    pub party: Party,
    /// The section of the document, such as `3.7`.
    pub section: &'static str,
    /// What was checked.
    pub rule: Rule,
    /// What was seen, with the conditions and their values, and what was expected instead.
    pub message: String,
}

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
    /// The time from the first frame to the last, in nanoseconds; on a live bus, on which time was told to pass, to the last
    /// that is reported if that is later.
    pub duration_ns: i64,
    /// The transitions seen, in order.
    pub transitions: Vec<Transition>,
    /// The findings, in order of time.
    pub findings: Vec<Finding>,
    /// How fast the AI Computer answered the handshake.
    pub responses: ResponseTimes,
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
