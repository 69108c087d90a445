//! What can be asked to step through scenarios.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Machine};

use super::trouble::Trouble;
use crate::protocol::{Answer, Shown};
use crate::suite::Scenario;

/// A VCU that is asked: a program, or a machine in this process.
pub trait Vcu {
    /// Steps through scenarios, each after a reset, and hands over the answers to all steps of each in turn.
    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), Trouble>;

    /// Ends it, and says what is worth knowing about how that went.
    fn end(&mut self) -> Result<Vec<String>, Trouble> {
        Ok(Vec::new())
    }
}

/// What was answered to a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::large_enum_variant, reason = "nearly all are answers")]
pub enum Reply {
    /// Outputs.
    Answer(Answer),
    /// `{}`, from a program that answers late and has nothing to show yet.
    Nothing,
}

impl Reply {
    /// Whether all that it says is so.
    pub(super) fn agrees(&self, shown: &Shown) -> bool {
        match self {
            Self::Answer(answer) => answer.agrees(shown),
            Self::Nothing => false,
        }
    }

    /// The state that it shows.
    pub(super) fn state(&self) -> Option<AsState> {
        match self {
            Self::Answer(answer) => AsState::from_raw(answer.get("as_state")?.raw?),
            Self::Nothing => None,
        }
    }

    /// The same without what it shows besides the state.
    pub(super) fn only_the_state(&self) -> Self {
        match self {
            Self::Answer(answer) => Self::Answer(answer.only("as_state")),
            Self::Nothing => Self::Nothing,
        }
    }

    /// The SHUTDOWN_CAUSE that it shows.
    pub(super) fn cause(&self) -> Option<ShutdownCause> {
        match self {
            Self::Answer(answer) => ShutdownCause::from_raw(answer.get("shutdown_cause")?.raw?),
            Self::Nothing => None,
        }
    }

    /// Whether it can come before the first step has its effect: a VCU that shows AS_OFF, or nothing yet.
    pub(super) fn is_initial(&self) -> bool {
        self.state().is_none_or(|state| state == AsState::Off)
    }
}

impl From<Shown> for Reply {
    fn from(shown: Shown) -> Self {
        Self::Answer(shown.into())
    }
}

/// A machine of the specification as a program under test: always right, if it has the right readings.
#[derive(Clone, Debug)]
pub struct InProcess(pub Machine);

impl Vcu for InProcess {
    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), Trouble> {
        let mut replies = Vec::new();
        for (place, (_, scenario)) in scenarios.iter().enumerate() {
            replies.clear();
            replies.extend(scenario.shown(&self.0).map(Reply::from));
            answered(place, &replies);
        }
        Ok(())
    }
}
