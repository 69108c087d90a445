//! When the AI Computer answered the handshake, and how fast: what the judge measures, answer by answer.

use adsdv_oracle::judge::{Meter, Report, Rule};
use adsdv_spec::Bus;
use adsdv_spec::messages::Node;

use crate::recording::{Recording, signal};

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Answer {
    /// When it came.
    pub(crate) t_ns: i64,
    /// How long after the edge.
    pub(crate) took_ns: i64,
}

/// Every answer, measured from where the judge measures: anew after each silence and each loss that it tells of.
pub(crate) fn answers(recording: &Recording, bus: &Bus, report: &Report) -> Vec<Answer> {
    let (Some(asked), Some(answered)) =
        (signal(bus, Node::Vcu, "handshake"), signal(bus, Node::Ai, "handshake"))
    else {
        return Vec::new();
    };
    let restarts = |rule| rule == Rule::Gap || rule == Rule::TimeBackwards;
    let mut restarts: Vec<i64> =
        report.findings.iter().filter(|finding| restarts(finding.rule)).map(|finding| finding.t_ns).collect();
    restarts.sort_unstable();
    let mut restarts = restarts.into_iter().peekable();
    let (mut meter, mut answers) = (Meter::default(), Vec::new());
    for frame in &recording.frames {
        let (t_ns, data) = (frame.t_ns, frame.data());
        while restarts.next_if(|restart| *restart <= t_ns).is_some() {
            meter.restart();
        }
        if frame.id == asked.id {
            if let Some(bit) = asked.signal.raw(data) {
                meter.vcu(t_ns, bit != 0);
            }
        } else if frame.id == answered.id
            && let Some(bit) = answered.signal.raw(data)
            && let Some(took_ns) = meter.ai(t_ns, bit != 0)
        {
            answers.push(Answer { t_ns, took_ns });
        }
    }
    answers
}
