//! The live judge says what `check` says of the same frames, and says it as soon as it is certain.

use std::error::Error;

use adsdv_can::ai::Ai;
use adsdv_can::bus::{Received, Trouble};
use adsdv_can::live::Watch;
use adsdv_oracle::candump::{FrameKind, write_record};
use adsdv_oracle::judge::{Finding, Rule, Severity, Transition};
use adsdv_oracle::log::{LogError, LogOptions, judge_log};
use adsdv_spec::messages::{AsState, Message as _, Vcu2AiStatus};

use super::bench::received;
use super::{Bench, mission, ms, run};

const ORIGIN: i64 = 1_795_209_995_000_000_000;
const MS: i64 = 1_000_000;

fn at(ns: i64, frame: Received) -> Received {
    Received { time_ns: ORIGIN + ns, ..frame }
}

fn status(state: AsState) -> Received {
    let as_switch_status = state != AsState::Off;
    let frame = Vcu2AiStatus { as_state: state, as_switch_status, ..Vcu2AiStatus::default() }.encode();
    received(FrameKind::Standard, frame.id.into(), frame.data())
}

/// The VCU's frames of a mission without an AI Computer's, with frames of every kind between them.
fn traffic() -> Vec<Received> {
    let bench = Bench::new();
    bench.plug_in(Ai::default());
    let mut vcu = mission(&bench);
    run(&mut vcu, &bench, ms(8000));
    let mut frames = Vec::new();
    for (index, (time, frame)) in bench.take_sent().into_iter().enumerate() {
        // A kernel tells nanoseconds, of which a log has microseconds.
        let ns = i64::try_from(time.as_nanos()).expect("seconds") + i64::try_from(index % 997).expect("few");
        let id = if index % 50 == 49 { 0x510 } else { frame.id };
        frames.push(at(ns, received(FrameKind::Standard, id.into(), frame.data())));
        match index % 100 {
            10 => frames.push(at(ns, received(FrameKind::Error, 4, &[0, 0x30, 0, 0, 0, 0, 0, 0]))),
            20 => frames.push(at(ns, received(FrameKind::Extended, 0x18FF_50E5, &[1, 2, 3]))),
            30 => frames.push(at(ns, received(FrameKind::Remote { extended: false, len: 8 }, 0x520, &[]))),
            40 => frames.push(at(ns, received(FrameKind::Standard, 0x520, &[1]))),
            _ => {}
        }
    }
    frames
}

#[test]
fn it_says_what_check_says_of_the_log_that_it_recorded() -> Result<(), Box<dyn Error>> {
    let mut watch = Watch::new("vcan0", LogOptions::default());
    let mut log = Vec::new();
    let (mut transitions, mut findings): (Vec<Transition>, Vec<Finding>) = Default::default();
    for (index, frame) in traffic().iter().enumerate() {
        let logged = watch.frame(frame);
        write_record(&mut log, &logged.record("vcan0"))?;
        if index % 7 == 0 {
            let (new_transitions, new_findings) = watch.news();
            transitions.extend(new_transitions);
            findings.extend(new_findings);
        }
    }
    let traffic = watch.traffic();
    let live = watch.finish()?;
    let recorded = judge_log(log.as_slice(), &LogOptions::default(), |_| {})?;
    assert_eq!(live.transitions, recorded.transitions);
    assert_eq!(live.findings, recorded.findings);
    assert_eq!((live.frames, live.duration_ns), (recorded.frames, recorded.duration_ns));
    assert!(live.transitions.len() >= 2 && live.findings.len() >= 3, "{:#?}", live.findings);
    // Nothing that was news is missing from the report, or was told twice.
    assert!(transitions.len() <= live.transitions.len() && !transitions.is_empty());
    assert!(
        transitions.iter().all(|told| live.transitions.iter().filter(|other| *other == told).count() == 1)
    );
    assert!(findings.iter().all(|told| live.findings.contains(told)) && !findings.is_empty());
    assert_eq!((traffic.frames, traffic.errors), (live.frames, live.frames / 104 + 1));
    assert!((800..=860).contains(&traffic.busiest), "{}", traffic.busiest);
    Ok(())
}

#[test]
fn what_is_certain_is_told_though_nothing_comes_any_more() {
    let mut watch = Watch::new("can0", LogOptions::default());
    watch.silence(ORIGIN - 500 * MS);
    for cycle in 0..20 {
        watch.frame(&at(cycle * 10 * MS, status(AsState::Off)));
    }
    watch.frame(&at(200 * MS, status(AsState::Driving)));
    assert!(watch.news().0.is_empty());
    // A frame that the kernel has may still be on its way.
    watch.silence(ORIGIN + 250 * MS);
    assert!(watch.news().0.is_empty());
    watch.silence(ORIGIN + 400 * MS);
    let (transitions, _) = watch.news();
    assert_eq!(transitions.len(), 1);
    assert_eq!((transitions[0].t_ns, transitions[0].to), (200 * MS, AsState::Driving));
    watch.silence(ORIGIN + 5000 * MS);
    assert!(watch.news().0.is_empty(), "it is told once");
}

#[test]
fn lost_frames_are_told_and_blamed_on_nobody() -> Result<(), Box<dyn Error>> {
    let judged = |lost: bool| -> Result<_, LogError> {
        let mut watch = Watch::new("can0", LogOptions::default());
        for cycle in 0..100 {
            watch.frame(&at(cycle * 10 * MS, status(AsState::Off)));
        }
        if lost {
            watch.dropped(350);
            watch.dropped(350);
        }
        // What was between them would have led here.
        for cycle in 100..200 {
            watch.frame(&at(cycle * 10 * MS, status(AsState::Finished)));
        }
        assert_eq!(watch.traffic().dropped, if lost { 350 } else { 0 });
        watch.finish()
    };
    let (lost, whole) = (judged(true)?, judged(false)?);
    assert!(whole.count(Severity::Violation) > 0);
    assert_eq!(lost.count(Severity::Violation), 0, "{:#?}", lost.findings);
    let told: Vec<_> = lost.findings.iter().filter(|finding| finding.rule == Rule::Gap).collect();
    assert_eq!(told.len(), 1);
    assert!(told[0].message.starts_with("350 frames lost here") && told[0].t_ns == 990 * MS, "{told:?}");
    Ok(())
}

#[test]
fn a_bus_without_a_frame_has_no_report() {
    let mut watch = Watch::new("can0", LogOptions::default());
    watch.silence(ORIGIN);
    watch.trouble(&Trouble::Down);
    assert_eq!((watch.traffic().frames, watch.traffic().troubles), (0, 1));
    assert!(matches!(watch.finish(), Err(LogError::NoFrame { .. })));
}
