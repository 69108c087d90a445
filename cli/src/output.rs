//! Standard output: the only place that writes to it.
//!
//! A reader that has seen enough (`adsdv check run.log | head`) closes the pipe. That is no error: the command
//! ends quietly, with the status it would have had.

use std::io::{self, IsTerminal as _, Write};

use anstream::AutoStream;
use clap::ColorChoice;

use crate::error::Error;

/// Text is wrapped to this width where the terminal does not say.
pub(crate) const WIDTH: usize = 100;
/// Lines longer than this are hard to read, however wide the terminal.
const WIDEST: usize = 120;
/// In fewer columns than this the layout does not fit anyway.
const NARROWEST: usize = 60;

/// The width to wrap text to, in columns.
pub(crate) fn width() -> usize {
    terminal_size::terminal_size_of(io::stdout())
        .map_or(WIDTH, |(width, _)| usize::from(width.0).clamp(NARROWEST, WIDEST))
}

/// Writes text with ANSI styles, without them if they are not wanted or `NO_COLOR` is set.
pub(crate) fn styled(text: &str, color: ColorChoice) -> Result<(), Error> {
    write(AutoStream::new(io::stdout().lock(), choice(color)), text)
}

/// Whether text on standard output is colored.
pub(crate) fn is_colored(color: ColorChoice) -> bool {
    choice(color) != anstream::ColorChoice::Never
}

fn choice(color: ColorChoice) -> anstream::ColorChoice {
    match color {
        // A terminal, and nothing else: CLICOLOR_FORCE does not put escapes into files.
        ColorChoice::Auto if io::stdout().is_terminal() => AutoStream::choice(&io::stdout()),
        ColorChoice::Auto | ColorChoice::Never => anstream::ColorChoice::Never,
        ColorChoice::Always => anstream::ColorChoice::Always,
    }
}

/// Writes a part of what goes on until the command is stopped, with ANSI styles as [`styled`] does. Tells whether anybody
/// still reads.
pub(crate) fn follow(text: &str, color: ColorChoice) -> Result<bool, Error> {
    write_some(AutoStream::new(io::stdout().lock(), choice(color)), text)
}

/// Writes text as it is.
pub(crate) fn plain(text: &str) -> Result<(), Error> {
    write(io::stdout().lock(), text)
}

fn write(out: impl Write, text: &str) -> Result<(), Error> {
    write_some(out, text).map(drop)
}

/// Tells whether anybody reads.
fn write_some(mut out: impl Write, text: &str) -> Result<bool, Error> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(Error::output(&error)),
    }
}
