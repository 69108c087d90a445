//! No false alarm: what the reference VCU does is never called a violation of the VCU, whatever the AI Computer and the
//! operator do, under any readings, however the recorder jitters and whatever frames it loses.

use adsdv_oracle::judge::{Options, Party, Severity};
use adsdv_spec::messages::{
    AmiState, AxleTorqueRequest, DirectionRequest, EbsState, MissionStatus, SteerAngle, WheelSpeed,
};
use adsdv_spec::{AsState, Choices, Interface, Machine, Reading, Readings};
use adsdv_tests::world::{MS, Random, World, judge, violations};

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
    match random.below(6) {
        0 => {}
        1 => world.ready(),
        2 => world.dwelt(),
        3 => world.driving(),
        4 => world.stopped(),
        _ => world.finished(),
    }
    let mut ebs_changed = world.t;
    for _ in 0..cycles {
        if random.one_in(rate) {
            change(random, &mut world);
        }
        // 502h comes every 100 ms: what lasts for less does not show, and an EBS does not flicker.
        if world.t - ebs_changed > 300 * MS && random.one_in(rate * 20) {
            world.inputs.ebs = random.pick(&[EbsState::Armed, EbsState::Armed, EbsState::Unavailable]);
            ebs_changed = world.t;
        }
        world.cycle();
    }
    world
}

fn change(random: &mut Random, world: &mut World) {
    let mostly = |random: &mut Random| !random.one_in(4);
    match random.below(20) {
        0 => world.inputs.asms = mostly(random),
        1 => world.inputs.tsms = mostly(random),
        2 => {
            world.inputs.ami = random.pick(&[AmiState::NotSelected, AmiState::Skidpad, AmiState::TrackDrive]);
        }
        3 => world.inputs.reports.batt_temp_high = random.one_in(2),
        4 | 5 => world.inputs.go = mostly(random),
        6 => world.ai.status.mission_status = random.pick(&MissionStatus::ALL),
        7 => world.ai.status.mission_status = MissionStatus::Selected,
        8 => world.ai.status.direction_request = random.pick(&DirectionRequest::ALL),
        9 => {
            let rpm = random.pick(&[0, 5, 9, 10, 11, 12, 300]);
            world.wheels(rpm);
            if random.one_in(3) {
                world.inputs.vehicle.wheel_speeds.rl_wheel_speed = WheelSpeed::clamped(11);
            }
        }
        10 => {
            world.ai.drive_f.front_axle_trq_request =
                AxleTorqueRequest::clamped(random.pick(&[0, 0, 1, 100]));
        }
        11 => {
            world.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(random.pick(&[0, 0, 1, 100]));
        }
        12 => world.ai.steer.steer_request = SteerAngle::clamped(random.pick(&[0, 0, 1, -1])),
        13 => world.inputs.vehicle.steer_angle = SteerAngle::clamped(random.pick(&[0, 49, 50, -49, -50])),
        14 => world.inputs.sdc.remote_estop = random.one_in(4),
        15 => world.inputs.reports.hvil_short = random.one_in(4),
        16 => world.inputs.reports.charging = random.one_in(6),
        17 => world.ai.status.estop_request = random.one_in(3),
        18 => world.ai_answers = mostly(random),
        _ => world.ai_sends = mostly(random),
    }
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
