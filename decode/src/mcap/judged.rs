//! What the judge says: the AS state, what blocks the arrows, and the findings.

use std::io::{self, Write};

use adsdv_oracle::candump::{Entry, Record};
use adsdv_oracle::judge::{Finding, JudgeOptions, Severity};
use adsdv_oracle::log::{LogJudge, LogOptions};
use adsdv_spec::Edition;
use serde_json::{Map, json};

use super::schema::{self, time_value, word};
use super::topics::{JSON, json_schema};
use super::writer::McapWriter;
use crate::Options;
use crate::arrows::{GuardedArrow, condition_name};
use crate::watch::Watch;

/// The topics.
pub(super) const STATE: &str = "/adsdv/as_state";
pub(super) const BLOCKED: &str = "/adsdv/blocked";
pub(super) const FINDINGS: &str = "/adsdv/findings";

/// What does not change is said again after so long, so that it is there wherever somebody begins to look.
const AGAIN_NS: i64 = 1_000_000_000;

/// How the times of a judge become those of the log.
#[derive(Clone, Copy, Debug, Default)]
struct Clock(i64);

impl Clock {
    /// A frame of this time was judged at that one.
    fn set(&mut self, time_ns: i64, judged_at: i64) {
        self.0 = time_ns.saturating_sub(judged_at);
    }

    fn time(self, judged: i64) -> i64 {
        self.0.saturating_add(judged)
    }
}

/// The state and the arrows, of one interface.
pub(super) struct State {
    edition: &'static Edition,
    arrows: Vec<GuardedArrow>,
    channels: Option<(u16, u16)>,
    watch: Option<Watch>,
    clock: Clock,
    /// When it was said last, and the time of the last frame.
    said: Option<i64>,
    last: Option<i64>,
}

impl State {
    pub(super) fn begin<W: Write>(edition: &'static Edition, writer: &mut McapWriter<W>) -> Self {
        let arrows = GuardedArrow::all(edition);
        let metadata = [("edition", edition.version)];
        let mut channel = |topic, definition| {
            let schema = json_schema(writer, &definition)?;
            writer.channel(schema, topic, JSON, &metadata)
        };
        let channels = channel(STATE, schema::of_state()).zip(channel(BLOCKED, schema::of_blocked(&arrows)));
        Self { edition, arrows, channels, watch: None, clock: Clock::default(), said: None, last: None }
    }

    /// Sees a frame; of which interface is known by its name.
    pub(super) fn frame<W: Write>(
        &mut self,
        writer: &mut McapWriter<W>,
        record: &Record<'_>,
        interface: Option<&str>,
    ) -> io::Result<()> {
        let time = record.time_ns;
        self.last = Some(time);
        let mut changed = false;
        if let Some(interface) = interface {
            let watch = self.watch.get_or_insert_with(|| Watch::new(self.edition, interface));
            changed = watch.frame(record);
            self.clock.set(time, watch.judged_at());
        }
        let is_late = |said: i64| !(0..AGAIN_NS).contains(&time.saturating_sub(said));
        if changed || self.said.is_none_or(is_late) { self.say(writer, time) } else { Ok(()) }
    }

    /// Says how it is at this time.
    fn say<W: Write>(&mut self, writer: &mut McapWriter<W>, time: i64) -> io::Result<()> {
        self.said = Some(time);
        let Some((state, blocked)) = self.channels else { return Ok(()) };
        let stay = self.watch.as_ref().and_then(Watch::stay);
        let name = stay.map_or(word(None), |stay| stay.state.name());
        let mut says = json!({"state": name});
        let since = stay.map(|stay| time_value(self.clock.time(stay.since_ns)));
        says.as_object_mut().zip(since).map(|(says, since)| says.insert("since".to_owned(), since));
        writer.message(state, time, |out| put(out, &says))?;
        let mut says = Map::new();
        says.insert("state".to_owned(), name.into());
        for arrow in &self.arrows {
            let now = arrow.now(stay);
            let mut of_arrow = Map::new();
            of_arrow.insert("blocked".to_owned(), word(now.blocked).into());
            let failed = now.by.map(|by| by.failed.as_slice()).unwrap_or_default();
            let by: Vec<_> = failed.iter().map(|one| one.needs(&self.edition.rules)).collect();
            of_arrow.insert("by".to_owned(), by.join(", ").into());
            for condition in &arrow.conditions {
                let holds = word(arrow.holds(*condition, now));
                of_arrow.insert(condition_name(*condition), holds.into());
            }
            says.insert(arrow.name(), of_arrow.into());
        }
        writer.message(blocked, time, |out| put(out, &says.into()))
    }

    pub(super) fn dropped(&mut self, dropped: &adsdv_oracle::candump::Dropped<'_>) {
        if let Some(watch) = &mut self.watch {
            watch.dropped(dropped);
        }
    }

    /// Says it a last time, so that it reaches to the end.
    pub(super) fn finish<W: Write>(&mut self, writer: &mut McapWriter<W>) -> io::Result<()> {
        match self.last {
            Some(last) if self.said != Some(last) => self.say(writer, last),
            _ => Ok(()),
        }
    }
}

/// The findings, as `adsdv check` has them of the same recording.
pub(super) struct Findings {
    judge: Option<LogJudge>,
    begun: bool,
    clock: Clock,
    channel: Option<u16>,
}

impl Findings {
    pub(super) fn begin<W: Write>(options: &Options, writer: &mut McapWriter<W>) -> Self {
        let edition = options.edition.unwrap_or(options.default);
        let interface = options.interface.clone();
        let judging = LogOptions { judge: JudgeOptions::of(edition), interface, ..LogOptions::default() };
        let judge = match options.edition {
            Some(_) => LogJudge::new(judging),
            None => LogJudge::recognising(judging),
        };
        let schema = json_schema(writer, &schema::of_finding());
        let channel = schema.and_then(|schema| writer.channel(schema, FINDINGS, JSON, &[]));
        Self { judge: Some(judge), begun: false, clock: Clock::default(), channel }
    }

    pub(super) fn heard<W: Write>(
        &mut self,
        writer: &mut McapWriter<W>,
        entry: &Entry<'_>,
    ) -> io::Result<()> {
        let Some(judge) = &mut self.judge else { return Ok(()) };
        match entry {
            Entry::Frame(record) => {
                judge.frame(record);
                match judge.judged_at() {
                    Some(judged_at) => self.clock.set(record.time_ns, judged_at),
                    // Until the edition is recognised it is that of the first frame.
                    None if !self.begun => self.clock.set(record.time_ns, 0),
                    None => {}
                }
                self.begun = true;
            }
            Entry::Dropped(dropped) => judge.dropped(dropped),
            Entry::Broken(error) => judge.broken(*error),
        }
        let (_, findings) = judge.news();
        findings.iter().try_for_each(|finding| self.say(writer, finding))
    }

    fn say<W: Write>(&self, writer: &mut McapWriter<W>, finding: &Finding) -> io::Result<()> {
        let Some(channel) = self.channel else { return Ok(()) };
        let time = self.clock.time(finding.t_ns);
        let (rule, section) = (finding.rule.id(), finding.section.to_string());
        let says = json!({
            "timestamp": time_value(time),
            "level": match finding.severity {
                Severity::Note => 2,
                Severity::Warning => 3,
                Severity::Violation => 4,
            },
            "message": format!("{} [{rule}, {section}]", finding.message()),
            "name": finding.party.name(),
            "file": "",
            "line": 0,
            "rule": rule,
            "section": section,
            "requirements": finding.requirements,
        });
        writer.message(channel, time, |out| put(out, &says))
    }

    /// The end of the recording, which had so many lines.
    pub(super) fn finish<W: Write>(&mut self, writer: &mut McapWriter<W>, lines: u64) -> io::Result<()> {
        let Some(judge) = self.judge.take() else { return Ok(()) };
        // A recording without a frame that could be judged is reported by the caller, who decodes it.
        let Ok((_, findings)) = judge.finish_with_news(lines) else { return Ok(()) };
        findings.iter().try_for_each(|finding| self.say(writer, finding))
    }
}

/// Appends it as text; neither JSON nor a vector fails.
fn put(out: &mut Vec<u8>, says: &serde_json::Value) {
    let _ = serde_json::to_writer(out, says);
}
