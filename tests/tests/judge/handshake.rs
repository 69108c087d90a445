//! The handshake: 50 ms, for both sides.

use adsdv_diagnosis::{Deviation, Remembers};
use adsdv_oracle::judge::{JudgeOptions, Meter, Party, Rule, Severity};
use adsdv_spec::messages::{AnyMessage, AsState, Node, Vcu2AiStatus};
use adsdv_spec::{Choice, Edition};
use adsdv_tests::bus::BUS;
use adsdv_tests::world::{MS, Recorded, World, judge};

use crate::check::{is_reported, is_reported_if_seen, is_silent, only, pinned};

/// AS_DRIVING, and the AI Computer does not answer for so long.
fn unanswered(ms: i64, vcu: impl Fn(&mut World)) -> World {
    let mut world = World::reference();
    world.driving();
    vcu(&mut world);
    world.ai_answers = false;
    world.wait(ms);
    world.ai_answers = true;
    world.wait(500);
    world
}

//= HS-13
#[test]
fn an_answer_after_20_ms_is_in_time() {
    let world = unanswered(20, |_| {});
    assert_eq!(world.control.state, AsState::Driving);
    is_silent(&world, JudgeOptions::default(), "answered after 20 ms");
    is_reported(&world, JudgeOptions::default(), Party::Ai, &[], "answered after 20 ms");
}

//= HS-9, HS-10
#[test]
fn an_answer_after_100_ms_is_late() {
    let world = unanswered(100, |_| {});
    assert_eq!(world.control.state, AsState::EmergencyBrake);
    is_silent(&world, JudgeOptions::default(), "answered after 100 ms");
    is_reported(
        &world,
        JudgeOptions::default(),
        Party::Ai,
        &[(Rule::HandshakeLate, "2.4")],
        "answered after 100 ms",
    );
}

/// To the limit the judge says nothing: it is on the bus that it measures.
#[test]
fn an_answer_at_the_limit_is_in_time() {
    let world = unanswered(40, |_| {});
    let mut meter = Meter::default();
    let slow = world.log.iter().position(|Recorded { t, frame }| {
        match BUS.decode(frame.id, frame.data()) {
            Ok(AnyMessage::Vcu2AiStatus(status)) => meter.vcu(*t, status.handshake),
            Ok(AnyMessage::Ai2VcuStatus(status)) => return meter.ai(*t, status.handshake) == Some(45 * MS),
            _ => {}
        }
        false
    });
    let slow = slow.expect("an answer after 45 ms");
    let mut log = world.log.clone();
    log[slow].t += 5 * MS;
    log.sort_by_key(|recorded| recorded.t);
    let report = judge(&log, JudgeOptions::default());
    assert_eq!(report.responses.max_ms(), Some(50.0));
    assert!(!report.findings.iter().any(|finding| finding.rule == Rule::HandshakeLate), "{report:#?}");
}

/// A VCU that never shows that communication is lost.
fn never_raises(world: &mut World) {
    world.hold_state();
    world.shows = |status| {
        status.ai_comms_lost = false;
        status.fault_status = false;
    };
}

#[test]
fn comms_lost_is_due() {
    let world = unanswered(600, never_raises);
    is_reported_if_seen(
        &world,
        JudgeOptions::default(),
        Party::Vcu,
        &[(Rule::CommsLostDue, "2.4")],
        "AI_COMMS_LOST stays 0",
    );
    is_reported_if_seen(
        &world,
        JudgeOptions::default(),
        Party::Ai,
        &[(Rule::HandshakeLate, "2.4")],
        "AI_COMMS_LOST stays 0",
    );
}

#[test]
fn comms_lost_is_due_together_with_its_arrow() {
    let world = unanswered(600, never_raises);
    let both = [(Rule::CommsLostDue, "2.4"), (Rule::Due, "3.7")];
    is_reported_if_seen(&world, pinned(Choice::CommsEveryState), Party::Vcu, &both, "and so does the state");
}

#[test]
fn comms_lost_without_reason() {
    let raises = |world: &mut World| {
        world.hold_state();
        world.shows = |status| {
            status.ai_comms_lost = true;
            status.fault_status = true;
        };
    };
    let world = unanswered(20, raises);
    let expected = [(Rule::FlagUnfounded, "2.4")];
    is_reported(&world, JudgeOptions::default(), Party::Vcu, &expected, "AI_COMMS_LOST though answered");
    is_reported(&world, JudgeOptions::default(), Party::Ai, &[], "AI_COMMS_LOST though answered");
}

/// In AS_OFF, too, once the AI Computer was there; and in every other state also where it never was.
#[test]
fn comms_lost_is_due_where_the_ai_computer_may_be_missing() {
    let mut world = World::reference();
    world.wait(300);
    world.inputs.tsms = true;
    world.wait(300);
    never_raises(&mut world);
    world.ai_answers = false;
    world.wait(600);
    assert_eq!(world.control.state, AsState::Off);
    let due = [(Rule::CommsLostDue, "2.4")];
    is_reported_if_seen(&world, JudgeOptions::default(), Party::Vcu, &due, "unanswered in AS_OFF");

    let mut world = unanswered(600, never_raises);
    world.log.retain(|recorded| recorded.sender() == Some(Node::Vcu));
    is_reported_if_seen(
        &world,
        JudgeOptions::default(),
        Party::Vcu,
        &due,
        "unanswered, and no AI Computer heard",
    );
}

/// While the tractive system is off nobody need answer, where the document is read so.
#[test]
fn comms_lost_while_the_tractive_system_is_off() {
    let mut world = World::reference();
    world.wait(300);
    world.ai_answers = false;
    world.shows = |status| status.handshake = true;
    world.wait(300);
    world.shows = |status| {
        (status.handshake, status.ai_comms_lost, status.fault_status) = (true, true, true);
    };
    world.wait(300);
    let unfounded = [(Rule::FlagUnfounded, "2.4")];
    is_reported(&world, pinned(Choice::HandshakeTsms), Party::Vcu, &unfounded, "raised while TSMS is off");
    is_silent(&world, JudgeOptions::default(), "raised while TSMS is off");
    let report = judge(&world.log, pinned(Choice::HandshakeTsms));
    assert!(only(&report).message().contains("but TS master switch OFF"), "{:#?}", report.findings);
}

#[test]
fn a_bit_that_is_answered_changes() {
    let mut world = World::reference();
    world.driving();
    world.hold_state();
    world.shows = |status| {
        (status.handshake, status.ai_comms_lost, status.fault_status) = (true, false, false);
    };
    world.wait(500);
    let expected = [(Rule::HandshakeEdge, "2.4")];
    is_reported(&world, JudgeOptions::default(), Party::Vcu, &expected, "HANDSHAKE is stuck");
}

#[test]
fn an_ai_computer_that_answers_in_time_is_never_blamed() {
    // Whatever the VCU says: that communication is lost at each edge, or all the time.
    let claims: [fn(&mut adsdv_spec::messages::Vcu2AiStatus); 2] =
        [|status| status.ai_comms_lost = status.handshake, |status| status.ai_comms_lost = true];
    for ms in [0, 10, 20, 30] {
        for shows in claims {
            let world = unanswered(ms, |world| {
                world.hold_state();
                world.shows = shows;
            });
            for window_ms in [1, 10, 30, 45, 60, 200] {
                let options = JudgeOptions { window_ms, ..JudgeOptions::default() };
                is_reported(&world, options, Party::Ai, &[], "answered in time");
            }
        }
    }
}

/// It sends one bit from the beginning on, which the AI Computer answers, and then says that it is not answered.
//= HS-9
#[test]
fn a_bit_that_never_changes_though_it_is_answered_leaves_no_reason_for_a_loss_of_communication() {
    let bits: [fn(&mut Vcu2AiStatus); 2] =
        [|status| status.handshake = true, |status| status.handshake = false];
    for stuck in bits {
        let mut world = World::reference();
        world.shows = stuck;
        world.ready();
        assert_eq!(world.control.state, AsState::EmergencyBrake);
        is_reported(
            &world,
            JudgeOptions { complete: true, ..JudgeOptions::default() },
            Party::Vcu,
            &[(Rule::FlagUnfounded, "2.4")],
            "answered all the time",
        );
    }
}

/// TSMS is switched on while the AI Computer has sent 1 for so long; it answers from then on.
fn begins_against_one(mut world: World, ms: i64) -> World {
    world.wait(300);
    (world.ai_answers, world.ai.status.handshake) = (false, true);
    world.wait(ms);
    world.inputs.tsms = true;
    world.cycle();
    world.ai_answers = true;
    world.wait(300);
    world
}

fn with_one(edition: &Edition) -> World {
    World::deviating(edition, Deviation::Remembers(Remembers::HandshakeBeginsWithOne))
}

/// How often the judge reports a beginning, and how severely.
fn beginnings(log: &[Recorded], options: JudgeOptions) -> Vec<Severity> {
    let report = judge(log, options);
    let beginnings = report.findings.iter().filter(|finding| finding.requirements.contains(&"HS-12"));
    beginnings.map(|finding| finding.severity).collect()
}

//= HS-12
#[test]
fn a_handshake_that_begins_with_1_where_the_ai_computer_sends_1_already_has_no_rising_edge_for_its_answer() {
    for edition in Edition::ALL {
        let open = JudgeOptions::of(edition);
        let complete = JudgeOptions { complete: true, ..open };
        let wrong = begins_against_one(with_one(edition), 400).log;
        assert_eq!(beginnings(&wrong, complete), [Severity::Violation], "{}", edition.version);
        assert_eq!(beginnings(&wrong, open), [Severity::Warning], "{}", edition.version);
        let finding = only(&judge(&wrong, complete));
        assert_eq!((finding.rule, finding.evidence.len()), (Rule::HandshakeEdge, 2));
        let is_right = |vcu, ms| {
            let right = begins_against_one(vcu, ms).log;
            assert_eq!(beginnings(&right, complete), [], "{}", edition.version);
        };
        is_right(World::of(edition), 400);
        // It may have seen a 0 last where one was sent so lately.
        is_right(with_one(edition), 100);
    }
}

/// A single 0 of the AI Computer is reason enough to begin with 1, also where it is recorded late.
#[test]
fn a_0_in_between_is_a_reason_to_begin_with_1() {
    let mut world = World::reference();
    world.wait(300);
    (world.ai_answers, world.ai.status.handshake) = (false, true);
    world.wait(400);
    world.ai.status.handshake = false;
    world.cycle();
    world.ai.status.handshake = true;
    world.inputs.tsms = true;
    world.cycle();
    let begun = world.log.len();
    world.ai_answers = true;
    world.wait(300);
    let complete = JudgeOptions { complete: true, ..JudgeOptions::default() };
    assert_eq!(beginnings(&world.log, complete), []);
    let status = |recorded: &&mut Recorded| recorded.frame.id == adsdv_spec::messages::Ai2VcuStatus::ID;
    for late_ms in [8, 20] {
        let mut log = world.log.clone();
        let zero = log[..begun].iter_mut().rev().filter(status).nth(1).expect("the 510h with 0");
        zero.t += late_ms * MS;
        let one = log[..begun].iter_mut().rev().find(status).expect("the one after it");
        one.t += (late_ms - 9).max(0) * MS;
        log.sort_by_key(|recorded| recorded.t);
        assert!(!beginnings(&log, complete).contains(&Severity::Violation), "late by {late_ms} ms");
    }
}
