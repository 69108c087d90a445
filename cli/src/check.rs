//! `adsdv check`: reads a log, has it judged, and prints the report.

use adsdv_formats::Log;
use adsdv_oracle::excerpt::{Excerpts, judge_with_excerpts};
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{Judged, LogError, LogOptions, LogProgress, judge_entries, judge_recognised};
use adsdv_oracle::recognise::Recognised;

use crate::args::CheckArgs;
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::report::{self, JudgedLog};
use crate::status::Status;
use crate::{excerpt, json, output, pins, recording, requires, rules};

pub(crate) fn run(args: &CheckArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let (edition, by_log) = (chosen.edition(), chosen.asked_for().is_none());
    let possible = if by_log { pins::possible_in_some } else { pins::possible };
    if !by_log {
        requires::possible(edition, &args.required)?;
    }
    let judge = JudgeOptions {
        window_ms: args.window,
        deadline_ms: args.deadline,
        readings: possible(edition, &args.readings)?,
        complete: args.complete,
        ..JudgeOptions::of(edition)
    };
    let rules = rules::read(args.rules.as_deref(), edition, by_log)?;
    let mut options = LogOptions { judge, interface: args.interface.clone(), rules };
    let name = recording::name(&args.log);
    let (Judged { report, failure, recognised }, excerpts) = read(args, &name, &options, by_log)?;
    options.judge = options.judge.under(recognised.edition);
    pins::possible(recognised.edition, &args.readings)?;
    requires::possible(recognised.edition, &args.required)?;
    let recognised = by_log.then_some(&recognised);
    if args.json {
        output::plain(&json::text(options.judge.edition, recognised, &report, &args.required))?;
    } else {
        let line = recognised.map_or_else(|| chosen.to_string(), report::recognised);
        let subject = JudgedLog {
            edition: Some(&line),
            name: &name,
            options: &options,
            pins: &args.readings,
            required: &args.required,
        };
        output::styled(&report::text(&subject, &report, output::width()), args.color)?;
    }
    if let (Some(directory), Some(excerpts)) = (&args.excerpt, excerpts) {
        excerpt::write(args, directory, options.judge.edition.version, &excerpts)?;
    }
    // What could be read has been judged; a verdict on all of the log it is not.
    let status = requires::status(&report, &args.required);
    failure.map_or(Ok(status), |failure| Err(Error::log(&name, &LogError::Read(failure))))
}

/// Judges by the edition of the options, or by the one that the log tells.
fn judge(
    log: Log,
    options: &LogOptions,
    by_log: bool,
    with_excerpts: bool,
    progress: impl FnMut(LogProgress),
) -> Result<(Judged, Option<Excerpts>), LogError> {
    if with_excerpts {
        return judge_with_excerpts(log, options, by_log, progress)
            .map(|(judged, excerpts)| (judged, Some(excerpts)));
    }
    if by_log {
        return judge_recognised(log, options, progress).map(|judged| (judged, None));
    }
    let (report, failure) = judge_entries(log, options, progress)?;
    Ok((Judged { report, failure, recognised: Recognised::named(options.judge.edition) }, None))
}

/// The report of what could be read, why that was not all, the edition that it was judged by, and excerpts if they are asked for.
fn read(
    args: &CheckArgs,
    name: &str,
    options: &LogOptions,
    by_log: bool,
) -> Result<(Judged, Option<Excerpts>), Error> {
    let mut line = ProgressLine::new();
    let progress = |progress: LogProgress| line.show(format_args!("{} lines", progress.lines));
    let log = recording::open(&args.log, name)?;
    args.excerpt.as_deref().map_or(Ok(()), excerpt::prepare)?;
    let judged = judge(log, options, by_log, args.excerpt.is_some(), progress);
    judged.map_err(|error| match (&error, &args.rules) {
        (LogError::Rules(error), Some(file)) => rules::refused(file, error),
        _ => Error::log(name, &error),
    })
}
