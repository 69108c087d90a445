//! `adsdv compare`: what differs between two recordings.
//!
//! ```text
//! GOOD, BAD --> Recording (oracle::compare) --> Comparison --> text, or json::compare
//! ```

mod frames;
mod margins;
mod parting;
mod requests;
mod section;
mod text;

use std::path::Path;

use adsdv_oracle::compare::{Comparison, Recording, Which};
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{LogError, LogOptions, LogProgress};

use crate::args::CompareArgs;
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{json, output, pins, recording};

pub(crate) fn run(args: &CompareArgs) -> Result<Status, Error> {
    if args.good == Path::new(recording::STDIN) && args.bad == Path::new(recording::STDIN) {
        return Err(Error {
            what: "- and -".to_owned(),
            why: "standard input can be read only once; expected a file for one of the two logs".to_owned(),
            hint: "save one of them first: cat > good.log".to_owned(),
        });
    }
    let (good, bad) = (read(args, Which::Good)?, read(args, Which::Bad)?);
    let comparison = Comparison::between(&good, &bad);
    if args.json {
        output::plain(&json::compared(&good, &bad, &comparison))?;
    } else {
        let names = [&args.good, &args.bad].map(|log| recording::name(log));
        output::styled(&text::text([&good, &bad], &names, &comparison, output::width()), args.color)?;
    }
    let status = if comparison.differs() { Status::Violates } else { Status::Conforms };
    // What could be read has been compared; an answer about all of it that is not.
    for (which, recording) in [(Which::Good, good), (Which::Bad, bad)] {
        if let Some(failure) = recording.failure {
            return Err(Error::log(&label(args, which), &LogError::Read(failure)));
        }
    }
    Ok(status)
}

/// Judges one of the two logs.
fn read(args: &CompareArgs, which: Which) -> Result<Recording, Error> {
    let chosen = args.edition.chosen()?;
    let (edition, by_log) = (chosen.edition(), chosen.asked_for().is_none());
    let possible = if by_log { pins::possible_in_some } else { pins::possible };
    let judge = JudgeOptions { readings: possible(edition, &args.readings)?, ..JudgeOptions::of(edition) };
    let options = LogOptions { judge, interface: args.interface.clone(), ..LogOptions::default() };
    let (log, label) = (log(args, which), label(args, which));
    let mut line = ProgressLine::new();
    let progress =
        |progress: LogProgress| line.show(format_args!("{}: {} lines", which.name(), progress.lines));
    let recording = Recording::read(recording::open(log, &label)?, &options, by_log, progress);
    let recording = recording.map_err(|error| Error::log(&label, &error))?;
    pins::possible(recording.edition, &args.readings)?;
    Ok(recording)
}

fn log(args: &CompareArgs, which: Which) -> &Path {
    match which {
        Which::Good => &args.good,
        Which::Bad => &args.bad,
    }
}

/// How an error names one of the two logs.
fn label(args: &CompareArgs, which: Which) -> String {
    format!("{}, {}", which.name(), recording::name(log(args, which)))
}
