//! How close a run came to its limits.

use adsdv_oracle::judge::{Basis, JudgeOptions, Margin, Measure, Report, Rule};
use adsdv_spec::messages::{
    Ai2VcuDriveF, Ai2VcuStatus, AsState, DirectionRequest, MissionStatus, SteerAngle, Vcu2AiStatus,
};
use adsdv_spec::{Choice, Edition};
use adsdv_tests::world::{MS, World, judge};

use crate::check::{pinned, recordings_of_a_kind};

/// The margin of a measure; of the gaps, that of a message.
fn find(report: &Report, what: Measure, message: Option<u16>) -> Option<&Margin> {
    report.margins.iter().find(|margin| margin.what == what && margin.message == message)
}

/// The same, which has to be there, as its value, its limit and its requirements.
fn shown(report: &Report, what: Measure) -> (f64, f64, &[&'static str]) {
    let margin = find(report, what, None).unwrap_or_else(|| panic!("no {}: {report:#?}", what.id()));
    (margin.value, margin.limit, &margin.requirements)
}

fn reported(world: &World) -> Report {
    let edition = Edition::find(world.vcu.edition().version).expect("an edition");
    world.judge(JudgeOptions::of(edition))
}

/// AS_READY for a while, in which the AI Computer answers later for so long.
fn answers_later(edition: &Edition, ms: i64) -> Report {
    let mut world = World::of(edition);
    world.ready();
    world.ai_answers = false;
    world.wait(ms);
    world.ai_answers = true;
    world.wait(1000);
    reported(&world)
}

#[test]
fn the_slowest_answer_is_held_against_the_limit_of_the_edition() {
    for (edition, limit, requirement) in [(&Edition::V3_0, 50.0, "HS-9"), (&Edition::V4_0, 100.0, "HS-17")] {
        let report = answers_later(edition, 20);
        assert_eq!(shown(&report, Measure::HandshakeAnswer), (25.0, limit, &[requirement][..]));
        let late = answers_later(edition, 200);
        let (value, ..) = shown(&late, Measure::HandshakeAnswer);
        assert!((200.0..=205.0).contains(&value), "{value}");
        assert!(find(&late, Measure::HandshakeAnswer, None).is_some_and(|margin| margin.left() < 0.0));
    }
}

/// An answer that never comes has taken until the end of the log.
#[test]
fn no_answer_counts_until_the_end() {
    let mut world = World::reference();
    world.ready();
    world.ai_answers = false;
    world.wait(2000);
    let (value, ..) = shown(&reported(&world), Measure::HandshakeAnswer);
    assert!((1990.0..2010.0).contains(&value), "{value}");
}

/// 511h, left out for so long while all others come.
fn left_out(edition: &Edition, ms: i64, to_the_end: bool) -> Report {
    let mut world = World::of(edition);
    world.ready();
    world.mutes = vec![Ai2VcuDriveF::ID];
    world.wait(ms);
    if !to_the_end {
        world.mutes.clear();
        world.wait(500);
    }
    reported(&world)
}

#[test]
fn the_longest_gap_of_a_message_is_held_against_the_limit_or_the_cycle() {
    let gap = |report: &Report| {
        let margin = find(report, Measure::MessageGap, Some(Ai2VcuDriveF::ID)).expect("511h").clone();
        (margin.value, margin.limit, margin.basis)
    };
    assert_eq!(gap(&left_out(&Edition::V4_0, 60, false)), (70.0, 100.0, Basis::Document));
    assert_eq!(gap(&left_out(&Edition::V4_0, 500, false)), (510.0, 100.0, Basis::Document), "reported");
    assert_eq!(gap(&left_out(&Edition::V4_0, 500, true)), (500.75, 100.0, Basis::Document), "to the end");
    assert_eq!(gap(&left_out(&Edition::V3_0, 500, false)), (510.0, 10.0, Basis::Cycle));
    let report = left_out(&Edition::V4_0, 60, false);
    let vcu = find(&report, Measure::MessageGap, Some(Vcu2AiStatus::ID)).expect("520h");
    assert_eq!((vcu.value, vcu.limit, vcu.basis), (10.0, 10.0, Basis::Cycle));
}

#[test]
fn what_only_has_a_cycle_stands_behind_what_has_a_limit() {
    let report = left_out(&Edition::V4_0, 60, false);
    let cycles: Vec<bool> = report.margins.iter().map(|margin| margin.basis == Basis::Cycle).collect();
    assert!(cycles.is_sorted() && cycles.contains(&true) && cycles.contains(&false), "{cycles:?}");
    for of_a_kind in report.margins.chunk_by(|a, b| (a.basis == Basis::Cycle) == (b.basis == Basis::Cycle)) {
        assert!(of_a_kind.is_sorted_by(|a, b| a.left() <= b.left()), "{of_a_kind:#?}");
    }
}

/// A recorder that pauses, and one that loses frames and says so: the gap is nobody's.
#[test]
fn a_time_in_which_nothing_comes_is_no_gap() {
    let mut world = World::of(&Edition::V4_0);
    world.ready();
    world.wait(1000);
    let away = world.t - 300 * MS..world.t - 220 * MS;
    world.log.retain(|recorded| !away.contains(&recorded.t));
    let report = reported(&world);
    let gap = find(&report, Measure::MessageGap, Some(Ai2VcuStatus::ID)).expect("510h");
    assert!(gap.value < 11.0, "{gap:?}");
}

/// FINISHED at speed leads to EMERGENCY_BRAKE at once; and, two steps later the second time.
#[test]
fn the_way_to_an_emergency_is_timed() {
    let mut world = World::with_reading(Choice::PowerCycleNotLatched);
    for late in [0, 20] {
        world.driving();
        let vcu = world.vcu;
        world.ai.status.mission_status = MissionStatus::Finished;
        if late > 0 {
            world.hold_state();
            world.wait(late);
            world.vcu = vcu;
        }
        world.wait(500);
        assert_eq!(world.control.state, AsState::EmergencyBrake);
        world.wheels(0);
        world.wait(16_000);
        world.inputs.asms = false;
        world.inputs.go = false;
        world.ai.status.mission_status = MissionStatus::NotSelected;
        world.ai.status.direction_request = DirectionRequest::Neutral;
        world.wait(500);
    }
    let report = reported(&world);
    let (fastest, limit, requirements) = shown(&report, Measure::FastestReaction);
    assert!(requirements.contains(&"DTE-4"), "{requirements:?}");
    assert_eq!((fastest, limit), (5.0, f64::from(JudgeOptions::default().deadline_ms)));
    let (slowest, limit, _) = shown(&report, Measure::SlowestReaction);
    assert_eq!((slowest, limit), (15.0, f64::from(JudgeOptions::default().deadline_ms)));
}

/// AS_DRIVING at this speed, and the AI Computer does something.
fn at_speed(rpm: i32, does: fn(&mut World)) -> Report {
    let mut world = World::reference();
    world.driving();
    world.wheels(rpm);
    world.wait(500);
    does(&mut world);
    world.wait(500);
    world.judge(pinned(Choice::FaultLevel))
}

#[test]
fn the_speed_at_finished_and_at_neutral() {
    let finished: fn(&mut World) = |world| world.ai.status.mission_status = MissionStatus::Finished;
    let neutral: fn(&mut World) = |world| world.ai.status.direction_request = DirectionRequest::Neutral;
    for (what, other, does) in [
        (Measure::FinishedSpeed, Measure::NeutralSpeed, finished),
        (Measure::NeutralSpeed, Measure::FinishedSpeed, neutral),
    ] {
        for rpm in [0, 7, 10, 11, 400] {
            let report = at_speed(rpm, does);
            let (value, limit, _) = shown(&report, what);
            assert_eq!((value, limit), (f64::from(rpm), 10.0));
            let left = find(&report, what, None).expect("it is there").left();
            assert_eq!(left < 0.0, rpm > 10, "{rpm}: {left}");
            assert_eq!(find(&report, other, None), None);
        }
    }
}

/// The way into AS_DRIVING with this angle and after so long, whatever the table says.
fn goes(tenths: i32, ms: i64) -> Report {
    let mut world = World::reference();
    world.prepare();
    world.inputs.vehicle.steer_angle = SteerAngle::clamped(tenths);
    world.inputs.asms = true;
    world.wait(ms);
    world.inputs.go = true;
    world.force(AsState::Driving);
    world.wait(500);
    reported(&world)
}

#[test]
fn the_angle_and_the_dwell_at_go() {
    let report = goes(-49, 6000);
    assert_eq!(shown(&report, Measure::SteerAtGo), (4.9, 5.0, &["DRV-9"][..]));
    let (value, limit, requirements) = shown(&report, Measure::ReadyDwell);
    assert_eq!((value, limit, requirements), (6010.0, 5000.0, &["DRV-4"][..]));
    let wrong = goes(60, 6000);
    assert_eq!(shown(&wrong, Measure::SteerAtGo), (6.0, 5.0, &["DRV-9"][..]));
    assert!(find(&wrong, Measure::SteerAtGo, None).is_some_and(|margin| margin.left() < 0.0));
    let early = goes(0, 4000);
    assert_eq!(shown(&early, Measure::ReadyDwell), (4010.0, 5000.0, &["DRV-4"][..]));
    assert!(find(&early, Measure::ReadyDwell, None).is_some_and(|margin| margin.left() < 0.0));
}

#[test]
fn what_never_happened_has_no_margin() {
    let mut world = World::reference();
    world.ai_sends = false;
    world.wait(1000);
    let report = reported(&world);
    assert!(report.margins.iter().all(|margin| margin.basis == Basis::Cycle), "{:#?}", report.margins);
}

/// What is reported where a value is past its limit.
fn rules(what: Measure) -> &'static [Rule] {
    match what {
        Measure::HandshakeAnswer => &[Rule::HandshakeLate],
        Measure::MessageGap => &[Rule::MessageMissed],
        Measure::SlowestReaction | Measure::FastestReaction => &[Rule::Due],
        Measure::FinishedSpeed => &[Rule::FinishedMoving],
        Measure::NeutralSpeed => &[Rule::NeutralMoving],
        Measure::SteerAtGo | Measure::ReadyDwell => &[Rule::Unjustified],
    }
}

/// However the recorder works: a margin is negative only where that was reported.
#[test]
fn nothing_is_past_a_limit_that_was_not_reported() {
    let runs: [fn(&mut World); 8] = [
        World::finished,
        |world| {
            world.driving();
            world.ai.status.mission_status = MissionStatus::Finished;
        },
        |world| {
            world.driving();
            world.ai_answers = false;
        },
        |world| {
            world.ready();
            world.mutes = vec![Ai2VcuDriveF::ID];
        },
        // Whether it is the recorder that hears nothing of the AI Computer, nobody knows.
        |world| {
            world.ready();
            world.ai_sends = false;
            world.wait(300);
            world.ai_sends = true;
        },
        // The wheels come to rest as FINISHED is declared.
        |world| {
            world.driving();
            world.hold_state();
            world.wheels(12);
            world.wait(20);
            world.ai.status.mission_status = MissionStatus::Finished;
            world.cycle();
            world.wheels(5);
        },
        // "Go" comes just in time.
        |world| {
            world.prepare();
            world.inputs.asms = true;
            world.wait(5000);
            world.inputs.go = true;
            world.force(AsState::Driving);
        },
        // EMERGENCY_BRAKE comes at the deadline.
        |world| {
            world.driving();
            let vcu = world.vcu;
            world.hold_state();
            world.ai.status.mission_status = MissionStatus::Finished;
            world.wait(60);
            world.vcu = vcu;
        },
    ];
    for (edition, run) in [&Edition::V3_0, &Edition::V4_0].into_iter().flat_map(|e| runs.map(|run| (e, run)))
    {
        let mut world = World::of(edition);
        run(&mut world);
        world.wait(500);
        for seed in 0..recordings_of_a_kind() {
            for (jitter, loss) in [(5, 0), (15, 0), (0, 20)] {
                let log = world.disturbed(seed, jitter * MS, loss);
                let report = judge(&log, JudgeOptions::of(edition));
                for margin in &report.margins {
                    let was = |rule: &Rule| report.findings.iter().any(|finding| finding.rule == *rule);
                    let past = margin.basis != Basis::Cycle && margin.left() < 0.0;
                    assert!(
                        !past || rules(margin.what).iter().any(was),
                        "{margin:#?} {:#?}",
                        report.findings
                    );
                }
            }
        }
    }
}
