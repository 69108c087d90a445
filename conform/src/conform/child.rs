//! A child process that is gone when it is dropped, with all that it started.

use std::ffi::OsString;
use std::io;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, Stdio};

#[cfg(unix)]
use super::marked::{kill_marked, ours};

/// The groups of the processes that run at present.
#[cfg(unix)]
type Groups = Vec<rustix::process::Pid>;

#[cfg(unix)]
static RUNNING: std::sync::Mutex<Groups> = std::sync::Mutex::new(Groups::new());

#[cfg(unix)]
fn running() -> std::sync::MutexGuard<'static, Groups> {
    RUNNING.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// While this is kept, no program under test starts, and a thread that had one waits before it goes on without.
#[cfg(unix)]
#[derive(Debug)]
pub struct Stopped {
    _running: std::sync::MutexGuard<'static, Groups>,
}

/// Kills every program under test that runs at present, with all that it started and that has stayed in its group; of a
/// [`RunningProgram`](super::RunningProgram), also what has left it.
///
/// For a command that has to stop at once: a program has a group of its own, so that a terminal's Ctrl-C does not reach it. Keep what it
/// returns until this process ends; else another thread may take the end of its program for a mistake of the program, and say so.
#[cfg(unix)]
#[must_use]
pub fn stop_programs() -> Stopped {
    let running = running();
    for &group in running.iter() {
        // What cannot be killed is gone already.
        let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
    }
    kill_marked(&ours(), true);
    Stopped { _running: running }
}

/// The process, and its pipes until they are taken.
#[derive(Debug)]
pub(super) struct Process(Child);

/// The three pipes of a process.
pub(super) type Pipes = (ChildStdin, ChildStdout, ChildStderr);

impl Process {
    /// Starts a program, in a group of its own where there are such.
    pub(super) fn start(program: &OsString, args: &[OsString]) -> io::Result<(Self, Pipes)> {
        let mut command = Command::new(program);
        command.args(args);
        Self::spawn(command)
    }

    /// The same of a command, whatever is to be different about it.
    pub(super) fn spawn(mut command: Command) -> io::Result<(Self, Pipes)> {
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        // A stop of all programs stops this one as well, or before it starts.
        #[cfg(unix)]
        let mut running = running();
        let mut child = command.spawn()?;
        #[cfg(unix)]
        {
            running.push(rustix::process::Pid::from_child(&child));
            drop(running);
        }
        let pipes = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let process = Self(child);
        match pipes {
            (Some(stdin), Some(stdout), Some(stderr)) => Ok((process, (stdin, stdout, stderr))),
            _ => Err(io::ErrorKind::BrokenPipe.into()),
        }
    }

    /// Asks it, and all of its group, to end.
    pub(super) fn ask_to_end(&self) {
        #[cfg(unix)]
        {
            use rustix::process::{Pid, Signal, kill_process_group};
            // What cannot be asked is gone already.
            let _ = kill_process_group(Pid::from_child(&self.0), Signal::TERM);
        }
    }

    /// Kills it, and all of its group.
    pub(super) fn kill_group(&self) {
        #[cfg(unix)]
        {
            use rustix::process::{Pid, Signal, kill_process_group};
            // What cannot be killed is gone already.
            let _ = kill_process_group(Pid::from_child(&self.0), Signal::KILL);
        }
    }

    /// How it ended, such as `exit status 3`; `None` while it runs.
    pub(super) fn ended(&mut self) -> Option<Ended> {
        // It is not waited for: as long as it is not, no other process gets its number, or that of its group.
        #[cfg(unix)]
        {
            use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
            let options = WaitIdOptions::EXITED.union(WaitIdOptions::NOHANG).union(WaitIdOptions::NOWAIT);
            let status = waitid(WaitId::Pid(Pid::from_child(&self.0)), options).ok().flatten()?;
            Some(match (status.exit_status(), status.terminating_signal()) {
                (Some(0), _) => Ended { well: true, how: "exit status 0".to_owned() },
                (Some(code), _) => Ended { well: false, how: format!("exit status {code}") },
                (None, Some(signal)) => Ended { well: false, how: format!("signal {signal}") },
                (None, None) => Ended { well: false, how: "for no reason that is known".to_owned() },
            })
        }
        #[cfg(not(unix))]
        {
            let status = self.0.try_wait().ok().flatten()?;
            Some(Ended { well: status.success(), how: status.to_string() })
        }
    }
}

/// How a process ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Ended {
    /// Without an error.
    pub(super) well: bool,
    /// In words.
    pub(super) how: String,
}

impl Drop for Process {
    fn drop(&mut self) {
        self.kill_group();
        #[cfg(unix)]
        {
            let group = rustix::process::Pid::from_child(&self.0);
            // Before it is waited for: after that its number may be another's.
            running().retain(|&other| other != group);
        }
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    use rustix::process::Pid;

    use super::*;

    /// The only test in this process that starts any: it stops all there are.
    #[test]
    fn programs_are_known_until_they_are_gone_and_can_be_stopped() {
        let start = || Process::start(&"sleep".into(), &["600".into()]).expect("it starts").0;
        let known = |group: Pid| RUNNING.lock().expect("nobody has panicked").contains(&group);
        let (mut stays, goes) = (start(), start());
        let (stayed, gone) = (Pid::from_child(&stays.0), Pid::from_child(&goes.0));
        assert!(known(stayed) && known(gone));
        drop(goes);
        assert!(known(stayed) && !known(gone));
        assert_eq!(stays.ended(), None);
        let stopped = stop_programs();
        let begun = Instant::now();
        while stays.ended().is_none() && begun.elapsed() < Duration::from_secs(20) {
            sleep(Duration::from_millis(1));
        }
        assert_eq!(stays.ended(), Some(Ended { well: false, how: "signal 9".to_owned() }));
        // What another thread would do next has to wait.
        let waits = std::thread::spawn(move || drop(stays));
        sleep(Duration::from_millis(50));
        assert!(!waits.is_finished());
        drop(stopped);
        waits.join().expect("it goes on");
    }
}
