//! A bus that somebody else hears, judged while its frames come: the lines that `adsdv watch --web` streams.

use std::fmt::Write as _;
use std::io::{Cursor, Read};

use adsdv_oracle::candump::{Entry, FrameKind, Reader, Record};
use adsdv_oracle::judge::{Severity, Verdict};
use adsdv_oracle::log::LogJudge;
use adsdv_oracle::why::Stay;
use adsdv_report::Asked;
use adsdv_report::json::{FindingJson, StayJson, seconds};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Edition, Machine};
use serde::Serialize;
use serde_json::Value;

use crate::drive::{BegunJson, ChangeJson};
use crate::error::Refusal;
use crate::subject;

/// A bus that is heard.
#[derive(Debug)]
pub(crate) struct Live {
    judge: LogJudge,
    /// The edition whose figure the page has.
    shown: Option<&'static str>,
    frames: u64,
    broken: u64,
    violations: usize,
}

/// What is new since the page asked before, and how all stands.
#[derive(Serialize)]
pub(crate) struct HeardJson {
    /// When the last frame came, in seconds since the first; `None` as long as the edition is to be recognised.
    t: Option<f64>,
    interface: Option<String>,
    frames: u64,
    /// How many lines were none that can be read.
    broken: u64,
    verdict: &'static str,
    /// What the page needs to begin, once it is known by which edition the bus is judged.
    begun: Option<BegunJson>,
    state: Option<&'static str>,
    in_state: f64,
    /// What is known of the conditions of Figure 2.
    known: Vec<(&'static str, &'static str)>,
    /// What blocks the arrows from here now.
    stay: Option<StayJson>,
    /// Of each message its last data, and how many frames came.
    messages: Vec<(f64, u16, String, u64)>,
    transitions: Vec<ChangeJson>,
    findings: Vec<Value>,
}

/// The last frame of a message, and how many came.
struct Last {
    id: u32,
    time_ns: i64,
    data: Vec<u8>,
    count: u64,
}

impl Live {
    /// By an edition, `None` where the frames are to tell it, and with readings that are pinned.
    pub(crate) fn begin(edition: Option<&str>, readings: &[String]) -> Result<Self, Refusal> {
        let (edition, pins) = (subject::edition(edition)?, subject::readings(readings)?);
        let asked = Asked::new(edition, &pins).map_err(|error| Refusal::pin(&error))?;
        let begin = if asked.by_log { LogJudge::recognising } else { LogJudge::new };
        let judge = begin(asked.options);
        Ok(Self { judge, shown: None, frames: 0, broken: 0, violations: 0 })
    }

    /// Hears lines of a log, as candump writes them, of which so many before were lost.
    pub(crate) fn hear(&mut self, lines: &str, missed: u64) -> Result<HeardJson, Refusal> {
        if missed > 0 {
            self.judge.lost(missed);
        }
        let mut last: Vec<Last> = Vec::new();
        // Of the kind that reads files, so that the module has one.
        let source: Box<dyn Read + Send> = Box::new(Cursor::new(lines.to_owned()));
        let mut reader = Reader::new(source);
        loop {
            match reader.next_record() {
                Ok(Some(Entry::Frame(record))) => {
                    self.frames += 1;
                    self.judge.frame(&record);
                    take_down(&mut last, &record);
                }
                Ok(Some(Entry::Dropped(dropped))) => self.judge.dropped(&dropped),
                Ok(Some(Entry::Broken(error))) => {
                    self.broken += 1;
                    self.judge.broken(error);
                }
                Ok(None) => break,
                Err(error) => return Err(Refusal::of_request(error.to_string())),
            }
        }
        Ok(self.json(&last))
    }

    /// Nothing comes any more: what waits for the edition is judged.
    pub(crate) fn end(&mut self) -> HeardJson {
        self.judge.decide();
        self.json(&[])
    }

    fn json(&mut self, last: &[Last]) -> HeardJson {
        let (transitions, findings) = self.judge.news();
        self.violations += findings.iter().filter(|one| one.severity == Severity::Violation).count();
        let judged_at = self.judge.judged_at().filter(|_| self.frames > 0);
        let state = self.judge.state();
        let (known, rules) = (self.judge.known(), &self.judge.edition().rules);
        HeardJson {
            t: judged_at.map(seconds),
            interface: self.judge.interface().map(str::to_owned),
            frames: self.frames,
            broken: self.broken,
            verdict: if self.violations > 0 { Verdict::Violates } else { Verdict::Conforms }.name(),
            state: state.map(AsState::name),
            in_state: self.judge.waits().map_or(0.0, |(now, stay)| seconds(now - stay.since_ns)),
            known: Atom::ALL.iter().map(|atom| (atom.id(), known.of(*atom).name())).collect(),
            stay: self.judge.waits().map(|(_, stay)| StayJson::of(rules, &latest(stay))),
            messages: last.iter().filter_map(message).collect(),
            transitions: transitions.iter().map(ChangeJson::of).collect(),
            findings: findings
                .iter()
                .filter_map(|finding| serde_json::to_value(FindingJson::from(finding)).ok())
                .collect(),
            begun: judged_at.and_then(|_| self.begun()),
        }
    }

    /// What a page needs that has not the figure of the edition that is judged by.
    fn begun(&mut self) -> Option<BegunJson> {
        let edition = Edition::find(self.judge.edition().version)?;
        (self.shown != Some(edition.version)).then(|| {
            self.shown = Some(edition.version);
            BegunJson::of(&Machine::new(*edition, edition.readings), edition)
        })
    }
}

fn take_down(last: &mut Vec<Last>, record: &Record<'_>) {
    if record.kind != FrameKind::Standard {
        return;
    }
    let (id, time_ns) = (record.id, record.time_ns);
    // There are some thirty.
    match last.iter_mut().find(|one| one.id == id) {
        Some(one) => {
            record.data.clone_into(&mut one.data);
            (one.time_ns, one.count) = (time_ns, one.count + 1);
        }
        None => last.push(Last { id, time_ns, data: record.data.to_vec(), count: 1 }),
    }
}

fn message(Last { id, time_ns, data, count }: &Last) -> Option<(f64, u16, String, u64)> {
    let mut hex = String::new();
    for byte in data {
        // Memory takes it.
        let _ = write!(hex, "{byte:02X}");
    }
    Some((seconds(*time_ns), u16::try_from(*id).ok()?, hex, *count))
}

/// A state with what blocks its arrows now; what blocked them before may be much.
fn latest(stay: &Stay) -> Stay {
    let mut stay = stay.clone();
    for arrow in &mut stay.arrows {
        let old = arrow.blocked.len().saturating_sub(1);
        arrow.blocked.drain(..old);
    }
    stay
}
