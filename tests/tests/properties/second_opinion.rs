//! The document once more, in its own words, over whole runs: both remember for themselves what they need to.

use std::fmt::Display;

use adsdv_proofs::words::{self, Arrow, StepOfDocument, Verdict};
use adsdv_spec::{Control, Readings};

use crate::operations::Run;
use crate::run::{Property, Seen};

/// At every step the machine shows what the transcription of the text of its edition's document shows.
pub(crate) struct SecondOpinion {
    says: StepOfDocument,
    readings: Readings,
    control: Control,
}

impl SecondOpinion {
    pub(crate) fn new(run: &Run) -> Self {
        let says = words::of_version(run.edition.version).expect("every edition has its words");
        Self { says, readings: run.readings, control: Control::INITIAL }
    }
}

impl Property for SecondOpinion {
    fn see(&mut self, seen: &Seen<'_>) -> Result<(), String> {
        if seen.power_cycled {
            self.control = Control::INITIAL;
        }
        let expected = (self.says)(&self.control, seen.inputs, seen.dt_ms, self.readings);
        self.control = expected.control;
        // What the machine remembers is its own affair: what it shows counts.
        let found = Verdict::of(expected.control, seen.outputs);
        if found == expected {
            return Ok(());
        }
        Err(format!(
            "the text says {}{}{}",
            difference("AS_STATE", &expected.state.name(), &found.state.name()),
            difference(
                "section",
                &expected.arrow.map_or("none", Arrow::section),
                &found.arrow.map_or("none", Arrow::section)
            ),
            match (expected.state == found.state, expected.flags == found.flags) {
                (true, false) => format!("{:?}, not {:?}", expected.flags, found.flags),
                (true, true) => format!(
                    "{}{}{}",
                    difference(
                        "SHUTDOWN_CAUSE",
                        &expected.shutdown_cause.name(),
                        &found.shutdown_cause.name()
                    ),
                    difference("HANDSHAKE", &expected.handshake, &found.handshake),
                    difference("GO_SIGNAL", &expected.go_signal, &found.go_signal),
                ),
                (false, _) => String::new(),
            }
        )
        .trim_end_matches("; ")
        .to_owned())
    }
}

fn difference<T: PartialEq + Display>(what: &str, expected: &T, found: &T) -> String {
    if expected == found { String::new() } else { format!("{what} {expected}, not {found}; ") }
}
