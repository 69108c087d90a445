//! A program that runs beside this one and is asked nothing: what it has to say it says elsewhere, such as on a bus.

use std::ffi::OsString;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::child::{Ended, Pipes, Process};
use super::marked::{MARK, kill_marked, mark};
use super::program_error::ProgramErrorKind;
use super::stderr::LastWords;

/// Between two looks at whether it has ended.
const PACE: Duration = Duration::from_millis(2);

/// A child process. It is killed when it is dropped, with everything that it started, be that in its group or not.
///
/// ```
/// # #[cfg(target_os = "linux")] {
/// use adsdv_conform::RunningProgram;
///
/// let mut program = RunningProgram::start(&"sh".into(), &["-c".into(), "echo no >&2; exit 3".into()])?;
/// while program.ended().is_none() {}
/// assert_eq!(program.ended().as_deref(), Some("exit status 3"));
/// assert_eq!(program.last_words(), ["no"]);
/// # }
/// # Ok::<(), adsdv_conform::ProgramErrorKind>(())
/// ```
#[derive(Debug)]
pub struct RunningProgram {
    process: Process,
    /// Its input stays open as long as it runs: some end with it.
    _stdin: std::process::ChildStdin,
    stderr: LastWords,
    /// It is read as well, so that the program never has to wait.
    _stdout: LastWords,
    mark: String,
}

impl RunningProgram {
    /// Starts a program in a group of its own.
    ///
    /// # Errors
    ///
    /// [`ProgramErrorKind::NoStart`] if the system cannot start it.
    pub fn start(program: &OsString, args: &[OsString]) -> Result<Self, ProgramErrorKind> {
        let mark = mark();
        let mut command = Command::new(program);
        command.args(args).env(MARK, &mark);
        let (process, (stdin, stdout, stderr)): (Process, Pipes) =
            Process::spawn(command).map_err(ProgramErrorKind::NoStart)?;
        let (stderr, stdout) = (LastWords::of(stderr), LastWords::of(stdout));
        Ok(Self { process, _stdin: stdin, stderr, _stdout: stdout, mark })
    }

    /// How it ended, such as `exit status 3`; `None` while it runs.
    pub fn ended(&mut self) -> Option<String> {
        self.process.ended().map(|Ended { how, .. }| how)
    }

    /// The last lines of its standard error.
    pub fn last_words(&self) -> Vec<String> {
        self.stderr.lines()
    }

    /// Asks it to end, and gives it so much time for that before it is killed.
    pub fn end(mut self, patience: Duration) {
        self.process.ask_to_end();
        let begun = Instant::now();
        while self.process.ended().is_none() && begun.elapsed() < patience {
            sleep(PACE);
        }
    }
}

impl Drop for RunningProgram {
    fn drop(&mut self) {
        // The group first, whose leader the drop of the process waits for behind this.
        self.process.kill_group();
        kill_marked(&self.mark, false);
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::fs;

    use super::*;

    fn shell(script: &str) -> RunningProgram {
        RunningProgram::start(&"sh".into(), &["-c".into(), script.into()]).expect("it starts")
    }

    fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
        let begun = Instant::now();
        while !holds() {
            assert!(begun.elapsed() < Duration::from_secs(20), "{what}");
            sleep(PACE);
        }
    }

    #[test]
    fn what_has_left_the_group_is_gone_as_well() {
        let file = std::env::temp_dir().join(format!("adsdv-running-{}", std::process::id()));
        // setsid is of util-linux, as is the shell's own job control elsewhere.
        let program = shell(&format!("setsid sh -c 'echo $$ > {}; exec sleep 600' & wait", file.display()));
        let daemon = || fs::read_to_string(&file).ok()?.trim().parse::<u32>().ok();
        wait_until("the daemon says its number", || daemon().is_some());
        let number = daemon().expect("it has just been there");
        assert!(fs::metadata(format!("/proc/{number}")).is_ok());
        drop(program);
        let runs = || {
            let status = fs::read_to_string(format!("/proc/{number}/stat")).unwrap_or_default();
            !status.is_empty() && !status.contains(") Z ")
        };
        wait_until("the daemon is gone", || !runs());
        let _ = fs::remove_file(file);
    }

    /// While a program becomes another its environment cannot be read.
    #[test]
    fn what_has_left_the_group_and_becomes_another_all_the_time_is_gone_as_well() {
        let name = format!("adsdv-running-{}-again", std::process::id());
        let file = std::env::temp_dir().join(&name);
        fs::write(&file, "exec sh \"$0\"\n").expect("it can be written");
        let runs = || {
            let folders = fs::read_dir("/proc").expect("Linux has it").flatten();
            let lines = folders.filter_map(|folder| fs::read(folder.path().join("cmdline")).ok());
            lines
                .filter(|line| line.split(|byte| *byte == 0).any(|word| word.ends_with(name.as_bytes())))
                .count()
        };
        for _ in 0..100 {
            let program = shell(&format!("setsid sh {} & wait", file.display()));
            wait_until("it runs", || runs() > 0);
            drop(program);
            // Many looks: it may be seen by none of a few.
            for _ in 0..10 {
                assert_eq!(runs(), 0);
                sleep(PACE);
            }
        }
        let _ = fs::remove_file(file);
    }

    #[test]
    fn one_that_does_not_end_when_it_is_asked_is_killed() {
        let program = shell("trap '' TERM; while :; do sleep 0.05; done");
        let begun = Instant::now();
        program.end(Duration::from_millis(50));
        assert!(begun.elapsed() < Duration::from_secs(20));
    }
}
