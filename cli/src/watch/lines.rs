//! What is printed while the bus is watched.

use std::fmt::{self, Display, Write as _};
use std::path::Path;

use adsdv_can::bus::Disturbance;
use adsdv_can::live::Traffic;
use adsdv_oracle::judge::{Finding, Transition};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::{Choice, Rules};
use clap::ColorChoice;

use crate::args::{ChosenEdition, WatchArgs};
use crate::error::Error;
use crate::layout::{Seconds, counted, wrapped};
use crate::report::style::{self, Styled};
use crate::{output, pins, report};

/// Prints lines, unless JSON was asked for, which comes in the end.
pub(super) struct Lines {
    color: ColorChoice,
    edition: ChosenEdition,
    pins: Vec<Choice>,
    quiet: bool,
    read: bool,
    failed: Option<Error>,
}

impl Lines {
    pub(super) fn new(args: &WatchArgs, edition: ChosenEdition) -> Self {
        let pins = args.readings.clone();
        Self { edition, pins, color: args.color, quiet: args.json, read: true, failed: None }
    }

    /// Whether somebody has named the edition, so that it need not be recognised.
    pub(super) fn is_named(&self) -> bool {
        self.edition.asked_for().is_some()
    }

    /// Whether anybody still reads what is printed, and it can be.
    pub(super) fn is_read(&self) -> bool {
        self.read
    }

    /// Why nothing could be printed any more, unless it is that nobody reads.
    pub(super) fn finish(self) -> Result<(), Error> {
        self.failed.map_or(Ok(()), Err)
    }

    pub(super) fn begin(&mut self, bus: &str, log: Option<&Path>) {
        let recorded = log.map(|log| format!(", recorded in {}", log.display())).unwrap_or_default();
        self.print(&format!("{}\n{bus} is watched{recorded}; Ctrl-C stops\n", self.edition()));
    }

    /// The first line.
    pub(super) fn edition(&self) -> String {
        if self.is_named() {
            self.edition.to_string()
        } else {
            "edition as the frames tell; --edition names one".to_owned()
        }
    }

    /// Which edition the frames tell, and by what. One in which a reading that was pinned is no answer ends the watching.
    pub(super) fn recognised(&mut self, recognised: &Recognised) {
        self.print(&format!("{}\n", report::recognised(recognised)));
        if let Err(error) = pins::possible(recognised.edition, &self.pins) {
            self.note(Err(error));
        }
    }

    /// Nobody is to read any more: why, the caller reports.
    pub(super) fn end(&mut self) {
        self.read = false;
    }

    /// What the judge found.
    pub(super) fn news(&mut self, rules: &Rules, (transitions, findings): (Vec<Transition>, Vec<Finding>)) {
        if !transitions.is_empty() || !findings.is_empty() {
            self.print(&report::news(rules, &transitions, &findings, output::width()));
        }
    }

    /// What the car waits for.
    pub(super) fn waits(&mut self, t_ns: i64, text: &str) {
        let mut lines = String::new();
        wrapped(&mut lines, text.split(' '), report::INDENT, output::width());
        self.print(&format!("{:>10} s  {}{}", Seconds(t_ns), Styled(style::QUIET, "waits\n"), lines));
    }

    /// What happened to the bus, at a time since the first frame.
    pub(super) fn trouble(&mut self, t_ns: i64, trouble: &Disturbance) {
        self.print(&format!("{:>10} s  {}\n", Seconds(t_ns), Styled(style::BAD, trouble)));
    }

    pub(super) fn up(&mut self, t_ns: i64) {
        self.print(&format!("{:>10} s  {}\n", Seconds(t_ns), Styled(style::GOOD, "the bus is there again")));
    }

    fn print(&mut self, text: &str) {
        if self.quiet || !self.read {
            return;
        }
        // The run is not over with it: what was heard is still judged and recorded, and then this is reported.
        self.note(output::follow(text, self.color));
    }

    pub(super) fn note(&mut self, printed: Result<bool, Error>) {
        self.read = printed.unwrap_or_else(|error| {
            self.failed = Some(error);
            false
        });
    }
}

/// What went over the bus, for the end.
pub(super) fn traffic(traffic: Traffic, duration_ns: i64, log: Option<impl Display>) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_traffic(&mut text, traffic, duration_ns, log);
    text
}

fn write_traffic(
    out: &mut String,
    traffic: Traffic,
    duration_ns: i64,
    log: Option<impl Display>,
) -> fmt::Result {
    let Traffic { frames, errors, dropped, troubles, busiest, .. } = traffic;
    let ms = u64::try_from(duration_ns / 1_000_000).unwrap_or(0);
    let mean = frames.saturating_mul(1000).checked_div(ms).unwrap_or(frames);
    write!(out, "bus: {mean} frames/s, at most {busiest}; {} dropped", counted(dropped, "frame"))?;
    if errors > 0 {
        write!(out, ", {}", counted(errors, "error frame"))?;
    }
    if troubles > 0 {
        write!(out, ", trouble {}", counted(troubles, "time"))?;
    }
    match log {
        Some(log) => writeln!(out, "; recorded in {log}"),
        None => writeln!(out),
    }
}
