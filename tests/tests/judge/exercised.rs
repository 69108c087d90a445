//! What a recording exercised: which requirements it shows, and which it never touched.

use std::collections::HashSet;

use adsdv_conform::suite;
use adsdv_oracle::judge::{Exercised, Judge, JudgeOptions, Lack, Required, Standing};
use adsdv_spec::messages::{AsState, AxleTorqueRequest, MissionStatus, Node, Vcu2AiStatus};
use adsdv_spec::{Atom, Choice, Edition};
use adsdv_tests::world::{World, judge};

use crate::check::pinned;

fn exercised(world: &World) -> Exercised {
    let edition = Edition::find(world.vcu.edition().version).expect("an edition");
    world.judge(JudgeOptions::of(edition)).exercised
}

/// How these requirements stand.
fn standings<const N: usize>(exercised: &Exercised, ids: [&str; N]) -> [Standing; N] {
    ids.map(|id| {
        let found = exercised.requirements.iter().find(|requirement| requirement.id == id);
        found.unwrap_or_else(|| panic!("no log can show {id}")).standing
    })
}

#[test]
fn a_mission_shows_its_arrows_and_nothing_of_an_emergency() {
    let mut world = World::reference();
    world.finished();
    let exercised = exercised(&world);
    let held = ["SM-9", "RDY-1", "RDY-5", "SM-11", "DRV-4", "DRV-9", "DRV-12", "SM-14", "FIN-3", "FIN-4"];
    assert_eq!(standings(&exercised, held), [Standing::Held; 10]);
    assert_eq!(standings(&exercised, ["SM-18", "HS-4", "HS-5", "HS-6", "HS-7"]), [Standing::Held; 5]);
    assert_eq!(
        standings(&exercised, ["DRV-2", "DRV-3", "FIN-5"]),
        [Standing::NotCertain; 3],
        "no message shows it"
    );
    let never = ["SM-13", "DTE-1", "DTE-4", "HS-9", "MSG-54", "ETO-1", "SM-16", "D-43"];
    assert_eq!(standings(&exercised, never), [Standing::NotExercised; 8]);
    assert_eq!(exercised.count(Standing::Violated), 0);
    let all: usize = Standing::ALL.iter().map(|&standing| exercised.count(standing)).sum();
    assert_eq!(all, exercised.requirements.len());
    assert_eq!((exercised.lacks(), exercised.states.len()), (vec![], 4));
}

#[test]
fn an_open_circuit_is_shown_by_a_flag_whose_own_reason_no_message_shows() {
    let mut world = World::reference();
    world.braking();
    let found = standings(&exercised(&world), ["SM-13", "DTE-1", "MSG-55", "DTE-4"]);
    assert_eq!(found, [Standing::Held, Standing::Held, Standing::NotCertain, Standing::NotExercised]);
}

#[test]
fn finished_at_speed_holds_for_the_vcu_and_not_for_the_ai_computer() {
    let mut world = World::of(&Edition::V4_0);
    world.driving();
    world.ai.status.mission_status = MissionStatus::Finished;
    world.wait(500);
    let exercised = exercised(&world);
    assert_eq!(standings(&exercised, ["DTE-7", "IMP-5", "IMP-4", "MSG-61"]), [Standing::Held; 4]);
    assert_eq!(standings(&exercised, ["FIN-3", "DTE-8"]), [Standing::Violated, Standing::NotExercised]);
}

#[test]
fn a_condition_that_was_passed_over_is_violated_and_its_row() {
    let mut world = World::reference();
    world.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(50);
    world.dwelt();
    world.inputs.go = true;
    world.force(AsState::Driving);
    world.wait(500);
    let found = standings(&exercised(&world), ["DRV-5", "SM-11", "DRV-6", "SM-18"]);
    assert_eq!(found, [Standing::Violated, Standing::Violated, Standing::NotExercised, Standing::Held]);
}

/// Where the readings differ in what an arrow needs, only what all of them ask for is certain to be broken.
#[test]
fn a_condition_that_only_some_readings_have_is_not_violated() {
    let mut world = World::reference();
    world.wait(500);
    world.inputs.tsms = true;
    world.wait(500);
    world.force(AsState::Ready);
    world.wait(500);
    let found = standings(&exercised(&world), ["SM-9", "RDY-2", "RDY-4", "RDY-3", "RDY-1"]);
    let broken = [Standing::Violated; 3];
    assert_eq!((&found[..3], &found[3..]), (&broken[..], &[Standing::NotExercised; 2][..]));
}

#[test]
fn an_arrow_that_was_not_taken_is_violated() {
    let mut world = World::reference();
    world.ready();
    world.hold_state();
    world.inputs.asms = false;
    world.wait(500);
    assert_eq!(standings(&exercised(&world), ["SM-10", "RTO-1"]), [Standing::Violated; 2]);
}

#[test]
fn an_arrow_that_comes_first_is_the_one_that_is_violated() {
    let mut world = World::reference();
    world.dwelt();
    world.hold_state();
    world.inputs.asms = false;
    world.wait(50);
    world.inputs.go = true;
    world.force(AsState::Driving);
    world.wait(500);
    let found = standings(&exercised(&world), ["SM-10", "SM-11"]);
    assert_eq!(found, [Standing::Violated, Standing::NotExercised]);
}

#[test]
fn an_arrow_that_there_is_not_violates_that_there_are_no_others() {
    let mut world = World::reference();
    world.ready();
    world.force(AsState::Finished);
    world.wait(500);
    assert_eq!(standings(&exercised(&world), ["SM-18"]), [Standing::Violated]);
}

/// AS_DRIVING, and the AI Computer does not answer any more.
fn silent(vcu: fn(&mut World)) -> World {
    let mut world = World::reference();
    world.driving();
    vcu(&mut world);
    world.ai_answers = false;
    world.wait(600);
    world
}

#[test]
fn the_handshake_when_an_edge_is_lost() {
    let right = silent(|_| {});
    let exercised_right = right.judge(pinned(Choice::CommsEveryState)).exercised;
    assert_eq!(standings(&exercised_right, ["HS-9", "HS-16", "MSG-59"]), [Standing::Held; 3]);
    assert_eq!(standings(&exercised_right, ["HS-5", "HS-10"]), [Standing::Violated, Standing::NotCertain]);
    let wrong = silent(|world| {
        world.hold_state();
        world.shows = |status| (status.ai_comms_lost, status.fault_status) = (false, false);
    });
    assert_eq!(standings(&exercised(&wrong), ["HS-9", "HS-16"]), [Standing::Violated; 2]);
}

#[test]
fn a_bit_that_changes_without_an_answer_is_not_held() {
    let mut world = silent(World::hold_state);
    let since = world.t - 300_000_000;
    let message = Edition::DEFAULT.bus.message(Vcu2AiStatus::ID).expect("520h");
    let shown = world.log.iter().rev().find(|recorded| recorded.frame.id == message.id).expect("520h");
    let bit = message.signal("HANDSHAKE").and_then(|signal| signal.raw(shown.frame.data())).expect("a bit");
    world.falsify(message, "HANDSHAKE", since, 1 - bit);
    let held = standings(&exercised(&world), ["HS-7", "HS-6"]);
    assert_eq!(held[usize::try_from(bit).expect("a bit")], Standing::Violated);
    assert_eq!(held[usize::try_from(1 - bit).expect("a bit")], Standing::Held);
}

/// AI_COMMS_LOST has two reasons; one says nothing of the other.
#[test]
fn a_handshake_that_is_not_answered_tells_nothing_of_messages_that_come() {
    let mut world = World::of(&Edition::V4_0);
    world.driving();
    world.ai_answers = false;
    world.wait(600);
    let found = standings(&exercised(&world), ["HS-18", "MSG-59"]);
    assert_eq!(found, [Standing::NotExercised, Standing::Held]);
}

#[test]
fn a_message_that_is_missed() {
    let mut world = World::of(&Edition::V4_0);
    world.driving();
    world.mutes = vec![adsdv_spec::messages::Ai2VcuDriveF::ID];
    let mut wrong = world.clone();
    world.wait(500);
    let right = exercised(&world);
    assert_eq!(
        standings(&right, ["HS-17", "HS-18", "MSG-59"]),
        [Standing::NotExercised, Standing::Held, Standing::Held]
    );
    wrong.hold_state();
    wrong.shows = |status| (status.ai_comms_lost, status.fault_status) = (false, false);
    wrong.wait(500);
    assert_eq!(standings(&exercised(&wrong), ["HS-18"]), [Standing::Violated]);
}

#[test]
fn a_flag_without_its_reason_and_a_reason_without_its_flag() {
    let mut world = World::reference();
    world.driving();
    let mut other = world.clone();
    world.shows = |status| (status.ai_estop_request, status.fault_status) = (true, true);
    world.wait(500);
    assert_eq!(standings(&exercised(&world), ["MSG-54"]), [Standing::Violated]);
    other.set(Atom::AiEstop, true);
    other.shows = |status| status.ai_estop_request = false;
    other.wait(500);
    assert_eq!(standings(&exercised(&other), ["MSG-54"]), [Standing::Violated]);
}

#[test]
fn what_was_not_there() {
    let mut world = World::reference();
    world.wait(500);
    assert_eq!(exercised(&world).lacks(), [Lack::LeftOff]);
    let of = |node| {
        let frames = world.log.iter().filter(|recorded| recorded.sender() == Some(node));
        judge(&frames.copied().collect::<Vec<_>>(), JudgeOptions::default()).exercised
    };
    assert_eq!(of(Node::Vcu).lacks(), [Lack::Ai, Lack::LeftOff]);
    assert_eq!(of(Node::Ai).lacks(), [Lack::Vcu]);
    assert_eq!(judge(&[], JudgeOptions::default()).exercised.lacks(), [Lack::Ai, Lack::Vcu]);
    let blind = world.log.iter().filter(|recorded| recorded.frame.id != Vcu2AiStatus::ID);
    let blind = judge(&blind.copied().collect::<Vec<_>>(), JudgeOptions::default()).exercised;
    assert_eq!(blind.lacks(), [Lack::State]);
    world.ready();
    assert_eq!(exercised(&world).lacks(), []);
}

/// What was heard before frames got lost was heard.
#[test]
fn a_side_that_came_before_a_loss_was_there() {
    let mut world = World::reference();
    world.wait(500);
    let mut judge = Judge::new(JudgeOptions::default());
    for recorded in &world.log {
        judge.frame(recorded.t, recorded.frame.id.into(), recorded.frame.data());
    }
    judge.lost(3);
    let exercised = judge.finish().exercised;
    assert_eq!((exercised.ai, exercised.vcu), (true, true));
}

#[test]
fn what_is_required_is_met_by_what_was_shown() {
    let mut world = World::reference();
    world.ai_sends = false;
    world.ready();
    let exercised = exercised(&world);
    let meets = |text: &str| exercised.meets(text.parse::<Required>().expect("something to require"));
    assert_eq!(["ai", "vcu", "AS_OFF", "AS_DRIVING", "DRV-4"].map(meets), [false, true, true, false, false]);
}

/// What a log can show are requirements of the edition, each once; and none that only answers an open question.
#[test]
fn what_a_log_can_show_are_requirements_of_its_edition() {
    for edition in Edition::ALL {
        let report = judge(&[], JudgeOptions::of(edition));
        let ids: Vec<&str> = report.exercised.requirements.iter().map(|one| one.id).collect();
        let named = suite::generate(edition).into_iter().flat_map(|test| test.requirements);
        let known: HashSet<String> = named.chain(suite::untested(edition).map(|one| one.id)).collect();
        let unknown: Vec<_> = ids.iter().filter(|id| !known.contains(**id)).collect();
        assert!(unknown.is_empty(), "{}: {unknown:?}", edition.version);
        assert_eq!(ids.iter().collect::<HashSet<_>>().len(), ids.len());
        assert!(ids.len() > 60, "{}: {}", edition.version, ids.len());
        for reading in edition.questions() {
            assert!(!ids.contains(&reading.decision()), "{}", reading.decision());
        }
    }
}

#[test]
fn what_no_log_can_show_is_refused_with_what_is_near() {
    let error = |text: &str| text.parse::<Required>().expect_err(text).to_string();
    for (text, expected) in [
        ("DTE-99", "nothing has that name; expected ai, vcu, AS_OFF, AS_READY"),
        ("rdy", "the nearest are RDY-1, RDY-2, RDY-3, RDY-4"),
        ("drv_8", "the nearest are DRV-8, "),
        ("DRV-1", "no log can show that requirement"),
        ("", ", such as DRV-4"),
        ("-", ", such as DRV-4"),
        ("\u{2603}-1", ", such as DRV-4"),
    ] {
        assert!(error(text).contains(expected), "{text}: {}", error(text));
    }
    let of_3_0: Required = "DTE-4".parse().expect("a requirement of 3.0");
    assert_eq!(of_3_0.is_shown_in(&Edition::V3_0), Ok(()));
    let error = of_3_0.is_shown_in(&Edition::V4_0).expect_err("not one of 4.0").to_string();
    assert!(error.starts_with("edition 4.0 has no such requirement; "), "{error}");
}
