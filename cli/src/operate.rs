//! The virtual VCU with an operator: on the terminal screen, or line by line where there is none.

use std::io::{self, IsTerminal as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use adsdv_can::car::Action;
use adsdv_can::live::{Handle, Runner};
use adsdv_can::status::Status;
use clap::ColorChoice;

use crate::args::ChosenEdition;
use crate::error::Error;
use crate::screen::{self, Source};
use crate::{interrupt, output, plain};

/// Whether there is a terminal for the screen.
pub(crate) fn has_screen() -> bool {
    io::stdout().is_terminal() && io::stdin().is_terminal()
}

/// Runs it on the terminal screen until the operator leaves it, then prints how it went, and tells how everything stood.
pub(crate) fn on_screen(
    runner: impl Runner + Send + 'static,
    chosen: ChosenEdition,
    color: ColorChoice,
) -> Result<Arc<Status>, Error> {
    let stop = interrupt::flag().map_err(|error| Error::system("signals", &error))?;
    let bus = runner.status().bus.clone();
    let handle = Handle::start(runner).map_err(|error| Error::system("threads", &error))?;
    let operated = Operated { handle: &handle, stop: &stop };
    screen::run(&operated, chosen, output::is_colored(color)).map_err(|error| Error::screen(&error))?;
    let status = handle.join().map_err(|error| Error::mistake(&bus, error))?;
    plain::conclude(&status, chosen, color)?;
    Ok(status)
}

/// A runner on the screen, until somebody sends a signal.
struct Operated<'a> {
    handle: &'a Handle,
    stop: &'a AtomicBool,
}

impl Source for Operated<'_> {
    fn status(&self) -> Status {
        Status::clone(&self.handle.status())
    }

    fn act(&self, action: Action) {
        self.handle.act(action);
    }

    fn is_over(&self) -> bool {
        !self.handle.is_running() || self.stop.load(Ordering::Relaxed)
    }
}
