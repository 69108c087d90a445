//! The judge never contradicts the reference: of a log that `step` itself produced, under any readings of any edition, nothing is
//! said against the VCU, but that a frame that was not recorded must have been there where one was not; and against the AI Computer
//! only what it did.

use adsdv_oracle::judge::{Finding, JudgeOptions, Party, Report, Rule, Severity};
use adsdv_spec::{AiMessages, AsState, Atom, Atoms, Choices, Machine, Row};

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
    let edition = bytes.edition();
    let readings = bytes.readings(edition);
    let (jitter_ms, loss, seed) = (bytes.below(JITTER_MS + 1), bytes.pick(&LOSSES), bytes.any());
    let choices = if bytes.one_in(2) { readings.choices() } else { Choices::ALL };
    let from_the_start = bytes.one_in(4);
    let mut world = World::new(Machine::new(*edition, readings));
    world.sets_out(&mut bytes);
    if !from_the_start {
        // The recorder was switched on late.
        let since = world.t - 200 * MS;
        world.log.retain(|recorded| recorded.t > since);
    }
    let did = happens(&mut world, &mut bytes);
    let log = world.disturbed(seed, jitter_ms.cast_signed() * MS, loss);
    let report = judge(&log, JudgeOptions { readings: choices, ..JudgeOptions::of(edition) });
    let wrong = contradictions(&report, did, jitter_ms > 0 || loss > 0);
    assert!(
        wrong.is_empty(),
        "{}: late by up to {jitter_ms} ms, one in {loss} lost, readings [{readings}]: {wrong:#?}",
        edition.version
    );
}

/// What the AI Computer did in a run that can be held against it.
#[derive(Clone, Copy, Debug, Default)]
struct Did {
    /// It did not answer, or did not send, all or one of its messages.
    silent: bool,
    /// Torque and brakes at once, as the VCU last heard of them or as it sends them.
    both: bool,
    /// FINISHED at speed in AS_DRIVING.
    finished: bool,
    /// NEUTRAL at speed in AS_DRIVING.
    neutral: bool,
    /// Requests that hold the vehicle in AS_READY after the dwell.
    held: bool,
}

impl Did {
    /// What it does in the cycle that comes.
    fn see(&mut self, world: &World) {
        let interface = world.vcu.edition();
        let atoms = world.inputs.observe(&interface.rules.thresholds).atoms();
        let driving_at_speed = world.control.state == AsState::Driving && atoms.has(Atom::Moving);
        self.silent |= !world.ai_answers || !world.ai_sends || !world.mutes.is_empty();
        let (ai, heard) = (&world.ai, &world.inputs.ai);
        let torque = |ai: &AiMessages| {
            ai.drive_f.front_axle_trq_request.raw() > 0 || ai.drive_r.rear_axle_trq_request.raw() > 0
        };
        let brakes =
            |ai: &AiMessages| ai.brake.hyd_press_f_req.raw() > 0 || ai.brake.hyd_press_r_req.raw() > 0;
        self.both |= (torque(ai) || torque(heard)) && (brakes(ai) || brakes(heard));
        self.finished |= driving_at_speed && atoms.has(Atom::MissionFinished);
        self.neutral |= driving_at_speed && atoms.has(Atom::DirectionNeutral);
        let starts = |row: &&Row| (row.from, row.to) == (AsState::Ready, AsState::Driving);
        let starting = interface.rules.table.rows().iter().filter(starts).flat_map(Row::terms);
        let wanted = starting.fold(Atoms::NONE, |all, term| all.union(term.on));
        let requests = wanted.without(Atom::GoEdge).without(Atom::DwellElapsed);
        self.held |= world.control.state == AsState::Ready
            && world.control.in_state_ms >= interface.rules.timing.ready_dwell_ms
            && !requests.is_subset(atoms);
    }
}

/// Anything happens. Tells what the AI Computer did.
fn happens(world: &mut World, bytes: &mut Bytes<'_>) -> Did {
    let mut did = Did::default();
    let is_newer = world.vcu.edition().rules.thresholds.missed_ms.is_some();
    for _ in 0..DEEDS {
        if !bytes.are_left() {
            break;
        }
        match bytes.below(8) {
            0 => world.ebs_changes(bytes),
            1 if is_newer => world.anything_newer(bytes),
            _ => world.anything(bytes),
        }
        let cycles = match bytes.below(4) {
            0 => 1,
            1 => bytes.below(8),
            2 => bytes.below(100),
            _ => 2,
        };
        did.see(world);
        for _ in 0..cycles {
            world.cycle();
            did.see(world);
        }
    }
    did
}

/// What the judge says that cannot be so; `excused`: frames are late, or lost.
fn contradictions(report: &Report, did: Did, excused: bool) -> Vec<&Finding> {
    let is_so = |finding: &Finding| match (finding.party, finding.rule) {
        // What an unseen frame could excuse, an unseen frame may have done.
        (Party::Vcu, _) => excused && finding.severity == Severity::Warning && !finding.unless.is_empty(),
        (Party::Own, _) => false,
        (Party::Log, _) => finding.severity != Severity::Violation,
        (Party::Ai, Rule::HandshakeLate | Rule::AiSilent | Rule::MessageMissed) => did.silent,
        (Party::Ai, Rule::BrakeAndTorque) => did.both,
        (Party::Ai, Rule::FinishedMoving) => did.finished,
        (Party::Ai, Rule::NeutralMoving) => did.neutral,
        (Party::Ai, rule) => rule == Rule::ReadyHeld && did.held,
    };
    let weighed = report.findings.iter().filter(|finding| finding.severity != Severity::Note);
    weighed.filter(|finding| !is_so(finding)).collect()
}
