//! Ctrl-C and SIGTERM: commands that go on until they are stopped end in order, and say how it went; what is half written does not
//! stay.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A flag that is set when a signal asks the command to stop. At a second one, it stops where it is.
#[cfg(unix)]
pub(crate) fn flag() -> io::Result<Arc<AtomicBool>> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::flag;

    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGHUP, SIGINT, SIGTERM] {
        // In this order: the first time the flag is not set yet.
        flag::register_conditional_default(signal, Arc::clone(&stop))?;
        flag::register(signal, Arc::clone(&stop))?;
    }
    Ok(stop)
}

/// Elsewhere a terminal ends the command.
#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "as on unix")]
pub(crate) fn flag() -> io::Result<Arc<AtomicBool>> {
    Ok(Arc::new(AtomicBool::new(false)))
}

/// Lets Ctrl-C, and what else ends the command, remove this file or directory first, if it still has that name.
#[cfg(unix)]
pub(crate) fn removes(path: PathBuf) -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    let mut signals = Signals::new([SIGHUP, SIGINT, SIGTERM])?;
    std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
        if let Some(signal) = signals.forever().next() {
            // It may have got its name in between, and then nothing has to be done.
            let _ = std::fs::remove_file(&path).or_else(|_| std::fs::remove_dir_all(&path));
            let _ = emulate_default_handler(signal);
        }
    })?;
    Ok(())
}

/// Elsewhere it stays.
#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "as on unix")]
pub(crate) fn removes(_: PathBuf) -> io::Result<()> {
    Ok(())
}
