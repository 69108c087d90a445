//! What is reported: a state that lasted, its arrows, and what blocked them.

use adsdv_spec::messages::SignalDef;
use adsdv_spec::{AsState, Atom, Atoms, Rules};

use super::Mover;

/// A condition that blocked an arrow, as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// The condition.
    pub atom: Atom,
    /// What it has to be.
    pub needed: bool,
    /// The identifier of the message that shows it; `None` where none does.
    pub id: Option<u16>,
    /// The signals of that message that decide it, with the raw values that they had first; none where it was not seen.
    pub values: Vec<(&'static SignalDef, i32)>,
}

impl Condition {
    /// Whose move it is.
    pub const fn mover(&self) -> Mover {
        Mover::of(self.atom)
    }

    /// The condition as it must be, in the words of Figure 2.
    pub fn needs(&self, rules: &Rules) -> String {
        rules.text(self.atom, self.needed).to_string()
    }

    /// Whether there is a message that would show it, but none has come.
    pub const fn is_unheard(&self) -> bool {
        self.id.is_some() && self.values.is_empty()
    }

    /// What was seen, such as `MISSION_STATUS is NOT SELECTED`; the condition itself where no signal shows more.
    pub fn seen(&self, rules: &Rules) -> String {
        if self.values.is_empty() {
            return rules.text(self.atom, !self.needed).to_string();
        }
        // The wheels say it together.
        if let [_, _, _, _] = self.values.as_slice() {
            let unit = self.values.first().map_or("", |(signal, _)| signal.unit);
            let speed = |(signal, raw): &(&SignalDef, i32)| signal.physical(*raw).to_string();
            let speeds: Vec<String> = self.values.iter().map(speed).collect();
            return format!("the wheel speeds are {} {unit}", speeds.join(", "));
        }
        let value =
            |(signal, raw): &(&SignalDef, i32)| format!("{} is {}", signal.name, signal.display(*raw));
        self.values.iter().map(value).collect::<Vec<_>>().join(", ")
    }
}

/// What blocked an arrow for some time.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocked {
    /// From when, in nanoseconds since the first frame.
    pub since_ns: i64,
    /// Until when.
    pub until_ns: i64,
    /// The conditions that failed.
    pub failed: Vec<Condition>,
    /// The conditions of which the bus does not tell.
    pub unknown: Vec<Condition>,
    /// The conditions that held.
    pub holding: Atoms,
}

/// An arrow that was not taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Untaken {
    /// Where it leads.
    pub to: AsState,
    /// The section that describes it.
    pub section: &'static str,
    /// Its requirements.
    pub requirements: &'static [&'static str],
    /// What blocked it, in order of time. Between two of these its guard held.
    pub blocked: Vec<Blocked>,
    /// How many more there were, before the last, that are not listed.
    pub more: u64,
}

/// A state that lasted.
#[derive(Clone, Debug, PartialEq)]
pub struct Stay {
    /// The state.
    pub state: AsState,
    /// From when, in nanoseconds since the first frame.
    pub since_ns: i64,
    /// Until when.
    pub until_ns: i64,
    /// The state behind it; `None` where the recording ends, or the VCU is not seen any more.
    pub left_to: Option<AsState>,
    /// The arrows that were not taken.
    pub arrows: Vec<Untaken>,
}
