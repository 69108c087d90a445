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
            let _stopped = adsdv_oracle::conform::stop_programs();
            // As if nobody had listened: whoever waits for the command learns what ended it.
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
    Ok(())
}

/// Elsewhere a terminal tells both.
#[cfg(not(unix))]
pub(crate) fn stops_the_program() -> io::Result<()> {
    Ok(())
}
