//! A comparison of two recordings. `cli/schema/compare.schema.json` describes it.

use adsdv_oracle::compare::{
    Comparison, FoundOnce, FrameDiffers, LastedDiffers, MarginDiffers, OnlyTransition, Parting, Range,
    RangeDiffers, Recording, Sequence, SequenceDiffers, Way, Which,
};
use adsdv_oracle::judge::ResponseTimes;
use serde::Serialize;

use super::exercised::MarginJson;
use super::finding::FindingJson;
use super::number::{seconds, to_microseconds};
use super::recognised::RecognisedJson;
use super::response::ResponseJson;
use super::stays::BlockedJson;
use super::{SCHEMA, line};

/// A comparison as one JSON object on one line.
pub fn compared(good: &Recording, bad: &Recording, comparison: &Comparison<'_>) -> String {
    let rules = [&good.edition.rules, &bad.edition.rules];
    line(&CompareJson {
        schema: SCHEMA,
        good: RecordingJson::of(good),
        bad: RecordingJson::of(bad),
        differs: comparison.differs(),
        begin: comparison.begin.map(|[good, bad]| PairJson { good: good.name(), bad: bad.name() }),
        parting: comparison.parting.as_ref().map(|parting| PartingJson::of(rules, parting)),
        transitions: comparison.transitions.iter().map(OnlyTransitionJson::from).collect(),
        lasted: comparison.lasted.iter().map(LastedJson::from).collect(),
        findings: comparison.found.iter().map(FoundJson::from).collect(),
        ranges: comparison.ranges.iter().filter_map(RangesJson::of).collect(),
        sequences: comparison.sequences.iter().map(SequencesJson::from).collect(),
        frames: comparison.frames.iter().map(FramesJson::from).collect(),
        margins: comparison.margins.iter().map(MarginsJson::from).collect(),
        handshake_response_ms: comparison.answers.as_ref().map(|answers| AnswersJson::of(&answers.times)),
    })
}

#[derive(Serialize)]
struct CompareJson<'a> {
    schema: u32,
    good: RecordingJson<'a>,
    bad: RecordingJson<'a>,
    differs: bool,
    begin: Option<PairJson<&'static str>>,
    parting: Option<PartingJson>,
    transitions: Vec<OnlyTransitionJson>,
    lasted: Vec<LastedJson>,
    findings: Vec<FoundJson<'a>>,
    ranges: Vec<RangesJson>,
    sequences: Vec<SequencesJson>,
    frames: Vec<FramesJson>,
    margins: Vec<MarginsJson>,
    handshake_response_ms: Option<AnswersJson>,
}

#[derive(Serialize)]
struct RecordingJson<'a> {
    edition: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    recognised: Option<RecognisedJson<'a>>,
    frames: u64,
    duration_s: f64,
    verdict: &'static str,
}

#[derive(Serialize)]
struct PartingJson {
    state: &'static str,
    good: WayJson,
    bad: WayJson,
    missed: Option<MissedJson>,
}

#[derive(Serialize)]
struct WayJson {
    since: f64,
    until: f64,
    to: Option<&'static str>,
    section: Option<&'static str>,
    justified: Option<&'static str>,
}

#[derive(Serialize)]
struct MissedJson {
    by: &'static str,
    to: &'static str,
    blocked: Vec<BlockedJson>,
}

#[derive(Serialize)]
struct OnlyTransitionJson {
    only: &'static str,
    t: f64,
    from: &'static str,
    to: &'static str,
}

#[derive(Serialize)]
struct LastedJson {
    state: &'static str,
    good: SpanJson,
    bad: SpanJson,
}

#[derive(Serialize)]
struct SpanJson {
    since: f64,
    lasted: f64,
}

#[derive(Serialize)]
struct FoundJson<'a> {
    only: &'static str,
    count: u64,
    first: FindingJson<'a>,
}

#[derive(Serialize)]
struct RangesJson {
    state: &'static str,
    again: bool,
    message: String,
    signal: &'static str,
    unit: &'static str,
    good: Option<RangeJson>,
    bad: Option<RangeJson>,
}

#[derive(Serialize)]
struct RangeJson {
    min: f64,
    max: f64,
}

#[derive(Serialize)]
struct SequencesJson {
    state: &'static str,
    again: bool,
    signal: &'static str,
    good: SequenceJson,
    bad: SequenceJson,
}

#[derive(Serialize)]
struct SequenceJson {
    values: Vec<String>,
    more: bool,
}

#[derive(Serialize)]
struct FramesJson {
    id: String,
    name: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    only: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cycle_ms: Option<PairJson<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lengths: Option<PairJson<Vec<u32>>>,
}

#[derive(Serialize)]
struct MarginsJson {
    matters: Option<&'static str>,
    good: Option<MarginJson>,
    bad: Option<MarginJson>,
}

#[derive(Serialize)]
struct PairJson<T> {
    good: T,
    bad: T,
}

#[derive(Serialize)]
struct AnswersJson {
    good: Option<ResponseJson>,
    bad: Option<ResponseJson>,
}

impl<'a> RecordingJson<'a> {
    fn of(recording: &'a Recording) -> Self {
        Self {
            edition: recording.edition.version,
            recognised: recording.recognised.as_ref().map(RecognisedJson::of),
            frames: recording.report.frames,
            duration_s: seconds(recording.report.duration_ns),
            verdict: recording.report.verdict().name(),
        }
    }
}

const fn which(which: Which) -> &'static str {
    match which {
        Which::Good => "good",
        Which::Bad => "bad",
    }
}

impl PartingJson {
    fn of(rules: [&adsdv_spec::Rules; 2], parting: &Parting<'_>) -> Self {
        let missed = parting.missed().map(|(by, to)| {
            let rules = if by == Which::Good { rules[0] } else { rules[1] };
            let untaken = parting.way(by).untaken(to);
            let blocked = untaken.iter().flat_map(|untaken| &untaken.blocked);
            let blocked = blocked.map(|blocked| BlockedJson::of(rules, blocked)).collect();
            MissedJson { by: which(by), to: to.name(), blocked }
        });
        Self {
            state: parting.state.name(),
            good: WayJson::from(&parting.good),
            bad: WayJson::from(&parting.bad),
            missed,
        }
    }
}

impl From<&Way<'_>> for WayJson {
    fn from(way: &Way<'_>) -> Self {
        Self {
            since: seconds(way.since_ns),
            until: seconds(way.until_ns),
            to: way.to.map(adsdv_spec::AsState::name),
            section: way.transition.map(|transition| transition.section),
            justified: way.transition.map(|transition| transition.justified.name()),
        }
    }
}

impl From<&OnlyTransition> for OnlyTransitionJson {
    fn from(only: &OnlyTransition) -> Self {
        Self { only: which(only.which), t: seconds(only.t_ns), from: only.from.name(), to: only.to.name() }
    }
}

impl From<&LastedDiffers> for LastedJson {
    fn from(lasted: &LastedDiffers) -> Self {
        let span = |since, lasted| SpanJson { since: seconds(since), lasted: seconds(lasted) };
        let LastedDiffers { state, since_ns, for_ns } = lasted;
        let (good, bad) = (span(since_ns[0], for_ns[0]), span(since_ns[1], for_ns[1]));
        Self { state: state.name(), good, bad }
    }
}

impl<'a> From<&FoundOnce<'a>> for FoundJson<'a> {
    fn from(found: &FoundOnce<'a>) -> Self {
        Self { only: which(found.which), count: found.count, first: FindingJson::from(found.first) }
    }
}

impl RangesJson {
    fn of(ranges: &RangeDiffers) -> Option<Self> {
        let of = ranges.good.or(ranges.bad)?;
        Some(Self {
            state: ranges.state.name(),
            again: ranges.again,
            message: format!("{:03X}h", of.id),
            signal: of.signal.name,
            unit: of.signal.unit,
            good: ranges.good.as_ref().map(RangeJson::from),
            bad: ranges.bad.as_ref().map(RangeJson::from),
        })
    }
}

impl From<&Range> for RangeJson {
    fn from(range: &Range) -> Self {
        let [min, max] = range.physical();
        Self { min, max }
    }
}

impl From<&SequenceDiffers<'_>> for SequencesJson {
    fn from(differs: &SequenceDiffers<'_>) -> Self {
        Self {
            state: differs.state.name(),
            again: differs.again,
            signal: differs.good.signal.name,
            good: SequenceJson::from(differs.good),
            bad: SequenceJson::from(differs.bad),
        }
    }
}

impl From<&Sequence> for SequenceJson {
    fn from(sequence: &Sequence) -> Self {
        let value = |raw: &i32| sequence.signal.display(*raw).to_string();
        Self { values: sequence.values.iter().map(value).collect(), more: sequence.more }
    }
}

impl From<&FrameDiffers> for FramesJson {
    fn from(frame: &FrameDiffers) -> Self {
        let lengths = |set: u16| (0..u16::BITS).filter(|len| set >> len & 1 == 1).collect();
        let cycle =
            |[good, bad]: [f64; 2]| PairJson { good: to_microseconds(good), bad: to_microseconds(bad) };
        let both = |[good, bad]: [u16; 2]| PairJson { good: lengths(good), bad: lengths(bad) };
        Self {
            id: format!("{:03X}h", frame.id),
            name: frame.name,
            only: frame.only.map(|(only, _)| which(only)),
            cycle_ms: frame.cycle_ms.map(cycle),
            lengths: frame.lengths.map(both),
        }
    }
}

impl From<&MarginDiffers<'_>> for MarginsJson {
    fn from(differs: &MarginDiffers<'_>) -> Self {
        let better = differs.got_better().then_some("better");
        Self {
            matters: if differs.got_worse() { Some("worse") } else { better },
            good: differs.good.map(MarginJson::from),
            bad: differs.bad.map(MarginJson::from),
        }
    }
}

impl AnswersJson {
    fn of([good, bad]: &[ResponseTimes; 2]) -> Self {
        Self { good: ResponseJson::of(good), bad: ResponseJson::of(bad) }
    }
}
