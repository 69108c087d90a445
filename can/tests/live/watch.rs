//! The live judge says what `check` says of the same frames, and says it as soon as it is certain.

use std::convert::Infallible;
use std::error::Error;

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::bus::{Disturbance, Received};
use adsdv_can::demo::{self, DemoOptions};
use adsdv_can::live::Watch;
use adsdv_can::scenario::Scenario;
use adsdv_oracle::candump::{FrameKind, Reader, write_dropped, write_record};
use adsdv_oracle::judge::{Finding, Report, Rule, Severity, Transition};
use adsdv_oracle::log::{LogError, LogOptions, judge_log, judge_recognised};
use adsdv_spec::messages::{AsState, Vcu2AiStatus};
use adsdv_spec::{AiMessages, Edition};

use super::bench::{encoded, received};
use super::{Bench, mission, ms, run};

const ORIGIN: i64 = 1_795_209_995_000_000_000;
const MS: i64 = 1_000_000;

fn at(ns: i64, frame: Received) -> Received {
    Received { time_ns: ORIGIN + ns, ..frame }
}

fn status(state: AsState) -> Received {
    let as_switch_status = state != AsState::Off;
    let frame = encoded(Vcu2AiStatus { as_state: state, as_switch_status, ..Vcu2AiStatus::default() });
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
fn watch_reports_what_check_reports_of_the_recorded_log() -> Result<(), Box<dyn Error>> {
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
    // Nothing that was news is missing from the report, or was reported twice.
    assert!(transitions.len() <= live.transitions.len() && !transitions.is_empty());
    assert!(
        transitions
            .iter()
            .all(|reported| live.transitions.iter().filter(|other| *other == reported).count() == 1)
    );
    assert!(findings.iter().all(|reported| live.findings.contains(reported)) && !findings.is_empty());
    assert_eq!((traffic.frames, traffic.errors), (live.frames, live.frames / 104 + 1));
    assert!((800..=860).contains(&traffic.busiest), "{}", traffic.busiest);
    Ok(())
}

/// A mission of an edition, both sides, as it is on the bus.
fn both_sides(edition: &'static Edition) -> Vec<Received> {
    let mut frames = Vec::new();
    let ai = Ai::new(edition, Plan::DEFAULT);
    demo::run(&Scenario::mission(), ai, &DemoOptions::default(), |ns, frame| {
        frames.push(at(ns, received(FrameKind::Standard, frame.id.into(), frame.data())));
        Ok::<(), Infallible>(())
    })
    .expect("it drives");
    frames
}

/// Whatever comes first, and however long the pauses are in which the judge learns of silence.
#[test]
fn watch_recognises_the_edition_that_check_recognises_in_the_recorded_log() -> Result<(), Box<dyn Error>> {
    let ai_first = |frames: &[Received], alone: i64| -> Vec<Received> {
        let is_ai = |frame: &Received| AiMessages::IDS.iter().any(|&id| frame.id == u32::from(id));
        let later = |frame: &Received| Received { time_ns: frame.time_ns + alone, ..*frame };
        let ai = frames.iter().filter(|frame| is_ai(frame) && frame.time_ns < ORIGIN + alone).copied();
        ai.chain(frames.iter().map(later)).collect()
    };
    for edition in Edition::ALL {
        let whole = both_sides(edition);
        let vcu_only: Vec<Received> = whole.iter().filter(|frame| frame.id >= 0x520).copied().collect();
        let status_only: Vec<Received> = whole.iter().filter(|frame| frame.id == 0x520).copied().collect();
        let pause: Vec<Received> = whole
            .iter()
            .filter(|frame| !(900..2700).contains(&((frame.time_ns - ORIGIN) / MS)))
            .copied()
            .collect();
        let few = whole.iter().take(30).copied().collect();
        let all = [
            ai_first(&whole, 3000 * MS),
            ai_first(&whole, 12_000 * MS),
            whole,
            vcu_only,
            status_only,
            pause,
            few,
        ];
        for (place, frames) in all.iter().enumerate() {
            let case = format!("edition {}, case {place}", edition.version);
            let mut watch = Watch::recognising("vcan0", LogOptions::default());
            let mut log = Vec::new();
            let mut named_after = None;
            let mut now = ORIGIN;
            let (mut transitions, mut findings): (Vec<Transition>, Vec<Finding>) = Default::default();
            for frame in frames {
                // As the thread does that listens: nothing came for so long, and then again.
                while frame.time_ns - now > 50 * MS {
                    now += 50 * MS;
                    watch.silence(now);
                }
                now = frame.time_ns;
                write_record(&mut log, &watch.frame(frame).record("vcan0"))?;
                if watch.recognised().is_some() && named_after.is_none() {
                    named_after = Some(watch.since_first(now));
                }
                let (new_transitions, new_findings) = watch.news();
                transitions.extend(new_transitions);
                findings.extend(new_findings);
            }
            watch.decide();
            let live = watch.recognised().cloned().expect("it is decided");
            let report = watch.finish()?;
            let check = judge_recognised(Reader::new(log.as_slice()), &LogOptions::default(), |_| {})?;
            assert_eq!(live, check.recognised, "{case}");
            assert_eq!(report.transitions, check.report.transitions, "{case}");
            assert_eq!(report.findings, check.report.findings, "{case}");
            assert!(transitions.iter().all(|reported| report.transitions.contains(reported)), "{case}");
            assert!(findings.iter().all(|reported| report.findings.contains(reported)), "{case}");
            assert_eq!(
                transitions.len(),
                report.transitions.len(),
                "{case}: none is lost before it is decided"
            );
            let length = frames.last().map_or(0, |frame| frame.time_ns) - ORIGIN;
            let bound = 10_100 * MS;
            assert!(named_after.is_none_or(|reported| reported <= bound), "{case}: {named_after:?}");
            assert!(named_after.is_some() || length < bound, "{case}: it takes too long");
            if live.certain {
                assert_eq!(live.edition, *edition, "{case}: {live}");
            }
        }
    }
    Ok(())
}

#[test]
fn the_judge_reports_what_is_certain_though_nothing_comes_any_more() {
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
    assert!(watch.news().0.is_empty(), "it is reported once");
}

#[test]
fn lost_frames_are_reported_and_blamed_on_nobody() -> Result<(), Box<dyn Error>> {
    let judged = |lost: bool| -> Result<_, LogError> {
        let mut watch = Watch::new("can0", LogOptions::default());
        for cycle in 0..100 {
            watch.frame(&at(cycle * 10 * MS, status(AsState::Off)));
        }
        if lost {
            assert!(watch.dropped(350).is_some());
            assert_eq!(watch.dropped(350), None);
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
    let reported: Vec<_> = lost.findings.iter().filter(|finding| finding.rule == Rule::Gap).collect();
    assert_eq!(reported.len(), 1);
    assert!(
        reported[0].seen.starts_with("350 frames lost here") && reported[0].t_ns == 990 * MS,
        "{reported:?}"
    );
    Ok(())
}

#[test]
fn a_bus_without_a_frame_has_no_report() {
    let mut watch = Watch::new("can0", LogOptions::default());
    watch.silence(ORIGIN);
    watch.trouble(ORIGIN, &Disturbance::Down);
    assert_eq!((watch.traffic().frames, watch.traffic().troubles), (0, 1));
    assert!(matches!(watch.finish(), Err(LogError::NoFrame { .. })));
}

/// The same as `check` says of the log, whatever happens between the frames.
fn assert_same(live: &Report, log: &[u8], what: &str) -> Result<(), Box<dyn Error>> {
    let recorded = judge_log(log, &LogOptions::default(), |_| {})?;
    assert_eq!(live.transitions, recorded.transitions, "{what}");
    // Of two long lists, what only one of them has.
    let only = |one: &Report, other: &Report| -> Vec<Finding> {
        one.findings.iter().filter(|finding| !other.findings.contains(finding)).cloned().collect()
    };
    assert_eq!((only(live, &recorded), only(&recorded, live)), (vec![], vec![]), "{what}");
    assert!(live.findings == recorded.findings, "{what}: the order, or how often");
    assert_eq!((live.frames, live.duration_ns), (recorded.frames, recorded.duration_ns), "{what}");
    assert_eq!(live.responses.count(), recorded.responses.count(), "{what}");
    Ok(())
}

#[test]
fn silences_and_losses_are_judged_as_in_the_log() -> Result<(), Box<dyn Error>> {
    let frames = traffic();
    let (mut silences, mut losses, mut gaps) = (0, 0, 0);
    for round in 0..60 {
        let mut random = fastrand::Rng::with_seed(0x0AD5_D001 + round);
        let mut watch = Watch::new("vcan0", LogOptions::default());
        let mut log = Vec::new();
        let (mut later, mut dropped, mut skip) = (0, 0, 0);
        let mut last = ORIGIN;
        for frame in &frames {
            // The bus is silent from time to time, for as long as to be noticed, or not.
            if random.u32(..400) == 0 {
                later += random.i64(0..600) * MS;
                silences += 1;
            }
            // Or frames are lost, one or many, once or time and again.
            if skip == 0 && random.u32(..if dropped % 2 == 1 { 20 } else { 600 }) == 0 {
                skip = random.i32(1..=40);
            }
            if skip > 0 {
                skip -= 1;
                dropped += 1;
                continue;
            }
            let frame = Received { time_ns: frame.time_ns + later, ..*frame };
            // The thread that listens reports silence every 50 ms or so, and never where a frame came.
            let mut now = last;
            while now < frame.time_ns {
                now += random.i64(1..=120 * MS);
                if now - 100 * MS < frame.time_ns {
                    watch.silence(now);
                }
            }
            last = frame.time_ns;
            if let Some(lost) = watch.dropped(dropped) {
                write_dropped(&mut log, &lost)?;
                losses += 1;
            }
            let logged = watch.frame(&frame);
            write_record(&mut log, &logged.record("vcan0"))?;
            watch.news();
        }
        watch.silence(last + random.i64(0..1000) * MS);
        let live = watch.finish()?;
        gaps += live.findings.iter().filter(|finding| finding.seen.contains("lost")).count();
        assert_same(&live, &log, &format!("round {round}"))?;
    }
    assert!(silences > 100 && losses > 100 && gaps > 50 && gaps < losses, "{silences} {losses} {gaps}");
    Ok(())
}

#[test]
fn a_pause_of_the_recorder_counts_whole_towards_no_timer() -> Result<(), Box<dyn Error>> {
    // AS_READY for just less than its dwell by the frames; a silence makes it more by the clock.
    let mut watch = Watch::new("can0", LogOptions::default());
    let mut log = Vec::new();
    let mut later = 0;
    for cycle in 0..700 {
        if cycle == 300 {
            for step in 1..=9 {
                watch.silence(ORIGIN + (cycle * 10 + step * 50) * MS);
            }
            later = 400 * MS;
        }
        let state = match cycle {
            10..490 => AsState::Ready,
            _ => AsState::Off,
        };
        let logged = watch.frame(&at(cycle * 10 * MS + later, status(state)));
        write_record(&mut log, &logged.record("can0"))?;
    }
    assert_same(&watch.finish()?, &log, "a pause of 400 ms")
}

#[test]
fn losses_without_end_are_few_findings_with_their_sum() -> Result<(), Box<dyn Error>> {
    let mut watch = Watch::new("can0", LogOptions::default());
    let mut log = Vec::new();
    for cycle in 0..2500_u32 {
        // Each second frame was dropped, for 25 s; the value is wrong in all that came.
        if let Some(lost) = watch.dropped(cycle.into()) {
            write_dropped(&mut log, &lost)?;
        }
        let wrong = received(FrameKind::Standard, 0x520, &[0, 0, 0xFF, 0, 0, 0, 0, 0]);
        let logged = watch.frame(&at(i64::from(cycle) * 10 * MS, wrong));
        write_record(&mut log, &logged.record("can0"))?;
    }
    assert_eq!(watch.traffic().dropped, 2499);
    let live = watch.finish()?;
    assert_same(&live, &log, "each second frame lost")?;
    let reported: Vec<_> = live.findings.iter().filter(|finding| finding.rule == Rule::Gap).collect();
    assert_eq!(reported.len(), 3, "{reported:#?}");
    let sum: u64 = reported.iter().filter_map(|f| f.seen.split(' ').next()?.parse::<u64>().ok()).sum();
    assert_eq!(sum, 2499);
    assert!(reported[0].seen.contains("times in") && reported[0].seen.contains("each time"), "{reported:#?}");
    let values = live.findings.iter().filter(|finding| finding.rule == Rule::Value).count();
    assert!((1..=30).contains(&values), "{values}");
    Ok(())
}

#[test]
fn the_log_blames_nobody_for_what_was_lost() -> Result<(), Box<dyn Error>> {
    let mut watch = Watch::new("can0", LogOptions::default());
    let mut log = Vec::new();
    for cycle in 0..200 {
        if cycle == 100 {
            write_dropped(&mut log, &watch.dropped(7).ok_or("7 are new")?)?;
        }
        let state = if cycle < 100 { AsState::Off } else { AsState::Finished };
        let logged = watch.frame(&at(cycle * 10 * MS, status(state)));
        write_record(&mut log, &logged.record("can0"))?;
    }
    assert_same(&watch.finish()?, &log, "7 lost")?;
    let judged = |log: &[u8]| judge_log(log, &LogOptions::default(), |_| {});
    assert_eq!(judged(&log)?.count(Severity::Violation), 0);
    // What another interface lost excuses nobody.
    let other = String::from_utf8(log)?.replace("'can0'", "'can1'");
    assert!(judged(other.as_bytes())?.count(Severity::Violation) > 0);
    Ok(())
}

#[test]
fn of_more_findings_than_are_listed_one_a_second_is_reported() -> Result<(), Box<dyn Error>> {
    let mut watch = Watch::new("can0", LogOptions::default());
    let mut reported = Vec::new();
    for cycle in 0..1000 {
        // Off and Finished, with no arrow either way: 100 violations a second for ten seconds.
        let state = if cycle % 2 == 0 { AsState::Off } else { AsState::Finished };
        watch.frame(&at(cycle * 10 * MS, status(state)));
        reported.extend(watch.news().1);
    }
    let of = |rule: Rule| reported.iter().filter(move |finding| finding.rule == rule).collect::<Vec<_>>();
    let listed = watch.finish()?.findings.iter().filter(|finding| finding.rule == Rule::NoArrow).count();
    let further: Vec<_> = of(Rule::Repeated);
    let further: Vec<_> = further.iter().filter(|f| f.seen.contains(Rule::NoArrow.id())).collect();
    assert_eq!(further.len(), 1, "{further:#?}");
    assert!(further[0].seen.contains("counted"), "{further:#?}");
    let more = of(Rule::NoArrow).len() - listed;
    assert!(listed == 200 && (5..=8).contains(&more), "{listed} listed, {more} more reported");
    Ok(())
}
