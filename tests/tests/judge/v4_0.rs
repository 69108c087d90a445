//! What version 4.0 adds: missed messages, torque and brakes at once, the EBS in 524h, and ranges and identifiers of its own.

use adsdv_oracle::judge::{JudgeOptions, Party, Report, Rule, Severity};
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuStatus, Ai2VcuSteer, AsState, AxleTorqueRequest, BrakePressure,
    EbsState, Frame, SteerAngle, Vcu2AiStatus, Vcu2AiSteer,
};
use adsdv_spec::{AiMessages, Choice, Choices, Edition, Fault, Machine};
use adsdv_tests::world::{MS, Recorded, World, judge, violations};

use crate::check::{by, recordings_of_a_kind, section_of};

static EDITION: &Edition = &Edition::V4_0;

pub(crate) fn options(pins: &[Choice]) -> JudgeOptions {
    let open = JudgeOptions::of(EDITION);
    JudgeOptions { readings: pins.iter().copied().fold(open.readings, Choices::pin), ..open }
}

pub(crate) fn world(pins: &[Choice]) -> World {
    let readings = pins.iter().fold(EDITION.readings, |readings, &pin| readings.with(pin));
    World::new(Machine::new(*EDITION, readings))
}

/// The recording as it is, jittered, and with frames lost.
pub(crate) fn recordings(world: &World) -> Vec<(String, Vec<Recorded>)> {
    let seeds = recordings_of_a_kind().min(12);
    let jittered = (0..seeds).map(|seed| (format!("jitter, seed {seed}"), world.disturbed(seed, 5 * MS, 0)));
    let thinned = (0..seeds).map(|seed| (format!("loss, seed {seed}"), world.disturbed(seed, 0, 20)));
    std::iter::once(("exactly".to_owned(), world.log.clone())).chain(jittered).chain(thinned).collect()
}

pub(crate) type Found = (Severity, Party, Rule, &'static str);

/// What is said of anybody but the log.
pub(crate) fn found(report: &Report) -> Vec<Found> {
    let blames = report.findings.iter().filter(|finding| finding.party != Party::Log);
    blames.map(|finding| (finding.severity, finding.party, finding.rule, section_of(finding))).collect()
}

/// Exactly this is found in the exact recording, and in no other anything else; but what is certain in the exact one may be excused by
/// an unseen frame in another.
pub(crate) fn finds(world: &World, options: JudgeOptions, expected: &[Found]) {
    for (how, log) in recordings(world) {
        let report = judge(&log, options);
        let found = found(&report);
        if how == "exactly" {
            assert_eq!(found, expected, "{:#?}", report.findings);
        }
        let other =
            found.iter().find(|found| !expected.contains(found) && !expected.contains(&for_certain(found)));
        assert_eq!(other, None, "{how}: {:#?}", report.findings);
    }
}

/// The same finding, where nothing excuses it.
pub(crate) fn for_certain(found: &Found) -> Found {
    let &(_, party, rule, section) = found;
    (Severity::Violation, party, rule, section)
}

pub(crate) fn the(severity: Severity, party: Party, rule: Rule, section: &'static str) -> Found {
    (severity, party, rule, section)
}

#[test]
fn a_mission_conforms_without_a_word() {
    let mut world = world(&[]);
    world.finished();
    world.inputs.asms = false;
    world.inputs.go = false;
    world.wait(1000);
    finds(&world, options(&[]), &[]);
    let report = judge(&world.log, options(&[]));
    assert_eq!(report.findings, [], "and nothing is noted either");
    let states: Vec<AsState> = report.transitions.iter().map(|transition| transition.to).collect();
    assert_eq!(states, [AsState::Ready, AsState::Driving, AsState::Finished, AsState::Off]);
}

#[test]
fn a_message_that_is_missed_is_the_ai_computers_fault() {
    for id in AiMessages::IDS {
        let mut world = world(&[]);
        world.driving();
        world.mutes.push(id);
        world.wait(400);
        world.mutes.clear();
        world.wait(400);
        assert_eq!(world.control.state, AsState::EmergencyBrake);
        let report = judge(&world.log, options(&[]));
        assert!(by(&report, Party::Vcu).is_empty(), "{:#?}", violations(&report));
        let missed = the(Severity::Violation, Party::Ai, Rule::MessageMissed, "2.4");
        let late = the(Severity::Violation, Party::Ai, Rule::HandshakeLate, "2.4");
        let expected = if id == Ai2VcuStatus::ID { vec![missed, late] } else { vec![missed] };
        let mut all = found(&report);
        all.sort_by_key(|(_, _, rule, _)| *rule != Rule::MessageMissed);
        assert_eq!(all, expected, "{id:03X}h: {:#?}", report.findings);
        let finding = report.findings.iter().find(|finding| finding.rule == Rule::MessageMissed);
        assert!(finding.is_some_and(|finding| finding.message().contains(&format!("({id:03X}h)"))));
        let brakes = report.transitions.last().and_then(|transition| transition.decided);
        assert_eq!(brakes.and_then(|(term, _)| term.fault), Some(Fault::AiCommsFault));
        for (how, log) in recordings(&world) {
            let report = judge(&log, options(&[]));
            assert!(by(&report, Party::Vcu).is_empty(), "{how}: {:#?}", violations(&report));
        }
    }
}

/// The VCU shows that it came before the recorder has it.
#[test]
fn a_frame_that_ends_a_silence_may_be_recorded_late() {
    let mut world = world(&[]);
    world.driving();
    world.mutes.push(Ai2VcuBrake::ID);
    world.wait(400);
    world.mutes.clear();
    let ends = world.t;
    world.wait(300);
    let ending = |one: &&mut Recorded| one.frame.id == Ai2VcuBrake::ID && one.t >= ends;
    world.log.iter_mut().find(ending).expect("it ends").t += 6 * MS;
    world.log.sort_by_key(|recorded| recorded.t);
    finds(&world, options(&[]), &[the(Severity::Violation, Party::Ai, Rule::MessageMissed, "2.4")]);
}

/// It is shown once only, and the recorder has it behind the frame that ends the silence.
#[test]
fn a_silence_that_has_ended_may_be_shown_late() {
    for choice in [None, Some(Choice::WatchAlways)] {
        let mut world = world(&[Choice::WatchAlways]);
        world.wait(500);
        world.mutes.push(Ai2VcuDriveF::ID);
        world.wait(100);
        world.mutes.clear();
        world.wait(300);
        let shows_loss = |one: &Recorded| {
            let status = (one.frame.id == Vcu2AiStatus::ID).then(|| EDITION.bus.decode_as(one.frame.data()));
            status.is_some_and(|status| matches!(status, Ok(Vcu2AiStatus { ai_comms_lost: true, .. })))
        };
        assert_eq!(world.log.iter().filter(|one| shows_loss(one)).count(), 1);
        world.log.iter_mut().find(|one| shows_loss(one)).expect("it is shown").t += 7 * MS;
        world.log.sort_by_key(|recorded| recorded.t);
        // In 120h it is not late, and counts where the VCU is known to watch.
        let missed = the(Severity::Warning, Party::Ai, Rule::MessageMissed, "2.4");
        let expected = if choice.is_some() { vec![missed] } else { Vec::new() };
        finds(&world, options(choice.as_slice()), &expected);
    }
}

#[test]
fn nine_messages_in_a_row_are_not_missed() {
    let mut world = world(&[]);
    world.driving();
    for id in AiMessages::IDS.into_iter().skip(1) {
        world.mutes.push(id);
        world.wait(90);
        world.mutes.clear();
        world.wait(300);
    }
    assert_eq!(world.control.state, AsState::Driving);
    finds(&world, options(&[]), &[]);
}

#[test]
fn messages_missed_while_tsms_is_off_are_nobodys_fault() {
    for choice in [Choice::WatchHandshake, Choice::WatchAlways] {
        let mut world = world(&[choice]);
        world.wait(500);
        world.mutes.push(Ai2VcuSteer::ID);
        world.wait(1000);
        let shown = world.log.iter().rev().find(|recorded| recorded.frame.id == Vcu2AiStatus::ID);
        let shown: Vcu2AiStatus = EDITION.bus.decode_as(shown.expect("a 520h").frame.data()).expect("valid");
        assert_eq!(shown.ai_comms_lost, choice == Choice::WatchAlways);
        finds(&world, options(&[]), &[]);
    }
}

#[test]
fn a_vcu_that_does_not_watch_messages_violates() {
    let mut world = world(&[]);
    world.driving();
    let deaf = Edition {
        rules: adsdv_spec::Rules {
            thresholds: adsdv_spec::Thresholds { missed_ms: None, ..EDITION.rules.thresholds },
            ..EDITION.rules
        },
        ..*EDITION
    };
    world.vcu = Machine::new(deaf, world.vcu.readings());
    world.mutes.push(Ai2VcuBrake::ID);
    world.wait(1000);
    assert_eq!(world.control.state, AsState::Driving);
    let expected = [
        the(Severity::Violation, Party::Ai, Rule::MessageMissed, "2.4"),
        the(Severity::Violation, Party::Vcu, Rule::CommsLostDue, "2.4"),
        the(Severity::Violation, Party::Vcu, Rule::Due, "3.7"),
        // The timeout in 120h.
        the(Severity::Violation, Party::Vcu, Rule::FlagMissing, "2.2"),
    ];
    finds(&world, options(&[]), &expected);
}

#[test]
fn a_vcu_that_says_without_a_reason_that_messages_are_missed_violates() {
    let mut world = world(&[]);
    world.driving();
    world.shows = |status| status.ai_comms_lost = true;
    world.wait(300);
    let report = judge(&world.log, options(&[]));
    let blames: Vec<Rule> = by(&report, Party::Vcu).iter().map(|finding| finding.rule).collect();
    assert!(blames.contains(&Rule::FlagUnfounded), "{:#?}", violations(&report));
    assert!(by(&report, Party::Ai).is_empty(), "{:#?}", violations(&report));
}

fn torque(world: &mut World) {
    world.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(100);
}

fn brakes(world: &mut World) {
    world.ai.brake.hyd_press_f_req = BrakePressure::clamped(20);
}

#[test]
fn torque_and_brakes_at_once_are_the_ai_computers_fault() {
    let mut world = world(&[]);
    world.driving();
    torque(&mut world);
    world.wait(300);
    brakes(&mut world);
    world.wait(500);
    assert_eq!(world.control.state, AsState::EmergencyBrake);
    // The VCU says that it saw both, whatever the readings are.
    let expected = [the(Severity::Violation, Party::Ai, Rule::BrakeAndTorque, "4")];
    finds(&world, options(&[]), &expected);
    finds(&world, options(&[Choice::TorqueAlways]), &expected);
}

#[test]
fn torque_and_brakes_at_once_violate_where_the_motors_are_in_torque_control_mode() {
    let mut world = world(&[Choice::TorqueNever]);
    world.driving();
    torque(&mut world);
    brakes(&mut world);
    world.wait(500);
    assert_eq!(world.control.state, AsState::Driving);
    let finding = |severity| the(severity, Party::Ai, Rule::BrakeAndTorque, "4");
    finds(&world, options(&[]), &[finding(Severity::Warning)]);
    finds(&world, options(&[Choice::TorqueNever]), &[]);
    let due = the(Severity::Violation, Party::Vcu, Rule::Due, "3.7");
    finds(&world, options(&[Choice::TorqueAlways]), &[finding(Severity::Violation), due]);
}

/// Each in a frame of its own, so that both are there for less than a cycle, between two steps of the VCU.
#[test]
fn torque_in_the_place_of_brakes_is_no_fault() {
    let mut world = world(&[]);
    world.driving();
    for _ in 0..5 {
        torque(&mut world);
        world.ai.brake = Ai2VcuBrake::default();
        world.wait(200);
        world.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(0);
        brakes(&mut world);
        world.wait(200);
    }
    assert_eq!(world.control.state, AsState::Driving);
    finds(&world, options(&[Choice::TorqueAlways]), &[]);
}

#[test]
fn torque_and_brakes_at_once_are_no_fault_outside_of_driving() {
    let mut world = world(&[]);
    world.dwelt();
    torque(&mut world);
    brakes(&mut world);
    world.wait(500);
    let held = the(Severity::Warning, Party::Ai, Rule::ReadyHeld, "3.2");
    finds(&world, options(&[]), &[held]);
}

#[test]
fn a_brake_plausibility_fault_without_a_reason_is_the_vcus_fault() {
    let mut world = world(&[]);
    world.driving();
    torque(&mut world);
    world.wait(300);
    world.shows = |status| {
        status.brake_plausibility_fault = true;
        status.fault_status = true;
    };
    world.wait(300);
    let unfounded = the(Severity::Violation, Party::Vcu, Rule::FlagUnfounded, "4");
    // 120h does not warn of it.
    let differs = the(Severity::Note, Party::Vcu, Rule::WarningDiffers, "2.2");
    finds(&world, options(&[]), &[unfounded, differs]);
}

#[test]
fn an_ebs_that_becomes_unavailable_ends_driving() {
    let mut world = world(&[]);
    world.driving();
    let mut stays = world.clone();
    world.inputs.ebs = EbsState::Unavailable;
    world.wait(500);
    assert_eq!(world.control.state, AsState::EmergencyBrake);
    finds(&world, options(&[]), &[]);
    stays.hold_state();
    // Just behind a 502h.
    stays.wait(10);
    stays.inputs.ebs = EbsState::Unavailable;
    stays.wait(500);
    finds(&stays, options(&[]), &[the(Severity::Violation, Party::Vcu, Rule::Due, "3.7")]);
    let report = judge(&stays.log, options(&[]));
    let due = report.findings.first().expect("it is found");
    assert!(due.message().contains("EBS status == UNAVAILABLE"), "{due:?}");
    // 502h comes every 100 ms: it is 524h that shows it at once.
    let late = due.t_ns / MS - (stays.t - 500 * MS) / MS;
    assert!((0..100).contains(&late), "{late} ms");
}

/// A recorder that leaves 524h out: 502h shows the EBS as well.
#[test]
fn the_ebs_is_read_from_502h_where_524h_does_not_come() {
    let mut world = world(&[]);
    world.driving();
    world.hold_state();
    world.inputs.ebs = EbsState::Unavailable;
    world.wait(1000);
    world.log.retain(|recorded| recorded.frame.id != 0x524);
    let report = judge(&world.log, options(&[]));
    let due = the(Severity::Violation, Party::Vcu, Rule::Due, "3.7");
    assert_eq!(found(&report), [due], "{:#?}", report.findings);
}

#[test]
fn a_battery_fault_brakes_in_ready_under_one_reading_only() {
    for choice in [Choice::BmsSdc, Choice::BmsDriving] {
        let mut world = world(&[choice]);
        world.ready();
        world.inputs.sdc.bms_fault = true;
        world.wait(500);
        assert_eq!(world.control.state == AsState::Ready, choice == Choice::BmsDriving);
        finds(&world, options(&[]), &[]);
        finds(&world, options(&[choice]), &[]);
    }
    let mut stays = world(&[Choice::BmsDriving]);
    stays.ready();
    stays.inputs.sdc.bms_fault = true;
    stays.wait(500);
    let due = the(Severity::Violation, Party::Vcu, Rule::Due, "3.5");
    finds(&stays, options(&[Choice::BmsSdc]), &[due]);
}

#[test]
fn the_handshake_may_take_a_hundred_milliseconds() {
    for (ms, fine) in [(80, true), (300, false)] {
        let mut world = world(&[]);
        world.driving();
        world.ai_answers = false;
        world.wait(ms);
        world.ai_answers = true;
        world.wait(300);
        let late = the(Severity::Violation, Party::Ai, Rule::HandshakeLate, "2.4");
        assert_eq!(world.control.state == AsState::Driving, fine);
        finds(&world, options(&[]), if fine { &[] } else { std::slice::from_ref(&late) });
    }
}

#[test]
fn a_steer_request_of_3_0_is_out_of_range() {
    let mut world = world(&[]);
    world.driving();
    let steer = EDITION.bus.message(Ai2VcuSteer::ID).expect("a message of 4.0");
    let signal = steer.signal_of("steer_request").expect("a signal of 513h");
    let since = world.t;
    world.wait(300);
    let beyond = SteerAngle::clamped(220).raw();
    assert!(beyond > signal.max && !world.log.is_empty());
    world.falsify(steer, signal.name, since, beyond);
    finds(&world, options(&[]), &[the(Severity::Violation, Party::Ai, Rule::Value, steer.section)]);
    let report = judge(&world.log, options(&[]));
    assert!(report.findings[0].message().contains("21"), "{:?}", report.findings);
}

/// The VCU shows the limit of version 3.0: what is within that is not the AI Computer's fault.
#[test]
fn a_steer_request_within_the_limit_that_the_vcu_shows_is_a_note() {
    let mut world = world(&[]);
    world.driving();
    world.wait(300);
    let field = |id: u16, field| {
        let message = EDITION.bus.message(id).expect("a message of 4.0");
        (message, message.signal_of(field).expect("a signal of it").name)
    };
    let (request, name) = field(Ai2VcuSteer::ID, "steer_request");
    let (shown, limit) = field(Vcu2AiSteer::ID, "steer_angle_max");
    world.falsify(shown, limit, 0, 240);
    let mut beyond = world.clone();
    world.falsify(request, name, world.t - 300 * MS, -230);
    let note = |party, section| the(Severity::Note, party, Rule::Value, section);
    finds(&world, options(&[]), &[note(Party::Vcu, shown.section), note(Party::Ai, request.section)]);
    beyond.falsify(request, name, beyond.t - 300 * MS, -241);
    let report = judge(&beyond.log, options(&[]));
    assert_eq!(by(&report, Party::Ai).len(), 1, "beyond that it is: {:#?}", report.findings);
}

#[test]
fn reserved_identifiers_are_those_of_the_edition() {
    let reserved = |id: u16, edition| {
        let mut world = World::of(edition);
        world.wait(100);
        let frame = Frame::new(id, &[0]).expect("a frame");
        world.log.push(Recorded { t: world.t, frame });
        let report = judge(&world.log, JudgeOptions::of(edition));
        report.findings.iter().any(|finding| finding.rule == Rule::Reserved)
    };
    for (id, before, now) in
        [(0x100, true, false), (0x201, true, false), (0x610, false, true), (0x655, false, true)]
    {
        assert_eq!((reserved(id, &Edition::V3_0), reserved(id, EDITION)), (before, now), "{id:03X}h");
    }
}
