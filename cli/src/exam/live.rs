//! `adsdv exam` on a bus, in real time.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use adsdv_exam::{
    ExamScenario, LiveBus, LiveError, LiveOptions, LiveProgram, LiveReport, Shorter, exam_live,
    prepare_namespaces,
};

use super::text::Minutes;
use super::verdict::Verdict;
use super::{Examinee, accepted, log, options, print};
use crate::args::{ChosenEdition, ExamArgs};
use crate::conform::program_name;
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::status::Status;

/// What the interface in a namespace is called where nobody gives it a name.
const MADE: &str = "vcan0";

pub(super) fn run(
    args: &ExamArgs,
    edition: ChosenEdition,
    scenarios: &[ExamScenario],
) -> Result<Status, Error> {
    // Before there is a second thread.
    if args.namespace {
        prepare_namespaces()?;
    }
    let interface = args.interface.clone().unwrap_or_else(|| MADE.to_owned());
    let name = if args.attach { interface.clone() } else { program_name(&args.command) };
    let stop = stops_in_order().map_err(|error| Error {
        what: name.clone(),
        why: format!("cannot be started so that it stops with this command: {error}"),
        hint: "run it where signals can be handled".to_owned(),
    })?;
    let accepted = accepted(args)?;
    let options = LiveOptions {
        exam: options(args, edition),
        bus: if args.namespace { LiveBus::Namespace(interface) } else { LiveBus::Interface(interface) },
        startup: args.startup,
        jobs: args.jobs.into(),
        stop,
    };
    let mut line = ProgressLine::new();
    let mut written = Ok(());
    let LiveReport { mut report, error } = exam_live(&program(args), scenarios, &options, &mut |progress| {
        let (done, all) = progress.done;
        line.show_bar(done, all, format_args!("{}, {} left", progress.name, Minutes(progress.left)));
        if let (Some(folder), Some(sent), Ok(())) = (&args.logs, progress.sent, &written) {
            written = log(folder, progress.name, sent);
        }
    });
    drop(line);
    if let Some(LiveError { what, why, .. }) = &error {
        report.notes.push(format!("it ended early: {what}: {why}"));
    }
    if report.scenarios.is_empty() {
        return Err(error.map_or_else(|| nothing(&name, &report.notes), Error::from));
    }
    let (verdict, shorter, early) = (Verdict::new(accepted), Shorter::new(), error.is_some());
    let subject = Examinee { edition, name: &name, args, verdict, shorter, early };
    print(&subject, &report)?;
    written?;
    let passes = subject.verdict.passes(&report);
    match error {
        Some(error) => Err(error.into()),
        None if passes && report.count("pass") == 0 => Err(nothing(&name, &report.notes)),
        None if passes => Ok(Status::Conforms),
        None => Ok(Status::Violates),
    }
}

fn program(args: &ExamArgs) -> LiveProgram {
    match args.command.split_first() {
        Some((program, rest)) if !args.attach => {
            LiveProgram::Started { program: program.clone(), args: rest.to_vec() }
        }
        _ => LiveProgram::Attached,
    }
}

/// What does nothing passes nothing.
fn nothing(name: &str, notes: &[String]) -> Error {
    Error {
        what: name.to_owned(),
        why: format!("nothing was exercised: {}", notes.join("; ")),
        hint: "choose other scenarios with --only, or a machine that has the time".to_owned(),
    }
}

impl From<LiveError> for Error {
    fn from(LiveError { what, why, hint }: LiveError) -> Self {
        Self { what, why, hint }
    }
}

/// A flag that is set when the command is stopped: the exam ends in order, and says what it saw. Stopped a second time, the
/// programs and the command end where they are.
#[cfg(unix)]
fn stops_in_order() -> io::Result<Arc<AtomicBool>> {
    use std::sync::atomic::Ordering;

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut signals = Signals::new([SIGHUP, SIGINT, SIGTERM])?;
    let stop = Arc::new(AtomicBool::new(false));
    let theirs = Arc::clone(&stop);
    std::thread::spawn(move || {
        for signal in signals.forever() {
            if theirs.swap(true, Ordering::AcqRel) {
                crate::conform::end_by(signal);
            }
        }
    });
    Ok(stop)
}

/// Elsewhere a terminal ends the command.
#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "as on unix")]
fn stops_in_order() -> io::Result<Arc<AtomicBool>> {
    Ok(Arc::new(AtomicBool::new(false)))
}
