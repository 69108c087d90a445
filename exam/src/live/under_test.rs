//! Who is examined: a program that is started afresh for each scenario, or one that runs all the time.

use std::time::Duration;

use adsdv_conform::{ProgramErrorKind, RunningProgram};

use super::error::LiveError;
use super::options::LiveProgram;

/// How long a program may take to end when it is asked to.
const FAREWELL: Duration = Duration::from_secs(1);

/// Who is examined, as far as that can be done something with beside the bus.
pub(super) trait UnderTest {
    /// Whether each scenario has it started afresh.
    fn starts(&self) -> bool;

    /// Starts it.
    fn start(&mut self) -> Result<(), LiveError>;

    /// How it has ended, if it has though nobody asked it to.
    fn ended(&mut self) -> Option<String>;

    /// Ends it.
    fn stop(&mut self);
}

/// A program that is started afresh.
#[derive(Debug)]
pub(super) struct Afresh<'a> {
    program: &'a LiveProgram,
    running: Option<RunningProgram>,
}

impl<'a> Afresh<'a> {
    pub(super) const fn new(program: &'a LiveProgram) -> Self {
        Self { program, running: None }
    }
}

impl UnderTest for Afresh<'_> {
    fn starts(&self) -> bool {
        matches!(self.program, LiveProgram::Started { .. })
    }

    fn start(&mut self) -> Result<(), LiveError> {
        if let LiveProgram::Started { program, args } = self.program {
            let started = RunningProgram::start(program, args);
            self.running = Some(started.map_err(|error| no_start(&program.to_string_lossy(), &error))?);
        }
        Ok(())
    }

    fn ended(&mut self) -> Option<String> {
        let running = self.running.as_mut()?;
        let mut how = running.ended()?;
        let last_words = running.last_words();
        if !last_words.is_empty() {
            how = format!("{how}; its last words: {}", last_words.join(" / "));
        }
        Some(how)
    }

    fn stop(&mut self) {
        if let Some(running) = self.running.take() {
            running.end(FAREWELL);
        }
    }
}

fn no_start(program: &str, error: &ProgramErrorKind) -> LiveError {
    let hint = match error {
        ProgramErrorKind::NoStart(error) if error.kind() == std::io::ErrorKind::NotFound => {
            "check the path, and put what the program is started with before it, such as: adsdv exam vcan0 -- python3 stack.py vcan0"
        }
        ProgramErrorKind::NoStart(error) if error.kind() == std::io::ErrorKind::PermissionDenied => {
            "make it executable (chmod +x), or start it with its interpreter"
        }
        _ => "start the program by hand",
    };
    LiveError::new(program, error.to_string(), hint)
}
