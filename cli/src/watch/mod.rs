//! `adsdv watch`: the judge of a live bus.
//!
//! ```text
//! bus --> Ears (a thread that does nothing else) --> judge --> lines, as it is certain of something
//!                                                |--> log     --> summary, in the end
//! ```
//!
//! It has nothing to send with: what it opens can only listen.

mod ears;
mod lines;
mod record;
#[cfg(test)]
mod tests;
mod waits;

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use adsdv_can::bus::{Event, Listen};
use adsdv_can::live::Watch;
use adsdv_can::socket;
use adsdv_oracle::judge::{JudgeOptions, Report};
use adsdv_oracle::log::{LogError, LogOptions};
use adsdv_oracle::recognise::Recognised;
use adsdv_oracle::rules::RuleFile;

use crate::args::WatchArgs;
use crate::error::Error;
use crate::report::{self, JudgedLog};
use crate::status::Status;
use crate::{interrupt, json, output, pins, rules};
use ears::{Arrival, Ears};
use lines::Lines;
use record::Recorder;
use waits::Waits;

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
    let listener = socket::listen(&args.interface)?;
    let recorder = args.log.as_deref().map(Recorder::create).transpose()?;
    let lines = Lines::new(args, chosen);
    let Watched { watch, recorder, lines, .. } = watch(listener, &options, recorder, lines, &stop)?;
    let log = recorder.map_or(Ok(()), Recorder::finish);
    let (traffic, outages) = (watch.traffic(), watch.outages().to_vec());
    let recognised = watch.recognised().cloned();
    if let Some(recognised) = &recognised {
        options.judge = options.judge.under(recognised.edition);
    }
    let report = watch.finish().map_err(|error| match (error, &args.rules) {
        (LogError::NoFrame { .. }, _) => Error::silent_bus(&args.interface),
        (LogError::Rules(error), Some(file)) => rules::refused(file, &error),
        (error, _) => Error::log(&args.interface, &error),
    });
    let printed = match &report {
        Ok(report) if lines.is_read() => {
            let line = recognised.as_ref().map_or_else(|| chosen.to_string(), report::recognised);
            let judged = Judged { line, recognised, options };
            summarize(args, &judged, report, &json::Bus { traffic, outages: &outages })
        }
        _ => lines.finish(),
    };
    // All that went wrong is reported, what ended the watching last.
    let (verdict, report) = match report {
        Ok(report) => (Some(report.verdict()), Ok(())),
        Err(error) => (None, Err(error)),
    };
    let mut errors: Vec<Error> = [report, log, printed].into_iter().filter_map(Result::err).collect();
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

/// What there is while it is watched, and when that ends.
struct Watched {
    name: String,
    watch: Watch,
    recorder: Option<Recorder>,
    lines: Lines,
    waits: Waits,
    /// The user's own rules, which the edition that is recognised has to have.
    rules: Option<RuleFile>,
    /// Which edition was recognised has been said.
    is_recognised: bool,
}

/// Watches until it is stopped, or nothing can be printed any more.
///
/// What waits for the edition is judged in the end, however short the run was.
fn watch(
    listener: impl Listen + Send + 'static,
    options: &LogOptions,
    recorder: Option<Recorder>,
    mut lines: Lines,
    stop: &AtomicBool,
) -> Result<Watched, Error> {
    let name = listener.name().to_owned();
    let begin = if lines.is_named() { Watch::new } else { Watch::recognising };
    let watch = begin(&name, options.clone());
    let ears = Ears::start(listener).map_err(|error| Error::system("threads", &error))?;
    lines.begin(&name, recorder.as_ref().map(Recorder::path));
    let mut watched = Watched {
        name,
        watch,
        recorder,
        lines,
        waits: Waits::default(),
        rules: options.rules.clone(),
        is_recognised: false,
    };
    while watched.lines.is_read() && !stop.load(Ordering::Relaxed) {
        // Many frames are heard before anything is printed: printing may take its time.
        ears.take().into_iter().for_each(|heard| watched.hear(heard));
        if let Some(recorder) = &mut watched.recorder {
            recorder.flush_now_and_then();
        }
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
        let Self { name, watch, recorder, lines, .. } = self;
        let Arrival { event, dropped, now_ns } = heard;
        if let Some(lost) = watch.dropped(dropped)
            && let Some(recorder) = recorder
        {
            recorder.dropped(&lost);
        }
        match event {
            Event::Frame(frame) => {
                let frame = watch.frame(&frame);
                if let Some(recorder) = recorder {
                    recorder.frame(&frame.record(name));
                }
            }
            Event::Nothing => watch.silence(now_ns),
            Event::Disturbance(trouble) => {
                watch.trouble(now_ns, &trouble);
                lines.trouble(watch.since_first(now_ns), &trouble);
            }
            Event::Up => {
                watch.up(now_ns);
                lines.up(watch.since_first(now_ns));
            }
        }
    }

    fn print_news(&mut self) {
        if let Some(recognised) = self.watch.recognised().filter(|_| !self.is_recognised) {
            self.is_recognised = true;
            self.lines.recognised(recognised);
            if self.rules.as_ref().is_some_and(|rules| rules.check(recognised.edition).is_err()) {
                // The end tells why.
                self.lines.end();
            }
        }
        let news = self.watch.news();
        let rules = &self.watch.edition().rules;
        self.lines.news(rules, news);
        let waits = self.watch.waits().and_then(|(t, stay)| Some((t, self.waits.news(rules, t, stay)?)));
        if let Some((t, text)) = waits {
            self.lines.waits(t, &text);
        }
    }
}

/// How a bus was judged in the end.
struct Judged {
    /// The line about the edition.
    line: String,
    /// How that was recognised, where nobody named it.
    recognised: Option<Recognised>,
    options: LogOptions,
}

fn summarize(args: &WatchArgs, judged: &Judged, report: &Report, bus: &json::Bus<'_>) -> Result<(), Error> {
    let Judged { line, recognised, options } = judged;
    if args.json {
        return output::plain(&json::watched(options.judge.edition, recognised.as_ref(), report, bus));
    }
    let (name, pins) = (&args.interface, &args.readings);
    let subject = JudgedLog { edition: Some(line), name, options, pins, required: &[] };
    let text = format!(
        "\n{}{}",
        report::text(&subject, report, output::width()),
        lines::traffic(bus.traffic, report.duration_ns, args.log.as_deref().map(Path::display))
    );
    output::styled(&text, args.color)
}
