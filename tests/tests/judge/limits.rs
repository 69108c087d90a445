//! Just at a limit of an edition, and just beyond it: an answer, a message that is missed, a steer request; and a VCU that has the
//! limit of another edition.

use adsdv_oracle::judge::{JudgeOptions, Measure, Party, Rule};
use adsdv_spec::messages::{Ai2VcuStatus, Ai2VcuSteer, AnyMessage, AsState, VcuStatus};
use adsdv_spec::{AiMessages, Edition, Fault, Machine, Timing};
use adsdv_tests::world::{MS, Recorded, World, judge};

use crate::check::{Blame, blames, by, is_reported, is_silent, recordings_of_a_kind};

/// The editions that watch messages, each with the limit.
fn watching() -> impl Iterator<Item = (&'static Edition, u16)> {
    Edition::ALL.iter().filter_map(|edition| Some((*edition, edition.rules.thresholds.missed_ms?)))
}

/// AS_DRIVING, and the AI Computer does not answer in so many cycles: its answer comes half a cycle after that.
fn unanswered(mut world: World, ms: i64) -> World {
    world.driving();
    world.ai_answers = false;
    world.wait(ms);
    world.ai_answers = true;
    world.wait(500);
    world
}

/// The VCU and the judge have the same limit: the last answer before it is nobody's fault, and the first behind it is the AI
/// Computer's.
//= HS-9, HS-13, HS-17
#[test]
fn an_answer_is_in_time_up_to_the_limit_of_the_edition() {
    for &edition in Edition::ALL {
        let limit = i64::from(edition.rules.timing.handshake_ms);
        for (ms, in_time) in [(limit - 10, true), (limit, false)] {
            let world = unanswered(World::of(edition), ms);
            let name = format!("{}: answered {} ms after the edge", edition.version, ms + 5);
            assert_eq!(world.control.state == AsState::Driving, in_time, "{name}");
            is_silent(&world, JudgeOptions::of(edition), &name);
            let expected: &[Blame] = if in_time { &[] } else { &[(Rule::HandshakeLate, "2.4")] };
            let report = world.judge(JudgeOptions::of(edition));
            assert_eq!(blames(&report, Party::Ai), expected, "{name}: {:#?}", report.findings);
        }
    }
}

/// A recording in which the slowest answer comes so many milliseconds after its edge, between the same two steps of the VCU as the
/// one that the simulated world has there.
fn answered_after(edition: &'static Edition, ms: i64) -> Vec<Recorded> {
    let limit = i64::from(edition.rules.timing.handshake_ms);
    let silent = if ms > limit { limit } else { limit - 10 };
    let mut world = unanswered(World::of(edition), silent);
    let bit = |recorded: &Recorded| match edition.bus.decode(recorded.frame.id, recorded.frame.data()) {
        Ok(AnyMessage::Vcu2AiStatus(status)) => Some((true, status.handshake)),
        Ok(AnyMessage::Ai2VcuStatus(status)) => Some((false, status.handshake)),
        _ => None,
    };
    let (mut edge, mut shown, mut is_answered, mut slow) = (0, false, true, None);
    for (place, recorded) in world.log.iter().enumerate() {
        match bit(recorded) {
            Some((true, bit)) if bit != shown => (edge, shown, is_answered) = (recorded.t, bit, false),
            Some((false, bit)) if bit == shown && !is_answered => {
                is_answered = true;
                if recorded.t - edge == (silent + 5) * MS {
                    slow = Some((place, edge));
                }
            }
            _ => {}
        }
    }
    let (slow, edge) = slow.expect("a slow answer");
    world.log[slow].t = edge + ms * MS;
    world.log.sort_by_key(|recorded| recorded.t);
    world.log
}

/// What is measured on the bus is late only beyond the limit.
#[test]
fn an_answer_a_millisecond_before_at_and_behind_the_limit() {
    for &edition in Edition::ALL {
        let limit = i64::from(edition.rules.timing.handshake_ms);
        for ms in [limit - 1, limit, limit + 1] {
            let report = judge(&answered_after(edition, ms), JudgeOptions::of(edition));
            let name = format!("{}: {ms} ms", edition.version);
            let slowest = report.responses.max_ms().map(|max| format!("{max:.3} ms"));
            assert_eq!(slowest, Some(format!("{ms}.000 ms")), "{name}");
            let late = report.findings.iter().any(|finding| finding.rule == Rule::HandshakeLate);
            assert_eq!(late, ms > limit, "{name}: {:#?}", report.findings);
            assert!(by(&report, Party::Vcu).is_empty(), "{name}: {:#?}", report.findings);
        }
    }
}

/// AS_DRIVING, and so many messages in a row do not come.
fn left_out(edition: &Edition, id: u16, count: i64) -> World {
    let mut world = World::of(edition);
    world.driving();
    world.mutes.push(id);
    world.wait(count * i64::from(edition.rules.timing.cycle_ms));
    world.mutes.clear();
    world.wait(400);
    world
}

/// 510h carries the answer to the handshake as well, which a VCU misses in the same cycle.
//= HS-18, D-52
#[test]
fn ten_messages_in_a_row_are_missed_and_nine_are_not() {
    for (edition, limit) in watching() {
        for id in AiMessages::IDS {
            for count in [9, 10, 11] {
                let world = left_out(edition, id, count);
                let name = format!("{}: {count} of {id:03X}h", edition.version);
                let missed = count * i64::from(edition.rules.timing.cycle_ms) >= limit.into();
                assert_eq!(missed, count >= 10, "{name}");
                assert_eq!(world.control.state == AsState::EmergencyBrake, missed, "{name}");
                is_silent(&world, JudgeOptions::of(edition), &name);
                let report = world.judge(JudgeOptions::of(edition));
                let is_missed = |blame: &Blame| *blame == (Rule::MessageMissed, "2.4");
                let blames = blames(&report, Party::Ai);
                assert_eq!(blames.iter().any(is_missed), missed, "{name}: {:#?}", report.findings);
                let others = blames.iter().filter(|blame| !is_missed(blame));
                let late = id == Ai2VcuStatus::ID && missed;
                assert_eq!(others.count(), usize::from(late), "{name}: {:#?}", report.findings);
                if missed {
                    let brakes = report.transitions.last().and_then(|transition| transition.decided);
                    assert_eq!(brakes.and_then(|(term, _)| term.fault), Some(Fault::AiCommsFault), "{name}");
                }
            }
        }
    }
}

/// A gap on the bus as long as the limit is none that is too long.
#[test]
fn a_gap_of_the_limit_is_the_margin_of_nothing() {
    for (edition, limit) in watching() {
        let report = left_out(edition, Ai2VcuSteer::ID, 9).judge(JudgeOptions::of(edition));
        let gap = report
            .margins
            .iter()
            .find(|margin| margin.what == Measure::MessageGap && margin.message == Some(Ai2VcuSteer::ID));
        let (gap, limit) = (gap.expect("513h has a gap"), f64::from(limit));
        assert_eq!((gap.value, gap.limit, gap.left()), (limit, limit, 0.0), "{}", edition.version);
    }
}

/// To either side.
#[test]
fn a_steer_request_may_be_at_the_limit_of_the_edition_and_not_a_step_beyond_it() {
    for &edition in Edition::ALL {
        let steer = edition.bus.message(Ai2VcuSteer::ID).expect("513h");
        let signal = steer.signal_of("steer_request").expect("a signal of 513h");
        for (raw, fine) in
            [(signal.max, true), (signal.min, true), (signal.max + 1, false), (signal.min - 1, false)]
        {
            let mut world = World::of(edition);
            world.driving();
            let since = world.t;
            world.wait(300);
            world.falsify(steer, signal.name, since, raw);
            let name = format!("{}: a steer request of {raw}", edition.version);
            let expected: &[Blame] = if fine { &[] } else { &[(Rule::Value, steer.section)] };
            is_reported(&world, JudgeOptions::of(edition), Party::Ai, expected, &name);
            is_silent(&world, JudgeOptions::of(edition), &name);
        }
    }
}

/// A VCU of an edition that waits for an answer for another time.
fn waits_for(edition: &Edition, handshake_ms: u16) -> World {
    let timing = Timing { handshake_ms, ..edition.rules.timing };
    World::new(Machine::new(edition.with_timing(timing), edition.readings))
}

/// The limit of version 3.0 in a VCU of a later one: the AI Computer answers in time, and the VCU brakes.
//= HS-17, HS-19
#[test]
fn a_vcu_that_waits_as_3_0_does_is_to_blame_in_a_later_edition() {
    let before = Edition::V3_0.rules.timing.handshake_ms;
    for &edition in Edition::ALL.iter().filter(|edition| edition.rules.timing.handshake_ms > before) {
        let world = unanswered(waits_for(edition, before), i64::from(before));
        assert_eq!(world.control.state, AsState::EmergencyBrake, "{}", edition.version);
        // In 120h, too, where an edition has it. That it brakes for what it has raised is as it should be.
        let flag = |section| (Rule::FlagUnfounded, section);
        let in_120h = edition.bus.message(VcuStatus::ID).map(|_| flag("2.2"));
        let expected: Vec<Blame> = [flag("2.4")].into_iter().chain(in_120h).collect();
        let report = world.judge(JudgeOptions::of(edition));
        assert_eq!(blames(&report, Party::Vcu), expected, "{}: {:#?}", edition.version, report.findings);
        for seed in 0..recordings_of_a_kind() {
            let report = judge(&world.disturbed(seed, 5 * MS, 0), JudgeOptions::of(edition));
            // 120h may come first.
            let mut blames = blames(&report, Party::Vcu);
            blames.sort_by_key(|&(_, section)| std::cmp::Reverse(section));
            assert_eq!(blames, expected, "{}, seed {seed}: {:#?}", edition.version, report.findings);
        }
        is_reported(&world, JudgeOptions::of(edition), Party::Ai, &[], edition.version);
        // The same VCU is right by the limit that it has.
        let right = unanswered(World::of(edition), i64::from(before));
        assert_eq!(right.control.state, AsState::Driving, "{}", edition.version);
        is_silent(&right, JudgeOptions::of(edition), edition.version);
    }
}
