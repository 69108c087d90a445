//! The judge never contradicts the reference: of a log that `step` itself produced, under any readings, nothing is said against
//! the VCU; and against the AI Computer only what it did.

use adsdv_oracle::judge::{Finding, Options, Party, Report, Rule, Severity};
use adsdv_spec::{Choices, Interface, Machine};

use super::Bytes;
use crate::world::{Chance, MS, World, judge};

/// So much may happen in one run.
const DEEDS: usize = 100;

/// Each frame is recorded late by up to this, one more or less than the other. The VCU's cycle and half of one, after which the
/// AI Computer answers, are in the window W as well.
const JITTER_MS: u64 = 15;

/// One in so many frames is lost; 0: none.
const LOSSES: [u64; 6] = [0, 0, 100, 20, 10, 3];

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let readings = bytes.readings();
    let (jitter_ms, loss, seed) = (bytes.below(JITTER_MS + 1), bytes.pick(&LOSSES), bytes.any());
    let choices = if bytes.one_in(2) { readings.choices() } else { Choices::ALL };
    let from_the_start = bytes.one_in(4);
    let mut world = World::new(Machine::new(Interface::V3_0, readings));
    world.sets_out(&mut bytes);
    if !from_the_start {
        // The recorder was switched on late.
        let since = world.t - 200 * MS;
        world.log.retain(|recorded| recorded.t > since);
    }
    let answers = happens(&mut world, &mut bytes);
    let log = world.disturbed(seed, jitter_ms.cast_signed() * MS, loss);
    let report = judge(&log, Options { readings: choices, ..Options::default() });
    let wrong = contradictions(&report, answers);
    assert!(
        wrong.is_empty(),
        "late by up to {jitter_ms} ms, one in {loss} lost, readings [{readings}]: {wrong:#?}"
    );
}

/// Anything happens. Tells whether the AI Computer answered all the time.
fn happens(world: &mut World, bytes: &mut Bytes<'_>) -> bool {
    let mut answers = true;
    for _ in 0..DEEDS {
        if !bytes.are_left() {
            break;
        }
        match bytes.below(8) {
            0 => world.ebs_changes(bytes),
            _ => world.anything(bytes),
        }
        answers &= world.ai_answers && world.ai_sends;
        let cycles = match bytes.below(4) {
            0 => 1,
            1 => bytes.below(8),
            2 => bytes.below(100),
            _ => 2,
        };
        (0..cycles).for_each(|_| world.cycle());
    }
    answers
}

/// What the judge says that cannot be so.
fn contradictions(report: &Report, answers: bool) -> Vec<&Finding> {
    let is_so = |finding: &Finding| match (finding.party, finding.rule) {
        (Party::Vcu, _) => false,
        (Party::Log, _) => finding.severity != Severity::Violation,
        (Party::Ai, Rule::HandshakeLate) => !answers,
        // It did so or not: what matters is that it can have.
        (Party::Ai, rule) => matches!(rule, Rule::FinishedMoving | Rule::NeutralMoving | Rule::ReadyHeld),
    };
    let told = report.findings.iter().filter(|finding| finding.severity != Severity::Note);
    told.filter(|finding| !is_so(finding)).collect()
}
