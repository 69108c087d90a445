//! `adsdv check` of several logs: on all cores, a line for each, the worst first, and the report of the worst.
//!
//! ```text
//! logs, directories --> find, each (adsdv-formats): judged::judged --> Row --> table, JSON Lines
//!                                                                     Rows --> junit, summary
//! ```
//!
//! Of a log that is done no more is kept than its row; of the worst its report.

mod junit;
mod row;
mod summary;
mod table;
mod written;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use adsdv_formats::{FindError, Found, Log, Step, each, find, is_several};
use adsdv_oracle::log::LogError;

use crate::args::CheckArgs;
use crate::error::Error;
use crate::judged::{self, Failed, Plan};
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{json, output, recording};
use row::{Row, Rows};

pub(crate) use written::write_one;

/// Whether these arguments ask for several logs.
pub(crate) fn is_asked_for(args: &CheckArgs) -> bool {
    !matches!(&args.logs[..], [one] if !is_several(one))
}

/// What came of one log.
struct Done {
    found: Found,
    row: Result<Row, Error>,
    /// There is no frame in it.
    is_empty: bool,
    /// What is printed of it, if it is the worst, or for a program.
    text: Option<String>,
}

pub(crate) fn run(args: &CheckArgs, plan: &Plan) -> Result<Status, Error> {
    if args.excerpt.is_some() {
        return Err(Error {
            what: "--excerpt".to_owned(),
            why: "writes the excerpts of one log; expected one log, and not several".to_owned(),
            hint: "give the one that they are to be of".to_owned(),
        });
    }
    if args.html.is_some() {
        return Err(Error {
            what: "--html".to_owned(),
            why: "writes the page of one log; expected one log, and not several".to_owned(),
            hint: "give the one that it is to be of".to_owned(),
        });
    }
    if args.logs.iter().any(|log| log == Path::new(recording::STDIN)) {
        return Err(Error {
            what: recording::STDIN.to_owned(),
            why: "standard input is judged alone; expected files and directories beside each other"
                .to_owned(),
            hint: "save it first: cat > run.log".to_owned(),
        });
    }
    let logs = find(&args.logs).map_err(|error| unfound(&error))?;
    let mut progress = Progress::new(&logs);
    let (mut rows, mut printed) = (Rows::default(), Ok(()));
    let read = Arc::clone(&progress.read);
    let done_all = each(
        None,
        logs,
        |found| done(args, plan, found, &read),
        |step| {
            if let Step::Done(done) = step {
                progress.done += 1;
                printed = taken(args, &mut rows, done);
            }
            progress.show();
            printed.is_ok()
        },
    );
    drop(progress);
    done_all.map_err(|error| Error::system("threads", &error))?;
    printed?;
    if rows.all.is_empty() {
        return Err(Error {
            what: args.logs.iter().map(|log| log.display().to_string()).collect::<Vec<_>>().join(", "),
            why: format!("has no log; {}", rows.passed_over()),
            hint: "name a directory with recordings in it".to_owned(),
        });
    }
    if !args.json {
        output::styled(&table::text(&rows, output::width()), args.color)?;
    }
    written::write(args, &rows)?;
    Ok(rows.status())
}

fn unfound(error: &FindError) -> Error {
    let hint = match error {
        FindError::Pattern { .. } => "check the path; * stands for any characters of a name",
        FindError::Directory { .. } => "this user may not read it; change its permissions, or name the files",
    };
    Error { what: error.path().display().to_string(), why: error.why(), hint: hint.to_owned() }
}

/// Opens a log; `read` counts the bytes that are read.
fn open(found: &Found, name: &str, read: &Arc<AtomicU64>) -> Result<Log, Failed> {
    let source = found.source(read).map_err(|error| Failed::Open(Error::open(name, &error)))?;
    adsdv_formats::open(source).map_err(|error| Failed::Open(Error::recording(name, &error)))
}

/// Judges one log.
fn done(args: &CheckArgs, plan: &Plan, found: Found, read: &Arc<AtomicU64>) -> Done {
    let name = found.path.display().to_string();
    let judged = open(&found, &name, read).and_then(|log| judged::judged(args, plan, log, |_| {}));
    match judged {
        Ok(subject) => {
            let row = Row::of(&name, &subject);
            let text =
                if args.json { subject.json(args, Some(&name)) } else { subject.text(args, plan, &name) };
            Done { found, row: Ok(row), is_empty: false, text: Some(text) }
        }
        Err(error) => {
            let is_empty = matches!(&error, Failed::Log(LogError::NoFrame { .. }));
            let error = error.into_error(args, &name);
            let text = args.json.then(|| json::unreadable(&name, &error));
            Done { found, row: Err(error), is_empty, text }
        }
    }
}

/// Keeps what came of a log, and prints it for a program.
fn taken(args: &CheckArgs, rows: &mut Rows, done: Done) -> Result<(), Error> {
    let Done { found, row, is_empty, text } = done;
    // Nobody said that this file is a log.
    if is_empty && found.by_directory {
        rows.no_logs += 1;
        return Ok(());
    }
    if args.json
        && let Some(text) = &text
    {
        output::plain(text)?;
    }
    rows.add(row.unwrap_or_else(|error| Row::unreadable(&found.path.display().to_string(), &error)), text);
    Ok(())
}

/// How far it is: by the bytes that were read, of all.
struct Progress {
    line: ProgressLine,
    begun: Instant,
    read: Arc<AtomicU64>,
    bytes: u64,
    logs: usize,
    done: usize,
}

impl Progress {
    fn new(logs: &[Found]) -> Self {
        Self {
            line: ProgressLine::new(),
            begun: Instant::now(),
            read: Arc::default(),
            bytes: logs.iter().map(|found| found.bytes).sum(),
            logs: logs.len(),
            done: 0,
        }
    }

    fn show(&mut self) {
        let read = self.read.load(Ordering::Relaxed);
        let text = pace(read, self.bytes, self.begun.elapsed().as_secs_f64());
        // A file may grow while it is read.
        let percent = usize::try_from(read.min(self.bytes) * 1000 / self.bytes.max(1)).unwrap_or(1000);
        self.line.show_bar(percent, 1000, format_args!("{} of {} logs{text}", self.done, self.logs));
    }
}

/// The rate, and the time that is left at that rate.
#[expect(clippy::cast_precision_loss, reason = "it is shown with one decimal")]
fn pace(read: u64, all: u64, seconds: f64) -> String {
    if read == 0 || seconds <= 0.0 {
        return String::new();
    }
    let rate = read as f64 / seconds;
    let left = all.saturating_sub(read) as f64 / rate;
    format!(", {:.1} MB/s, {left:.0} s left", rate / 1e6)
}

#[cfg(test)]
mod tests {
    use super::pace;

    #[test]
    fn the_pace_is_what_was_read_and_what_is_left_at_that_rate() {
        assert_eq!(pace(0, 100, 1.0), "");
        assert_eq!(pace(20_000_000, 100_000_000, 2.0), ", 10.0 MB/s, 8 s left");
        assert_eq!(pace(300, 100, 1.0), ", 0.0 MB/s, 0 s left", "a file that grew");
    }
}
