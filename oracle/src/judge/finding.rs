//! What the judge finds, as data: who, what, when, by which requirement, and by which frames.

use std::fmt;

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
    /// A rule of the user's own: who broke it, the judge does not know.
    Own,
}

impl Party {
    /// `AI`, `VCU`, `LOG` or `OWN`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ai => "AI",
            Self::Vcu => "VCU",
            Self::Log => "LOG",
            Self::Own => "OWN",
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
    ($($(#[$doc:meta])* $rule:ident = $id:literal $(unless $unless:literal)?;)*) => {
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

            /// What would have to be true for a violation or a warning of it not to be one: what the judge takes for granted.
            /// Empty where it takes nothing for granted but that the frames were on the bus.
            pub const fn unless(self) -> &'static str {
                match self { $(Self::$rule => concat!($($unless)?),)* }
            }
        }
    };
}

rules! {
    /// A transition happened for which Figure 2 has no arrow.
    NoArrow = "no-such-arrow"
        unless "the VCU was in another state between, which no 520h shows";
    /// A transition happened though no guard of its arrow could be true.
    Unjustified = "transition-unjustified"
        unless "the VCU saw something at that step that no frame within the window shows";
    /// A transition was due and did not happen.
    Due = "transition-due"
        unless "the VCU saw something that no frame shows, or takes longer for a step than the deadline";
    /// A fault flag, or a flag of 120h, was raised though its condition did not hold.
    FlagUnfounded = "fault-flag-unfounded"
        unless "the VCU saw a reason that no frame within the window shows";
    /// A flag was not raised, or went back to 0, though its reason was there: the AI Computer asked for an emergency stop, or 120h has
    /// no timeout for a message that is missed or a handshake that is not answered.
    FlagMissing = "fault-flag-missing"
        unless "the VCU did not receive what was recorded, or takes longer for a step than the deadline";
    /// `FAULT_STATUS` or `WARNING_STATUS` contradicts the flags it sums up.
    StatusSum = "status-flag-sum"
        unless "the VCU sums its flags up later than the deadline";
    /// `SHUTDOWN_CAUSE` names a fault whose flag is not raised.
    CauseWithoutFlag = "cause-without-flag"
        unless "the VCU raises the flag later than the deadline";
    /// `SHUTDOWN_CAUSE` names a fault while the Autonomous System goes on.
    CauseWithoutShutdown = "cause-without-shutdown"
        unless "the VCU goes to EMERGENCY_BRAKE later than the deadline";
    /// `EMERGENCY_BRAKE` without a `SHUTDOWN_CAUSE`.
    CauseMissing = "cause-missing"
        unless "the VCU names the cause later than the deadline, or has none for this reason";
    /// `SHUTDOWN_CAUSE` changed after the shutdown.
    CauseChanged = "cause-changed"
        unless "the vehicle was power-cycled in between";
    /// The VCU's HANDSHAKE bit did not change though it was answered, or did change though it was not.
    HandshakeEdge = "handshake-edge"
        unless "an answer, or an edge, was on the bus that was not recorded";
    /// `AI_COMMS_LOST` was not raised in time.
    CommsLostDue = "comms-lost-due"
        unless "the VCU received a frame that was not recorded, or takes longer for a step than the deadline";
    /// The AI Computer did not answer the handshake in time.
    HandshakeLate = "handshake-late"
        unless "an answer was on the bus in time that was not recorded";
    /// The AI Computer declared FINISHED while the vehicle was moving.
    FinishedMoving = "finished-while-moving"
        unless "the wheels stood still before the VCU saw the request";
    /// The AI Computer requested NEUTRAL while the vehicle was moving.
    NeutralMoving = "neutral-while-moving"
        unless "the wheels stood still before the VCU saw the request";
    /// The AI Computer asked for torque and for brakes at once.
    BrakeAndTorque = "brake-and-torque"
        unless "the VCU never saw both requests in one step";
    /// A message of the AI Computer did not come for too long.
    MessageMissed = "message-missed"
        unless "a frame of it was on the bus that was not recorded";
    /// Nothing came from the AI Computer any more, and the VCU went on as if it had.
    AiSilent = "ai-silent"
        unless "its frames were on the bus and were not recorded";
    /// Requests that are not zero hold the vehicle in `AS_READY`.
    ReadyHeld = "ready-held"
        unless "the vehicle was not meant to drive yet";
    /// A signal has a value outside its range or its enumeration.
    Value = "value-out-of-range";
    /// A signal still has the start value of the CAN database, which its enumeration does not have.
    StartValue = "start-value";
    /// A frame is too short for its signals.
    TooShort = "frame-too-short";
    /// A frame has another length than the CAN database says.
    Length = "frame-length";
    /// The AI Computer sent a reserved identifier, or somebody unknown did; also one that the VCU had in an earlier edition.
    Reserved = "reserved-identifier"
        unless "the log names another sender than the one there was";
    /// A message came from the wrong side.
    Sender = "wrong-sender"
        unless "the log names another sender than the one there was";
    /// What does not fit the edition that was recognised, or that was named.
    Edition = "edition";
    /// 502h shows another AS state than 520h.
    AssiDiffers = "assi-differs"
        unless "the VCU shows its state in 502h later than the deadline";
    /// 520h shows another stage of the Emergency Braking System than the state in 524h.
    EbsDiffers = "ebs-differs";
    /// `GO_SIGNAL` of 520h contradicts the switch that the remote control shows.
    GoDiffers = "go-differs"
        unless "the VCU did not receive what the remote control sent, or shows \"Go\" later than the deadline";
    /// `SM_AS` of 120h shows another state than 520h.
    SmAsDiffers = "sm-as-differs"
        unless "the VCU shows its state in 120h later than the deadline";
    /// `SM_SYS` or `SYS_ACTION_STATE` of 120h tell of another mode than the autonomous one while 520h shows `AS_DRIVING`.
    ModeDiffers = "mode-differs";
    /// A warning of 120h contradicts the fault flag of 520h that has its name.
    WarningDiffers = "warning-differs";
    /// A line of the log could not be read.
    BrokenLine = "broken-line";
    /// The log's time went backwards.
    TimeBackwards = "time-backwards";
    /// The VCU was silent, or frames were lost, so that what happened meanwhile is unknown.
    Gap = "gap";
    /// Two VCUs are in one recording.
    TwoSenders = "two-senders"
        unless "the recording was put together from several, each of one VCU";
    /// Messages of one side are missing altogether.
    OneSided = "one-sided";
    /// The log holds frames that are not judged.
    NotJudged = "not-judged";
    /// A rule of the user's own was broken.
    Custom = "custom-rule"
        unless "a frame was on the bus that was not recorded";
    /// Findings of one rule beyond the number that is listed.
    Repeated = "repeated";
}

/// Where the rule stands that a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Section {
    /// A section or a figure of the document, such as `3.7`.
    Document(&'static str),
    /// A line of the user's own rules, from 1.
    Line(usize),
}

impl From<&'static str> for Section {
    fn from(section: &'static str) -> Self {
        Self::Document(section)
    }
}

/// As `3.7`, or `line 12`; a width counts for both.
impl fmt::Display for Section {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Document(section) => f.pad(section),
            Self::Line(line) => f.pad(&format!("line {line}")),
        }
    }
}

/// A frame that shows what a finding says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// When it came, in nanoseconds since the first frame.
    pub t_ns: i64,
    /// The identifier of its message.
    pub id: u16,
}

/// One thing that the judge found.
///
/// ```
/// use adsdv_oracle::judge::{Finding, Party, Rule};
///
/// let finding = Finding::violation(Party::Vcu, "2.2", Rule::StatusSum, 0)
///     .seen("FAULT_STATUS is 0, but HVIL_OPEN_FAULT is set")
///     .expected("1");
/// assert_eq!(finding.message(), "FAULT_STATUS is 0, but HVIL_OPEN_FAULT is set; expected 1");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// When, in nanoseconds since the first frame.
    pub t_ns: i64,
    /// How much it weighs.
    pub severity: Severity,
    /// Who is at fault.
    pub party: Party,
    /// Where the rule stands.
    pub section: Section,
    /// What was checked.
    pub rule: Rule,
    /// The requirements of the edition that it is against, as `REQUIREMENTS.md` names them; none where no single one is.
    pub requirements: Vec<&'static str>,
    /// What was seen, with the conditions and their values.
    pub seen: String,
    /// What was expected instead; empty where nothing else was.
    pub expected: String,
    /// What would have to be true for it not to be one, beyond what [the rule](Rule::unless) says of all its findings; empty where
    /// there is nothing beyond that.
    pub unless: String,
    /// The frames that show it, in order of time: of each message that decides, the last one before it.
    pub evidence: Vec<Evidence>,
}

impl Finding {
    /// A finding of which it is still to be said what was seen.
    pub fn new(severity: Severity, party: Party, section: impl Into<Section>, rule: Rule, t_ns: i64) -> Self {
        Self {
            t_ns,
            severity,
            party,
            section: section.into(),
            rule,
            requirements: Vec::new(),
            seen: String::new(),
            expected: String::new(),
            unless: String::new(),
            evidence: Vec::new(),
        }
    }

    /// The same for a violation.
    pub fn violation(party: Party, section: impl Into<Section>, rule: Rule, t_ns: i64) -> Self {
        Self::new(Severity::Violation, party, section, rule, t_ns)
    }

    /// The same for a warning.
    pub fn warning(party: Party, section: impl Into<Section>, rule: Rule, t_ns: i64) -> Self {
        Self::new(Severity::Warning, party, section, rule, t_ns)
    }

    /// The same for a note.
    pub fn note(party: Party, section: impl Into<Section>, rule: Rule, t_ns: i64) -> Self {
        Self::new(Severity::Note, party, section, rule, t_ns)
    }

    /// This was seen.
    #[must_use]
    pub fn seen(self, seen: impl Into<String>) -> Self {
        Self { seen: seen.into(), ..self }
    }

    /// This was expected instead.
    #[must_use]
    pub fn expected(self, expected: impl Into<String>) -> Self {
        Self { expected: expected.into(), ..self }
    }

    /// It is none if this is true.
    #[must_use]
    pub fn unless(self, unless: impl Into<String>) -> Self {
        Self { unless: unless.into(), ..self }
    }

    /// It is against these requirements.
    #[must_use]
    pub fn against(self, ids: &[&'static str]) -> Self {
        Self { requirements: ids.to_vec(), ..self }
    }

    /// These frames show it.
    #[must_use]
    pub fn shown_by(self, evidence: Vec<Evidence>) -> Self {
        Self { evidence, ..self }
    }

    /// What would have to be true for it not to be one: what is special to it, or what the judge takes for granted in all findings
    /// of its rule. `None` for a note, which accuses nobody, and where nothing would.
    pub fn excuse(&self) -> Option<&str> {
        let own = Some(self.unless.as_str());
        let general = Some(self.rule.unless()).filter(|_| self.severity != Severity::Note);
        own.filter(|text| !text.is_empty()).or(general.filter(|text| !text.is_empty()))
    }

    /// What was seen, what was expected instead, and what would excuse it, in one sentence.
    pub fn message(&self) -> String {
        let part = |before: &str, text: &str| {
            if text.is_empty() { String::new() } else { format!("{before}{text}") }
        };
        format!("{}{}{}", self.seen, part("; expected ", &self.expected), part(", unless ", &self.unless))
    }
}
