//! What happens when the command is stopped: the program under test stops as well.

use std::io;

/// Lets Ctrl-C, and what else ends the command, end the program under test first.
#[cfg(unix)]
pub(crate) fn stops_the_program() -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut signals = Signals::new([SIGHUP, SIGINT, SIGTERM])?;
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            end_by(signal);
        }
    });
    Ok(())
}

/// Ends the programs under test, and then the command, as if nobody had listened: the shell learns what ended it.
#[cfg(unix)]
pub(crate) fn end_by(signal: i32) {
    let _stopped = adsdv_conform::stop_programs();
    let _ = signal_hook::low_level::emulate_default_handler(signal);
}

/// Elsewhere a terminal tells both.
#[cfg(not(unix))]
pub(crate) fn stops_the_program() -> io::Result<()> {
    Ok(())
}
