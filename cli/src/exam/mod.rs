//! `adsdv exam`: examines an AI Computer, and tells what came of it.
//!
//! ```text
//! scenarios ---> exam ---> shorter ones of what is wrong ---> text, json or a page; JUnit, a summary and logs in files
//!                  |
//!   a program that does not keep to the protocol: an error
//! ```
//!
//! `live.rs` is all of it on a bus, in real time.

mod choose;
mod files;
mod junit;
mod live;
mod page;
mod summary;
mod text;
mod verdict;

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::Path;

use adsdv_conform::ProgramErrorKind;
use adsdv_exam::{
    ExamForm, ExamOptions, ExamReport, ExamScenario, Sent, Shorter, StackError, StackErrorKind, StdioStack,
    exam, shorter, write_log,
};

use crate::accept::Accepted;
use crate::args::{ChosenEdition, ExamArgs};
use crate::conform::{program_name, stops_the_program};
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{html, output};

use verdict::Verdict;

pub(crate) fn run(args: &ExamArgs) -> Result<Status, Error> {
    html::prepare_long(args.html.as_deref(), args.json)?;
    let edition = args.edition.chosen()?;
    let scenarios = choose::chosen(args)?;
    if args.list {
        output::plain(&text::list(&scenarios, &options(args, edition)))?;
        return Ok(Status::Conforms);
    }
    if let Some(folder) = &args.logs {
        fs::create_dir_all(folder).map_err(|error| unwritten(folder, &error))?;
    }
    if !args.stdio {
        return live::run(args, edition, &scenarios);
    }
    let name = program_name(&args.command);
    stops_the_program().map_err(|error| Error {
        what: name.clone(),
        why: format!("cannot be started so that it stops with this command: {error}"),
        hint: "run it where signals can be handled".to_owned(),
    })?;
    let options = options(args, edition);
    let no_verdict = |trouble: StackError| no_verdict(&name, args, &trouble);
    let accepted = accepted(args)?;
    let (report, written) = examine(args, &scenarios, &options).map_err(no_verdict)?;
    let shorter = if args.shrink == 0 || report.passes() {
        Shorter::new()
    } else {
        let mut stack = start(args).map_err(no_verdict)?;
        let mut line = ProgressLine::new();
        let mut show = |done, all| line.show_bar(done, all, "of the search for shorter scenarios");
        shorter(&mut stack, &scenarios, &report, &options, args.shrink, &mut show).map_err(no_verdict)?
    };
    let verdict = Verdict::new(accepted);
    let subject = Examinee { edition, name: &name, args, verdict, shorter, early: false };
    print(&subject, &report)?;
    written?;
    if let Some(folder) = &args.logs {
        write_shorter(folder, &report, &subject.shorter)?;
    }
    Ok(if subject.verdict.passes(&report) { Status::Conforms } else { Status::Violates })
}

/// What is accepted.
fn accepted(args: &ExamArgs) -> Result<Accepted, Error> {
    let read = |path| Accepted::read(path, &verdict::ACCEPTABLE);
    args.accept.as_deref().map_or(Ok(Accepted::default()), read)
}

/// Prints the report, and then writes the files that somebody asks for: one that cannot be written takes nothing from the report.
fn print(subject: &Examinee<'_>, report: &ExamReport) -> Result<(), Error> {
    if html::is_printed(subject.args.html.as_deref()) {
        // The page is the answer.
    } else if subject.args.json {
        output::plain(&json(subject, report))?;
    } else {
        output::styled(&text::text(subject, report, output::width()), subject.args.color)?;
    }
    if let Some(path) = &subject.args.write_accept {
        subject.verdict.write(path, report)?;
    }
    if let Some(file) = &subject.args.html {
        html::write(file, page::html(subject, report))?;
    }
    files::write(subject, report)
}

/// The report as one JSON object on one line.
fn json(subject: &Examinee<'_>, report: &ExamReport) -> String {
    let form = ExamForm {
        edition: subject.edition.edition(),
        program: subject.args.command.iter().map(|word| word.to_string_lossy().into_owned()).collect(),
        shorter: &subject.shorter,
        reason: &|id| subject.verdict.reason(id),
        unused: subject.verdict.unused(report).into_iter().map(|(id, _)| id).collect(),
        passes: !subject.early && subject.verdict.passes(report),
    };
    form.text(report)
}

fn options(args: &ExamArgs, edition: ChosenEdition) -> ExamOptions {
    let mission_ms = u64::try_from(args.mission_time.as_millis()).unwrap_or(u64::MAX);
    ExamOptions { mission_ms, ..ExamOptions::of(edition.edition()) }
}

/// Who was examined.
struct Examinee<'a> {
    edition: ChosenEdition,
    name: &'a str,
    args: &'a ExamArgs,
    verdict: Verdict,
    shorter: Shorter,
    /// Whether it ended before all was seen, so that there is no verdict.
    early: bool,
}

/// Starts the program.
fn start(args: &ExamArgs) -> Result<StdioStack, StackError> {
    // The arguments have the program at least: without it they are refused.
    let (program, rest) = args.command.split_at(args.command.len().min(1));
    let program = program.first().cloned().unwrap_or_default();
    StdioStack::start(&program, rest, args.timeout, args.time_limit)
}

/// The report, and whether the logs could be written.
fn examine(
    args: &ExamArgs,
    scenarios: &[ExamScenario],
    options: &ExamOptions,
) -> Result<(ExamReport, Result<(), Error>), StackError> {
    let mut stack = start(args)?;
    let mut line = ProgressLine::new();
    let mut written = Ok(());
    let report = exam(&mut stack, scenarios, options, &mut |progress| {
        let (done, all) = progress.done;
        line.show_bar(done, all, progress.name);
        if let (Some(folder), Ok(())) = (&args.logs, &written) {
            written = log(folder, progress.name, progress.sent);
        }
    });
    drop(line);
    Ok((report?, written))
}

/// Of each finding that is shown, by its number, the shortest scenario and its log.
fn write_shorter(folder: &Path, report: &ExamReport, shorter: &Shorter) -> Result<(), Error> {
    for (number, place) in (1..).zip(report.shown()) {
        let Some(shortest) = shorter.get(&place) else { continue };
        let name = format!("finding-{number}");
        let path = folder.join(format!("{name}.txt"));
        fs::write(&path, shortest.scenario.to_string()).map_err(|error| unwritten(&path, &error))?;
        log(folder, &name, &shortest.sent)?;
    }
    Ok(())
}

/// A log as the AI Computer would have recorded it.
fn log(folder: &Path, name: &str, sent: &[Sent]) -> Result<(), Error> {
    let path = folder.join(format!("{name}.log"));
    let written = File::create(&path).and_then(|file| write_log(BufWriter::new(file), sent));
    written.map_err(|error| unwritten(&path, &error))
}

fn unwritten(path: &Path, error: &io::Error) -> Error {
    let hint = match error.kind() {
        io::ErrorKind::StorageFull => "free some space, or name a directory on another disk with --logs",
        _ => "name a directory that can be written with --logs",
    };
    let why = format!("cannot write the logs: {error}");
    Error { what: path.display().to_string(), why, hint: hint.to_owned() }
}

fn no_verdict(name: &str, args: &ExamArgs, trouble: &StackError) -> Error {
    let is_directory = args.command.first().is_some_and(|program| Path::new(program).is_dir());
    let (why, hint) = match &trouble.what {
        // The system tells that it may not be executed, or is not there, and means this.
        StackErrorKind::Program(ProgramErrorKind::NoStart(_)) if is_directory => {
            ("is a directory; expected a program".to_owned(), "name the program in it")
        }
        _ => (trouble.to_string(), trouble.hint()),
    };
    Error { what: name.to_owned(), why, hint: hint.to_owned() }
}
