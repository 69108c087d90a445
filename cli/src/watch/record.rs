//! The log that is recorded while the bus is judged.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use adsdv_oracle::candump::{Dropped, Record, write_dropped, write_record};

use crate::error::Error;

/// What is recorded is in the file at the latest after this time, so that it can be followed, and little is lost with the power.
const FLUSH: Duration = Duration::from_millis(200);

/// Writes a log of `candump -L`.
///
/// When it cannot write any more (a full disk) it says so, once, and what comes is judged all the same; the command then ends
/// with the status of trouble.
pub(super) struct Recorder<W: Write = File> {
    path: PathBuf,
    out: BufWriter<W>,
    flushed: Instant,
    failed: Option<io::Error>,
}

impl Recorder {
    /// Makes the file. One that is there already is written anew, as candump does.
    pub(super) fn create(path: &Path) -> Result<Self, Error> {
        let file = File::create(path).map_err(|error| Error::record(path, &error))?;
        Ok(Self::new(path, file))
    }
}

impl<W: Write> Recorder<W> {
    fn new(path: &Path, out: W) -> Self {
        let out = BufWriter::with_capacity(1 << 16, out);
        Self { path: path.to_owned(), out, flushed: Instant::now(), failed: None }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a frame.
    pub(super) fn frame(&mut self, frame: &Record<'_>) {
        if self.failed.is_none()
            && let Err(error) = write_record(&mut self.out, frame)
        {
            self.fail(error);
        }
    }

    /// Writes that frames were lost before the next one, so that a judge of the log blames nobody for it.
    pub(super) fn dropped(&mut self, dropped: &Dropped<'_>) {
        if self.failed.is_none()
            && let Err(error) = write_dropped(&mut self.out, dropped)
        {
            self.fail(error);
        }
    }

    /// Has what was written reach the file, if it has waited for long.
    pub(super) fn flush_now_and_then(&mut self) {
        if self.failed.is_none() && self.flushed.elapsed() >= FLUSH {
            self.flushed = Instant::now();
            if let Err(error) = self.out.flush() {
                self.fail(error);
            }
        }
    }

    /// Has everything reach the file. Fails if anything did not.
    pub(super) fn finish(mut self) -> Result<(), Error> {
        if self.failed.is_none()
            && let Err(error) = self.out.flush()
        {
            self.failed = Some(error);
        }
        self.failed.as_ref().map_or(Ok(()), |error| Err(Error::record(&self.path, error)))
    }

    fn fail(&mut self, error: io::Error) {
        // The end of the command tells it again; now it can still be mended.
        Error::record(&self.path, &error).print();
        self.failed = Some(error);
    }
}

#[cfg(test)]
mod tests {
    use adsdv_oracle::candump::FrameKind;

    use super::*;

    /// A disk with so much room.
    struct Disk(usize, Vec<u8>);

    impl Write for &mut Disk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if bytes.len() > self.0 {
                return Err(io::ErrorKind::StorageFull.into());
            }
            self.0 -= bytes.len();
            self.1.extend(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    const FRAME: Record<'_> = Record {
        line: 0,
        time_ns: 1_000_000_000,
        interface: "can0",
        kind: FrameKind::Remote { extended: false, len: 3 },
        id: 0x123,
        data: &[],
        direction: None,
        terminated: true,
    };
    const LINE: &str = "(0000000001.000000) can0 123#R3\n";

    #[test]
    fn what_was_recorded_is_in_the_file_at_the_end() {
        let mut disk = Disk(1000, Vec::new());
        let mut recorder = Recorder::new(Path::new("run.log"), &mut disk);
        (0..3).for_each(|_| recorder.frame(&FRAME));
        assert!(recorder.finish().is_ok());
        assert_eq!(String::from_utf8_lossy(&disk.1), LINE.repeat(3));
    }

    #[test]
    fn what_was_recorded_is_in_the_file_soon() {
        let mut disk = Disk(1000, Vec::new());
        let mut recorder = Recorder::new(Path::new("run.log"), &mut disk);
        recorder.frame(&FRAME);
        recorder.flush_now_and_then();
        assert!(recorder.out.get_ref().1.is_empty());
        recorder.flushed -= FLUSH;
        recorder.flush_now_and_then();
        assert_eq!(String::from_utf8_lossy(&recorder.out.get_ref().1), LINE);
    }

    #[test]
    fn a_full_disk_ends_the_log_and_not_the_watching() {
        let mut disk = Disk(100_000, Vec::new());
        let mut recorder = Recorder::new(Path::new("run.log"), &mut disk);
        (0..10_000).for_each(|_| recorder.frame(&FRAME));
        let error = recorder.finish().expect_err("the disk is full").to_string();
        assert!(
            error.starts_with("run.log: cannot record the log: ") && error.contains("hint: free"),
            "{error}"
        );
        assert!(disk.1.len() > 60_000, "what there was room for is there");
    }
}
