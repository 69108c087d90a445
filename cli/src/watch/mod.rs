//! `adsdv watch`: the judge of a live bus.
//!
//! ```text
//! bus --> Ears (a thread that does nothing else) --> judge --> lines, as it is certain of something
//!                                                |--> log     --> summary, in the end
//!                                                |--> pages
//! ```
//!
//! It has nothing to send with: what it opens can only listen. Where another program hears the bus, `piped` takes the place of the ears.

mod audience;
mod ears;
mod lines;
mod news;
mod piped;
mod record;
#[cfg(test)]
mod tests;
mod waits;
mod web;

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use adsdv_can::bus::{Event, Listen};
use adsdv_can::live::{Outage, Traffic, Watch};
use adsdv_can::socket;
use adsdv_oracle::judge::{JudgeOptions, Report};
use adsdv_oracle::log::{LogError, LogJudge, LogOptions};
use adsdv_oracle::recognise::Recognised;

use crate::args::{ChosenEdition, WatchArgs};
use crate::error::Error;
use crate::report::{self, JudgedLog};
use crate::status::Status;
use crate::{interrupt, json, output, pins, rules};
use audience::Audience;
use ears::{Arrival, Ears};
use lines::Lines;
use news::News;
use piped::Piped;
use record::Recorder;
use web::Pages;

pub(crate) fn run(args: &WatchArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let by_bus = chosen.asked_for().is_none();
    let possible = if by_bus { pins::possible_in_some } else { pins::possible };
    let judge = JudgeOptions {
        window_ms: args.window,
        deadline_ms: args.deadline,
        readings: possible(chosen.edition(), &args.readings)?,
        ..JudgeOptions::of(chosen.edition())
    };
    let rules = rules::read(args.rules.as_deref(), chosen.edition(), by_bus)?;
    let mut options = LogOptions { judge, interface: None, rules };
    let stop = interrupt::flag().map_err(|error| Error::system("signals", &error))?;
    let news = News::new(Lines::new(args, chosen), options.rules.clone());
    let heard = if args.interface == piped::STDIN {
        // Who opens the page need not wait for the first line.
        let audience = audience(args, chosen, piped::NAME)?;
        let log = piped::open(&stop)?;
        Heard::piped(piped::watch(log, judge_of(&options, by_bus), audience, news, &stop))
    } else {
        let listener =
            socket::listen(&args.interface).map_err(|error| Error::interface(&args.interface, error))?;
        let audience = audience(args, chosen, listener.name())?;
        Heard::on_bus(watch(listener, &options, audience, news, &stop)?)
    };
    let Heard { name, recognised, report, traffic, outages, audience, lines, failure } = heard;
    let Audience { recorder, pages } = audience;
    let log = recorder.map_or(Ok(()), Recorder::finish);
    if let Some(recognised) = &recognised {
        options.judge = options.judge.under(recognised.edition);
    }
    let report = report.map_err(|error| match (error, &args.rules) {
        (LogError::NoFrame { .. }, _) if args.interface != piped::STDIN => Error::silent_bus(&name),
        (LogError::Rules(error), Some(file)) => rules::refused(file, &error),
        (error, _) => Error::log(&name, &error),
    });
    let printed = match &report {
        Ok(report) if lines.is_read() => {
            let line = recognised.as_ref().map_or_else(|| chosen.to_string(), report::recognised);
            let judged = Judged { name, line, recognised, options };
            summarize(args, &judged, report, &json::Bus { traffic, outages: &outages })
        }
        _ => lines.finish(),
    };
    if let Some(pages) = pages {
        let piped = args.interface == piped::STDIN;
        let why = if stop.load(Ordering::Relaxed) { "it was stopped" } else { "no more frames come" };
        pages.end(why, &stop, piped);
    }
    // All that went wrong is reported, what ended the watching last.
    let (verdict, report) = match report {
        Ok(report) => (Some(report.verdict()), Ok(())),
        Err(error) => (None, Err(error)),
    };
    let read = failure.map_or(Ok(()), Err);
    let mut errors: Vec<Error> = [report, log, printed, read].into_iter().filter_map(Result::err).collect();
    match (errors.pop(), verdict) {
        (None, Some(verdict)) => Ok(verdict.into()),
        (Some(last), _) => {
            for error in &errors {
                error.print();
            }
            Err(last)
        }
        (None, None) => Ok(Status::NoAnswer),
    }
}

fn audience(args: &WatchArgs, chosen: ChosenEdition, name: &str) -> Result<Audience, Error> {
    // An address that cannot be had leaves the log as it was.
    let pages = Pages::serve(args, chosen, name)?;
    Ok(Audience { recorder: args.log.as_deref().map(Recorder::create).transpose()?, pages })
}

fn judge_of(options: &LogOptions, by_bus: bool) -> LogJudge {
    if by_bus { LogJudge::recognising(options.clone()) } else { LogJudge::new(options.clone()) }
}

/// What came of watching, wherever the frames came from.
struct Heard {
    name: String,
    recognised: Option<Recognised>,
    report: Result<Report, LogError>,
    traffic: Traffic,
    outages: Vec<Outage>,
    audience: Audience,
    lines: Lines,
    /// Why no more could be read.
    failure: Option<Error>,
}

impl Heard {
    fn on_bus(watched: Watched) -> Self {
        let Watched { name, watch, audience, news } = watched;
        let (traffic, outages) = (watch.traffic(), watch.outages().to_vec());
        let recognised = watch.recognised().cloned();
        let (report, lines) = (watch.finish(), news.lines);
        Self { name, recognised, report, traffic, outages, audience, lines, failure: None }
    }

    fn piped(piped: Piped) -> Self {
        let Piped { judge, traffic, audience, news, lines: count, failure } = piped;
        let recognised = judge.recognised().cloned();
        let (name, report) = (piped::NAME.to_owned(), judge.finish(count));
        Self { name, recognised, report, traffic, outages: Vec::new(), audience, lines: news.lines, failure }
    }
}

/// What there is while a bus is watched, and when that ends.
struct Watched {
    name: String,
    watch: Watch,
    audience: Audience,
    news: News,
}

/// Watches until it is stopped, or nothing can be printed any more.
///
/// What waits for the edition is judged in the end, however short the run was.
fn watch(
    listener: impl Listen + Send + 'static,
    options: &LogOptions,
    audience: Audience,
    mut news: News,
    stop: &AtomicBool,
) -> Result<Watched, Error> {
    let name = listener.name().to_owned();
    let begin = if news.lines.is_named() { Watch::new } else { Watch::recognising };
    let watch = begin(&name, options.clone());
    let ears = Ears::start(listener).map_err(|error| Error::system("threads", &error))?;
    news.lines.begin(&name, audience.log());
    let mut watched = Watched { name, watch, audience, news };
    while watched.news.lines.is_read() && !stop.load(Ordering::Relaxed) {
        // Many frames are heard before anything is printed: printing may take its time.
        ears.take().into_iter().for_each(|heard| watched.hear(heard));
        watched.audience.flush_now_and_then();
        watched.print_news();
    }
    // What the kernel had when it was stopped is of the run as well.
    ears.finish().into_iter().for_each(|heard| watched.hear(heard));
    watched.watch.decide();
    watched.print_news();
    Ok(watched)
}

impl Watched {
    fn hear(&mut self, heard: Arrival) {
        let Self { name, watch, audience, news } = self;
        let Arrival { event, dropped, now_ns } = heard;
        if let Some(lost) = watch.dropped(dropped) {
            audience.dropped(&lost);
        }
        match event {
            Event::Frame(frame) => {
                let frame = watch.frame(&frame);
                audience.frame(&frame.record(name));
            }
            Event::Nothing => watch.silence(now_ns),
            Event::Disturbance(trouble) => {
                watch.trouble(now_ns, &trouble);
                news.lines.trouble(watch.since_first(now_ns), &trouble);
            }
            Event::Up => {
                watch.up(now_ns);
                news.lines.up(watch.since_first(now_ns));
            }
        }
    }

    fn print_news(&mut self) {
        self.news.print(self.watch.judge());
        self.news.print_waits(self.watch.judge());
    }
}

/// How a bus was judged in the end.
struct Judged {
    name: String,
    /// The line about the edition.
    line: String,
    /// How that was recognised, where nobody named it.
    recognised: Option<Recognised>,
    options: LogOptions,
}

fn summarize(args: &WatchArgs, judged: &Judged, report: &Report, bus: &json::Bus<'_>) -> Result<(), Error> {
    let Judged { name, line, recognised, options } = judged;
    if args.json {
        return output::plain(&json::watched(options.judge.edition, recognised.as_ref(), report, bus));
    }
    let subject = JudgedLog { edition: Some(line), name, options, pins: &args.readings, required: &[] };
    let text = format!(
        "\n{}{}",
        report::text(&subject, report, output::width()),
        lines::traffic(bus.traffic, report.duration_ns, args.log.as_deref().map(Path::display))
    );
    output::styled(&text, args.color)
}
