//! Processes that are known by a variable of their environment, which every process passes on to those that it starts.
//!
//! A program that makes itself a daemon leaves its group, so that killing the group does not end it; the variable goes with it.
//! Linux shows it in `/proc`; elsewhere nothing is found.

/// The variable.
pub(super) const MARK: &str = "ADSDV_PROGRAM";

/// What the variable is set to for a program: this process, and a number that no other of its programs has.
pub(super) fn mark() -> String {
    use std::sync::atomic::{AtomicU32, Ordering};
    static COUNT: AtomicU32 = AtomicU32::new(0);
    format!("{}{}", ours(), COUNT.fetch_add(1, Ordering::Relaxed))
}

/// How the marks of all programs of this process begin.
pub(super) fn ours() -> String {
    format!("{}.", std::process::id())
}

/// Kills every process whose mark is this one, or begins so where all is true.
#[cfg(target_os = "linux")]
pub(super) fn kill_marked(mark: &str, all: bool) {
    /// One that forks all the time may have left another behind while it was looked for.
    const ROUNDS: usize = 20;
    let wanted = format!("{MARK}={mark}");
    for _ in 0..ROUNDS {
        let found = marked(&wanted, all);
        if found.is_empty() {
            break;
        }
        for process in found {
            // What cannot be killed is gone already.
            let _ = rustix::process::kill_process(process, rustix::process::Signal::KILL);
        }
    }
}

/// The others of this user that run and have such a variable.
#[cfg(target_os = "linux")]
fn marked(wanted: &str, all: bool) -> Vec<rustix::process::Pid> {
    let has = |variable: &[u8]| {
        if all { variable.starts_with(wanted.as_bytes()) } else { variable == wanted.as_bytes() }
    };
    let folders = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = folders.filter_map(|folder| folder.file_name().to_str()?.parse::<i32>().ok());
    let others = numbers.filter(|number| number.unsigned_abs() != std::process::id());
    // One that has ended, and nobody has asked how, has no environment any more.
    let is_marked = |number: &i32| {
        std::fs::read(format!("/proc/{number}/environ"))
            .is_ok_and(|environment| environment.split(|byte| *byte == 0).any(has))
    };
    others.filter(is_marked).filter_map(rustix::process::Pid::from_raw).collect()
}

#[cfg(not(target_os = "linux"))]
pub(super) fn kill_marked(_: &str, _: bool) {}
