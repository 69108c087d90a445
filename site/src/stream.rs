//! A stream as server-sent events: an event of some lines, with the number of the next as its id, so that a browser that connects again
//! says where it was.

use std::io::{self, Write};
use std::time::Duration;

use tiny_http::Request;

use crate::feed::{Feed, Lines, Reader};
use crate::headers::HEADERS;

/// Where it is.
pub(crate) const PATH: &str = "/live";
/// What comes within this time goes together.
const TOGETHER: Duration = Duration::from_millis(40);
/// So often something is written, so that a connection that is gone is noticed.
const PATIENCE: Duration = Duration::from_secs(1);

/// Writes all that comes, until it ends or nobody reads any more.
pub(crate) fn write(request: Request, reader: &Reader) -> io::Result<()> {
    let feed = &reader.feed;
    let mut line = last(&request, feed).unwrap_or(0);
    let mut out = request.into_writer();
    write!(out, "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nConnection: close\r\n")?;
    for (name, value) in HEADERS {
        write!(out, "{name}: {value}\r\n")?;
    }
    write!(out, "\r\nretry: 1000\n")?;
    begin(&mut out, feed)?;
    loop {
        let Lines { text, next, missed, end } = feed.after(line, PATIENCE);
        if missed > 0 {
            write!(out, "event: missed\ndata: {missed}\n\n")?;
        }
        if text.is_empty() {
            write!(out, ":\n\n")?;
        } else {
            writeln!(out, "id: {}.{next}", feed.run())?;
            text.lines().try_for_each(|line| writeln!(out, "data: {line}"))?;
            out.write_all(b"\n")?;
        }
        line = next;
        if let Some(why) = end {
            write!(out, "event: end\ndata: {}\n\n", one_line(&why))?;
            return out.flush();
        }
        out.flush()?;
        if !text.is_empty() && text.len() < TOGETHER_BYTES {
            std::thread::sleep(TOGETHER);
        }
    }
}

/// From so many bytes on there is more to read at once.
const TOGETHER_BYTES: usize = 32 << 10;

/// Says which stream it is, for a page that was connected to another.
fn begin(out: &mut impl Write, feed: &Feed) -> io::Result<()> {
    write!(out, "event: begin\ndata: {}\ndata: {}\n", feed.run(), one_line(feed.name()))?;
    feed.judged_by().iter().try_for_each(|line| writeln!(out, "data: {}", one_line(line)))?;
    out.write_all(b"\n")
}

fn one_line(text: &str) -> String {
    text.replace(['\r', '\n'], " ")
}

/// Where a browser was, if it was connected to this stream.
fn last(request: &Request, feed: &Feed) -> Option<u64> {
    let header = request.headers().iter().find(|header| header.field.equiv("Last-Event-ID"))?;
    let (run, line) = header.value.as_str().split_once('.')?;
    line.parse().ok().filter(|_| run == feed.run())
}
