//! The page of the recordings, and of logs that are made to be difficult: what is on it is what was recorded and what was judged.

mod harmless;
mod recorded;
mod said;
mod unpack;

use adsdv_oracle::candump::Reader;
use adsdv_oracle::judge::Report;
use adsdv_oracle::log::{Judged, LogOptions, judge_recognised};
use adsdv_report::{Recorder, Recording, Subject};
use adsdv_spec::Edition;
use serde_json::Value;

/// A log that was judged.
struct Run {
    edition: &'static Edition,
    report: Report,
    recording: Recording,
}

/// Judges a log, as the command does.
fn run(log: &[u8]) -> Run {
    let options = LogOptions::default();
    let mut recorder = Recorder::new(Reader::new(log), options.judge.window_ms);
    let judged = judge_recognised(&mut recorder, &options, |_| {}).expect("a log that can be judged");
    let Judged { report, recognised, interface, .. } = judged;
    Run { edition: recognised.edition, report, recording: recorder.finish(interface.as_deref()) }
}

/// One of the two recordings.
fn recorded(name: &str) -> Vec<u8> {
    let path = format!("{}/../tests/logs/{name}.log", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

impl Run {
    fn subject<'a>(&'a self, name: &'a str, check: &'a str) -> Subject<'a> {
        Subject {
            name,
            settings: &[],
            check,
            edition: self.edition,
            report: &self.report,
            recording: &self.recording,
        }
    }

    /// The data of its page.
    fn data(&self) -> Value {
        let data = self.subject("run.log", "{}").data().expect("data");
        serde_json::from_str(&data).expect("JSON")
    }
}
