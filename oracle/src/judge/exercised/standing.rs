//! What a recording tells of the requirements.

use adsdv_spec::AsState;

use super::required::Required;

/// What a recording tells of a requirement. What weighs more stands behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Standing {
    /// Nothing: what it is about never happened.
    NotExercised,
    /// What it is about happened, and the recording does not show whether it was kept.
    NotCertain,
    /// It was kept at least once, and never seen broken.
    Held,
    /// It was broken.
    Violated,
}

impl Standing {
    /// Each of them, what matters most to a reader first.
    pub const ALL: [Self; 4] = [Self::Violated, Self::Held, Self::NotCertain, Self::NotExercised];

    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NotExercised => "not exercised",
            Self::NotCertain => "not certain",
            Self::Held => "held",
            Self::Violated => "violated",
        }
    }
}

/// A requirement that a log can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RequirementStanding {
    /// As `spec/REQUIREMENTS.md` numbers it, such as `RDY-5`.
    pub id: &'static str,
    /// What the recording tells of it.
    pub standing: Standing,
}

/// Something without which a recording tells little.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lack {
    /// No message of the AI Computer.
    Ai,
    /// No message of the VCU.
    Vcu,
    /// The VCU was there, and showed no AS_STATE that could be read.
    State,
    /// The VCU never showed another state than AS_OFF.
    LeftOff,
}

impl Lack {
    /// In words.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Ai => "no message of the AI Computer",
            Self::Vcu => "no message of the VCU",
            Self::State => "no AS_STATE shown",
            Self::LeftOff => "never left AS_OFF",
        }
    }
}

/// What the recording exercised.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exercised {
    /// Whether a message of the AI Computer came.
    pub ai: bool,
    /// Whether a message of the VCU came.
    pub vcu: bool,
    /// The AS states that 520h showed, in the order of their numbers.
    pub states: Vec<AsState>,
    /// The requirements of the edition that a log can show, in the order of the document.
    pub requirements: Vec<RequirementStanding>,
}

impl Exercised {
    /// How many requirements stand so.
    pub fn count(&self, standing: Standing) -> usize {
        self.requirements.iter().filter(|requirement| requirement.standing == standing).count()
    }

    /// What was not there, so that the verdict is about less than a run.
    pub fn lacks(&self) -> Vec<Lack> {
        let state = match self.states[..] {
            _ if !self.vcu => None,
            [] => Some(Lack::State),
            [AsState::Off] => Some(Lack::LeftOff),
            _ => None,
        };
        let sides = [(self.ai, Lack::Ai), (self.vcu, Lack::Vcu)];
        sides.into_iter().filter(|(there, _)| !there).map(|(_, lack)| lack).chain(state).collect()
    }

    /// Whether the recording showed this.
    pub fn meets(&self, required: Required) -> bool {
        match required {
            Required::Ai => self.ai,
            Required::Vcu => self.vcu,
            Required::State(state) => self.states.contains(&state),
            Required::Requirement(id) => {
                self.requirements.iter().any(|one| one.id == id && one.standing != Standing::NotExercised)
            }
        }
    }
}
