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
    /// To become another program takes less, but for a machine that is busy: then there are more rounds.
    const PACE: std::time::Duration = std::time::Duration::from_millis(2);
    let wanted = format!("{MARK}={mark}");
    for _ in 0..ROUNDS {
        let Marked { found, unsure } = marked(&wanted, all);
        if found.is_empty() && !unsure {
            break;
        }
        if found.is_empty() {
            std::thread::sleep(PACE);
        }
        for process in found {
            // What cannot be killed is gone already.
            let _ = rustix::process::kill_process(process, rustix::process::Signal::KILL);
        }
    }
}

/// The others of this user that run and have such a variable.
#[cfg(target_os = "linux")]
#[derive(Default)]
struct Marked {
    found: Vec<rustix::process::Pid>,
    /// Whether there is one that may have it: while it becomes another program its environment is empty for a moment.
    unsure: bool,
}

#[cfg(target_os = "linux")]
fn marked(wanted: &str, all: bool) -> Marked {
    let has = |variable: &[u8]| {
        if all { variable.starts_with(wanted.as_bytes()) } else { variable == wanted.as_bytes() }
    };
    let folders = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = folders.filter_map(|folder| folder.file_name().to_str()?.parse::<i32>().ok());
    let others = numbers.filter(|number| number.unsigned_abs() != std::process::id());
    let (mut marked, mut memory) = (Marked::default(), vec![0; LONGEST]);
    for number in others {
        let Some(environment) = environment(number, &mut memory) else { continue };
        if environment.split(|byte| *byte == 0).any(has) {
            marked.found.extend(rustix::process::Pid::from_raw(number));
        }
        // One that has ended, and nobody has asked how, has no environment any more, and no program; nor has a thread of the kernel.
        let runs = || std::fs::read_link(format!("/proc/{number}/exe")).is_ok();
        marked.unsure |= environment.is_empty() && runs();
    }
    marked
}

/// The longest environment that Linux gives a program, in bytes, with its arguments, where its stack is as large as usual.
#[cfg(target_os = "linux")]
const LONGEST: usize = 2 << 20;

/// The environment of a process, by a single read: between two it may become another program, and the second finds nothing more.
#[cfg(target_os = "linux")]
fn environment(number: i32, memory: &mut [u8]) -> Option<&[u8]> {
    use std::io::Read;
    let mut file = std::fs::File::open(format!("/proc/{number}/environ")).ok()?;
    let length = file.read(memory).ok()?;
    memory.get(..length)
}

#[cfg(not(target_os = "linux"))]
pub(super) fn kill_marked(_: &str, _: bool) {}
