//! What the bus of 2026 shows beyond that of version 4.0: the remote control's switches, the stage of the EBS, and devices.

use adsdv_oracle::judge::{Judge, JudgeOptions, Party, Report, Rule, Severity};
use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{
    Ai2VcuSteer, AsState, AxleTorqueRequest, BrakePressure, EbsStage, EbsState, Frame, SteerAngle,
    Vcu2AiBrake, Vcu2AiStatus, Vcu2LogStatus, VcuStatus,
};
use adsdv_spec::{Choice, Choices, Edition, Machine, Truth};
use adsdv_tests::world::{MS, Recorded, World, judge};

use crate::check::{by, section_of};
use crate::v4_0::{Found, for_certain, found, recordings, the};

static EDITION: &Edition = &Edition::V2026;

fn options(pins: &[Choice]) -> JudgeOptions {
    let open = JudgeOptions::of(EDITION);
    JudgeOptions { readings: pins.iter().copied().fold(open.readings, Choices::pin), ..open }
}

fn world(pins: &[Choice]) -> World {
    let readings = pins.iter().fold(EDITION.readings, |readings, &pin| readings.with(pin));
    World::new(Machine::new(*EDITION, readings))
}

/// The identifier of the remote control's message.
fn remote() -> u16 {
    Remote::of(&EDITION.bus).expect("the database has it").message().id
}

/// Exactly this is found in the exact recording, and in no other anything else; but what is certain in the exact one may be excused by
/// an unseen frame in another.
fn finds(world: &World, options: JudgeOptions, expected: &[Found]) {
    for (how, log) in recordings(world) {
        let report = judge(&log, options);
        let found = found(&report);
        if how == "exactly" {
            assert_eq!(found, expected, "{:#?}", report.findings);
        }
        let other =
            found.iter().find(|found| !expected.contains(found) && !expected.contains(&for_certain(found)));
        assert_eq!(other, None, "{how}: {:#?}", report.findings);
        // A gap is that of a message which there is, also where it is the remote control's.
        let nameless = report.findings.iter().find(|finding| finding.message().contains("000h"));
        assert_eq!(nameless, None, "{how}");
    }
}

/// The same of what the remote control tells: without its frames nothing is found.
fn finds_by_remote(world: &World, options: JudgeOptions, expected: &[Found]) {
    finds(world, options, expected);
    let mut without = world.clone();
    without.log.retain(|recorded| recorded.frame.id != remote());
    finds(&without, options, &[]);
}

fn vcu(rule: Rule, section: &'static str) -> Found {
    the(Severity::Violation, Party::Vcu, rule, section)
}

#[test]
fn a_mission_conforms_without_a_word() {
    for choice in [Choice::GoAccepted, Choice::GoRaw] {
        let mut world = world(&[choice]);
        world.finished();
        world.inputs.asms = false;
        world.inputs.go = false;
        world.wait(1000);
        finds(&world, options(&[]), &[]);
        let report = judge(&world.log, options(&[]));
        assert_eq!(report.findings, [], "and nothing is noted either");
        let states: Vec<AsState> = report.transitions.iter().map(|transition| transition.to).collect();
        assert_eq!(states, [AsState::Ready, AsState::Driving, AsState::Finished, AsState::Off]);
        let justified = report.transitions.iter().all(|transition| transition.justified == Truth::True);
        assert!(justified, "the switch shows: {:#?}", report.transitions);
    }
}

/// `AS_READY` with the dwell over, "Go" having been on since before; `GO_SIGNAL` shows nothing of it.
fn go_since_before() -> World {
    let mut world = world(&[]);
    world.prepare();
    world.inputs.go = true;
    world.wait(200);
    world.inputs.asms = true;
    world.wait(6000);
    assert_eq!(world.control.state, AsState::Ready);
    world
}

//= DRV-12
#[test]
fn driving_needs_a_new_edge_of_the_switch() {
    let mut world = go_since_before();
    finds(&world, options(&[]), &[]);
    world.force(AsState::Driving);
    world.wait(300);
    finds_by_remote(&world, options(&[]), &[vcu(Rule::Unjustified, "3.2")]);
    let report = judge(&world.log, options(&[]));
    assert!(report.findings.iter().any(|finding| finding.message().contains("no accepted")), "{report:#?}");
}

//= DRV-15
#[test]
fn an_edge_that_the_vcu_loses_is_reported() {
    let mut world = world(&[]);
    world.dwelt();
    let mut takes = world.clone();
    world.hold_state();
    world.inputs.go = true;
    world.wait(500);
    finds_by_remote(&world, options(&[]), &[vcu(Rule::Due, "3.2")]);
    takes.inputs.go = true;
    takes.wait(500);
    assert_eq!(takes.control.state, AsState::Driving);
    finds(&takes, options(&[]), &[]);
}

//= DRV-11, D-6
#[test]
fn an_edge_before_the_dwell_is_over_does_not_count() {
    let mut world = world(&[]);
    world.ready();
    world.inputs.go = true;
    world.wait(6000);
    assert_eq!(world.control.state, AsState::Ready);
    finds(&world, options(&[]), &[]);
    world.force(AsState::Driving);
    world.wait(300);
    finds_by_remote(&world, options(&[]), &[vcu(Rule::Unjustified, "3.2")]);
}

/// The VCU shows "Go" on all the time: only the switch tells that it is off.
//= DTE-2
#[test]
fn driving_ends_when_the_switch_is_off() {
    let mut world = world(&[]);
    world.driving();
    let mut obeys = world.clone();
    obeys.inputs.go = false;
    obeys.wait(500);
    assert_eq!(obeys.control.state, AsState::EmergencyBrake);
    finds(&obeys, options(&[]), &[]);
    world.hold_state();
    world.shows = |status| status.go_signal = true;
    world.inputs.go = false;
    world.wait(500);
    finds_by_remote(&world, options(&[]), &[vcu(Rule::Due, "3.7")]);
}

fn emergency(report: &Report) -> (Truth, bool) {
    let brakes = report.transitions.iter().find(|one| one.to == AsState::EmergencyBrake).expect("it brakes");
    (brakes.justified, brakes.remote_estop)
}

//= RTE-2, DTE-1
#[test]
fn the_remote_e_stop_is_the_reason_of_an_emergency_whatever_its_level() {
    for level in [false, true] {
        for arrive in [World::ready, World::driving, World::finished] {
            let mut world = world(&[]);
            world.estop_pressed = level;
            arrive(&mut world);
            world.inputs.sdc.remote_estop = true;
            world.wait(1000);
            world.inputs.sdc.remote_estop = false;
            world.wait(500);
            finds(&world, options(&[]), &[]);
            assert_eq!(emergency(&judge(&world.log, options(&[]))), (Truth::True, true), "level {level}");
        }
    }
}

#[test]
fn another_reason_is_not_taken_for_the_remote_e_stop() {
    let mut world = world(&[]);
    world.driving();
    world.inputs.sdc.vehicle_estop = true;
    world.wait(500);
    finds(&world, options(&[]), &[]);
    let (_, remote_estop) = emergency(&judge(&world.log, options(&[])));
    assert!(!remote_estop);
}

/// A press is over before something else opens the circuit.
#[test]
fn an_e_stop_that_was_released_long_before_is_no_reason() {
    let mut world = world(&[]);
    world.braking();
    world.wait(i64::from(EDITION.rules.timing.ebs_timer_ms));
    world.inputs.asms = false;
    world.inputs.go = false;
    world.wait(500);
    world.control.power_cycle_needed = false;
    world.ai.status.mission_status = adsdv_spec::messages::MissionStatus::Selected;
    world.inputs.asms = true;
    world.wait(500);
    assert_eq!(world.control.state, AsState::Ready);
    world.inputs.sdc.vehicle_estop = true;
    world.wait(500);
    let report = judge(&world.log, options(&[]));
    let reasons: Vec<bool> = report.transitions.iter().map(|one| one.remote_estop).collect();
    assert_eq!(reasons, [false, false, true, false, false, false], "{:#?}", report.transitions);
}

//= RTE-2, DTE-1
#[test]
fn a_vcu_that_drives_on_with_the_remote_e_stop_pressed_violates() {
    for (arrive, section) in
        [(World::ready as fn(&mut World), "3.5"), (World::driving, "3.7"), (World::finished, "3.8")]
    {
        let mut world = world(&[]);
        arrive(&mut world);
        world.hold_state();
        world.inputs.sdc.remote_estop = true;
        // Nothing but the button tells of it.
        world.shows = |status| {
            adsdv_spec::Faults::NONE.show(status);
            status.fault_status = false;
            status.shutdown_cause = adsdv_spec::messages::ShutdownCause::NoShutdown;
        };
        world.wait(500);
        finds_by_remote(&world, options(&[]), &[vcu(Rule::Due, section)]);
        let report = judge(&world.log, options(&[]));
        assert!(report.findings[0].message().contains("remote E-stop pressed"), "{:?}", report.findings);
    }
}

/// Before the vehicle was ready nothing tells which level means what.
#[test]
fn a_level_that_nothing_explains_blames_nobody() {
    for level in [false, true] {
        let mut world = world(&[]);
        world.estop_pressed = level;
        world.inputs.sdc.remote_estop = true;
        world.wait(500);
        world.inputs.sdc.remote_estop = false;
        world.finished();
        finds(&world, options(&[]), &[]);
    }
}

/// By either answer to what `GO_SIGNAL` is, and whatever came before, it is 1 while "Go" makes the vehicle drive.
//= DRV-14, MSG-46
#[test]
fn go_that_is_not_shown_while_driving_violates() {
    for choice in [Choice::GoAccepted, Choice::GoRaw] {
        let mut world = world(&[choice]);
        world.driving();
        let before = world.clone();
        world.shows = |status| status.go_signal = false;
        world.wait(500);
        finds_by_remote_only(&world, options(&[]), &[vcu(Rule::GoDiffers, "3.2")]);
        let report = judge(&world.log, options(&[]));
        let finding = &report.findings[0];
        let said = "GO_SIGNAL is 0 in AS_DRIVING, but the remote control shows \"Go\" on; expected 1";
        assert_eq!((finding.message().as_str(), &finding.requirements[..]), (said, &["DRV-14"][..]));
        let mut evidence: Vec<u16> = finding.evidence.iter().map(|frame| frame.id).collect();
        evidence.sort_unstable();
        assert_eq!(evidence, [remote(), Vcu2AiStatus::ID]);
        // For a moment it may be late.
        let mut moment = before;
        moment.shows = |status| status.go_signal = false;
        moment.wait(50);
        moment.shows = |_| {};
        moment.wait(300);
        finds(&moment, options(&[]), &[]);
    }
}

/// Without the switch it is an arrow that is due; with it, only the signal is wrong.
fn finds_by_remote_only(world: &World, options: JudgeOptions, expected: &[Found]) {
    finds(world, options, expected);
    let mut without = world.clone();
    without.log.retain(|recorded| recorded.frame.id != remote());
    finds(&without, options, &[vcu(Rule::Due, "3.7")]);
}

//= MSG-46
#[test]
fn go_that_is_shown_while_the_switch_is_off_is_a_note() {
    let mut world = world(&[]);
    world.ready();
    world.shows = |status| status.go_signal = true;
    world.wait(500);
    let note = the(Severity::Note, Party::Vcu, Rule::GoDiffers, "2.2");
    finds_by_remote(&world, options(&[]), &[note]);
    finds(&world, options(&[Choice::GoAccepted]), &[note]);
    finds_by_remote(&world, options(&[Choice::GoRaw]), &[vcu(Rule::GoDiffers, "2.2")]);
}

/// Recordings keep it at 1 behind a run; and it may be the edge, which an AS_READY with "Go" on since before does not show.
//= D-7
#[test]
fn go_that_either_answer_allows_is_no_finding() {
    let since_before = go_since_before();
    finds(&since_before, options(&[]), &[]);
    finds_by_remote(&since_before, options(&[Choice::GoRaw]), &[vcu(Rule::GoDiffers, "2.2")]);
    for after in [World::finished as fn(&mut World), World::braking] {
        let mut world = world(&[]);
        after(&mut world);
        world.inputs.go = false;
        world.shows = |status| status.go_signal = true;
        world.wait(500);
        finds(&world, options(&[]), &[]);
        finds_by_remote(&world, options(&[Choice::GoRaw]), &[vcu(Rule::GoDiffers, "2.2")]);
    }
}

/// Version 4.0 has 120h, and the database of 2026 dropped it; but the document of 4.0 stays valid, and no frame says who sent it.
//= MSG-116
#[test]
fn a_vcu_status_of_4_0_is_a_note() {
    let mut world = World::of(&Edition::V4_0);
    world.wait(300);
    world.log.retain(|recorded| recorded.frame.id == VcuStatus::ID);
    let report = judge(&world.log, options(&[]));
    let finding = report.findings.iter().find(|finding| finding.rule == Rule::Reserved).expect("it is found");
    let said = "VCU_STATUS (120h) was sent, which the VCU sends in version 4.0 and not in this one; the log does not say by whom; expected no such message";
    assert_eq!(finding.message(), said);
    assert_eq!((finding.severity, finding.party, section_of(finding)), (Severity::Note, Party::Vcu, "2.2"));
    assert_eq!((&finding.requirements[..], finding.evidence.len()), (&["MSG-116"][..], 1));
    let others = report.findings.iter().filter(|finding| finding.rule != Rule::Reserved);
    assert_eq!(others.map(|finding| finding.rule).collect::<Vec<_>>(), [Rule::OneSided], "once");
    // Its neighbours are nobody's.
    let mut judge = Judge::new(options(&[]));
    judge.frame(0, 0x121, &[0]);
    let report = judge.finish();
    assert!(report.findings[0].message().starts_with("121h is reserved and was sent"), "{report:?}");
}

#[test]
fn a_stage_of_the_ebs_that_contradicts_its_state_is_a_note() {
    let mut world = world(&[]);
    world.driving();
    let since = world.t;
    world.wait(500);
    let status = EDITION.bus.message(Vcu2AiStatus::ID).expect("a message of 2026");
    let mut differs = world.clone();
    differs.falsify(status, "EBS_STATE", since, EbsStage::Charging as i32);
    finds(&differs, options(&[]), &[the(Severity::Note, Party::Vcu, Rule::EbsDiffers, "2.2")]);
    // For a moment they may.
    let mut moment = world.clone();
    let until = since + 50 * MS;
    let shown = |recorded: &&mut Recorded| recorded.frame.id == status.id;
    for recorded in moment.log.iter_mut().filter(shown).filter(|one| (since..until).contains(&one.t)) {
        let signal = status.signal("EBS_STATE").expect("a signal of 520h");
        recorded.frame.data = signal.put(recorded.frame.data, EbsStage::Charging as i32);
    }
    finds(&moment, options(&[]), &[]);
}

/// 502h is up to 100 ms late, and may say something else: 524h is believed.
#[test]
fn the_ebs_is_judged_by_the_message_of_every_cycle() {
    let mut world = world(&[]);
    world.driving();
    world.hold_state();
    world.wait(10);
    world.inputs.ebs = EbsState::Unavailable;
    world.wait(90);
    let late = EDITION.bus.message(Vcu2LogStatus::ID).expect("a message of 2026");
    world.falsify(late, "State_EBS", 0, EbsState::Armed as i32);
    finds(&world, options(&[]), &[vcu(Rule::Due, "3.7")]);
    world.log.retain(|recorded| recorded.frame.id != Vcu2AiBrake::ID);
    finds(&world, options(&[]), &[]);
}

#[test]
fn the_vehicle_may_show_as_init_before_as_off() {
    let mut world = world(&[]);
    world.ready();
    let status = EDITION.bus.message(Vcu2AiStatus::ID).expect("a message of 2026");
    let init = |recorded: &&mut Recorded| recorded.frame.id == status.id && recorded.t < 700 * MS;
    let signal = status.signal("AS_STATE").expect("a signal of 520h");
    world.log.iter_mut().filter(init).for_each(|one| one.frame.data = signal.put(one.frame.data, 0));
    finds(&world, options(&[]), &[]);
    let report = judge(&world.log, options(&[]));
    assert_eq!(report.transitions.len(), 1, "{:#?}", report.transitions);
    assert_eq!(report.transitions[0].from, AsState::Off);
}

//= MSG-105
#[test]
fn the_ai_computer_may_steer_by_30_degrees() {
    let steer = EDITION.bus.message(Ai2VcuSteer::ID).expect("a message of 2026");
    for (raw, expected) in
        [(300, vec![]), (301, vec![the(Severity::Violation, Party::Ai, Rule::Value, steer.section)])]
    {
        let mut world = world(&[]);
        world.driving();
        let since = world.t;
        world.ai.steer.steer_request = SteerAngle::clamped(300);
        world.wait(300);
        world.falsify(steer, "STEER_REQUEST", since, raw);
        finds(&world, options(&[]), &expected);
    }
}

//= MSG-98
#[test]
fn a_message_that_is_missed_is_the_ai_computers_fault() {
    for (ms, missed) in [(90, false), (400, true)] {
        let mut world = world(&[]);
        world.driving();
        world.mutes.push(Ai2VcuSteer::ID);
        world.wait(ms);
        world.mutes.clear();
        world.wait(400);
        let fault = the(Severity::Violation, Party::Ai, Rule::MessageMissed, "2.4");
        finds(&world, options(&[]), if missed { std::slice::from_ref(&fault) } else { &[] });
    }
}

/// The vehicle is said not to react: that is no fault of the VCU, and asking for both is a warning as it is in 4.0.
//= D-67
#[test]
fn torque_and_brakes_at_once_are_a_warning() {
    let mut world = world(&[]);
    world.driving();
    world.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(100);
    world.ai.brake.hyd_press_f_req = BrakePressure::clamped(20);
    world.wait(500);
    assert_eq!(world.control.state, AsState::Driving);
    finds(&world, options(&[]), &[the(Severity::Warning, Party::Ai, Rule::BrakeAndTorque, "4")]);
    finds(&world, options(&[Choice::TorqueNever]), &[]);
}

//= ID-20
#[test]
fn nothing_is_said_of_a_devices_frame_whatever_its_length() {
    let mut world = world(&[]);
    world.finished();
    let t = world.t;
    for device in EDITION.bus.devices {
        for len in 0..=8 {
            let frame = Frame::new(device.id, &[0xFF; 8][..len]).expect("a frame");
            world.log.push(Recorded { t, frame });
        }
    }
    let report = judge(&world.log, options(&[]));
    assert_eq!(report.findings, [], "no database of 2026 leaves these out");
    // They are reserved where nobody says whose they are.
    let report = judge(&world.log, JudgeOptions::of(&Edition::V4_0));
    let reserved = report.findings.iter().filter(|finding| finding.rule == Rule::Reserved).count();
    let known = |id| Edition::V4_0.bus.is_reserved(id);
    assert_eq!(reserved, EDITION.bus.devices.iter().filter(|device| known(device.id)).count());
}

/// A log with directions tells who sent a frame.
//= ID-20
#[test]
fn the_ai_computer_must_not_send_a_devices_message() {
    for device in EDITION.bus.devices {
        let mut judge = Judge::new(options(&[]));
        for t in 0..3 {
            judge.sent_by_ai(t * MS, device.id.into());
        }
        let report = judge.finish();
        let rule =
            if EDITION.bus.is_reserved(device.id) { (Rule::Reserved, "2.3") } else { (Rule::Sender, "2.2") };
        let found: Vec<_> =
            by(&report, Party::Ai).iter().map(|finding| (finding.rule, section_of(finding))).collect();
        assert_eq!(found, [rule], "{}", device.name);
    }
}

/// Frames of the remote control that are cut off tell nothing, and nothing of the switch is known any more.
#[test]
fn a_short_frame_of_the_remote_control_tells_nothing() {
    let mut world = world(&[]);
    world.driving();
    world.hold_state();
    world.shows = |status| status.go_signal = true;
    world.inputs.go = false;
    let since = world.t;
    world.wait(500);
    for recorded in world.log.iter_mut().filter(|one| one.frame.id == remote() && one.t >= since - 20 * MS) {
        recorded.frame.len = 1;
        recorded.frame.data[1..].fill(0);
    }
    finds(&world, options(&[]), &[]);
}
