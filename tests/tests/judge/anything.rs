//! Whatever may come: a VCU that errs, that does what a test forces on it or shows what is not so, an AI Computer and an operator who do
//! anything, and a recorder that pauses, is set back, has a coarse clock, loses frames and cuts some off.
//!
//! What is said of it need not be right, since nobody could know. But the judge never fails, what it tells while the bus goes on is
//! what its report has, and it says no more when it sees less.

use std::sync::LazyLock;

use adsdv_oracle::judge::{Judge, JudgeOptions};
use adsdv_spec::messages::{Ai2VcuStatus, Frame, MessageDef, ShutdownCause, Vcu2AiStatus, Vcu2LogStatus};
use adsdv_spec::{AsState, Choices, Edition, Machine, Mutation};
use adsdv_tests::bus::{BUS, def_of};
use adsdv_tests::world::{Chance, MS, Random, Recorded, World, any_readings};

use crate::curated::laws;

/// A VCU that shows something else than it does.
const LIES: [fn(&mut Vcu2AiStatus); 8] = [
    |_| {},
    |status| status.shutdown_cause = ShutdownCause::NoShutdown,
    |status| status.ai_comms_lost = !status.ai_comms_lost,
    |status| status.go_signal = !status.go_signal,
    |status| status.mission_status_fault = true,
    |status| status.charge_procedure_fault = true,
    |status| status.ai_estop_request = !status.ai_estop_request,
    |status| status.handshake = false,
];

fn any_vcu(random: &mut Random) -> Machine {
    let readings = any_readings(random, Edition::DEFAULT);
    let mutations: Vec<Mutation> = Mutation::all(Edition::DEFAULT).collect();
    let errs = random.one_in(2);
    let mutation = &mutations[index(random, mutations.len())];
    let interface = if errs { mutation.apply(Edition::DEFAULT) } else { *Edition::DEFAULT };
    Machine::new(interface, readings)
}

fn index(random: &mut Random, len: usize) -> usize {
    usize::try_from(random.below(len as u64)).unwrap_or(0)
}

/// The messages that tell most.
const TELLING: [&MessageDef; 3] =
    [def_of::<Vcu2AiStatus>(), def_of::<Vcu2LogStatus>(), def_of::<Ai2VcuStatus>()];

/// Where runs begin.
static BEGINNINGS: LazyLock<Vec<World>> = LazyLock::new(|| {
    let routes: [fn(&mut World); 8] = [
        |_| {},
        World::prepare,
        World::ready,
        World::dwelt,
        World::driving,
        World::finished,
        World::braking,
        World::after_emergency,
    ];
    let worlds = routes.iter().map(|route| {
        let mut world = World::reference();
        route(&mut world);
        world
    });
    worlds.collect()
});

/// A run of some seconds in which anything happens.
fn any_run(random: &mut Random) -> World {
    let mut world = BEGINNINGS[index(random, BEGINNINGS.len())].clone();
    world.vcu = any_vcu(random);
    let honest = world.vcu;
    // Seldom is all of it recorded.
    let kept = random.pick(&[100, 500, 1000, 1000, 3000, 30_000]) * MS;
    world.log.retain(|recorded| recorded.t >= world.t - kept);
    for _ in 0..random.below(40) {
        for _ in 0..=random.below(2) {
            world.anything(random);
        }
        world.ebs_changes(random);
        match random.below(20) {
            0 => world.force(random.pick(&AsState::ALL)),
            1 => world.hold_state(),
            2 | 3 => world.vcu = honest,
            4 => world.shows = random.pick(&LIES),
            5 => world.shows = LIES[0],
            _ => {}
        }
        let ms = random.pick(&[10, 10, 20, 50, 100, 300]);
        world.wait(ms);
    }
    world
}

/// What a recorder makes of it.
fn any_recording(random: &mut Random, world: &World) -> Vec<Recorded> {
    let jitter = random.pick(&[0, 5, 25]) * MS;
    let loss = random.pick(&[0, 0, 10, 50]);
    let mut log = world.disturbed(random.bits(), jitter, loss);
    let start = if random.one_in(2) { index(random, log.len()) / 2 } else { 0 };
    log.drain(..start);
    let step = random.pick(&[1, 1, 1, 20 * MS]);
    for recorded in &mut log {
        recorded.t -= recorded.t.rem_euclid(step);
    }
    let damages = random.below(8);
    for _ in 0..damages {
        let place = index(random, log.len());
        damage(random, &mut log, place);
    }
    log
}

/// Something goes wrong with the recording at this place.
fn damage(random: &mut Random, log: &mut Vec<Recorded>, place: usize) {
    let Some(&Recorded { t, frame: Frame { id, .. } }) = log.get(place) else { return };
    match random.below(20) {
        // A silence: of all, or of one message.
        0 => {
            let lasts = random.pick(&[25, 45, 200, 490, 510, 3000]) * MS;
            log.retain(|recorded| !(t..t + lasts).contains(&recorded.t));
        }
        1 => {
            let lasts = random.pick(&[15, 35, 110, 490, 510, 3000]) * MS;
            log.retain(|recorded| recorded.frame.id != id || !(t..t + lasts).contains(&recorded.t));
        }
        // The clock is set.
        2 => {
            let by = random.pick(&[-100_000, -31, -29, -5, 25, 40, 600, 100_000]) * MS;
            log[place..].iter_mut().for_each(|recorded| recorded.t += by);
        }
        // Frames in each other's place.
        3 => {
            let other = (place + index(random, 12)).min(log.len() - 1);
            log.swap(place, other);
        }
        // One frame is cut off, or all of its message from here on are.
        4 => {
            let len = random.below(8);
            let all = random.one_in(3);
            let cut = log[place..].iter_mut().filter(|recorded| recorded.frame.id == id);
            for recorded in cut.take(if all { usize::MAX } else { 1 }) {
                recorded.frame.len = u8::try_from(len).unwrap_or(0).min(recorded.frame.len);
                recorded.frame.data[usize::from(recorded.frame.len)..].fill(0);
            }
        }
        // A byte is another.
        5 => {
            let byte = index(random, 8);
            log[place].frame.data[byte] = u8::try_from(random.below(256)).unwrap_or(0);
        }
        // A frame comes twice, the second time later.
        6 => {
            let at = t + i64::try_from(random.below(40)).unwrap_or(0) * MS;
            let later = log.partition_point(|recorded| recorded.t <= at);
            let twice = Recorded { t: at, ..log[place] };
            log.insert(later, twice);
        }
        // Many at the same time.
        7 => {
            let until = (place + index(random, 200)).min(log.len());
            log[place..until].iter_mut().for_each(|recorded| recorded.t = t);
        }
        // For a while, a signal says something else.
        _ => {
            let message = if random.one_in(4) { random.pick(BUS.messages) } else { random.pick(&TELLING) };
            let signal = &message.signals[index(random, message.signals.len())];
            let any = |random: &mut Random| i32::try_from(random.below(1 << signal.width)).unwrap_or(0);
            let mut raw = any(random);
            for _ in 0..random.pick(&[0, 200, 200, 200, 200]) {
                raw = if signal.allows(raw) { raw } else { any(random) };
            }
            let lasts = random.pick(&[10, 30, 80, 150, 600, 3000]) * MS;
            for recorded in &mut log[place..] {
                if recorded.frame.id == message.id && (t..t + lasts).contains(&recorded.t) {
                    recorded.frame.data = signal.put(recorded.frame.data, raw);
                }
            }
        }
    }
}

fn any_options(random: &mut Random, world: &World) -> JudgeOptions {
    let (window_ms, deadline_ms) = random.pick(&[(30, 50), (30, 50), (0, 0), (5, 20), (100, 200)]);
    let readings = if random.one_in(3) { world.vcu.readings().choices() } else { Choices::ALL };
    JudgeOptions { window_ms, deadline_ms, readings, ..JudgeOptions::default() }
}

/// How many runs each test has.
const RUNS: u64 = 300;

/// The recording of this number, how it is judged, and what chance comes to next.
fn anything(seed: u64) -> (Vec<Recorded>, JudgeOptions, Random) {
    let mut random = Random::with_seed(seed);
    let world = any_run(&mut random);
    let log = any_recording(&mut random, &world);
    let options = any_options(&mut random, &world);
    (log, options, random)
}

#[test]
fn the_live_judge_says_what_the_judge_of_a_log_says() {
    for seed in 0..4 * RUNS {
        let (log, options, _) = anything(seed);
        laws::live_is_the_same(&log, options).unwrap_or_else(|broken| panic!("run {seed}: {broken}"));
    }
}

/// But for a frame that was changed on its way: without it, what comes before and what comes behind may not go together.
#[test]
fn losing_frames_adds_no_violation() {
    for seed in 0..4 * RUNS {
        let mut random = Random::with_seed(seed);
        let world = any_run(&mut random);
        let mut options = any_options(&mut random, &world);
        // Where nothing may be late, what follows a frame that is missing is too late.
        options = JudgeOptions {
            window_ms: options.window_ms.max(5),
            deadline_ms: options.deadline_ms.max(20),
            ..options
        };
        let added = laws::losing_frames_adds_nothing(&world.log, options, seed);
        added.unwrap_or_else(|broken| panic!("run {seed}: {broken}"));
    }
}

/// On a live bus time passes without frames, and the reader may be too slow: whatever is found has its time in the report.
#[test]
fn whatever_goes_on_the_report_is_in_order_and_ends_last() {
    for seed in 0..RUNS {
        let (log, options, mut random) = anything(seed);
        let origin = log.first().map_or(0, |first| first.t);
        let mut judge = Judge::new(options);
        for recorded in &log {
            let t = recorded.t - origin;
            match random.below(2000) {
                0 => judge.lost(random.below(3)),
                1 => judge.time_passes(t - MS),
                2 => judge.time_passes(t + random.pick(&[1, 20, 35, 300]) * MS),
                3 => {
                    judge.other_frame(t);
                }
                _ => {}
            }
            judge.frame(t, recorded.frame.id.into(), recorded.frame.data());
        }
        if random.one_in(2) {
            let end = log.last().map_or(0, |last| last.t - origin);
            judge.time_passes(end + random.pick(&[10, 40, 400, 4000]) * MS);
        }
        let report = judge.finish();
        let times: Vec<i64> = report.findings.iter().map(|finding| finding.t_ns).collect();
        assert!(times.is_sorted(), "seed {seed}: {:#?}", report.findings);
        let transitions = report.transitions.iter().map(|transition| transition.t_ns);
        let latest = times.last().copied().into_iter().chain(transitions).max();
        assert!(latest.is_none_or(|latest| latest <= report.duration_ns), "seed {seed}: {report:#?}");
    }
}
