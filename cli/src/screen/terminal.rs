//! The loop between a car and a terminal.

use std::env;
use std::ffi::OsStr;
use std::io::{self, IsTerminal as _, stdout};
use std::mem::ManuallyDrop;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use adsdv_spec::Inputs;
use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event};
use ratatui::crossterm::style::force_color_output;
#[cfg(unix)]
use ratatui::crossterm::{execute, terminal};
use ratatui::layout::{Position, Rect};

use super::keyboard::Keyboard;
use super::render::render;
use super::{Effect, Screen, Source, keys};
use crate::args::ChosenEdition;

/// The screen is drawn this often, at least.
const FRAME: Duration = Duration::from_millis(50);

/// Shows the car, and does what the operator does, until one of them has had enough.
///
/// The terminal is left as it was found, whatever happens.
///
/// # Errors
///
/// Standard output is no terminal, or a dumb one, or the terminal cannot be read or written.
pub(crate) fn run(source: &dyn Source, chosen: ChosenEdition, color: bool) -> io::Result<()> {
    fit(stdout().is_terminal(), env::var_os("TERM").as_deref())?;
    // Whether colors are wanted has been decided; NO_COLOR was asked then.
    force_color_output(color);
    let keyboard = Keyboard::open()?;
    // The panic hook that this sets puts the terminal back before a panic is printed.
    let mut open = Open(ManuallyDrop::new(ratatui::try_init().inspect_err(|_| put_back())?));
    let (mut screen, begun) = (Screen::new(color).of(&chosen), Instant::now());
    while !source.is_over() {
        let status = source.status();
        screen.tick(begun.elapsed().as_millis());
        let mut log = screen.log;
        open.0.draw(|frame| log = render(&status, &screen, frame.area(), frame.buffer_mut()))?;
        screen.log = log;
        if listen(source, &keyboard, &mut screen, &status.inputs, &mut open.0)?.is_break() {
            break;
        }
    }
    Ok(())
}

/// Whether a screen can be drawn there.
fn fit(is_terminal: bool, kind: Option<&OsStr>) -> io::Result<()> {
    let why = if !is_terminal {
        "the screen needs a terminal, and standard output is none"
    } else if kind.is_some_and(|kind| kind == "dumb") {
        "the screen needs a terminal with a cursor that moves, and TERM says dumb"
    } else {
        return Ok(());
    };
    Err(io::Error::new(io::ErrorKind::Unsupported, why))
}

/// Follows the keys until the next frame is due.
fn listen(
    source: &dyn Source,
    keyboard: &Keyboard,
    screen: &mut Screen,
    inputs: &Inputs,
    terminal: &mut DefaultTerminal,
) -> io::Result<ControlFlow<()>> {
    let due = Instant::now() + FRAME;
    while keyboard.has_news(due)? {
        let command = match event::read()? {
            Event::Key(key) => keys::command(key),
            // A new size: the next frame has it.
            _ => return Ok(ControlFlow::Continue(())),
        };
        match command.map(|command| screen.follow(command, inputs)) {
            Some(Effect::Quit) => return Ok(ControlFlow::Break(())),
            Some(Effect::Act(action)) => source.act(action),
            Some(Effect::Redraw) => anew(terminal)?,
            Some(Effect::Suspend) => suspend(terminal)?,
            Some(Effect::Nothing) | None => {}
        }
        if Instant::now() >= due {
            break;
        }
    }
    Ok(ControlFlow::Continue(()))
}

/// Forgets what the terminal shows. Unlike `Terminal::clear`, this asks the terminal nothing that it may not answer.
fn anew(screen: &mut DefaultTerminal) -> io::Result<()> {
    let size = screen.size()?;
    screen.resize(Rect::from((Position::ORIGIN, size)))
}

/// Hands the terminal back to the shell, and goes on when the shell says so. The whole program stops, the car with it.
#[cfg(unix)]
fn suspend(screen: &mut DefaultTerminal) -> io::Result<()> {
    screen.show_cursor()?;
    ratatui::try_restore()?;
    signal_hook::low_level::emulate_default_handler(signal_hook::consts::SIGTSTP)?;
    terminal::enable_raw_mode()?;
    execute!(stdout(), terminal::EnterAlternateScreen)?;
    anew(screen)
}

#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "as on unix")]
fn suspend(_: &mut DefaultTerminal) -> io::Result<()> {
    Ok(())
}

/// A terminal that is put back when it is dropped. ratatui would tell, and panic, that a terminal that is gone has no cursor.
struct Open(ManuallyDrop<DefaultTerminal>);

impl Drop for Open {
    fn drop(&mut self) {
        let _ = self.0.show_cursor();
        put_back();
    }
}

fn put_back() {
    // If it cannot be put back it is most likely gone, and with it the person who could read of it.
    let _ = ratatui::try_restore();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_screen_needs_a_terminal_that_is_not_dumb() {
        let fitted = |is_terminal, kind: &str| {
            fit(is_terminal, Some(OsStr::new(kind))).map_err(|error| (error.kind(), error.to_string()))
        };
        for (is_terminal, kind, part) in
            [(true, "dumb", "TERM says dumb"), (false, "xterm", "standard output is none")]
        {
            let (kind, why) = fitted(is_terminal, kind).expect_err("no screen");
            assert!(kind == io::ErrorKind::Unsupported && why.contains(part), "{why}");
        }
        assert_eq!(fitted(true, "xterm-256color"), Ok(()));
        assert!(fit(true, None).is_ok());
    }
}
