//! A finding about the AI Computer names the requirement that the edition has for it.

use adsdv_oracle::judge::{Judge, JudgeOptions, Party, Report, RequirementStanding, Rule, Standing};
use adsdv_spec::messages::{
    Ai2VcuSteer, AxleTorqueRequest, BrakePressure, DirectionRequest, Frame, Vcu2AiStatus,
};
use adsdv_spec::{Choice, Edition, Machine};
use adsdv_tests::world::{MS, World, judge};

/// What is named in findings of a rule about the AI Computer.
fn named(report: &Report, rule: Rule) -> Vec<Vec<&'static str>> {
    let found = report.findings.iter().filter(|one| one.rule == rule && one.party != Party::Vcu);
    found.map(|one| one.requirements.clone()).collect()
}

/// A car of the edition that drives, and since then an AI Computer that does this.
fn driving(edition: &'static Edition, does: fn(&mut World)) -> Report {
    let mut world = World::new(Machine::new(*edition, edition.readings));
    world.driving();
    does(&mut world);
    world.wait(500);
    judge(&world.log, JudgeOptions::of(edition))
}

/// The three editions' own, in their order.
fn of_editions(names: [&[&str]; 3], of: impl Fn(&'static Edition) -> Vec<Vec<&'static str>>) {
    for (edition, expected) in Edition::ALL.iter().copied().zip(names) {
        let expected: Vec<Vec<&str>> = if expected.is_empty() { Vec::new() } else { vec![expected.to_vec()] };
        assert_eq!(of(edition), expected, "{}", edition.version);
    }
}

#[test]
fn neutral_at_speed() {
    of_editions([&["DTE-5"], &["IMP-6"], &["IMP-6"]], |edition| {
        let report = driving(edition, |world| world.ai.status.direction_request = DirectionRequest::Neutral);
        named(&report, Rule::NeutralMoving)
    });
}

#[test]
fn torque_and_brakes_at_once() {
    of_editions([&[], &["IMP-8"], &["IMP-8"]], |edition| {
        let mut world = World::new(Machine::new(*edition, edition.readings.with(Choice::TorqueAlways)));
        world.driving();
        world.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(100);
        world.ai.brake.hyd_press_f_req = BrakePressure::clamped(20);
        world.wait(500);
        named(&judge(&world.log, JudgeOptions::of(edition)), Rule::BrakeAndTorque)
    });
}

#[test]
fn a_message_that_is_missed() {
    of_editions([&[], &["HS-18", "MSG-98"], &["HS-18", "MSG-98"]], |edition| {
        let mut world = World::new(Machine::new(*edition, edition.readings));
        world.driving();
        let since = world.t;
        world.wait(500);
        world.log.retain(|one| one.frame.id != Ai2VcuSteer::ID || one.t < since);
        named(&judge(&world.log, JudgeOptions::of(edition)), Rule::MessageMissed)
    });
}

/// What it sends, each time with another frame of 513h.
#[test]
fn frames_that_are_not_as_they_should_be() {
    fn with(edition: &'static Edition, data: &[u8]) -> Report {
        let mut world = World::new(Machine::new(*edition, edition.readings));
        world.driving();
        let frame = Frame::new(Ai2VcuSteer::ID, data).expect("a frame");
        world.wait(500);
        let t = world.t - 200 * MS;
        for one in world.log.iter_mut().filter(|one| one.frame.id == frame.id && one.t >= t) {
            one.frame = frame;
        }
        judge(&world.log, JudgeOptions::of(edition))
    }
    of_editions([&["MSG-24"], &["MSG-99"], &["MSG-105"]], |edition| {
        let len = edition.bus.message(Ai2VcuSteer::ID).expect("513h").len;
        named(&with(edition, &[0x00, 0x7F, 0, 0, 0, 0, 0, 0][..len.into()]), Rule::Value)
    });
    of_editions([&["MSG-23"]; 3], |edition| named(&with(edition, &[0]), Rule::TooShort));
    of_editions([&["D-30"], &["MSG-97"], &["MSG-113"]], |edition| {
        named(&with(edition, &[0; 5]), Rule::Length)
    });
}

#[test]
fn what_is_not_the_ai_computers_to_send() {
    let sent = |edition: &'static Edition, id: u16| {
        let mut judge = Judge::new(JudgeOptions::of(edition));
        judge.sent_by_ai(0, id.into());
        judge.finish()
    };
    of_editions([&["ID-17"]; 3], |edition| named(&sent(edition, 0x700), Rule::Reserved));
    of_editions([&["ID-15"], &["ID-18"], &["ID-18"]], |edition| named(&sent(edition, 0x601), Rule::Reserved));
    for (edition, expected) in Edition::ALL.iter().zip([&[][..], &[], &["ID-20"]]) {
        assert_eq!(named(&sent(edition, Vcu2AiStatus::ID), Rule::Sender), [expected], "{}", edition.version);
    }
}

/// What the VCU has to do about it, and did, is not broken by what the AI Computer did.
#[test]
fn what_the_vcu_did_about_it_holds() {
    for edition in Edition::ALL {
        let report = driving(edition, |world| world.ai.status.direction_request = DirectionRequest::Neutral);
        let is_broken = |one: &&RequirementStanding| one.standing == Standing::Violated;
        let broken: Vec<_> = report.exercised.requirements.iter().filter(is_broken).collect();
        assert!(broken.is_empty(), "{}: {broken:?}", edition.version);
    }
}
