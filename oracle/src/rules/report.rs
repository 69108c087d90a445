//! What became of the rules over a recording.

/// Whether a rule was kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RuleVerdict {
    /// It was kept at least once, and never seen broken.
    Holds,
    /// It was broken.
    Broken,
    /// The recording does not decide it, or there was nothing to keep it in.
    Undecided,
}

impl RuleVerdict {
    /// `holds`, `broken` or `never decided`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Broken => "broken",
            Self::Undecided => "never decided",
        }
    }
}

/// A time at which a rule was broken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Breach {
    /// When, in nanoseconds since the first frame: when what must not be began, or when a bound was over.
    pub t_ns: i64,
    /// The values at that time of all that the rule is about.
    pub seen: String,
}

/// What became of a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleReport {
    /// The rule's name.
    pub name: String,
    /// The line of the file, from 1.
    pub line: usize,
    /// What it asks for, as it is written.
    pub rule: String,
    /// What it is for, if that is written.
    pub note: Option<String>,
    /// How many times it was kept: of `always` and `never`, for how many times in a row without an interruption; of `for at most`,
    /// how many times it was over in time; of the others, how many times the premise became true and the rest followed.
    pub held: u64,
    /// How many times it was broken.
    pub broken: u64,
    /// How many times it came up and stayed undecided: something was unknown, or the recording ended before.
    pub undecided: u64,
    /// The first twenty times that it was broken, in order.
    pub breaches: Vec<Breach>,
    /// Why it was never decided, where that is the verdict.
    pub why: Option<String>,
}

impl RuleReport {
    /// Whether it was kept.
    pub const fn verdict(&self) -> RuleVerdict {
        match (self.broken, self.held) {
            (0, 0) => RuleVerdict::Undecided,
            (0, _) => RuleVerdict::Holds,
            _ => RuleVerdict::Broken,
        }
    }
}
