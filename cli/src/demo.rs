//! `adsdv demo`: a whole mission without any CAN, judged.
//!
//! The log is written and judged frame by frame, as the frames come: no file is read back, and none has to be there.

use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Write as _};
use std::path::Path;

use adsdv_can::ai::Ai;
use adsdv_can::demo::{self, BUS, LocalBus, Options, Run, RunError};
use adsdv_can::live::Vcu;
use adsdv_can::scenario::{Player, Scenario, Unreadable};
use adsdv_oracle::candump::{FrameKind, Record, write_record};
use adsdv_oracle::log::{LogJudge, LogOptions};
use adsdv_spec::Machine;

use crate::args::DemoArgs;
use crate::error::Error;
use crate::layout::{Seconds, wrapped};
use crate::report::style::{self, Styled};
use crate::report::{self, Subject};
use crate::status::Status;
use crate::{json, operate, output};

/// The name that stands for standard input, which is no name of a file here.
const STDIN: &str = "-";

pub(crate) fn run(args: &DemoArgs) -> Result<Status, Error> {
    if args.screen {
        return on_screen(args);
    }
    let scenario = match &args.scenario {
        Some(file) => read(file)?,
        None => Scenario::mission(),
    };
    let mut log = match &args.log {
        Some(file) => Some(create(file, args.scenario.as_deref())?),
        None => None,
    };
    let options = LogOptions::default();
    let mut judge = LogJudge::new(options.clone());
    let made = demo::run(&scenario, Ai::default(), &Options::default(), |time_ns, frame| {
        let record = Record {
            line: 0,
            time_ns,
            interface: BUS,
            kind: FrameKind::Standard,
            id: frame.id.into(),
            data: frame.data(),
            direction: None,
            terminated: true,
        };
        judge.frame(&record);
        log.as_mut().map_or(Ok(()), |log| write_record(log, &record))
    });
    let name = args.log.as_ref().map_or_else(|| BUS.to_owned(), |log| log.display().to_string());
    let flushed = log.map_or(Ok(()), |mut log| log.flush());
    let written = |result: io::Result<()>| result.map_err(|error| write_error(&name, &error));
    let run = match made {
        Ok(run) => run,
        Err(RunError::Sink(error)) => return Err(write_error(&name, &error)),
        Err(error) => {
            written(flushed)?;
            return Err(waits(args.scenario.as_deref(), &error));
        }
    };
    written(flushed)?;
    let report = judge.finish(run.frames).map_err(|error| Error::log(&name, &error))?;
    if args.json {
        output::plain(&json::text(&report))?;
    } else {
        let width = output::width();
        let subject = Subject { name: &name, options: &options, pins: &[] };
        let text = story(args, &run, width) + &report::text(&subject, &report, width);
        output::styled(&text, args.color)?;
    }
    Ok(report.verdict().into())
}

/// The car in real time, with the switches as keys; a scenario is only played if there is one.
fn on_screen(args: &DemoArgs) -> Result<Status, Error> {
    let scenario = args.scenario.as_deref().map(read).transpose()?;
    let bus = LocalBus::new(Ai::default());
    let vcu = Vcu::new(bus, Machine::REFERENCE, scenario.as_ref().map(Player::new));
    operate::on_screen(vcu, args.color)?;
    Ok(Status::Conforms)
}

/// What was done: the lines before the report.
fn story(args: &DemoArgs, run: &Run, width: usize) -> String {
    let scenario = match &args.scenario {
        Some(file) => format!("the scenario {}", scenario_name(file)),
        None => "the built-in scenario".to_owned(),
    };
    let mut text = String::new();
    let about = format!(
        "A virtual VCU with its car, and a small AI Computer, on a bus within this program: {scenario}, {} s of \
         simulated time, {:.1} m driven.",
        Seconds(nanoseconds(run.duration_ms)),
        run.distance_m
    );
    wrapped(&mut text, about.split(' '), 0, width);
    // Writing to a string does not fail.
    let _ = writeln!(text, "\n{}", Styled(style::HEADING, "OPERATOR"));
    let mut actions = run.actions.iter().peekable();
    while let Some((time_ms, action)) = actions.next() {
        let mut together = vec![action.to_string()];
        while let Some((_, action)) = actions.next_if(|(time, _)| time == time_ms) {
            together.push(action.to_string());
        }
        let time = Seconds(nanoseconds(*time_ms));
        let _ = writeln!(text, "{time:>10} s  {}", together.join(", "));
    }
    text.push('\n');
    text
}

fn nanoseconds(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX).saturating_mul(1_000_000)
}

pub(crate) fn scenario_name(file: &Path) -> String {
    if file == Path::new(STDIN) { "standard input".to_owned() } else { file.display().to_string() }
}

/// The scenario of a file, or of standard input.
pub(crate) fn read(file: &Path) -> Result<Scenario, Error> {
    let name = scenario_name(file);
    let read = if file == Path::new(STDIN) {
        Scenario::read(io::stdin().lock())
    } else {
        let source = File::open(file).map_err(|error| Error {
            what: name.clone(),
            why: format!("cannot open the scenario: {error}"),
            hint: match error.kind() {
                io::ErrorKind::NotFound => "check the path; - stands for standard input",
                io::ErrorKind::PermissionDenied => "this user may not read it; change its permissions",
                _ => "give a file of text; can/scenarios has some to begin with",
            }
            .to_owned(),
        })?;
        Scenario::read(BufReader::new(source))
    };
    read.map_err(|error| Error {
        why: match &error {
            Unreadable::Io { source, .. } if source.kind() == io::ErrorKind::IsADirectory => {
                "is a directory; expected a scenario".to_owned()
            }
            Unreadable::Io { .. } => error.to_string(),
            Unreadable::Lines { .. } => format!("is no scenario\n{error}"),
        },
        what: name,
        hint: "can/README.md says what may stand in a scenario; can/scenarios has some to begin with"
            .to_owned(),
    })
}

/// Makes the log, empty. It is not the scenario, which would be lost.
fn create(file: &Path, scenario: Option<&Path>) -> Result<BufWriter<File>, Error> {
    let name = file.display().to_string();
    if file.as_os_str() == OsStr::new(STDIN) {
        return Err(Error {
            what: "--log -".to_owned(),
            why: "the report goes to standard output, so that the log cannot".to_owned(),
            hint: "name a file; one whose name is - is given as ./-".to_owned(),
        });
    }
    let same = scenario.is_some_and(|scenario| match (fs::canonicalize(scenario), fs::canonicalize(file)) {
        (Ok(scenario), Ok(log)) => scenario == log,
        _ => false,
    });
    if same {
        return Err(Error {
            what: name,
            why: "is the scenario, which the log would replace".to_owned(),
            hint: "name another file with --log".to_owned(),
        });
    }
    File::create(file).map(BufWriter::new).map_err(|error| write_error(&name, &error))
}

fn write_error(name: &str, error: &io::Error) -> Error {
    let hint = match error.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => {
            "make the directory first, or name another file with --log"
        }
        io::ErrorKind::IsADirectory => "name a file in it with --log",
        io::ErrorKind::StorageFull => "free some space, or name a file on another disk with --log",
        _ => "name a file that can be written with --log",
    };
    Error { what: name.to_owned(), why: format!("cannot write the log: {error}"), hint: hint.to_owned() }
}

/// A scenario that does not come to its end.
fn waits(scenario: Option<&Path>, error: &RunError<io::Error>) -> Error {
    Error {
        what: scenario.map_or_else(|| "the built-in scenario".to_owned(), scenario_name),
        why: error.to_string(),
        hint: "have the operator do what is missing in a line before that one".to_owned(),
    }
}
