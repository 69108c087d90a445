//! `adsdv check`: reads a log, has it judged, and prints the report; of several logs `many` does that.

use std::path::PathBuf;

use adsdv_oracle::log::{LogError, LogProgress};

use crate::args::CheckArgs;
use crate::error::Error;
use crate::judged::{Plan, judged};
use crate::kept::keep;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{excerpt, html, many, output, recording, requires};

pub(crate) fn run(args: &CheckArgs) -> Result<Status, Error> {
    for (option, file) in [("--html", &args.html), ("--junit", &args.junit), ("--summary", &args.summary)] {
        keep(args.logs.iter().map(PathBuf::as_path), option, file.as_deref())?;
    }
    let plan = Plan::of(args)?;
    if many::is_asked_for(args) {
        return many::run(args, &plan);
    }
    let [log] = &args.logs[..] else { return Ok(Status::NoAnswer) };
    html::prepare(args.html.as_deref(), args.json)?;
    let name = recording::name(log);
    let mut line = ProgressLine::new();
    let progress = |progress: LogProgress| line.show(format_args!("{} lines", progress.lines));
    let log = recording::open(log, &name)?;
    args.excerpt.as_deref().map_or(Ok(()), excerpt::prepare)?;
    let subject = judged(args, &plan, log, progress).map_err(|error| error.into_error(args, &name))?;
    if html::is_printed(args.html.as_deref()) {
        // The page is the answer.
    } else if args.json {
        output::plain(&subject.json(args, None))?;
    } else {
        output::styled(&subject.text(args, &plan, &name), args.color)?;
    }
    if let (Some(directory), Some(excerpts)) = (&args.excerpt, &subject.excerpts) {
        excerpt::write(args, directory, subject.edition().version, excerpts)?;
    }
    many::write_one(args, &name, &subject)?;
    if let (Some(file), Some(recorded)) = (&args.html, &subject.recorded) {
        html::write(file, subject.page(args, &name, recorded))?;
    }
    // What could be read has been judged; a verdict on all of the log it is not.
    match subject.failure {
        None => Ok(requires::status(&subject.report, &args.required)),
        Some(failure) => Err(Error::log(&name, &LogError::Read(failure))),
    }
}
