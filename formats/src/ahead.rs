//! Reads ahead in a thread of its own, so that a log is unpacked while it is judged.

use std::io::{self, Read};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use crate::Source;
use crate::watch::Watch;

/// How much is handed over at once.
const PIECE: usize = 256 * 1024;
/// How many pieces may wait to be taken.
const PIECES: usize = 4;
/// So long nothing comes before the watch is asked.
const PATIENCE: Duration = Duration::from_millis(100);

/// The same source, read ahead; itself, where there are no threads. While nothing comes the watch is asked whether to wait.
pub(crate) fn ahead(source: Source, watch: Option<&Watch>) -> Source {
    if cfg!(target_family = "wasm") {
        return source;
    }
    let (tell, pieces) = sync_channel(PIECES);
    let (give, take) = sync_channel(1);
    let spawned = thread::Builder::new().name("unpack".to_owned()).spawn(move || {
        if let Ok(source) = take.recv() {
            read(source, &tell);
        }
    });
    match spawned {
        // It waits for the source: sending does not fail.
        Ok(_) => match give.send(source) {
            Ok(()) => {
                let watch = watch.cloned();
                Box::new(Ahead { pieces, piece: Vec::new(), at: 0, failed: false, watch })
            }
            Err(back) => back.0,
        },
        Err(_) => source,
    }
}

/// Reads until the source ends, fails, or nobody takes any more.
fn read(mut source: Source, tell: &SyncSender<io::Result<Vec<u8>>>) {
    loop {
        let mut piece = Vec::with_capacity(PIECE);
        let read = source.by_ref().take(PIECE as u64).read_to_end(&mut piece);
        let end = piece.is_empty();
        // What came before a failure is of the log.
        if !end && tell.send(Ok(piece)).is_err() {
            return;
        }
        match read {
            Err(error) => {
                let _ = tell.send(Err(error));
                return;
            }
            Ok(_) if end => return,
            Ok(_) => {}
        }
    }
}

struct Ahead {
    pieces: Receiver<io::Result<Vec<u8>>>,
    piece: Vec<u8>,
    at: usize,
    /// The source has failed, and is asked no more.
    failed: bool,
    watch: Option<Watch>,
}

impl Ahead {
    /// The next piece; `None` at the end.
    fn next(&self) -> io::Result<Option<Vec<u8>>> {
        let Some(watch) = &self.watch else { return self.pieces.recv().ok().transpose() };
        loop {
            match self.pieces.recv_timeout(PATIENCE) {
                Ok(piece) => return piece.map(Some),
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) => watch()?,
            }
        }
    }
}

impl Read for Ahead {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        while self.at == self.piece.len() && !self.failed {
            match self.next() {
                Ok(Some(piece)) => (self.piece, self.at) = (piece, 0),
                Ok(None) => return Ok(0),
                Err(error) => {
                    self.failed = true;
                    return Err(error);
                }
            }
        }
        let len = self.piece.get(self.at..).unwrap_or_default().read(room)?;
        self.at += len;
        Ok(len)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Fails;

    impl Read for Fails {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::ErrorKind::TimedOut.into())
        }
    }

    #[test]
    fn all_of_a_source_is_read_in_order_and_its_failure_after_it() {
        let bytes: Vec<u8> = (0..251).cycle().take(3_000_000).collect();
        let mut all = Vec::new();
        ahead(Box::new(io::Cursor::new(bytes.clone())), None)
            .read_to_end(&mut all)
            .expect("it does not fail");
        assert_eq!(all, bytes);

        let mut all = Vec::new();
        let mut source = ahead(Box::new(io::Cursor::new(bytes.clone()).chain(Fails)), None);
        assert_eq!(source.read_to_end(&mut all).map_err(|error| error.kind()), Err(io::ErrorKind::TimedOut));
        assert_eq!(all, bytes);
        assert_eq!(source.read(&mut [0; 1]).ok(), Some(0), "after its failure there is no more");
    }

    #[test]
    fn a_source_that_nobody_reads_any_more_is_let_go() {
        let endless = ahead(Box::new(io::repeat(7)), None);
        drop(endless);
    }
}
