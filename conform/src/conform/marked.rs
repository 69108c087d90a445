//! Processes that are known by a variable of their environment, which every process passes on to those that it starts.
//!
//! A program that makes itself a daemon leaves its group, so that killing the group does not end it; the variable goes with it.
//! Linux shows it in `/proc`; elsewhere nothing is found.

#[cfg(target_os = "linux")]
use std::time::{Duration, Instant};

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

/// Kills every process whose mark is this one, or begins so where all is true, and waits until they are gone.
#[cfg(target_os = "linux")]
pub(super) fn kill_marked(mark: &str, all: bool) {
    /// One that forks all the time may have left another behind while it was looked for; on a machine that is busy it takes its time
    /// to become another program, or to die of a signal that it has. What is still there then cannot be killed.
    const PATIENCE: Duration = Duration::from_secs(2);
    /// Between two looks where the last found nothing that is new.
    const PACE: Duration = Duration::from_millis(2);
    let wanted = format!("{MARK}={mark}");
    let (begun, mut killed) = (Instant::now(), Vec::new());
    while begun.elapsed() < PATIENCE {
        let Marked { found, unsure } = marked(&wanted, all);
        if found.is_empty() && !unsure {
            break;
        }
        // Again what has the signal already: its number may be another's by now, which has the mark as well.
        for &process in &found {
            // What cannot be killed is gone already.
            let _ = rustix::process::kill_process(process, rustix::process::Signal::KILL);
        }
        if found.iter().all(|process| killed.contains(process)) {
            std::thread::sleep(PACE);
        }
        killed = found;
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
        marked.unsure |= environment.is_empty() && may_have_one(number);
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

/// Whether a process that shows no environment may have one all the same.
#[cfg(target_os = "linux")]
fn may_have_one(number: i32) -> bool {
    // One that has ended, and nobody has asked how, has no environment any more, and no program; nor has a thread of the kernel.
    let runs = std::fs::read_link(format!("/proc/{number}/exe")).is_ok();
    runs && !was_given_none(number)
}

/// Whether a process was started without any environment, by `env -i` for one: the place of it is known then, and has no length.
#[cfg(target_os = "linux")]
fn was_given_none(number: i32) -> bool {
    let Ok(line) = std::fs::read_to_string(format!("/proc/{number}/stat")) else { return false };
    // The second field is the program's name, in brackets, and may have spaces and brackets of its own.
    let Some((_, fields)) = line.rsplit_once(") ") else { return false };
    let mut fields = fields.split_ascii_whitespace().skip(26 - 3);
    // The fields 26, 50 and 51. While a program begins its environment has a place, but no length until all of it is there; only then is
    // it known where its code begins.
    let (code, start, end) = (fields.next(), fields.nth(50 - 27), fields.next());
    let has_begun = code.is_some_and(|code| code != "0");
    has_begun && start.is_some() && start == end && start != Some("0")
}

#[cfg(not(target_os = "linux"))]
pub(super) fn kill_marked(_: &str, _: bool) {}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::process::{Child, Command};

    use super::*;

    /// `sleep`, until it is dropped.
    struct Sleeper(Child);

    impl Sleeper {
        fn start(command: &mut Command) -> Self {
            Self(command.arg("600").spawn().expect("it starts"))
        }

        fn number(&self) -> i32 {
            i32::try_from(self.0.id()).expect("Linux has no larger ones")
        }

        fn is_asleep(&self) -> bool {
            std::fs::read(format!("/proc/{}/cmdline", self.number()))
                .is_ok_and(|line| line == b"sleep\x00600\x00")
        }
    }

    impl Drop for Sleeper {
        fn drop(&mut self) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }

    #[test]
    fn one_that_was_given_no_environment_is_not_waited_for() {
        let bare = Sleeper::start(Command::new("sleep").env_clear());
        let clothed = Sleeper::start(&mut Command::new("sleep"));
        let begun = Instant::now();
        // The place of the environment is known a moment after the arguments.
        while !bare.is_asleep() || !clothed.is_asleep() || !was_given_none(bare.number()) {
            assert!(begun.elapsed() < Duration::from_secs(20), "they start, and one has no environment");
            std::thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(environment(bare.number(), &mut vec![0; LONGEST]), Some(&[][..]));
        assert!(!may_have_one(bare.number()) && !was_given_none(clothed.number()));
        let ended = bare.number();
        drop(bare);
        assert!(!may_have_one(ended), "it has ended");
    }
}
