//! No false alarm: what the reference VCU does is never called a violation of the VCU, whatever the AI Computer and the
//! operator do, under any readings, however the recorder jitters and whatever frames it loses.

use adsdv_oracle::judge::{JudgeOptions, Party};
use adsdv_proofs::seed::seed;
use adsdv_spec::{AsState, Choices, Edition, Machine};
use adsdv_tests::world::{Chance, MS, Random, Recorded, World, any_readings, judge, violations};

use crate::check::{USUAL, by, recordings_of_a_kind};

/// A run of `cycles` with random changes, biased so that every state is reached.
fn random_run(random: &mut Random, edition: &Edition, cycles: u32) -> World {
    let readings = if random.one_in(2) { edition.readings } else { any_readings(random, edition) };
    let mut world = World::new(Machine::new(*edition, readings));
    let rate = random.pick(&[1, 3, 20, 100]);
    world.sets_out(random);
    for _ in 0..cycles {
        if random.one_in(rate) {
            world.anything(random);
        }
        if edition.rules.thresholds.missed_ms.is_some() && random.one_in(rate * 2) {
            world.anything_newer(random);
        }
        if random.one_in(rate * 20) {
            world.ebs_changes(random);
        }
        world.cycle();
    }
    world
}

/// A recording of a random run of a VCU, and how it is judged.
struct Recording {
    /// For people.
    name: String,
    log: Vec<Recorded>,
    options: JudgeOptions,
}

impl Recording {
    fn new(edition: &'static Edition, seed: u64, jitter_ms: i64, loss: u64) -> Self {
        Self::of_vcu(edition, edition, seed, jitter_ms, loss)
    }

    /// Of a VCU that follows another Figure 2 than the edition by which it is judged.
    fn of_vcu(edition: &'static Edition, vcu: &Edition, seed: u64, jitter_ms: i64, loss: u64) -> Self {
        let mut random = Random::with_seed(seed);
        let world = random_run(&mut random, vcu, 400);
        // Half of the recordings start in mid-run, and half are judged by the very readings that the VCU follows.
        let mut log = world.disturbed(seed, jitter_ms * MS, loss);
        let start = if random.one_in(2) { random.below(log.len() as u64 / 2) } else { 0 };
        log.drain(..usize::try_from(start).unwrap_or(0));
        let pinned = random.one_in(2);
        let readings = if pinned { world.vcu.readings().choices() } else { Choices::ALL };
        let name = format!(
            "seed {seed}, jitter {jitter_ms} ms, loss 1/{loss}, from {start}, readings [{}]{}",
            world.vcu.readings(),
            if pinned { ", pinned" } else { "" },
        );
        Self { name, log, options: JudgeOptions { readings, ..JudgeOptions::of(edition) } }
    }
}

fn never_blames_the_vcu(jitter_ms: i64, loss: u64) {
    for edition in Edition::ALL {
        never_blames_the_vcu_of(edition, jitter_ms, loss);
    }
}

/// `scripts/sensitivity.sh -s` judges thousands more, and as many as one likes.
fn never_blames_the_vcu_of(edition: &'static Edition, jitter_ms: i64, loss: u64) {
    let runs = 100 * recordings_of_a_kind() / USUAL;
    let mut states = std::collections::BTreeSet::new();
    let mut transitions = 0;
    for place in 0..runs {
        // Far apart, so that no run is tried twice when the next seed is the next number.
        let seed = seed().wrapping_mul(1 << 32).wrapping_add(place);
        let Recording { name, log, options } = Recording::new(edition, seed, jitter_ms, loss);
        let report = judge(&log, options);
        assert!(
            by(&report, Party::Vcu).is_empty(),
            "{}, {name}: {:#?}",
            edition.version,
            violations(&report)
        );
        transitions += report.transitions.len();
        states.extend(report.transitions.iter().map(|transition| transition.to));
    }
    assert!(states.len() == AsState::ALL.len() || runs < 100, "the runs reach every state");
    assert!(transitions as u64 > runs, "the runs take transitions");
}

#[test]
fn exact_recordings() {
    never_blames_the_vcu(0, 0);
}

#[test]
fn five_milliseconds_of_jitter() {
    never_blames_the_vcu(5, 0);
}

#[test]
fn lost_frames() {
    never_blames_the_vcu(0, 20);
}

#[test]
fn jitter_and_lost_frames() {
    never_blames_the_vcu(5, 10);
}

#[test]
fn jitter_longer_than_a_cycle() {
    never_blames_the_vcu(15, 0);
}
