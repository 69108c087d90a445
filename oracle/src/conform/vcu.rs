//! What can be asked to step through scenarios.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Machine};

use super::program_error::{ProgramError, ProgramErrorKind, excerpt};
use crate::protocol::{Answer, BadLine, Shown};
use crate::suite::Scenario;

/// A VCU that is asked: a program, or a machine in this process.
pub trait Vcu {
    /// Steps through scenarios, each after a reset, and hands over the answers to all steps of each in turn.
    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError>;

    /// Ends it, and says what is worth knowing about how that went.
    fn end(&mut self) -> Result<Vec<String>, ProgramError> {
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
    /// The answer to a step, as a program writes it. One that is `late` may have nothing to show yet.
    ///
    /// Errors: the line is no text, or says no outputs.
    pub fn to_step(line: &[u8], late: bool) -> Result<Self, ProgramErrorKind> {
        let line = text(line)?;
        line.parse().map(Self::Answer).or_else(|why: BadLine| {
            if late && line.trim() == "{}" {
                Ok(Self::Nothing)
            } else {
                Err(ProgramErrorKind::NoAnswer(excerpt(line.as_bytes()), why))
            }
        })
    }

    /// Reads the answer to a reset.
    ///
    /// Errors: the line is no text, or another answer.
    pub fn to_reset(line: &[u8]) -> Result<(), ProgramErrorKind> {
        let line = text(line)?;
        match Answer::is_reset(line) {
            Ok(true) => Ok(()),
            Ok(false) => Err(ProgramErrorKind::NoReset(excerpt(line.as_bytes()), None)),
            Err(why) => Err(ProgramErrorKind::NoReset(excerpt(line.as_bytes()), Some(why))),
        }
    }

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

fn text(line: &[u8]) -> Result<&str, ProgramErrorKind> {
    std::str::from_utf8(line).map_err(|_| ProgramErrorKind::NotText(excerpt(line)))
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
    ) -> Result<(), ProgramError> {
        let mut replies = Vec::new();
        for (place, (_, scenario)) in scenarios.iter().enumerate() {
            replies.clear();
            replies.extend(scenario.shown(&self.0).map(Reply::from));
            answered(place, &replies);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_the_answer_to_a_step_to_a_reset_or_none() {
        let off = b"{\"as_state\":\"AS_OFF\"}";
        let step = |line: &[u8], late| Reply::to_step(line, late);
        assert_eq!(step(off, false).ok().and_then(|reply| reply.state()), Some(AsState::Off));
        assert!(matches!(step(b" {} \r", true), Ok(Reply::Nothing)));
        assert!(matches!(step(b"{}", false), Err(ProgramErrorKind::NoAnswer(line, _)) if line == "{}"));
        assert!(
            matches!(step(b"nonsense", true), Err(ProgramErrorKind::NoAnswer(line, _)) if line == "nonsense")
        );
        assert!(matches!(step(&[0xFF], true), Err(ProgramErrorKind::NotText(_))));
        assert!(Reply::to_reset(b"{}").is_ok());
        assert!(matches!(Reply::to_reset(off), Err(ProgramErrorKind::NoReset(_, None))));
        assert!(matches!(Reply::to_reset(b"ready"), Err(ProgramErrorKind::NoReset(_, Some(_)))));
        assert!(matches!(Reply::to_reset(&[0xFF]), Err(ProgramErrorKind::NotText(_))));
    }

    #[test]
    fn a_machine_answers_each_step_and_ends_without_a_word() {
        let step = crate::suite::Step { dt_ms: 10, inputs: adsdv_spec::Inputs::default() };
        let scenario = Scenario { steps: vec![step; 3] };
        let mut told = Vec::new();
        let mut machine = InProcess(Machine::REFERENCE);
        let asked = machine.ask(&[("a", &scenario), ("b", &scenario)], &mut |place, replies| {
            told.push((place, replies.len(), replies.iter().all(Reply::is_initial)));
        });
        assert!(asked.is_ok() && machine.end().is_ok_and(|notes| notes.is_empty()));
        assert_eq!(told, [(0, 3, true), (1, 3, true)]);
    }

    #[test]
    fn only_as_off_can_come_before_the_first_step() {
        let initial = |line: &[u8]| Reply::to_step(line, true).is_ok_and(|reply| reply.is_initial());
        assert!(initial(b"{}") && initial(b"{\"as_state\":\"AS_OFF\"}"));
        assert!(!initial(b"{\"as_state\":\"AS_READY\"}"));
    }
}
