//! The input of a program: written without anybody waiting until it is read.

use std::io::Write as _;
use std::process::ChildStdin;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;

/// A pipe to a program. What it has no room for at present waits, in a thread; what it has room for is written at once, which spares
/// two changes of threads for each line of a program that is asked one thing after the other.
#[derive(Debug)]
pub(super) struct Questions {
    pipe: Arc<ChildStdin>,
    /// To the thread that writes.
    waiting: Sender<Vec<u8>>,
    /// How many writes it has not finished.
    unwritten: Arc<AtomicUsize>,
}

impl Questions {
    pub(super) fn of(pipe: ChildStdin) -> Self {
        let (waiting, to_write) = channel::<Vec<u8>>();
        let (pipe, unwritten) = (Arc::new(pipe), Arc::new(AtomicUsize::new(0)));
        let (own, left) = (pipe.clone(), unwritten.clone());
        // It ends with the questions, or with the program, which nobody writes to any more: then some stay unwritten.
        thread::spawn(move || {
            to_write.iter().try_for_each(|lines| {
                (&*own).write_all(&lines)?;
                left.fetch_sub(1, Ordering::Release);
                std::io::Result::Ok(())
            })
        });
        Self { pipe, waiting, unwritten }
    }

    /// Writes lines, behind all that were written before.
    pub(super) fn write(&self, lines: Vec<u8>) {
        // That the program has ended shows where its answer is missing.
        if self.unwritten.load(Ordering::Acquire) == 0 && has_room(&self.pipe, lines.len()) {
            let _ = (&*self.pipe).write_all(&lines);
        } else {
            self.unwritten.fetch_add(1, Ordering::Relaxed);
            let _ = self.waiting.send(lines);
        }
    }
}

/// Whether so many bytes can be written to a pipe without waiting. Where there is room at all, there is for a write that is never torn.
#[cfg(unix)]
fn has_room(pipe: &ChildStdin, bytes: usize) -> bool {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    let mut pipes = [PollFd::new(pipe, PollFlags::OUT)];
    bytes <= rustix::pipe::PIPE_BUF
        && poll(&mut pipes, Some(&Timespec::default())) == Ok(1)
        && pipes.iter().all(|pipe| pipe.revents() == PollFlags::OUT)
}

/// It is not known.
#[cfg(not(unix))]
const fn has_room(_: &ChildStdin, _: usize) -> bool {
    false
}

#[cfg(all(test, unix))]
mod tests {
    use std::io::{BufRead as _, BufReader, Read as _};
    use std::process::{Command, Stdio};

    use rustix::process::{Pid, Signal, kill_process};

    use super::*;

    fn started(program: &str, args: &[&str]) -> std::process::Child {
        let mut command = Command::new(program);
        command.args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("it starts")
    }

    #[test]
    fn lines_come_in_order_whether_there_is_room_for_them_or_not() {
        let mut child = started("cat", &[]);
        let signal = |child: &std::process::Child, signal| {
            kill_process(Pid::from_child(child), signal).expect("it is ours");
        };
        let questions = Questions::of(child.stdin.take().expect("a pipe"));
        let line = |number: usize| format!("{number} {}\n", "x".repeat(1 + number));
        let (stops, goes_on, count) = (5, 600, 1200);
        for number in 0..count {
            // It reads nothing meanwhile, and a pipe is full of less than all that is written.
            if number == stops {
                signal(&child, Signal::STOP);
            }
            // What waits now is not overtaken by what there is room for again.
            if number == goes_on {
                assert!(questions.unwritten.load(Ordering::Acquire) > 0);
                signal(&child, Signal::CONT);
            }
            questions.write(line(number).into_bytes());
        }
        drop(questions);
        let mut lines = BufReader::new(child.stdout.take().expect("a pipe")).lines();
        for number in 0..count {
            let read = lines.next().expect("as many lines").expect("text");
            assert_eq!(read, line(number).trim_end());
        }
        assert!(lines.next().is_none() && child.wait().expect("it ends").success());
    }

    #[test]
    fn what_there_is_room_for_is_written_at_once_and_no_more() {
        let mut child = started("sleep", &["600"]);
        let questions = Questions::of(child.stdin.take().expect("a pipe"));
        let mut at_once = 0;
        while at_once < 1000 && has_room(&questions.pipe, rustix::pipe::PIPE_BUF) {
            questions.write(vec![b'x'; rustix::pipe::PIPE_BUF]);
            at_once += 1;
            assert_eq!(questions.unwritten.load(Ordering::Acquire), 0);
        }
        assert!((1..1000).contains(&at_once), "a pipe is full some day: {at_once}");
        questions.write(b"y".to_vec());
        assert_eq!(questions.unwritten.load(Ordering::Acquire), 1);
        child.kill().expect("it is ours");
        child.wait().expect("it ends");
        assert!(!has_room(&questions.pipe, 1), "nobody reads it any more");
        let mut rest = Vec::new();
        assert_eq!(child.stdout.take().expect("a pipe").read_to_end(&mut rest).expect("it has ended"), 0);
    }
}
