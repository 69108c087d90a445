//! The judge of logs, by any edition, on any bytes as text, and on frames at any time, with silences and losses.

use adsdv_oracle::candump::{Direction, Dropped, FrameKind, Record, write_dropped, write_record};
use adsdv_oracle::judge::{Finding, JudgeOptions, Report, Rule, Severity, Verdict};
use adsdv_oracle::log::{LogJudge, LogOptions, judge_log};
use adsdv_spec::Bus;
use adsdv_spec::messages::{AnyMessage, Frame};

use super::Bytes;
use crate::world::{Chance, MS};

/// The interfaces of the logs.
const INTERFACES: [&str; 3] = ["can0", "vcan0", "x"];

/// The choices that make the rest of the bytes the text of a log, judged as usual by the first edition.
pub const AS_TEXT: [u8; 5] = [0, 1, 7, 1, 0];

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let (options, is_text) = choices(&mut bytes);
    if is_text {
        any_text(bytes.rest(), &options);
    } else {
        any_frames(&mut bytes, &options);
    }
}

/// How an input is judged, and its text, if it is one.
pub fn text(bytes: &[u8]) -> Option<(LogOptions, &[u8])> {
    let mut bytes = Bytes::new(bytes);
    let (options, is_text) = choices(&mut bytes);
    is_text.then(|| (options, bytes.rest()))
}

fn choices(bytes: &mut Bytes<'_>) -> (LogOptions, bool) {
    let judge = JudgeOptions::of(bytes.edition());
    let readings = if bytes.one_in(2) { bytes.any() } else { judge.readings };
    let mut below = |n| u32::try_from(bytes.below(n)).unwrap_or(0);
    let (window_ms, deadline_ms) = match below(8) {
        0 => (bytes.any(), bytes.any()),
        1 => (below(200), below(200)),
        _ => (judge.window_ms, judge.deadline_ms),
    };
    let interface = bytes.one_in(8).then(|| bytes.pick(&INTERFACES).to_owned());
    let options = LogOptions {
        judge: JudgeOptions { window_ms, deadline_ms, readings, ..judge },
        interface,
        ..LogOptions::default()
    };
    (options, bytes.one_in(2))
}

fn any_text(log: &[u8], options: &LogOptions) {
    match judge_log(log, options, |_| {}) {
        Ok(report) => sound(&report),
        Err(error) => printed(&error),
    }
}

/// What is printed is text for a terminal.
fn printed(text: &impl ToString) {
    let text = text.to_string();
    assert!(!text.is_empty() && !text.contains(|c: char| c.is_control()), "{text:?}");
}

/// What holds of each report.
fn sound(report: &Report) {
    assert!(report.findings.is_sorted_by_key(|finding| finding.t_ns), "{:#?}", report.findings);
    assert!(report.transitions.is_sorted_by_key(|transition| transition.t_ns));
    let ends = report.duration_ns;
    for transition in &report.transitions {
        assert!((0..=ends).contains(&transition.t_ns), "{transition:?}, and the log ends at {ends}");
        assert_ne!(transition.from, transition.to);
        printed(&transition.section);
    }
    for finding in &report.findings {
        assert!((0..=ends).contains(&finding.t_ns), "{finding:?}, and the log ends at {ends}");
        printed(&finding.message());
        printed(&finding.section);
    }
    let violates = report.findings.iter().any(|finding| finding.severity == Severity::Violation);
    assert_eq!(report.verdict() == Verdict::Violates, violates);
}

/// What is written for a log and given to a judge at once.
struct LiveLog {
    judge: LogJudge,
    log: Vec<u8>,
    /// Whether the log has all that the judge got.
    complete: bool,
    news: (usize, Vec<Finding>),
}

impl LiveLog {
    fn frame(&mut self, record: &Record<'_>) {
        self.complete &= write_record(&mut self.log, record).is_ok();
        self.judge.frame(record);
        self.hear();
    }

    fn hear(&mut self) {
        let (transitions, findings) = self.judge.news();
        self.news.0 += transitions.len();
        self.news.1.extend(findings);
    }
}

fn any_frames(bytes: &mut Bytes<'_>, options: &LogOptions) {
    let judge = LogJudge::new(options.clone());
    let mut all = LiveLog { judge, log: Vec::new(), complete: true, news: (0, Vec::new()) };
    let mut time_ns: i64 = 1_000_000_000;
    let mut fed = 0;
    let bus = &options.judge.edition.bus;
    let mut data = vec![[0; 8]; bus.messages.len()];
    while bytes.are_left() && fed < 4000 {
        time_ns = match bytes.below(16) {
            0 => bytes.any(),
            1 => time_ns.saturating_sub(bytes.below(200).cast_signed() * MS),
            2 => time_ns.saturating_add(bytes.below(20_000).cast_signed() * MS),
            3 => time_ns,
            _ => time_ns.saturating_add(bytes.below(2048).cast_signed() * (MS / 128)),
        };
        match bytes.below(64) {
            0 => {
                let dropped =
                    Dropped { line: 0, interface: bytes.pick(&INTERFACES), count: bytes.any(), total: 0 };
                all.complete &= write_dropped(&mut all.log, &dropped).is_ok();
                all.judge.dropped(&dropped);
                continue;
            }
            1 => {
                // A log cannot say this.
                all.complete = false;
                all.judge.time_passes(time_ns);
                all.hear();
                continue;
            }
            _ => {}
        }
        fed += 1;
        let (id, sent, len) = any_frame(bytes, bus, &mut data);
        let extended = bytes.one_in(64);
        let direction = match bytes.below(16) {
            0 => Some(Direction::Rx),
            1 => Some(Direction::Tx),
            _ => None,
        };
        let kind = match bytes.below(64) {
            0 => FrameKind::Extended,
            1 => FrameKind::Error,
            2 => FrameKind::Remote { extended, len: 0 },
            3 => FrameKind::Fd { extended, flags: 0 },
            _ => FrameKind::Standard,
        };
        let interface = if bytes.one_in(32) { bytes.pick(&INTERFACES) } else { INTERFACES[0] };
        let data = if matches!(kind, FrameKind::Remote { .. }) { &[] } else { &sent[..len] };
        all.frame(&Record { line: 0, time_ns, interface, kind, id, data, direction, terminated: true });
    }
    finish(all, fed, options);
}

/// The identifier, the data and its length: mostly a message with what it said last, or one signal changed.
fn any_frame(bytes: &mut Bytes<'_>, bus: &Bus, said: &mut [[u8; 8]]) -> (u32, [u8; 8], usize) {
    let place = usize::try_from(bytes.below(bus.messages.len() as u64)).unwrap_or(0);
    let (def, last) = (bus.messages[place], &mut said[place]);
    match bytes.below(16) {
        0 => return (bytes.any(), bytes.any(), usize::try_from(bytes.below(9)).unwrap_or(8)),
        1 => *last = bytes.any(),
        2 => {
            let allowed = bytes.0.arbitrary::<AnyMessage>().ok().filter(|message| message.id() == def.id);
            let frame = allowed.and_then(|message| bus.encode(message));
            frame.iter().flat_map(Frame::data).zip(last).for_each(|(byte, place)| *place = *byte);
            return (def.id.into(), said[place], def.len.into());
        }
        3..=7 => {
            let signal = bytes.pick(def.signals);
            let span = i64::from(signal.max) - i64::from(signal.min) + 1;
            let raw = i64::from(signal.min) + bytes.below(span.unsigned_abs()).cast_signed();
            *last = signal.put(*last, i32::try_from(raw).unwrap_or(0));
        }
        8 if bytes.one_in(4) => return (def.id.into(), *last, usize::try_from(bytes.below(9)).unwrap_or(8)),
        _ => {}
    }
    (def.id.into(), *last, def.len.into())
}

fn finish(all: LiveLog, fed: u64, options: &LogOptions) {
    let LiveLog { judge, log, complete, news } = all;
    let lines = log.split_inclusive(|&byte| byte == b'\n').count() as u64;
    let live = judge.finish(lines);
    match &live {
        Ok(report) => {
            sound(report);
            assert_eq!(report.frames, fed);
            assert!(news.0 <= report.transitions.len());
            // What is news is in the report, but for what is counted there.
            for finding in &news.1 {
                let counted = |other: &&Finding| other.rule == finding.rule;
                assert!(
                    report.findings.contains(finding)
                        || finding.rule == Rule::Repeated
                        || report.findings.iter().filter(counted).count() >= 200,
                    "{finding:?} is in no report"
                );
            }
        }
        Err(error) => printed(error),
    }
    if complete {
        let read = judge_log(log.as_slice(), options, |_| {});
        assert_eq!(
            live.map_err(|error| error.to_string()).as_ref().map(plain),
            read.map_err(|error| error.to_string()).as_ref().map(plain),
            "a log says what the bus said"
        );
    }
}

/// A report in words.
fn plain(report: &Report) -> String {
    format!("{report:?}")
}
