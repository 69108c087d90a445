//! Watching a bus that is told what comes.

use std::collections::VecDeque;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use adsdv_can::bus::{Event, Listen, Received, Trouble};
use adsdv_oracle::candump::FrameKind;
use adsdv_oracle::log::LogOptions;
use clap::Parser as _;

use super::*;
use crate::args::{Cli, Command};

/// A bus from which these come, as fast as they are taken; then the command is told to stop.
struct Script(VecDeque<Event>, Arc<AtomicBool>, Arc<Mutex<u64>>);

impl Listen for Script {
    fn name(&self) -> &'static str {
        "script0"
    }

    fn receive(&mut self, until: Instant) -> Event {
        self.0.pop_front().unwrap_or_else(|| {
            self.1.store(true, Ordering::Relaxed);
            thread::sleep(until.saturating_duration_since(Instant::now()).min(Duration::from_millis(5)));
            Event::Nothing
        })
    }

    fn dropped(&self) -> u64 {
        *self.2.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn frame(ms: i64) -> Event {
    let (kind, id, len, data) = (FrameKind::Standard, 0x520, 8, [0, 0, 1, 0, 0, 0, 0, 0]);
    Event::Frame(Received { time_ns: 1_795_209_995_000_000_000 + ms * 1_000_000, kind, id, len, data })
}

fn args(words: &[&str]) -> WatchArgs {
    let words = ["adsdv", "watch", "script0"].iter().chain(words);
    match Cli::try_parse_from(words).map(|cli| cli.command) {
        Ok(Command::Watch(args)) => args,
        other => panic!("{other:?}"),
    }
}

fn watched(events: impl IntoIterator<Item = Event>, dropped: u64) -> Watched {
    let told = Arc::new(AtomicBool::new(false));
    let script = Script(events.into_iter().collect(), Arc::clone(&told), Arc::new(Mutex::new(dropped)));
    // With --json nothing is printed while it is watched.
    let lines = Lines::new(&args(&["--json"]));
    watch(script, &LogOptions::default(), None, lines, &told).expect("it watches")
}

#[test]
fn every_frame_is_judged_however_fast_they_come_and_though_it_is_told_to_stop() {
    let watched = watched((0..100_000).map(frame), 0);
    assert_eq!(watched.watch.traffic().frames, 100_000);
    let report = watched.watch.finish().expect("frames");
    assert_eq!((report.frames, report.duration_ns), (100_000, 99_999_000_000));
}

#[test]
fn trouble_and_dropped_frames_are_in_the_end() {
    let events = [frame(0), Event::Trouble(Trouble::Down), Event::Up, frame(10)];
    let traffic = watched(events, 12).watch.traffic();
    assert_eq!((traffic.frames, traffic.troubles, traffic.dropped), (2, 1, 12));
    let text = lines::traffic(traffic, 10_000_000, Some("run.log"));
    assert_eq!(
        text,
        "bus: 200 frames/s, at most 2; 12 frames dropped, trouble 1 time; recorded in run.log\n"
    );
}
