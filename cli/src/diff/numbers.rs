//! Times and thresholds.

use adsdv_spec::mutation::{Threshold, Time};
use adsdv_spec::{Thresholds, Timing};
use serde_json::{Value, json};

use super::change::Change;

/// A number by its name for programs and in words, with its value for both.
type Number = (&'static str, String, Value, String);

/// The times that differ.
pub(super) fn timing(from: &Timing, to: &Timing) -> Vec<Change> {
    differing(times(from), times(to))
}

/// The thresholds that differ.
pub(super) fn thresholds(from: &Thresholds, to: &Thresholds) -> Vec<Change> {
    differing(limits(from), limits(to))
}

/// A further time has to be named here before this compiles.
fn times(timing: &Timing) -> [Number; 4] {
    let Timing { ready_dwell_ms, ebs_timer_ms, handshake_ms, cycle_ms } = *timing;
    let ms = |name, label: &dyn ToString, ms: u16| (name, label.to_string(), json!(ms), milliseconds(ms));
    [
        ms("ready_dwell_ms", &Time::ReadyDwell, ready_dwell_ms),
        ms("ebs_timer_ms", &Time::EbsTimer, ebs_timer_ms),
        ms("handshake_ms", &Time::Handshake, handshake_ms),
        ms("cycle_ms", &"cycle of the VCU", cycle_ms),
    ]
}

/// A further threshold has to be named here before this compiles.
fn limits(thresholds: &Thresholds) -> [Number; 3] {
    let Thresholds { wheel_speed, straight, missed_ms } = *thresholds;
    [
        ("wheel_speed", Threshold::WheelSpeed.to_string(), json!(wheel_speed.raw()), wheel_speed.to_string()),
        ("straight", Threshold::Straight.to_string(), json!(straight.raw()), straight.to_string()),
        (
            "missed_ms",
            Threshold::Missed.to_string(),
            json!(missed_ms),
            missed_ms.map(milliseconds).unwrap_or_default(),
        ),
    ]
}

fn milliseconds(ms: u16) -> String {
    format!("{ms} ms")
}

fn differing<const N: usize>(from: [Number; N], to: [Number; N]) -> Vec<Change> {
    let both = from.into_iter().zip(to);
    let change = |((name, label, from, from_words), (_, _, to, to_words)): (Number, Number)| {
        Some(Change { label, ..Change::of(name, (from, from_words), (to, to_words))? })
    };
    both.filter_map(change).collect()
}
