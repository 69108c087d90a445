//! What is asked of the judge, and a log that was judged: for one log and for many.

use adsdv_formats::Log;
use adsdv_oracle::candump::{Entries, ReadError};
use adsdv_oracle::excerpt::{Excerpts, judge_with_excerpts};
use adsdv_oracle::judge::Report;
use adsdv_oracle::log::{Judged, LogError, LogProgress};
use adsdv_oracle::recognise::Recognised;
use adsdv_report::{Asked, PageError, Recorder, Recording, Subject as PageSubject};
use adsdv_spec::Edition;

use crate::args::{CheckArgs, ChosenEdition};
use crate::error::Error;
use crate::report::JudgedLog;
use crate::status::Status;
use crate::{json, output, pins, report, requires, rules};

/// How logs are judged, by the arguments.
pub(crate) struct Plan {
    chosen: ChosenEdition,
    asked: Asked,
}

impl Plan {
    pub(crate) fn of(args: &CheckArgs) -> Result<Self, Error> {
        let chosen = args.edition.chosen()?;
        let (edition, by_log) = (chosen.edition(), chosen.asked_for().is_none());
        if !by_log {
            requires::possible(edition, &args.required)?;
        }
        let named = Some(edition).filter(|_| !by_log);
        let mut asked = Asked::new(named, &args.readings).map_err(|error| pins::refused(&error))?;
        let judge = &mut asked.options.judge;
        (judge.window_ms, judge.deadline_ms, judge.complete) = (args.window, args.deadline, args.complete);
        let rules = rules::read(args.rules.as_deref(), edition, by_log)?;
        asked.options.rules = rules;
        asked.options.interface.clone_from(&args.interface);
        Ok(Self { chosen, asked })
    }
}

/// A log that was judged.
pub(crate) struct Subject {
    pub(crate) report: Report,
    /// Why not all of the log could be read.
    pub(crate) failure: Option<ReadError>,
    recognised: Recognised,
    asked: Asked,
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
        let mut recorder = Recorder::new(log, plan.asked.options.judge.window_ms);
        let judged = judge(&mut recorder, &plan.asked, with_excerpts, progress);
        (judged, Some(recorder))
    } else {
        (judge(log, &plan.asked, with_excerpts, progress), None)
    };
    let (Judged { report, failure, recognised, interface }, excerpts) = judged.map_err(Failed::Log)?;
    let recorded = heard.map(|recorder| recorder.finish(interface.as_deref()));
    let asked = plan.asked.under(recognised.edition).map_err(|error| Failed::Asked(pins::refused(&error)))?;
    requires::possible(recognised.edition, &args.required).map_err(Failed::Asked)?;
    let status = if failure.is_some() { Status::NoAnswer } else { requires::status(&report, &args.required) };
    let missing = args.required.iter().filter(|one| !report.exercised.meets(**one));
    let missing = missing.map(|one| format!("{one} ({})", one.missing())).collect();
    Ok(Subject { report, failure, recognised, asked, excerpts, recorded, status, missing })
}

impl Subject {
    pub(crate) fn edition(&self) -> &'static Edition {
        self.asked.options.judge.edition
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
        let line =
            if self.asked.by_log { report::recognised(&self.recognised) } else { plan.chosen.to_string() };
        let subject = JudgedLog {
            edition: Some(&line),
            name,
            options: &self.asked.options,
            pins: &args.readings,
            required: &args.required,
        };
        report::text(&subject, &self.report, output::width())
    }

    /// How it was judged, a line each.
    fn settings(&self) -> Vec<String> {
        self.asked.settings()
    }

    /// The report as a page to look at.
    pub(crate) fn page(
        &self,
        args: &CheckArgs,
        name: &str,
        recording: &Recording,
    ) -> Result<String, PageError> {
        let (settings, check) = (self.settings(), self.json(args, None));
        let edition = self.edition();
        let page = PageSubject {
            name,
            settings: &settings,
            check: &check,
            edition,
            report: &self.report,
            recording,
        };
        page.html()
    }

    /// The report for a program; with the name of the log, where it is one of several.
    pub(crate) fn json(&self, args: &CheckArgs, log: Option<&str>) -> String {
        let recognised = self.asked.by_log.then_some(&self.recognised);
        json::text(log, self.edition(), recognised, &self.report, &args.required)
    }
}

/// Judges as it is asked for.
fn judge(
    log: impl Entries,
    asked: &Asked,
    with_excerpts: bool,
    progress: impl FnMut(LogProgress),
) -> Result<(Judged, Option<Excerpts>), LogError> {
    if with_excerpts {
        return judge_with_excerpts(log, &asked.options, asked.by_log, progress)
            .map(|(judged, excerpts)| (judged, Some(excerpts)));
    }
    asked.judge(log, progress).map(|judged| (judged, None))
}
