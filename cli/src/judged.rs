//! What is asked of the judge, and a log that was judged: for one log and for many.

use adsdv_formats::Log;
use adsdv_oracle::candump::{Entries, ReadError};
use adsdv_oracle::excerpt::{Excerpts, judge_with_excerpts};
use adsdv_oracle::judge::{JudgeOptions, Report};
use adsdv_oracle::log::{Judged, LogError, LogOptions, LogProgress, judge_entries, judge_recognised};
use adsdv_oracle::recognise::Recognised;
use adsdv_report::{Recorder, Recording};
use adsdv_spec::Edition;

use crate::args::{CheckArgs, ChosenEdition};
use crate::error::Error;
use crate::report::JudgedLog;
use crate::status::Status;
use crate::{json, output, pins, report, requires, rules};

/// How logs are judged, by the arguments.
pub(crate) struct Plan {
    chosen: ChosenEdition,
    /// The edition is recognised.
    by_log: bool,
    options: LogOptions,
}

impl Plan {
    pub(crate) fn of(args: &CheckArgs) -> Result<Self, Error> {
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
        let options = LogOptions { judge, interface: args.interface.clone(), rules };
        Ok(Self { chosen, by_log, options })
    }
}

/// A log that was judged.
pub(crate) struct Subject {
    pub(crate) report: Report,
    /// Why not all of the log could be read.
    pub(crate) failure: Option<ReadError>,
    recognised: Recognised,
    by_log: bool,
    options: LogOptions,
    pub(crate) excerpts: Option<Excerpts>,
    /// What was recorded, where somebody is to look at it.
    pub(crate) recorded: Option<Recording>,
    status: Status,
    missing: Vec<String>,
}

/// Why there is no report.
pub(crate) enum Failed {
    /// The log cannot be opened.
    Open(Error),
    /// It cannot be judged.
    Log(LogError),
    /// An argument asks for what the edition that the log speaks has not.
    Asked(Error),
}

impl Failed {
    pub(crate) fn into_error(self, args: &CheckArgs, name: &str) -> Error {
        match (self, &args.rules) {
            (Self::Open(error) | Self::Asked(error), _) => error,
            (Self::Log(LogError::Rules(error)), Some(file)) => rules::refused(file, &error),
            (Self::Log(error), _) => Error::log(name, &error),
        }
    }
}

/// Judges a log, by the edition of the options or by the one that it speaks.
pub(crate) fn judged(
    args: &CheckArgs,
    plan: &Plan,
    log: Log,
    progress: impl FnMut(LogProgress),
) -> Result<Subject, Failed> {
    let with_excerpts = args.excerpt.is_some();
    let (judged, heard) = if args.html.is_some() {
        let mut recorder = Recorder::new(log, plan.options.judge.window_ms);
        let judged = judge(&mut recorder, &plan.options, plan.by_log, with_excerpts, progress);
        (judged, Some(recorder))
    } else {
        (judge(log, &plan.options, plan.by_log, with_excerpts, progress), None)
    };
    let (Judged { report, failure, recognised }, excerpts) = judged.map_err(Failed::Log)?;
    let interface = plan.options.interface.as_deref();
    let recorded = heard.map(|recorder| recorder.finish(recognised.edition, interface));
    let mut options = plan.options.clone();
    options.judge = options.judge.under(recognised.edition);
    pins::possible(recognised.edition, &args.readings).map_err(Failed::Asked)?;
    requires::possible(recognised.edition, &args.required).map_err(Failed::Asked)?;
    let status = if failure.is_some() { Status::NoAnswer } else { requires::status(&report, &args.required) };
    let missing = args.required.iter().filter(|one| !report.exercised.meets(**one));
    let missing = missing.map(|one| format!("{one} ({})", one.missing())).collect();
    Ok(Subject {
        report,
        failure,
        recognised,
        by_log: plan.by_log,
        options,
        excerpts,
        recorded,
        status,
        missing,
    })
}

impl Subject {
    pub(crate) fn edition(&self) -> &'static Edition {
        self.options.judge.edition
    }

    /// How the command ends for it.
    pub(crate) const fn status(&self) -> Status {
        self.status
    }

    /// What was required and is missing.
    pub(crate) fn missing(&self) -> Vec<String> {
        self.missing.clone()
    }

    /// The report for a person.
    pub(crate) fn text(&self, args: &CheckArgs, plan: &Plan, name: &str) -> String {
        let line = if self.by_log { report::recognised(&self.recognised) } else { plan.chosen.to_string() };
        let subject = JudgedLog {
            edition: Some(&line),
            name,
            options: &self.options,
            pins: &args.readings,
            required: &args.required,
        };
        report::text(&subject, &self.report, output::width())
    }

    /// How it was judged, a line each.
    pub(crate) fn settings(&self, args: &CheckArgs) -> Vec<String> {
        let subject = JudgedLog {
            edition: None,
            name: "",
            options: &self.options,
            pins: &args.readings,
            required: &args.required,
        };
        subject.settings()
    }

    /// The report for a program; with the name of the log, where it is one of several.
    pub(crate) fn json(&self, args: &CheckArgs, log: Option<&str>) -> String {
        let recognised = self.by_log.then_some(&self.recognised);
        json::text(log, self.edition(), recognised, &self.report, &args.required)
    }
}

/// Judges by the edition of the options, or by the one that the log tells.
fn judge(
    log: impl Entries,
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
