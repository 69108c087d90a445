//! The AI Computer's answers to the handshake, for a program whose bit is not the specification's.
//!
//! A scenario has the AI Computer's bit as one that the specification would be answered with. A program whose bit is another at some
//! step would seem to lose communication there, and nothing behind it would be judged. So such a program is asked one step after
//! the other, and where the scenario answers the specification's bit its own is answered.

use std::time::Instant;

use adsdv_spec::{Edition, Machine};

use super::program_error::ProgramError;
use super::vcu::{Reply, Vcu};
use super::wall_clock::takes;
use crate::protocol::{About, SHOWN};
use crate::suite::{Scenario, Step};

/// What is asked, and by whose bit.
pub(super) struct Asked<'a> {
    pub(super) vcu: &'a mut dyn Vcu,
    /// The machine whose bit the scenarios answer, if the program is to be answered by its own.
    pub(super) own: Option<Machine>,
    /// Until when scenarios are begun, if there is no time for all of them.
    pub(super) until: Option<Instant>,
}

impl Vcu for Asked<'_> {
    fn hello(&mut self, edition: &Edition) -> Result<About, ProgramError> {
        self.vcu.hello(edition)
    }

    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError> {
        if self.own.is_none() && self.until.is_none() {
            return self.vcu.ask(scenarios, answered);
        }
        for (place, (name, scenario)) in scenarios.iter().enumerate() {
            if self.until.is_some_and(|until| Instant::now() + takes(scenario) > until) {
                break;
            }
            let Some(machine) = self.own else {
                self.vcu.ask(&[(*name, *scenario)], &mut |_, replies| answered(place, replies))?;
                continue;
            };
            let answers: Vec<bool> = scenario.answers(&machine).collect();
            let mut bit = false;
            let mut next = |place: usize, last: Option<&Reply>| {
                // It may be asked from the beginning again.
                bit = last.map_or(Some(false), handshake).unwrap_or(bit);
                let (step, answers) = (scenario.steps.get(place)?, answers.get(place)?);
                let mut inputs = step.inputs;
                inputs.ai.status.handshake = bit == *answers;
                Some(Step { inputs, ..*step })
            };
            let replies = self.vcu.ask_in_turn(name, &mut next)?;
            answered(place, &replies);
        }
        Ok(())
    }

    fn end(&mut self) -> Result<Vec<String>, ProgramError> {
        self.vcu.end()
    }
}

/// The bit that a program shows, if it shows one.
pub(super) fn handshake(reply: &Reply) -> Option<bool> {
    match reply {
        Reply::Answer(answer) => Some(answer.get(HANDSHAKE)?.raw? != 0),
        Reply::Nothing => None,
    }
}

/// Whether a program shows another bit than a machine in some step.
pub(super) fn differs(machine: &Machine, scenario: &Scenario, replies: &[Reply]) -> bool {
    let bits = scenario.run(machine).map(|(control, _)| control.handshake.bit);
    bits.zip(replies).any(|(bit, reply)| handshake(reply).is_some_and(|own| own != bit))
}

/// The key of the bit, the VCU's and the AI Computer's.
pub(super) const HANDSHAKE: &str = {
    let mut place = 0;
    while !SHOWN[place].key.eq_ignore_ascii_case("handshake") {
        place += 1;
    }
    SHOWN[place].key
};
