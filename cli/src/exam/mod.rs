//! `adsdv exam`: examines an AI Computer, and tells what came of it.
//!
//! ```text
//! scenarios ---> exam ---> text or json, and logs
//!                  |
//!   a program that does not keep to the protocol: an error
//! ```
//!
//! `live.rs` is all of it on a bus, in real time.

mod json;
mod live;
mod text;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write as _};
use std::path::Path;

use adsdv_exam::{
    ExamOptions, ExamReport, ExamScenario, Sent, StackError, StackErrorKind, StdioStack, exam, scenarios,
};
use adsdv_oracle::candump::{Direction, FrameKind, Record, write_record};
use adsdv_oracle::conform::ProgramErrorKind;

use crate::args::{ChosenEdition, ExamArgs};
use crate::conform::{program_name, stops_the_program};
use crate::error::Error;
use crate::output;
use crate::progress::Line;
use crate::status::Status;

/// The name of the bus in logs.
const BUS: &str = "exam";

pub(crate) fn run(args: &ExamArgs) -> Result<Status, Error> {
    let edition = args.edition.chosen()?;
    let scenarios = chosen(args)?;
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
    let report = examine(args, edition, &scenarios, &name)?;
    print(&Examinee { edition, name: &name, args, early: false }, &report)?;
    Ok(if report.passes() { Status::Conforms } else { Status::Violates })
}

fn print(subject: &Examinee<'_>, report: &ExamReport) -> Result<(), Error> {
    if subject.args.json {
        output::plain(&json::text(subject, report))
    } else {
        output::styled(&text::text(subject, report, output::width()), subject.args.color)
    }
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
    /// Whether it ended before all was seen, so that there is no verdict.
    early: bool,
}

fn examine(
    args: &ExamArgs,
    edition: ChosenEdition,
    scenarios: &[ExamScenario],
    name: &str,
) -> Result<ExamReport, Error> {
    let no_verdict = |trouble: StackError| no_verdict(name, args, &trouble);
    // The arguments have the program at least: without it they are refused.
    let (program, rest) = args.command.split_at(args.command.len().min(1));
    let program = program.first().cloned().unwrap_or_default();
    let mut stack = StdioStack::start(&program, rest, args.timeout, args.time_limit).map_err(no_verdict)?;
    let options = options(args, edition);
    let mut line = Line::new();
    let mut written = Ok(());
    let report = exam(&mut stack, scenarios, &options, &mut |progress| {
        let (done, all) = progress.done;
        line.show_bar(done, all, progress.name);
        if let (Some(folder), Ok(())) = (&args.logs, &written) {
            written = log(folder, progress.name, progress.sent);
        }
    });
    drop(line);
    let report = report.map_err(no_verdict)?;
    written?;
    Ok(report)
}

/// The scenarios whose names begin as somebody asks.
fn chosen(args: &ExamArgs) -> Result<Vec<ExamScenario>, Error> {
    let all = scenarios();
    let begins = |scenario: &ExamScenario, name: &String| scenario.name.starts_with(name.as_str());
    if let Some(unknown) = args.only.iter().find(|name| !all.iter().any(|one| begins(one, name))) {
        let names: Vec<&str> = all.iter().map(|scenario| scenario.name.as_str()).collect();
        return Err(Error {
            what: format!("--only {}", unknown.escape_default()),
            why: format!("no scenario begins so; expected one of {}", names.join(", ")),
            hint: "adsdv exam --list says what each is about".to_owned(),
        });
    }
    let is_asked = |one: &ExamScenario| {
        let named = args.only.is_empty() || args.only.iter().any(|name| begins(one, name));
        named && (!args.quick || one.is_quick())
    };
    Ok(all.into_iter().filter(is_asked).collect())
}

/// A log as the AI Computer would have recorded it: what it sent itself is marked so.
fn log(folder: &Path, name: &str, sent: &[Sent]) -> Result<(), Error> {
    let path = folder.join(format!("{name}.log"));
    let write = || -> io::Result<()> {
        let mut out = BufWriter::new(File::create(&path)?);
        for Sent { t_ns, by_ai, frame } in sent {
            let direction = Some(if *by_ai { Direction::Tx } else { Direction::Rx });
            let (kind, id) = (FrameKind::Standard, frame.id.into());
            let record = Record {
                line: 0,
                time_ns: *t_ns,
                interface: BUS,
                kind,
                id,
                data: frame.data(),
                direction,
                terminated: true,
            };
            write_record(&mut out, &record)?;
        }
        out.flush()
    };
    write().map_err(|error| unwritten(&path, &error))
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
