//! `adsdv check`: reads a log, has it judged, and prints the report.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{Judged, LogError, LogOptions, LogProgress, judge_readable, judge_recognised};
use adsdv_oracle::recognise::Recognised;

use crate::args::CheckArgs;
use crate::error::Error;
use crate::progress::Line;
use crate::report::{self, JudgedLog};
use crate::status::Status;
use crate::{json, output, pins};

/// The name that stands for standard input.
const STDIN: &str = "-";

pub(crate) fn run(args: &CheckArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let (edition, by_log) = (chosen.edition(), chosen.asked_for().is_none());
    let possible = if by_log { pins::possible_in_some } else { pins::possible };
    let judge = JudgeOptions {
        window_ms: args.window,
        deadline_ms: args.deadline,
        readings: possible(edition, &args.readings)?,
        ..JudgeOptions::of(edition)
    };
    let mut options = LogOptions { judge, interface: args.interface.clone() };
    let name = if args.log == Path::new(STDIN) {
        "standard input".to_owned()
    } else {
        args.log.display().to_string()
    };
    let Judged { report, failure, recognised } = read(&args.log, &name, &options, by_log)?;
    options.judge = options.judge.under(recognised.edition);
    pins::possible(recognised.edition, &args.readings)?;
    let recognised = by_log.then_some(&recognised);
    if args.json {
        output::plain(&json::text(options.judge.edition, recognised, &report))?;
    } else {
        let line = recognised.map_or_else(|| chosen.to_string(), recognised_line);
        let subject =
            JudgedLog { edition: Some(&line), name: &name, options: &options, pins: &args.readings };
        output::styled(&report::text(&subject, &report, output::width()), args.color)?;
    }
    // What could be read has been judged; a verdict on all of the log it is not.
    failure.map_or(Ok(report.verdict().into()), |failure| Err(Error::log(&name, &LogError::Read(failure))))
}

/// The line about an edition that was recognised, and by what. What does not fit it is among the findings.
fn recognised_line(recognised: &Recognised) -> String {
    /// So many facts tell enough.
    const SHOWN: usize = 2;
    let Recognised { edition, evidence, .. } = recognised;
    let mut facts: Vec<String> = evidence.iter().take(SHOWN).cloned().collect();
    if let Some(more) = evidence.len().checked_sub(SHOWN).filter(|more| *more > 0) {
        facts.push(format!("{more} more such"));
    }
    facts.extend(recognised.doubt());
    format!("edition {} (recognised: {})", edition.version, facts.join("; "))
}

/// Judges by the edition of the options, or by the one that the log tells.
fn judge(
    source: impl Read,
    options: &LogOptions,
    by_log: bool,
    progress: impl FnMut(LogProgress),
) -> Result<Judged, LogError> {
    if by_log {
        return judge_recognised(source, options, progress);
    }
    let (report, failure) = judge_readable(source, options, progress)?;
    Ok(Judged { report, failure, recognised: Recognised::named(options.judge.edition) })
}

/// The report of what could be read, why that was not all, and the edition that it was judged by.
fn read(log: &Path, name: &str, options: &LogOptions, by_log: bool) -> Result<Judged, Error> {
    let mut line = Line::new();
    let progress = |progress: LogProgress| line.show(format_args!("{} lines", progress.lines));
    let judged = if log == Path::new(STDIN) {
        judge(io::stdin().lock(), options, by_log, progress)
    } else {
        let file = File::open(log).map_err(|error| Error::open(name, &error))?;
        judge(file, options, by_log, progress)
    };
    judged.map_err(|error| match &error {
        LogError::Read(read) if read.source.kind() == io::ErrorKind::IsADirectory => Error::directory(name),
        _ => Error::log(name, &error),
    })
}
