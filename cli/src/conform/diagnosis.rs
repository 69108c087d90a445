//! `--diagnose`: what the program does otherwise, each by itself.

use std::fmt::{self, Write as _};

use adsdv_diagnosis::{Diagnosis, Subject, diagnose};
use adsdv_oracle::conform::{Program, ProgramError, Vcu as _};
use adsdv_oracle::protocol::Answer;
use adsdv_spec::{Edition, Inputs};
use serde::Serialize;

use super::start;
use crate::args::ConformArgs;
use crate::layout::{counted, wrapped};
use crate::progress::Line;
use crate::report::style::{self, Styled};

/// Progress is shown after so many steps.
const SHOWN_EVERY: u64 = 500;

/// What a program does otherwise, by an edition as it reads it.
#[derive(Clone, Debug)]
pub(super) struct DiagnosedProgram {
    edition: Edition,
    found: Diagnosis,
}

/// Starts the program once more, and finds out.
pub(super) fn of(args: &ConformArgs, edition: &Edition) -> Result<DiagnosedProgram, ProgramError> {
    let mut program = Asked { program: start(args)?, steps: 0, line: Line::new() };
    program.program.hello(edition)?;
    let found = diagnose(&mut program, edition)?;
    Ok(DiagnosedProgram { edition: *edition, found })
}

/// A program, with how many steps it was asked for on the terminal.
struct Asked {
    program: Program,
    steps: u64,
    line: Line,
}

impl Subject for Asked {
    fn reset(&mut self) -> Result<(), ProgramError> {
        Subject::reset(&mut self.program)
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        self.steps += 1;
        if self.steps.is_multiple_of(SHOWN_EVERY) {
            self.line.show(format_args!("diagnosis: {} steps asked", self.steps));
        }
        Subject::step(&mut self.program, dt_ms, inputs)
    }
}

/// As text, below the header.
pub(super) fn write(out: &mut String, program: &DiagnosedProgram, width: usize) -> fmt::Result {
    let DiagnosedProgram { edition, found } = program;
    writeln!(out, "\n{}", Styled(style::HEADING, "DEVIATIONS"))?;
    if found.deviations.is_empty() {
        writeln!(out, "  none in {}", counted(found.experiments as u64, "experiment"))?;
    }
    for deviation in &found.deviations {
        let requirements = deviation.requirements(edition).join(", ");
        let of = if requirements.is_empty() { String::new() } else { format!(" ({requirements})") };
        wrapped(out, format!("{}{of}", deviation.text(edition)).split(' '), 2, width);
    }
    if !found.unexplained.is_empty() {
        let many = counted(found.unexplained.len() as u64, "experiment");
        let rest = format!("not explained by that: {many} of {}", found.experiments);
        wrapped(out, rest.split(' '), 2, width);
    }
    Ok(())
}

/// As `--json` writes it.
#[derive(Serialize)]
pub(super) struct DiagnosisJson {
    experiments: usize,
    deviations: Vec<DeviationJson>,
    unexplained: usize,
}

#[derive(Serialize)]
struct DeviationJson {
    id: String,
    text: String,
    requirements: Vec<&'static str>,
}

impl From<&DiagnosedProgram> for DiagnosisJson {
    fn from(DiagnosedProgram { edition, found }: &DiagnosedProgram) -> Self {
        let one = |deviation: &adsdv_diagnosis::Deviation| DeviationJson {
            id: deviation.id(edition),
            text: deviation.text(edition).to_string(),
            requirements: deviation.requirements(edition),
        };
        Self {
            experiments: found.experiments,
            deviations: found.deviations.iter().map(one).collect(),
            unexplained: found.unexplained.len(),
        }
    }
}
