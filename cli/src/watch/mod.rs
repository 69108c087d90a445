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

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use adsdv_can::bus::{Event, Listen};
use adsdv_can::live::{Traffic, Watch};
use adsdv_can::socket;
use adsdv_oracle::judge::{Options, Report};
use adsdv_oracle::log::{LogError, LogOptions};

use crate::args::WatchArgs;
use crate::error::Error;
use crate::report::{self, Subject};
use crate::status::Status;
use crate::{interrupt, json, output, pins};
use ears::Ears;
use lines::Lines;
use record::Recorder;

pub(crate) fn run(args: &WatchArgs) -> Result<Status, Error> {
    let judge = Options {
        window_ms: args.window,
        deadline_ms: args.deadline,
        readings: pins::possible(&args.readings)?,
    };
    let options = LogOptions { judge, interface: None };
    let told = interrupt::flag().map_err(|error| Error::system("signals", &error))?;
    let listener = socket::listen(&args.interface)?;
    let recorder = args.log.as_deref().map(Recorder::create).transpose()?;
    let lines = Lines::new(args);
    let Watched { watch, recorder, lines } = watch(listener, &options, recorder, lines, &told)?;
    let log = recorder.map_or(Ok(()), Recorder::finish);
    let traffic = watch.traffic();
    let report = watch.finish().map_err(|error| match error {
        LogError::NoFrame { .. } => Error::silent_bus(&args.interface),
        error => Error::log(&args.interface, &error),
    })?;
    if lines.is_read() {
        summarize(args, &options, &report, traffic)?;
    }
    log?;
    Ok(report.verdict().into())
}

/// What there is when watching ends.
struct Watched {
    watch: Watch,
    recorder: Option<Recorder>,
    lines: Lines,
}

/// Watches until it is told to stop, or nobody reads any more.
fn watch(
    listener: impl Listen + Send + 'static,
    options: &LogOptions,
    mut recorder: Option<Recorder>,
    mut lines: Lines,
    told: &AtomicBool,
) -> Result<Watched, Error> {
    let name = listener.name().to_owned();
    let mut watch = Watch::new(&name, options.clone());
    let ears = Ears::start(listener).map_err(|error| Error::system("threads", &error))?;
    lines.begin(&name, recorder.as_ref().map(Recorder::path))?;
    while lines.is_read() && !told.load(Ordering::Relaxed) {
        // Many frames are heard before anything is printed: printing may take its time.
        for heard in ears.take() {
            watch.dropped(heard.dropped);
            match heard.event {
                Event::Frame(frame) => {
                    let frame = watch.frame(&frame);
                    if let Some(recorder) = &mut recorder {
                        recorder.frame(&frame.record(&name));
                    }
                }
                Event::Nothing => watch.silence(heard.now_ns),
                Event::Trouble(trouble) => {
                    watch.trouble(&trouble);
                    lines.trouble(watch.since_first(heard.now_ns), &trouble)?;
                }
                Event::Up => lines.up(watch.since_first(heard.now_ns))?,
            }
        }
        if let Some(recorder) = &mut recorder {
            recorder.flush_now_and_then();
        }
        lines.news(watch.news())?;
    }
    // What the kernel had when it was told to stop is of the run as well.
    for heard in ears.finish() {
        if let Event::Frame(frame) = heard.event {
            watch.dropped(heard.dropped);
            let frame = watch.frame(&frame);
            if let Some(recorder) = &mut recorder {
                recorder.frame(&frame.record(&name));
            }
        }
    }
    lines.news(watch.news())?;
    Ok(Watched { watch, recorder, lines })
}

fn summarize(args: &WatchArgs, options: &LogOptions, report: &Report, traffic: Traffic) -> Result<(), Error> {
    if args.json {
        return output::plain(&json::text(report));
    }
    let subject = Subject { name: &args.interface, options, pins: &args.readings };
    let text = format!(
        "\n{}{}",
        report::text(&subject, report, output::width()),
        lines::traffic(traffic, report.duration_ns, args.log.as_deref().map(Path::display))
    );
    output::styled(&text, args.color)
}

#[cfg(test)]
mod tests;
