//! The AI Computer on a bus.

use std::time::Duration;

use adsdv_can::ai::Ai;
use adsdv_can::bus::{Disturbance, Event};
use adsdv_can::live::AiComputer;
use adsdv_can::status::{HappeningKind, Status};
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::{AsState, Vcu2AiStatus};

use super::bench::encoded;
use super::{Bench, are_apart, count, ms};

fn run(ai: &mut AiComputer<Bench>, bench: &Bench, until: Duration) {
    while bench.time() < until {
        ai.turn();
    }
}

fn states(status: &Status) -> Vec<(Option<AsState>, Option<AsState>)> {
    let state = |what: &HappeningKind| match *what {
        HappeningKind::State { from, to, .. } => Some((from, to)),
        _ => None,
    };
    status.happened.iter().filter_map(|happening| state(&happening.what)).collect()
}

#[test]
fn the_ai_computer_reports_what_the_vcu_shows_and_when_it_is_gone() {
    let bench = Bench::new();
    let mut ai = AiComputer::new(bench.clone(), Ai::default());
    for (at, state) in [(100, AsState::Off), (110, AsState::Off), (120, AsState::Ready), (900, AsState::Off)]
    {
        let frame = encoded(Vcu2AiStatus { as_state: state, ..Vcu2AiStatus::default() });
        bench.frame_comes(ms(at), FrameKind::Standard, frame.id.into(), frame.data());
    }
    run(&mut ai, &bench, ms(1000));
    let (off, ready) = (Some(AsState::Off), Some(AsState::Ready));
    assert_eq!(states(ai.status()), [(None, off), (off, ready), (ready, None), (None, off)]);
    assert_eq!((ai.status().cycles.count, ai.status().cycles.late), (101, 0));
    let sent = bench.take_sent();
    let status: Vec<_> = sent.iter().filter(|(_, frame)| frame.id == 0x510).map(|(at, _)| *at).collect();
    assert!(status.len() == 91 && are_apart(&status, ms(10)), "{status:?}");
}

#[test]
fn the_ai_computer_reports_a_second_one_garbage_and_disturbances() {
    let bench = Bench::new();
    let mut ai = AiComputer::new(bench.clone(), Ai::default());
    bench.frame_comes(ms(5), FrameKind::Standard, 0x510, &[0; 8]);
    bench.frame_comes(ms(6), FrameKind::Standard, 0x520, &[0; 1]);
    bench.frame_comes(ms(6), FrameKind::Standard, 0x525, &[0; 1]);
    bench.frame_comes(ms(6), FrameKind::Standard, 0x123, &[0; 1]);
    bench.comes(ms(7), Event::Disturbance(Disturbance::Down));
    bench.comes(ms(300), Event::Up);
    run(&mut ai, &bench, ms(1000));
    let status = ai.status();
    assert_eq!((status.foreign, status.refused, status.trouble.clone()), (1, 2, None));
    assert_eq!(
        count(status, |what| matches!(what, HappeningKind::OtherAi(text) if text.contains("510h"))),
        1
    );
    assert_eq!(
        count(status, |what| matches!(what, HappeningKind::Refused(text) if text.starts_with("520h: "))),
        1
    );
    assert_eq!(
        count(status, |what| matches!(what, HappeningKind::Refused(text) if text.starts_with("525h: "))),
        1
    );
    assert_eq!(count(status, |what| *what == HappeningKind::Disturbance(Disturbance::Down)), 1);
    assert_eq!(count(status, |what| *what == HappeningKind::Up), 1);
}
