//! What a recorder keeps of a run, and what the judge says of it.

use std::collections::HashMap;

use adsdv_oracle::judge::{Judge, JudgeOptions, Report, Severity};
use adsdv_spec::Edition;
use adsdv_spec::messages::{Frame, MessageDef, Node};

use super::random::Random;
use super::{Chance, World};

/// A frame of the recording.
#[derive(Clone, Copy, Debug)]
pub struct Recorded {
    /// When, in nanoseconds.
    pub t: i64,
    /// What.
    pub frame: Frame,
}

impl Recorded {
    /// Who sends such frames, if they are of a message of the document.
    pub fn sender(&self) -> Option<Node> {
        let message = |edition: &&Edition| edition.bus.message(self.frame.id);
        Edition::ALL.iter().find_map(message).map(|message| message.sender)
    }
}

impl World {
    /// Makes every frame of a message since a time show another raw value of a signal.
    ///
    /// # Panics
    ///
    /// The message has to have that signal.
    pub fn falsify(&mut self, message: &MessageDef, signal: &str, since: i64, raw: i32) {
        let signal = message.signal(signal).expect("a signal of the message");
        let shown = |recorded: &&mut Recorded| recorded.frame.id == message.id && recorded.t >= since;
        for recorded in self.log.iter_mut().filter(shown) {
            recorded.frame.data = signal.put(recorded.frame.data, raw);
        }
    }

    /// The recording with each time stamp late by up to `jitter`, and one in `loss` frames lost.
    pub fn disturbed(&self, seed: u64, jitter: i64, loss: u64) -> Vec<Recorded> {
        let mut random = Random::with_seed(seed);
        // A recorder may swap messages, but not two of the same identifier.
        let mut last = HashMap::new();
        let mut log: Vec<Recorded> = self
            .log
            .iter()
            .filter_map(|recorded| {
                let late = if jitter > 0 { random.below(jitter.unsigned_abs()).cast_signed() } else { 0 };
                let missing = loss > 0 && random.one_in(loss);
                let before = last.entry(recorded.frame.id).or_insert(0);
                let t = (recorded.t + late).max(*before);
                *before = t;
                (!missing).then_some(Recorded { t, ..*recorded })
            })
            .collect();
        log.sort_by_key(|recorded| recorded.t);
        log
    }
}

/// What the judge says of a recording.
pub fn judge(log: &[Recorded], options: JudgeOptions) -> Report {
    let mut judge = Judge::new(options);
    let origin = log.first().map_or(0, |first| first.t);
    for recorded in log {
        judge.frame(recorded.t - origin, recorded.frame.id.into(), recorded.frame.data());
    }
    judge.finish()
}

/// The findings that matter, a line each.
pub fn violations(report: &Report) -> Vec<String> {
    report
        .findings
        .iter()
        .filter(|finding| finding.severity == Severity::Violation)
        .map(|f| {
            #[allow(clippy::cast_precision_loss)]
            let t = f.t_ns as f64 / 1e9;
            format!("{t:.3} {} {} {}: {}", f.party.name(), f.section, f.rule.id(), f.message())
        })
        .collect()
}
