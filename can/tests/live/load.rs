//! A bus at its limit, and far beyond it; and a machine that is too slow.

use std::time::Duration;

use adsdv_can::ai::Ai;
use adsdv_can::live::Runner as _;
use adsdv_can::status::HappeningKind;
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::AsState;

use super::{Bench, count, ms, run, vcu};

const fn us(us: u64) -> Duration {
    Duration::from_micros(us)
}

#[test]
fn a_full_bus_and_ten_times_that_cost_nothing() {
    for (every, cost) in [(us(250), us(20)), (us(25), us(20))] {
        let bench = Bench::new();
        let mut vcu = vcu(&bench, "");
        bench.cost(cost);
        let frames = 3_000_000 / u32::try_from(every.as_micros()).expect("few");
        for frame in 0..frames {
            bench.frame_comes(every * frame, FrameKind::Standard, 0x100 + frame % 16, &[1, 2, 3]);
        }
        run(&mut vcu, &bench, ms(3100));
        let status = vcu.status();
        assert_eq!((status.received, status.cycles.count, status.cycles.late), (frames.into(), 311, 0));
        assert!(status.cycles.worst_ms < 1.0, "{} ms", status.cycles.worst_ms);
    }
}

#[test]
fn a_mission_is_driven_beside_a_full_bus() {
    let bench = Bench::new();
    bench.plug_in(Ai::default());
    let mut vcu = super::mission(&bench);
    bench.cost(us(20));
    for frame in 0..240_000 {
        bench.frame_comes(us(250) * frame, FrameKind::Standard, 0x100 + frame % 16, &[1, 2, 3]);
    }
    while !vcu.is_over() {
        assert!(bench.time() < ms(60_000), "{:#?}", vcu.status().happened);
        vcu.turn();
    }
    let status = vcu.status();
    assert!(status.distance_m > 40.0, "{} m: {:#?}", status.distance_m, status.happened);
    assert_eq!(count(status, |what| *what == HappeningKind::AiSilent), 0);
    assert!(status.outputs.is_some_and(|outputs| outputs.faults.is_empty()), "{:?}", status.outputs);
}

#[test]
fn a_bus_that_brings_more_than_can_be_taken_does_not_hold_up_the_cycle() {
    let bench = Bench::new();
    bench.plug_in(Ai::default());
    let mut vcu = vcu(&bench, "");
    // Each frame takes twice as long to take as to come.
    bench.cost(us(50));
    for frame in 0..40_000 {
        bench.frame_comes(us(25) * frame, FrameKind::Standard, 0x100, &[]);
    }
    bench.dropped(7);
    run(&mut vcu, &bench, ms(1000));
    let status = vcu.status();
    assert!(status.cycles.count >= 99, "{:?}", status.cycles);
    assert_eq!(status.cycles.late, 0, "{:?}", status.cycles);
    assert!(status.cycles.worst_ms <= 5.1, "{:?}", status.cycles);
    assert_eq!(status.dropped, 7);
    assert_eq!(bench.take_sent().iter().filter(|(_, frame)| frame.id == 0x520).count(), 101);
}

#[test]
fn cycles_that_were_missed_are_left_out_and_reported() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "0 asms on\n");
    run(&mut vcu, &bench, ms(1000));
    bench.stall(ms(57));
    run(&mut vcu, &bench, ms(2000));
    let status = vcu.status();
    assert_eq!(count(status, |what| *what == HappeningKind::Late(4)), 1, "{:#?}", status.happened);
    let cycles = status.cycles;
    assert_eq!((cycles.count, cycles.late, cycles.left_out), (201 - 4, 1, 4));
    assert_eq!(cycles.count + cycles.left_out, status.time_ms / 10 + 1);
    // The grid is the same as before: nothing drifted.
    let sent = bench.take_sent();
    let last = sent.last().expect("it sent").0;
    assert_eq!(last, ms(2000));
    assert!((status.cycles.worst_ms - 47.0).abs() < 0.01, "{}", status.cycles.worst_ms);
}

#[test]
fn nobody_is_blamed_for_answers_that_the_vcu_had_no_time_for() {
    let bench = Bench::new();
    bench.plug_in(Ai::default());
    let mut vcu = vcu(&bench, "0 tsms on\n");
    for stall in 0..40 {
        run(&mut vcu, &bench, ms(500 + stall * 503));
        bench.stall(ms(57 + stall));
    }
    let status = vcu.status();
    assert!(status.cycles.late >= 39, "{:?}", status.cycles);
    // The status reports them once a second, and forgets none.
    let reported = status.happened.iter().map(|happening| match happening.what {
        HappeningKind::Late(cycles) => cycles,
        _ => 0,
    });
    let reported: Vec<u64> = reported.filter(|cycles| *cycles > 0).collect();
    assert!((15..=25).contains(&reported.len()), "{reported:?}");
    assert!(
        status.cycles.left_out - reported.iter().sum::<u64>() < 10,
        "{reported:?} of {:?}",
        status.cycles
    );
    assert!(status.outputs.is_some_and(|outputs| outputs.faults.is_empty()), "{:?}", status.outputs);
}

#[test]
fn who_sleeps_too_long_still_takes_what_came_meanwhile() {
    for begin in 2000..2020 {
        let bench = Bench::new();
        bench.plug_in(Ai::default());
        let mut vcu = super::mission(&bench);
        run(&mut vcu, &bench, ms(1990));
        // Foreign frames that wait before the answer.
        for place in 0..20 {
            bench.frame_comes(ms(begin) + us(place), FrameKind::Standard, 0x100, &[1]);
        }
        while bench.time() < ms(begin) {
            vcu.turn();
        }
        bench.oversleep(ms(60));
        run(&mut vcu, &bench, ms(3000));
        let status = vcu.status();
        assert!(count(status, |what| matches!(what, HappeningKind::Late(_))) > 0, "{begin}");
        let state = status.outputs.map(|outputs| outputs.state);
        assert_eq!(state, Some(AsState::Ready), "{begin}: {:#?}", status.happened);
    }
}
