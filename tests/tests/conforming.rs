//! No false alarm: what the reference VCU does is never called a violation of the VCU, whatever the AI Computer and the
//! operator do, under any readings, however the recorder jitters and whatever frames it loses.

use adsdv_oracle::judge::{Options, Party, Severity};
use adsdv_spec::{AsState, Choices, Interface, Machine, Reading, Readings};
use adsdv_tests::world::{Chance, MS, Random, World, judge, violations};

/// A run of `cycles` with random changes, biased so that every state is reached.
fn random_run(random: &mut Random, cycles: u32) -> World {
    let readings = if random.one_in(2) {
        Readings::DEFAULT
    } else {
        Reading::ALL.iter().fold(Readings::DEFAULT, |readings, reading| {
            if random.one_in(3) { readings.with(random.pick(reading.choices())) } else { readings }
        })
    };
    let mut world = World::new(Machine::new(Interface::V3_0, readings));
    let rate = random.pick(&[1, 3, 20, 100]);
    world.sets_out(random);
    for _ in 0..cycles {
        if random.one_in(rate) {
            world.anything(random);
        }
        if random.one_in(rate * 20) {
            world.ebs_changes(random);
        }
        world.cycle();
    }
    world
}

fn never_blames_the_vcu(runs: u64, jitter_ms: i64, loss: u64) {
    let mut states = std::collections::BTreeSet::new();
    let mut transitions = 0;
    for seed in 0..runs {
        let mut random = Random(seed);
        let world = random_run(&mut random, 400);
        // Half of the recordings start in mid-run, and half are judged by the very readings that the VCU follows.
        let recording = world.disturbed(seed, jitter_ms * MS, loss);
        let start = if random.one_in(2) { random.below(recording.len() as u64 / 2) } else { 0 };
        let pinned = random.one_in(2);
        let readings = if pinned { world.vcu.readings().choices() } else { Choices::ALL };
        let log = recording.get(usize::try_from(start).unwrap_or(0)..).unwrap_or_default();
        let report = judge(log, Options { readings, ..Options::default() });
        let blamed = report
            .findings
            .iter()
            .any(|finding| finding.party == Party::Vcu && finding.severity == Severity::Violation);
        assert!(
            !blamed,
            "seed {seed}, jitter {jitter_ms} ms, loss 1/{loss}, from {start}, readings [{}]{}: {:#?}",
            world.vcu.readings(),
            if pinned { ", pinned" } else { "" },
            violations(&report)
        );
        transitions += report.transitions.len();
        states.extend(report.transitions.iter().map(|transition| transition.to));
    }
    assert_eq!(states.len(), AsState::ALL.len(), "the runs reach every state");
    assert!(transitions as u64 > runs, "the runs take transitions");
}

#[test]
fn exact_recordings() {
    never_blames_the_vcu(500, 0, 0);
}

#[test]
fn five_milliseconds_of_jitter() {
    never_blames_the_vcu(500, 5, 0);
}

#[test]
fn lost_frames() {
    never_blames_the_vcu(500, 0, 20);
}

#[test]
fn jitter_and_lost_frames() {
    never_blames_the_vcu(500, 5, 10);
}

#[test]
fn jitter_longer_than_a_cycle() {
    never_blames_the_vcu(500, 15, 0);
}
