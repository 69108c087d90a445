//! `adsdv conform`: runs the suite and random scenarios against a program, and tells what came of it.
//!
//! ```text
//! suite (generated, or read) ---> conform ---> text, json or a page
//!                                    |
//!            a program that does not keep to the protocol: an error
//! ```

mod diagnosis;
mod figure;
mod json;
mod page;
mod stop;
mod text;

#[cfg(unix)]
pub(crate) use stop::end_by;
pub(crate) use stop::stops_the_program;

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

use adsdv_conform::suite::{self, Test};
use adsdv_conform::{
    ConformOptions, ConformProgress, ConformReport, NOT_ALIKE, Phase, Program, ProgramError,
    ProgramErrorKind, conform,
};
use adsdv_spec::{Choices, Edition, Machine, Reading};

use diagnosis::DiagnosedProgram;

use crate::accept::{Acceptable, Accepted};
use crate::args::{ChosenEdition, ConformArgs};
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{html, output, pins};

/// What `--accept` accepts.
const ACCEPTABLE: Acceptable = Acceptable {
    command: "conform",
    things: "deviations",
    example: "ready-dwell:+50ms  the RES needs that long",
};

pub(crate) fn run(args: &ConformArgs) -> Result<Status, Error> {
    html::prepare_long(args.html.as_deref(), args.json)?;
    let chosen = args.edition.chosen()?;
    let edition = chosen.edition();
    let options = ConformOptions {
        possible: possible(args, edition)?,
        strict: args.strict,
        latency: args.latency,
        cycle_ms: args.cycle_ms,
        seed: args.seed,
        // A program that does not say more takes most of its time for answers.
        wall_time: args.time_limit.mul_f64(0.9),
        runs: args.runs,
        ..ConformOptions::of(edition)
    };
    let tests = match &args.suite {
        Some(file) => read(file, &pins::machine(edition, &args.readings)?)?,
        None => suite::generate(edition),
    };
    let name = program_name(&args.command);
    stops_the_program().map_err(|error| Error {
        what: name.clone(),
        why: format!("cannot be started so that it stops with this command: {error}"),
        hint: "run it where signals can be handled".to_owned(),
    })?;
    let read = |path| Accepted::read(path, &ACCEPTABLE);
    let accepted = args.accept.as_deref().map_or(Ok(Accepted::default()), read)?;
    let mut report = judge(args, &tests, &options).map_err(|trouble| no_verdict(&name, args, &trouble))?;
    if report.tests == 0 {
        return Err(nothing_run(&name, &report));
    }
    let diagnosis = if is_diagnosed(args, &report) {
        let found = diagnosis::of(args, (edition, options.possible), &report, &accepted);
        Some(found.map_err(|trouble| no_verdict(&name, args, &trouble))?)
    } else {
        None
    };
    if report.repeats && diagnosis.as_ref().is_some_and(|program| !program.repeats()) {
        report.repeats = false;
        report.notes.push(NOT_ALIKE.to_owned());
    }
    if let Some(path) = &args.write_accept {
        let deviations = diagnosis.as_ref().map_or(&[][..], DiagnosedProgram::deviations);
        let wrong = deviations.iter().map(|one| (one.id(edition), one.text(edition).to_string()));
        accepted.write(path, &ACCEPTABLE, wrong)?;
    }
    if let Some(path) = &args.figure {
        let title = format!("Figure 2 as {name} does it ({})", chosen.edition().version);
        let own = diagnosis.as_ref().map(|program| program.figure.clone());
        figure::draw(path, &title, &own.unwrap_or_else(|| adsdv_diagnosis::figure(edition, &[], &[])))?;
    }
    let conforms = conforms(args, &report, diagnosis.as_ref());
    let undiagnosed = undiagnosed(args, &report);
    let subject = JudgedProgram { edition: chosen, name: &name, args, diagnosis, undiagnosed, conforms };
    if html::is_printed(args.html.as_deref()) {
        // The page is the answer.
    } else if args.json {
        output::plain(&json::text(&subject, &report))?;
    } else {
        output::styled(&text::text(&subject, &report, output::width()), args.color)?;
    }
    if let Some(file) = &args.html {
        html::write(file, page::html(&subject, &report))?;
    }
    Ok(if conforms { Status::Conforms } else { Status::Violates })
}

/// No test was run, so that there is nothing to judge by.
fn nothing_run(name: &str, report: &ConformReport) -> Error {
    const SHOWN: usize = 5;
    let names = report.not_run.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    let more = report.not_run.len().checked_sub(SHOWN).filter(|more| *more > 0);
    let more = more.map_or_else(String::new, |more| format!(" and {more} more"));
    let hint = if report.about.wall_clock {
        "raise --time-limit, or give tests that take less time with --suite"
    } else {
        "give it the inputs of these tests, and announce them (\"inputs\", see conform/PROTOCOL.md), or give others with --suite"
    };
    Error {
        what: name.to_owned(),
        why: format!("no test of the suite was run, for {}: {names}{more}", text::why_not_run(report)),
        hint: hint.to_owned(),
    }
}

/// Whether it is found out what the program does otherwise: where it does something so, and does not go by a clock of its own.
fn is_diagnosed(args: &ConformArgs, report: &ConformReport) -> bool {
    let can_be = args.latency == 0 && !report.about.wall_clock;
    let differs = !report.conforms() || !report.observations.is_empty();
    // What one experiment teaches would not hold in the next.
    can_be && report.repeats && !args.no_diagnosis && (args.diagnose || differs)
}

/// Why it is not found out what a program does otherwise that fails; `None` where it is, or nobody wants to know.
fn undiagnosed(args: &ConformArgs, report: &ConformReport) -> Option<&'static str> {
    if args.no_diagnosis || report.conforms() && !args.diagnose {
        None
    } else if args.latency > 0 {
        Some(
            "with --latency an answer may be to a step before, and an experiment is judged by the answer to each step",
        )
    } else if report.about.wall_clock {
        Some(
            "by a clock on the wall the thousands of experiments would take hours; a program that goes by dt_ms is diagnosed; FAILURES has what its tests show",
        )
    } else if !report.repeats {
        Some("it does not answer alike each time, and what one experiment teaches would not hold in the next")
    } else {
        None
    }
}

/// The verdict: with accepted deviations it is about the others, and about what does not follow from any.
fn conforms(args: &ConformArgs, report: &ConformReport, diagnosis: Option<&DiagnosedProgram>) -> bool {
    match diagnosis.filter(|_| args.accept.is_some()) {
        Some(program) => {
            program.is_accepted()
                && report.more_failures == 0
                && report.failures.iter().all(|failure| program.explains(failure))
        }
        // What no test shows an experiment may.
        None => report.conforms() && diagnosis.is_none_or(DiagnosedProgram::is_accepted),
    }
}

/// The readings that are allowed for: where it is strict, the default ones, but for what is pinned.
fn possible(args: &ConformArgs, edition: &Edition) -> Result<Choices, Error> {
    let possible = pins::possible(edition, &args.readings)?;
    if !args.strict {
        return Ok(possible);
    }
    let pinned = |reading: Reading| args.readings.iter().any(|choice| choice.reading() == reading);
    let open = edition.questions().filter(|reading| !pinned(*reading));
    Ok(open.fold(possible, |possible, reading| possible.pin(edition.readings.choice(reading))))
}

/// What was judged, and how.
#[derive(Clone, Debug)]
struct JudgedProgram<'a> {
    /// The edition that it was asked about.
    edition: ChosenEdition,
    /// The command line of the program.
    name: &'a str,
    /// What was asked for.
    args: &'a ConformArgs,
    /// What it does otherwise, if that was asked for.
    diagnosis: Option<DiagnosedProgram>,
    /// Why that is not there, if somebody may look for it.
    undiagnosed: Option<&'static str>,
    /// The verdict.
    conforms: bool,
}

fn judge(
    args: &ConformArgs,
    tests: &[Test],
    options: &ConformOptions,
) -> Result<ConformReport, ProgramError> {
    let mut program = start(args)?;
    let mut line = ProgressLine::new();
    conform(&mut program, tests, options, &mut |ConformProgress { phase, done, all }| {
        line.show_bar(
            done,
            all,
            match phase {
                Phase::Suite => "of the suite",
                Phase::Random => "of the random scenarios",
                Phase::Shrinking => "of the search for shorter scenarios",
            },
        );
    })
}

/// Starts the program.
fn start(args: &ConformArgs) -> Result<Program, ProgramError> {
    // The arguments have the program at least: without it they are refused.
    let (program, rest) = args.command.split_at(args.command.len().min(1));
    let program = program.first().cloned().unwrap_or_default();
    Ok(Program::start(&program, rest, args.timeout, args.latency > 0)?.within(args.time_limit))
}

fn no_verdict(name: &str, args: &ConformArgs, trouble: &ProgramError) -> Error {
    let is_directory = args.command.first().is_some_and(|program| Path::new(program).is_dir());
    let (why, hint) = match &trouble.what {
        // The system tells that it may not be executed, or is not there, and means this.
        ProgramErrorKind::NoStart(_) if is_directory => {
            ("is a directory; expected a program".to_owned(), "name the program in it")
        }
        _ => (trouble.to_string(), trouble.hint()),
    };
    Error { what: name.to_owned(), why, hint: hint.to_owned() }
}

/// The command line of the program, fit for a terminal.
pub(crate) fn program_name(command: &[OsString]) -> String {
    let words = command.iter().map(|word| word.to_string_lossy());
    let words: Vec<String> = words
        .map(|word| {
            word.chars()
                .flat_map(|c| if c.is_control() { c.escape_default().collect() } else { vec![c] })
                .collect()
        })
        .collect();
    words.join(" ")
}

/// The tests of a file of JSON Lines, which expects what this machine shows: one with the readings under which it was written. One line that is no test is one test that is not run: that is no verdict.
fn read(path: &Path, reference: &Machine) -> Result<Vec<Test>, Error> {
    const WRITE: &str = "write a suite with: adsdv suite > suite.jsonl";
    let name = path.display().to_string();
    let trouble = |why: String, hint: &str| Error { what: name.clone(), why, hint: hint.to_owned() };
    let unreadable = |what: &str, error: &io::Error| match error.kind() {
        io::ErrorKind::IsADirectory => trouble("is a directory; expected a suite".to_owned(), WRITE),
        io::ErrorKind::NotFound => trouble(format!("cannot {what} the suite: {error}"), "check the path"),
        io::ErrorKind::PermissionDenied => trouble(
            format!("cannot {what} the suite: {error}"),
            "this user may not read it; change its permissions",
        ),
        _ => trouble(format!("cannot {what} the suite: {error}"), WRITE),
    };
    let file = File::open(path).map_err(|error| unreadable("open", &error))?;
    let suite = suite::read(BufReader::new(file), reference).map_err(|error| unreadable("read", &error))?;
    if !suite.bad.is_empty() {
        const SHOWN: u64 = 10;
        let count = suite.bad.iter().fold(suite.more_bad, |count, _| count + 1);
        let what = if count == 1 {
            "a line that is no test".to_owned()
        } else {
            format!("{count} lines that are no tests")
        };
        let shown = (0..SHOWN).zip(&suite.bad).map(|(_, bad)| bad.to_string());
        let more = (count > SHOWN).then(|| format!("and {} more", count - SHOWN));
        let why = std::iter::once(what).chain(shown).chain(more).collect::<Vec<_>>().join("\n  ");
        return Err(trouble(
            why,
            "correct these lines, or leave them out; `adsdv suite` writes a whole suite",
        ));
    }
    if suite.tests.is_empty() {
        return Err(trouble("the suite is empty; expected one test a line".to_owned(), WRITE));
    }
    Ok(suite.tests)
}
