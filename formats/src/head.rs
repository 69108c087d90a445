//! The beginning of a source, looked at before anything is read.

use std::io::{self, Cursor, Read};

use crate::Source;

/// So much is looked at, at most.
const MOST: usize = 4096;

/// The beginning of a source, and all of it: at most [`MOST`] bytes, or up to the end of the first line that is not blank, so that a pipe
/// is not waited for longer than it takes to send that.
///
/// A source that fails in the middle of its beginning fails again when that is read.
pub(crate) fn look(mut source: Source) -> io::Result<(Vec<u8>, Source)> {
    let mut head = vec![0; MOST];
    let mut len = 0;
    while !is_enough(head.get(..len).unwrap_or_default()) {
        match source.read(head.get_mut(len..).unwrap_or_default()) {
            Ok(0) => break,
            Ok(more) => len = MOST.min(len + more),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) if len == 0 => return Err(error),
            Err(error) => {
                head.truncate(len);
                return Ok((head.clone(), Box::new(Cursor::new(head).chain(Failing(Some(error))))));
            }
        }
    }
    head.truncate(len);
    Ok((head.clone(), Box::new(Cursor::new(head).chain(source))))
}

fn is_enough(head: &[u8]) -> bool {
    head.len() >= MOST
        || head
            .iter()
            .position(|byte| !byte.is_ascii_whitespace())
            .is_some_and(|begin| head.iter().skip(begin).any(|&byte| byte == b'\n'))
}

/// A source that fails once more.
struct Failing(Option<io::Error>);

impl Read for Failing {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        self.0.take().map_or(Ok(0), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A source that gives these pieces and then fails.
    struct Pieces(Vec<&'static [u8]>);

    impl Read for Pieces {
        fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
            if self.0.is_empty() {
                return Err(io::ErrorKind::TimedOut.into());
            }
            self.0.remove(0).read(room)
        }
    }

    #[test]
    fn a_pipe_is_not_waited_for_behind_its_first_line() {
        let (head, mut all) = look(Box::new(Pieces(vec![b"\n \n(1.0) can0", b" 520#\n"]))).expect("a line");
        assert_eq!(head, b"\n \n(1.0) can0 520#\n");
        let mut text = String::new();
        assert_eq!(all.read_to_string(&mut text).map_err(|error| error.kind()), Err(io::ErrorKind::TimedOut));
        assert_eq!(text, "\n \n(1.0) can0 520#\n");
    }

    #[test]
    fn what_came_before_a_failure_is_read() {
        let (head, mut all) = look(Box::new(Pieces(vec![b"MDF"]))).expect("three bytes");
        assert_eq!(head, b"MDF");
        let mut room = [0; 8];
        assert_eq!(all.read(&mut room).ok(), Some(3));
        assert!(all.read(&mut room).is_err(), "it fails where it failed");
        assert!(look(Box::new(Pieces(Vec::new()))).is_err());
    }

    #[test]
    fn a_long_line_is_looked_at_up_to_a_limit() {
        let (head, mut all) = look(Box::new(io::repeat(b'x').take(10_000))).expect("it is long");
        assert_eq!(head.len(), MOST);
        assert_eq!(io::copy(&mut all, &mut io::sink()).ok(), Some(10_000));
    }
}
