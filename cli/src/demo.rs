//! `adsdv demo`: a whole mission without any CAN, judged.
//!
//! The log is written and judged frame by frame, as the frames come: no file is read back, and none has to be there.

pub(crate) mod help;

use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Write as _};
use std::path::Path;

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::car::Action;
use adsdv_can::demo::{self, BUS, DemoOptions, LocalBus, Run, RunError};
use adsdv_can::live::Vcu;
use adsdv_can::scenario::{Player, Scenario, Stuck, Unreadable};
use adsdv_oracle::candump::write_record;
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{LogJudge, LogOptions};
use adsdv_spec::Machine;

use crate::args::{ChosenEdition, DemoArgs};
use crate::error::Error;
use crate::layout::{Seconds, wrapped};
use crate::report::style::{self, Styled};
use crate::report::{self, JudgedLog};
use crate::status::Status;
use crate::{json, operate, output};

/// The name that stands for standard input, which is no name of a file here.
const STDIN: &str = "-";

pub(crate) fn run(args: &DemoArgs) -> Result<Status, Error> {
    if args.screen {
        return on_screen(args);
    }
    // Before a file is made: what the arguments lack is reported before anything is lost.
    let chosen = args.edition.chosen()?;
    let scenario = match &args.scenario {
        Some(file) => read(file)?,
        None => Scenario::mission(),
    };
    let mut log = match &args.log {
        Some(file) => Some(create(file, args.scenario.as_deref())?),
        None => None,
    };
    let options = LogOptions { judge: JudgeOptions::of(chosen.edition()), ..LogOptions::default() };
    let mut judge = LogJudge::new(options.clone());
    let made = demo::run(
        &scenario,
        Ai::new(chosen.edition(), Plan::DEFAULT),
        &DemoOptions::default(),
        |time_ns, frame| {
            let record = demo::record(time_ns, frame);
            judge.frame(&record);
            log.as_mut().map_or(Ok(()), |log| write_record(log, &record))
        },
    );
    let name = args.log.as_ref().map_or_else(|| BUS.to_owned(), |log| log.display().to_string());
    let flushed = log.map_or(Ok(()), |mut log| log.flush());
    let written = |result: io::Result<()>| result.map_err(|error| write_error(&name, &error));
    let run = match made {
        Ok(run) => run,
        Err(RunError::Sink(error)) => return Err(write_error(&name, &error)),
        Err(RunError::Waits { stuck, run }) => {
            written(flushed)?;
            return Err(waits(args, &stuck, &run));
        }
    };
    written(flushed)?;
    let report = judge.finish(run.frames).map_err(|error| Error::log(&name, &error))?;
    if args.json {
        output::plain(&json::text(None, chosen.edition(), None, &report, &[]))?;
    } else {
        let width = output::width();
        let subject = JudgedLog { edition: None, name: &name, options: &options, pins: &[], required: &[] };
        let text = story(args, chosen, &run, width) + &report::text(&subject, &report, width);
        output::styled(&text, args.color)?;
    }
    Ok(report.verdict().into())
}

/// The car in real time, with the switches as keys; a scenario is only played if there is one.
fn on_screen(args: &DemoArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let scenario = args.scenario.as_deref().map(read).transpose()?;
    let bus = LocalBus::new(Ai::new(chosen.edition(), Plan::DEFAULT));
    let machine = Machine::new(*chosen.edition(), chosen.edition().readings);
    let vcu = Vcu::new(bus, machine, scenario.as_ref().map(Player::new));
    operate::on_screen(vcu, chosen, args.color)?;
    Ok(Status::Conforms)
}

/// What was done: the lines before the report.
fn story(args: &DemoArgs, chosen: ChosenEdition, run: &Run, width: usize) -> String {
    let scenario = printed(args.scenario.as_deref());
    let mut text = format!("{chosen}\n");
    let about = format!(
        "A virtual VCU with its car, and a small AI Computer, on a bus within this program: {scenario}, {} s of \
         simulated time, {:.1} m driven.",
        Seconds(nanoseconds(run.duration_ms)),
        run.distance_m
    );
    wrapped(&mut text, about.split(' '), 0, width);
    // Writing to a string does not fail.
    let _ = writeln!(text, "\n{}", Styled(style::HEADING, "OPERATOR"));
    text.push_str(&did(&run.actions));
    text.push('\n');
    text
}

/// What the operator did, a line for each time.
fn did(actions: &[(u64, Action)]) -> String {
    let mut text = String::new();
    let mut left = actions.iter().peekable();
    while let Some((time_ms, action)) = left.next() {
        let mut together = vec![action.to_string()];
        while let Some((_, action)) = left.next_if(|(time, _)| time == time_ms) {
            together.push(action.to_string());
        }
        let time = Seconds(nanoseconds(*time_ms));
        // Writing to a string does not fail.
        let _ = writeln!(text, "{time:>10} s  {}", together.join(", "));
    }
    if actions.is_empty() {
        text.push_str("  nothing\n");
    }
    text
}

fn nanoseconds(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX).saturating_mul(1_000_000)
}

pub(crate) fn scenario_name(file: &Path) -> String {
    if file == Path::new(STDIN) { "standard input".to_owned() } else { file.display().to_string() }
}

/// The scenario in a sentence.
fn printed(scenario: Option<&Path>) -> String {
    match scenario {
        None => "the built-in scenario".to_owned(),
        Some(file) if sample(file).is_some() => format!("the built-in scenario {}", file.display()),
        Some(file) if file == Path::new(STDIN) => "the scenario on standard input".to_owned(),
        Some(file) => format!("the scenario {}", file.display()),
    }
}

/// The text of the scenario that comes with the program under this name.
fn sample(name: &Path) -> Option<&'static str> {
    Scenario::sample(name.to_str()?)
}

/// The scenario of a file, of standard input, or of those that come with the program.
pub(crate) fn read(file: &Path) -> Result<Scenario, Error> {
    let name = scenario_name(file);
    let read = if file == Path::new(STDIN) {
        Scenario::read(io::stdin().lock())
    } else if let Some(text) = sample(file) {
        text.parse()
    } else {
        let source = File::open(file).map_err(|error| Error {
            what: name.clone(),
            why: format!("cannot open the scenario: {error}"),
            hint: match error.kind() {
                io::ErrorKind::NotFound => {
                    format!(
                        "check the path; - stands for standard input, and these come with adsdv: {}",
                        samples()
                    )
                }
                io::ErrorKind::PermissionDenied => {
                    "this user may not read it; change its permissions".to_owned()
                }
                _ => format!("give a file of text, or one that comes with adsdv: {}", samples()),
            },
        })?;
        Scenario::read(BufReader::new(source))
    };
    read.map_err(|error| Error {
        why: match &error {
            Unreadable::Io { source, .. } if source.kind() == io::ErrorKind::IsADirectory => {
                "is a directory; expected a scenario".to_owned()
            }
            Unreadable::Io { .. } | Unreadable::Long { .. } => error.to_string(),
            Unreadable::Lines { .. } => format!("is no scenario\n{error}"),
        },
        what: name,
        hint: format!(
            "adsdv demo --help says what may stand in a scenario; these come with adsdv: {}",
            samples()
        ),
    })
}

/// The names of the scenarios that come with the program.
fn samples() -> String {
    Scenario::SAMPLES.map(|(name, _)| name).join(", ")
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

/// A scenario that does not come to its end: the error says what it did until then, and the log has it.
fn waits(args: &DemoArgs, stuck: &Stuck, run: &Run) -> Error {
    let mut why = format!("{stuck}\n\nOPERATOR until then\n{}", did(&run.actions));
    if let Some(log) = &args.log {
        let time = Seconds(nanoseconds(run.duration_ms));
        // Writing to a string does not fail.
        let _ = write!(why, "\n{} has the run until then: {time} s, {} frames", log.display(), run.frames);
    }
    Error {
        what: args.scenario.as_deref().map_or_else(|| printed(None), scenario_name),
        why: why.trim_end().to_owned(),
        hint: "have the operator do what is missing in a line before that one".to_owned(),
    }
}
