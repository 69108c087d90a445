//! `adsdv check`: reads a log, has it judged, and prints the report.

use std::fs::File;
use std::io;
use std::path::Path;

use adsdv_oracle::candump::ReadError;
use adsdv_oracle::judge::{JudgeOptions, Report};
use adsdv_oracle::log::{LogError, LogOptions, LogProgress, judge_readable};

use crate::args::CheckArgs;
use crate::error::Error;
use crate::progress::Line;
use crate::report::{self, JudgedLog};
use crate::status::Status;
use crate::{json, output, pins};

/// The name that stands for standard input.
const STDIN: &str = "-";

pub(crate) fn run(args: &CheckArgs) -> Result<Status, Error> {
    let judge = JudgeOptions {
        window_ms: args.window,
        deadline_ms: args.deadline,
        readings: pins::possible(&args.readings)?,
        ..JudgeOptions::default()
    };
    let options = LogOptions { judge, interface: args.interface.clone() };
    let name = if args.log == Path::new(STDIN) {
        "standard input".to_owned()
    } else {
        args.log.display().to_string()
    };
    let (report, failure) = read(&args.log, &name, &options)?;
    if args.json {
        output::plain(&json::text(&report))?;
    } else {
        let subject = JudgedLog { name: &name, options: &options, pins: &args.readings };
        output::styled(&report::text(&subject, &report, output::width()), args.color)?;
    }
    // What could be read has been judged; a verdict on all of the log it is not.
    failure.map_or(Ok(report.verdict().into()), |failure| Err(Error::log(&name, &LogError::Read(failure))))
}

/// The report of what could be read, and why that was not all.
fn read(log: &Path, name: &str, options: &LogOptions) -> Result<(Report, Option<ReadError>), Error> {
    let mut line = Line::new();
    let progress = |progress: LogProgress| line.show(format_args!("{} lines", progress.lines));
    let judged = if log == Path::new(STDIN) {
        judge_readable(io::stdin().lock(), options, progress)
    } else {
        let file = File::open(log).map_err(|error| Error::open(name, &error))?;
        judge_readable(file, options, progress)
    };
    judged.map_err(|error| match &error {
        LogError::Read(read) if read.source.kind() == io::ErrorKind::IsADirectory => Error::directory(name),
        _ => Error::log(name, &error),
    })
}
