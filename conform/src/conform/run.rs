//! What goes on, and what it has come to: who is asked, how far it is, and what has been shown.

use std::time::Duration;

use super::keys::Keys;
use super::options::{ConformOptions, ConformProgress, Phase};
use super::own_bit::Asked;
use super::program_error::ProgramError;
use super::vcu::{Reply, Vcu as _};
use crate::protocol::InputField;
use crate::suite::Scenario;

/// What goes on, and what it has come to.
pub(super) struct Run<'a> {
    pub(super) asked: Asked<'a>,
    /// The inputs that it does not have.
    pub(super) lacking: Vec<&'static InputField>,
    pub(super) options: &'a ConformOptions,
    pub(super) progress: &'a mut dyn FnMut(ConformProgress),
    /// How far it is.
    pub(super) at: ConformProgress,
    /// The steps that the program has made.
    pub(super) steps: u64,
    /// Those of the whole suite.
    pub(super) suite_steps: u64,
    /// The outputs that it has shown.
    pub(super) shown: Keys,
    /// How long the search for shorter scenarios may still take.
    pub(super) shrinking: Duration,
}

impl Run<'_> {
    /// Asks, counts steps, notes what is shown, and tells how far it is.
    pub(super) fn ask(
        &mut self,
        named: &[(&str, &Scenario)],
        phase: Phase,
        before: usize,
        all: usize,
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError> {
        let Self { asked, progress, at, steps, shown, .. } = self;
        *at = ConformProgress { phase, done: before, all };
        asked.ask(named, &mut |place, replies| {
            *steps += replies.len() as u64;
            *shown = replies.iter().fold(*shown, |shown, reply| shown.or(Keys::given(reply)));
            answered(place, replies);
            *at = ConformProgress { phase, done: before + place + 1, all };
            progress(*at);
        })
    }

    /// Tells how far it is.
    pub(super) fn report(&mut self, at: ConformProgress) {
        self.at = at;
        (self.progress)(at);
    }
}
