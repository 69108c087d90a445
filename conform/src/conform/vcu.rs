//! What can be asked to step through scenarios.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Edition, Machine};

use super::program_error::{ProgramError, ProgramErrorKind, excerpt};
use crate::protocol::{About, Answer, BadLine, Protocol, Shown};
use crate::suite::{Scenario, Step};

/// A VCU that is asked: a program, or a machine in this process.
pub trait Vcu {
    /// Learns, before anything else, which edition all that follows is about, and tells about itself.
    ///
    /// # Errors
    ///
    /// Fails if it is of another edition.
    fn hello(&mut self, edition: &Edition) -> Result<About, ProgramError>;

    /// Steps through scenarios, each after a reset, and hands over the answers to all steps of each in turn.
    ///
    /// # Errors
    ///
    /// Fails where it does not answer, or answers what is none; what was answered before has been handed over.
    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError>;

    /// Steps through one scenario, after a reset, of which each step depends on the answer to the one before: `next` has the step
    /// at a place, given that answer. Hands over the answers.
    ///
    /// # Errors
    ///
    /// As [`ask`](Self::ask).
    fn ask_in_turn(
        &mut self,
        name: &str,
        next: &mut dyn FnMut(usize, Option<&Reply>) -> Option<Step>,
    ) -> Result<Vec<Reply>, ProgramError> {
        // One that can only be asked for whole scenarios is asked again for a longer one each time: that is for tests.
        let mut scenario = Scenario::default();
        let mut replies: Vec<Reply> = Vec::new();
        while let Some(step) = next(scenario.steps.len(), replies.last()) {
            scenario.steps.push(step);
            self.ask(&[(name, &scenario)], &mut |_, all| replies = all.to_vec())?;
        }
        Ok(replies)
    }

    /// Ends it, and says what is worth knowing about how that went.
    ///
    /// # Errors
    ///
    /// Fails if it says something that nobody asked for.
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
    /// The answer to a hello: whether the program is of the edition that it names.
    ///
    /// # Errors
    ///
    /// Fails if the line is no text, no object, or says another edition, or none.
    pub fn to_hello(line: &[u8], edition: &Edition) -> Result<(), ProgramErrorKind> {
        let line = text(line)?;
        match Answer::edition(line) {
            Ok(Some(said)) if said == edition.version => Ok(()),
            Ok(said) => Err(ProgramErrorKind::OtherEdition {
                asked: edition.version.to_owned(),
                said: said.map(|said| excerpt(said.as_bytes())),
            }),
            Err(why) => Err(ProgramErrorKind::NoHello(excerpt(line.as_bytes()), why)),
        }
    }

    /// What a program says of itself, if a line says that.
    ///
    /// # Errors
    ///
    /// Fails if the line is no text, or says what cannot be so.
    pub fn about(line: &[u8], protocol: &Protocol) -> Result<Option<About>, ProgramErrorKind> {
        let line = text(line)?;
        About::read(line, protocol).map_err(|why| ProgramErrorKind::NoAbout(excerpt(line.as_bytes()), why))
    }

    /// The answer to a step, as a program writes it. One that is `late` may have nothing to show yet.
    ///
    /// # Errors
    ///
    /// Fails if the line is no text, or says no outputs.
    pub fn to_step(line: &[u8], late: bool, protocol: &Protocol) -> Result<Self, ProgramErrorKind> {
        let line = text(line)?;
        protocol.answer(line).map(Self::Answer).or_else(|why: BadLine| {
            if late && line.trim() == "{}" {
                Ok(Self::Nothing)
            } else {
                Err(ProgramErrorKind::NoAnswer(excerpt(line.as_bytes()), why))
            }
        })
    }

    /// Reads the answer to a reset.
    ///
    /// # Errors
    ///
    /// Fails if the line is no text, or another answer.
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

    /// The state that it shows; `None` if that is none.
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
        matches!(self, Self::Nothing) || self.state() == Some(AsState::Off)
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
    fn hello(&mut self, edition: &Edition) -> Result<About, ProgramError> {
        let own = self.0.edition().version;
        if own == edition.version {
            return Ok(About::default());
        }
        let (asked, said) = (edition.version.to_owned(), Some(own.to_owned()));
        Err(ProgramError::new(ProgramErrorKind::OtherEdition { asked, said }))
    }

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
        let protocol = Protocol::of(&Edition::V3_0);
        let step = |line: &[u8], late| Reply::to_step(line, late, &protocol);
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
    fn a_hello_is_answered_with_the_edition_that_it_names() {
        let named = |line: &[u8]| Reply::to_hello(line, &Edition { version: "test", ..Edition::V3_0 });
        assert!(named(br#"{"edition":"test"}"#).is_ok());
        for (line, other) in
            [("{}", None), (r#"{"edition":"3.0"}"#, Some("3.0")), (r#"{"edition":4}"#, Some("4"))]
        {
            let Err(ProgramErrorKind::OtherEdition { asked, said }) = named(line.as_bytes()) else {
                panic!("{line} is of another edition")
            };
            assert_eq!((asked.as_str(), said.as_deref()), ("test", other));
        }
        assert!(matches!(named(b"ready"), Err(ProgramErrorKind::NoHello(line, _)) if line == "ready"));
        assert!(matches!(named(&[0xFF]), Err(ProgramErrorKind::NotText(_))));
    }

    #[test]
    fn a_machine_answers_each_step_and_ends_without_a_word() {
        let step = crate::suite::Step { dt_ms: 10, inputs: adsdv_spec::Inputs::default() };
        let scenario = Scenario { steps: vec![step; 3] };
        let mut calls = Vec::new();
        let mut machine = InProcess(Machine::REFERENCE);
        let asked = machine.ask(&[("a", &scenario), ("b", &scenario)], &mut |place, replies| {
            calls.push((place, replies.len(), replies.iter().all(Reply::is_initial)));
        });
        assert!(asked.is_ok() && machine.end().is_ok_and(|notes| notes.is_empty()));
        assert_eq!(calls, [(0, 3, true), (1, 3, true)]);
    }

    #[test]
    fn only_as_off_can_come_before_the_first_step() {
        let protocol = Protocol::of(&Edition::V3_0);
        let initial =
            |line: &[u8]| Reply::to_step(line, true, &protocol).is_ok_and(|reply| reply.is_initial());
        assert!(initial(b"{}") && initial(b"{\"as_state\":\"AS_OFF\"}"));
        assert!(!initial(b"{\"as_state\":\"AS_READY\"}"));
    }
}
