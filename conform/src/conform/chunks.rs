//! What a program writes, as it comes, with a limit to how long a reader waits for more.
//!
//! Where the system can say that a pipe has something, the one that waits reads it: a thread in between would cost two changes of threads for
//! each answer of a program that is asked one thing after the other. Elsewhere a thread reads.

use std::time::Duration;

/// What is read at once.
const CHUNK: usize = 1 << 16;

/// What came of waiting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Waited {
    /// Some bytes, or nothing yet: there is time left.
    Look,
    /// Nothing, in all the time.
    Nothing,
    /// There will be no more.
    End,
}

#[cfg(unix)]
pub(super) use polled::Polled as Chunks;
#[cfg(not(unix))]
pub(super) use threaded::Threaded as Chunks;

#[cfg(unix)]
mod polled {
    use std::fs::File;
    use std::io::{ErrorKind, Read as _};
    use std::os::fd::OwnedFd;

    use rustix::event::{PollFd, PollFlags, Timespec, poll};

    use super::{CHUNK, Duration, Waited};

    /// A pipe that is read when there is something in it.
    #[derive(Debug)]
    pub(in super::super) struct Polled {
        pipe: File,
        buffer: Box<[u8]>,
    }

    impl Polled {
        /// Of the output of a program.
        pub(in super::super) fn of(pipe: impl Into<OwnedFd>) -> Self {
            Self { pipe: pipe.into().into(), buffer: vec![0; CHUNK].into_boxed_slice() }
        }

        /// Waits no longer than this for more.
        pub(in super::super) fn wait(&mut self, limit: Duration, came: impl FnOnce(&[u8])) -> Waited {
            let limit = Timespec::try_from(limit).ok();
            match poll(&mut [PollFd::new(&self.pipe, PollFlags::IN)], limit.as_ref()) {
                Ok(0) => return Waited::Nothing,
                Ok(_) => {}
                Err(rustix::io::Errno::INTR) => return Waited::Look,
                // A pipe that cannot be waited for is not read, which might take for ever.
                Err(_) => return Waited::End,
            }
            match self.pipe.read(&mut self.buffer) {
                Ok(0) => Waited::End,
                Ok(len) => {
                    came(self.buffer.get(..len).unwrap_or_default());
                    Waited::Look
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => Waited::Look,
                // A pipe that cannot be read any more has ended.
                Err(_) => Waited::End,
            }
        }
    }
}

#[cfg(any(test, not(unix)))]
mod threaded {
    use std::io::{ErrorKind, Read};
    use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
    use std::thread;

    use super::{CHUNK, Duration, Waited};

    /// So many chunks wait to be looked at, before the program has to wait.
    const WAITING: usize = 16;

    /// A pipe that a thread reads, which ends with the pipe, or when nobody wants what it brings any more.
    #[derive(Debug)]
    pub(in super::super) struct Threaded(Receiver<Vec<u8>>);

    impl Threaded {
        /// Of the output of a program.
        pub(in super::super) fn of(pipe: impl Read + Send + 'static) -> Self {
            let (sender, chunks) = sync_channel(WAITING);
            thread::spawn(move || read(pipe, &sender));
            Self(chunks)
        }

        /// Waits no longer than this for more.
        pub(in super::super) fn wait(&mut self, limit: Duration, came: impl FnOnce(&[u8])) -> Waited {
            match self.0.recv_timeout(limit) {
                Ok(chunk) => {
                    came(&chunk);
                    Waited::Look
                }
                Err(RecvTimeoutError::Disconnected) => Waited::End,
                Err(RecvTimeoutError::Timeout) => Waited::Nothing,
            }
        }
    }

    fn read(mut pipe: impl Read, chunks: &SyncSender<Vec<u8>>) {
        let mut buffer = vec![0; CHUNK];
        loop {
            match pipe.read(&mut buffer) {
                Ok(0) => break,
                Ok(len) => {
                    let chunk = buffer.get(..len).unwrap_or_default().to_vec();
                    if chunks.send(chunk).is_err() {
                        break;
                    }
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                // A pipe that cannot be read any more has ended.
                Err(_) => break,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::{self, Cursor, ErrorKind, Read};
    use std::thread;

    use super::threaded::Threaded;
    use super::*;

    const LONG: Duration = Duration::from_mins(1);

    /// All that comes, to its end.
    fn all(mut wait: impl FnMut(&mut Vec<u8>) -> Waited) -> Vec<u8> {
        let mut bytes = Vec::new();
        loop {
            match wait(&mut bytes) {
                Waited::Look => {}
                Waited::End => return bytes,
                Waited::Nothing => panic!("there is no end of it"),
            }
        }
    }

    /// A pipe that is interrupted before each byte, and fails in the end.
    struct Fitful(Vec<u8>, bool);

    impl Read for Fitful {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.1 = !self.1;
            if self.1 {
                return Err(ErrorKind::Interrupted.into());
            }
            match (self.0.pop(), buffer.first_mut()) {
                (Some(byte), Some(place)) => {
                    *place = byte;
                    Ok(1)
                }
                _ => Err(ErrorKind::BrokenPipe.into()),
            }
        }
    }

    #[test]
    fn a_thread_reads_a_pipe_to_its_end_and_through_interruptions() {
        let written: Vec<u8> = (0..200_000_u32).map(|number| number.to_le_bytes()[0]).collect();
        let fitful = Fitful(written.iter().rev().copied().collect(), false);
        for pipe in [Box::new(Cursor::new(written.clone())) as Box<dyn Read + Send>, Box::new(fitful)] {
            let mut chunks = Threaded::of(pipe);
            assert_eq!(all(|bytes| chunks.wait(LONG, |chunk| bytes.extend(chunk))), written);
        }
    }

    /// A pipe that stays open and silent.
    struct Silent;

    impl Read for Silent {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            loop {
                thread::park();
            }
        }
    }

    #[test]
    fn nobody_waits_for_ever_for_a_thread_that_reads_nothing() {
        let mut chunks = Threaded::of(Silent);
        assert_eq!(chunks.wait(Duration::from_millis(1), |_| panic!("it is silent")), Waited::Nothing);
    }

    #[cfg(unix)]
    #[test]
    fn what_is_polled_is_read_to_its_end_and_nobody_waits_for_ever() {
        use std::io::Write as _;
        let (reader, mut writer) = io::pipe().expect("a pipe");
        let mut chunks = Chunks::of(reader);
        assert_eq!(chunks.wait(Duration::from_millis(1), |_| panic!("it is silent")), Waited::Nothing);
        let written: Vec<u8> = (0..200_000_u32).map(|number| number.to_le_bytes()[0]).collect();
        let bytes = written.clone();
        let done = thread::spawn(move || writer.write_all(&bytes));
        assert_eq!(all(|bytes| chunks.wait(LONG, |chunk| bytes.extend(chunk))), written);
        done.join().expect("it ends").expect("all is read");
    }
}
