//! 120h, which version 4.0 adds: its state, mode, timeouts and warnings against what the rest of the bus shows.

use adsdv_oracle::judge::{Finding, JudgeOptions, Party, Report, Rule, Severity};
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuStatus, Ai2VcuSteer, AsState, AxleTorqueRequest, BrakePressure,
    MessageDef, MissionStatus, SmAs, SmSys, SysActionState, Vcu2AiStatus, VcuStatus,
};
use adsdv_spec::{AiMessages, AsState as State, Edition, Fault, Faults};
use adsdv_tests::world::{MS, Recorded, World, judge};

use crate::check::is_at;
use crate::v4_0::{Found, finds, options, the, world};

const TIMEOUTS: [&str; 5] = [
    "R1_AI2VCU_STATUS_TIMEOUT_ERROR",
    "R1_AI2VCU_DRIVE_F_TIMEOUT_ERROR",
    "R1_AI2VCU_DRIVE_R_TIMEOUT_ERROR",
    "R1_AI2VCU_STEER_TIMEOUT_ERROR",
    "R1_AI2VCU_BRAKE_TIMEOUT_ERROR",
];

const HANDSHAKE: &str = "R1_AI2VCU_STATUS_HANDSHAKE_TIMEOUT_ERROR";

fn def() -> &'static MessageDef {
    Edition::V4_0.bus.message(VcuStatus::ID).expect("a message of 4.0")
}

fn violation(rule: Rule) -> Found {
    the(Severity::Violation, Party::Vcu, rule, "2.2")
}

fn note(rule: Rule) -> Found {
    the(Severity::Note, Party::Vcu, rule, "2.2")
}

/// AS_DRIVING under way, with a signal of 120h falsified for half a second.
fn driving_with(signal: &str, raw: i32) -> World {
    let mut world = world(&[]);
    moving(&mut world);
    let since = world.t;
    world.wait(500);
    world.falsify(def(), signal, since, raw);
    world
}

fn moving(world: &mut World) {
    world.driving();
    world.set(adsdv_spec::Atom::Moving, true);
    world.set(adsdv_spec::Atom::DirectionNeutral, false);
    world.wait(500);
}

fn of_rule(report: &Report, rule: Rule) -> &Finding {
    report.findings.iter().find(|finding| finding.rule == rule).expect("it is found")
}

/// What shows a finding: its requirements, and the messages of its evidence, none of which came behind it.
fn shown_by(finding: &Finding) -> (Vec<&'static str>, Vec<u16>) {
    (finding.requirements.clone(), finding.evidence.iter().map(|frame| frame.id).collect())
}

//= MSG-92, D-56
#[test]
fn a_timeout_that_is_raised_while_its_message_comes_violates() {
    for (id, signal) in AiMessages::IDS.into_iter().zip(TIMEOUTS) {
        let world = driving_with(signal, 1);
        finds(&world, options(&[]), &[violation(Rule::FlagUnfounded)]);
        let report = judge(&world.log, options(&[]));
        let finding = of_rule(&report, Rule::FlagUnfounded);
        assert_eq!(finding.requirements, ["MSG-92"]);
        let message = finding.message();
        assert!(message.starts_with(&format!("{signal} was raised, but ")), "{message}");
        assert!(message.ends_with(&format!("({id:03X}h) has come all the time; expected 0")), "{message}");
        let (_, mut evidence) = shown_by(finding);
        evidence.sort_unstable();
        assert_eq!(evidence, [VcuStatus::ID, id]);
        let late = finding.evidence.iter().filter(|frame| frame.t_ns > finding.t_ns);
        assert_eq!(late.count(), 0, "{finding:?}");
    }
}

/// As long as it may have been missed, or the VCU may still show what was.
//= MSG-92, D-56
#[test]
fn a_timeout_of_a_message_that_was_silent_is_no_violation() {
    for (place, &id) in AiMessages::IDS.iter().enumerate().skip(1) {
        for ms in [80, 90, 100, 200] {
            let mut world = world(&[]);
            moving(&mut world);
            world.mutes.push(id);
            world.wait(ms);
            world.mutes.clear();
            let since = world.t;
            world.wait(20);
            world.falsify(def(), TIMEOUTS[place], since - 10 * MS, 1);
            world.wait(300);
            let report = judge(&world.log, options(&[]));
            let unfounded = report.findings.iter().find(|one| one.rule == Rule::FlagUnfounded);
            assert_eq!(unfounded, None, "{id:03X}h, {ms} ms");
        }
    }
}

/// A flag that is kept says what was.
//= MSG-92
#[test]
fn a_timeout_that_stays_behind_a_silence_is_no_violation() {
    let mut world = world(&[]);
    moving(&mut world);
    world.hold_state();
    world.mutes.push(Ai2VcuSteer::ID);
    world.wait(300);
    let since = world.t;
    world.mutes.clear();
    world.wait(1000);
    world.falsify(def(), TIMEOUTS[3], since - 100 * MS, 1);
    let report = judge(&world.log, options(&[]));
    let of_120h = |finding: &&Finding| finding.requirements.contains(&"MSG-92");
    assert_eq!(report.findings.iter().find(of_120h), None);
}

//= MSG-92, D-56
#[test]
fn a_timeout_that_is_not_raised_though_its_message_is_missed_violates() {
    for (id, signal) in AiMessages::IDS.into_iter().zip(TIMEOUTS) {
        let mut silent_since = 0;
        let mut missed = |raised: bool| {
            let mut world = world(&[]);
            moving(&mut world);
            silent_since = world.t;
            world.mutes.push(id);
            world.wait(500);
            if !raised {
                world.falsify(def(), signal, 0, 0);
            }
            let report = judge(&world.log, options(&[]));
            let of_120h = |finding: &&Finding| finding.requirements == ["MSG-92"];
            report.findings.iter().filter(of_120h).cloned().collect::<Vec<_>>()
        };
        assert_eq!(missed(true), []);
        let missing = missed(false);
        assert_eq!(missing.len(), 1, "{missing:?}");
        let finding = &missing[0];
        let JudgeOptions { window_ms, deadline_ms, .. } = options(&[]);
        let limit = Edition::V4_0.rules.thresholds.missed_ms.map_or(0, i64::from);
        is_at(finding, silent_since + (limit + i64::from(window_ms + deadline_ms)) * MS, 20);
        assert_eq!(
            (finding.severity, finding.party, finding.rule),
            (Severity::Violation, Party::Vcu, Rule::FlagMissing)
        );
        let message = finding.message();
        assert!(message.starts_with(&format!("{signal} is 0, but ")), "{message}");
        assert!(message.ends_with(&format!("({id:03X}h) has not come for 100 ms; expected 1")), "{message}");
        let (_, mut evidence) = shown_by(finding);
        evidence.sort_unstable();
        assert_eq!(evidence, [VcuStatus::ID, id]);
    }
}

/// A silence that the recorder alone may have made a little too long is one where 120h says so as well.
//= MSG-92
#[test]
fn a_timeout_is_evidence_that_its_message_was_missed() {
    for raised in [true, false] {
        let mut world = world(&[]);
        moving(&mut world);
        world.mutes.push(Ai2VcuDriveF::ID);
        world.wait(110);
        world.mutes.clear();
        let end = world.t;
        world.wait(500);
        // Nothing else tells of it.
        let status = Edition::V4_0.bus.message(Vcu2AiStatus::ID).expect("a message of 4.0");
        let of_120h = |one: &Recorded| one.frame.id == VcuStatus::ID;
        for one in &mut world.log {
            let (message, flag) = if of_120h(one) { (def(), TIMEOUTS[1]) } else { (status, "AI_COMMS_LOST") };
            let up = raised && of_120h(one) && (end - 5 * MS..end + 5 * MS).contains(&one.t);
            if one.frame.id == message.id {
                let signal = message.signal(flag).expect("a flag of it");
                one.frame.data = signal.put(one.frame.data, up.into());
            }
        }
        let report = judge(&world.log, options(&[]));
        let missed = report.findings.iter().find(|finding| finding.rule == Rule::MessageMissed);
        assert_eq!(missed.is_some(), raised, "{:#?}", report.findings);
        let Some(missed) = missed else { continue };
        let message = missed.message();
        assert!(message.contains(&format!("and the VCU has raised {}", TIMEOUTS[1])), "{message}");
        let (_, evidence) = shown_by(missed);
        assert_eq!(evidence, [Ai2VcuDriveF::ID, VcuStatus::ID]);
    }
}

/// Whether nobody watches while the tractive system is off, no document says.
//= MSG-92, D-51
#[test]
fn a_timeout_is_not_expected_while_tsms_is_off() {
    let mut world = world(&[]);
    world.wait(500);
    world.mutes.push(Ai2VcuDriveF::ID);
    world.wait(1000);
    world.falsify(def(), TIMEOUTS[1], 0, 0);
    finds(&world, options(&[]), &[]);
}

//= MSG-93, D-56
#[test]
fn an_error_of_a_handshake_that_is_answered_violates() {
    let world = driving_with(HANDSHAKE, 1);
    finds(&world, options(&[]), &[violation(Rule::FlagUnfounded)]);
    let report = judge(&world.log, options(&[]));
    let (requirements, mut evidence) = shown_by(of_rule(&report, Rule::FlagUnfounded));
    evidence.sort_unstable();
    assert_eq!(
        (requirements, evidence),
        (vec!["MSG-93"], vec![VcuStatus::ID, Ai2VcuStatus::ID, Vcu2AiStatus::ID])
    );
}

//= MSG-93, D-56
#[test]
fn an_error_of_a_handshake_that_is_answered_by_all_that_was_recorded_is_mostly_a_warning() {
    let mut reported = 0;
    let world = driving_with(HANDSHAKE, 1);
    for (seed, loss) in (1..=20).flat_map(|seed| [(seed, 0), (seed, 10)]) {
        let report = judge(&world.disturbed(seed, 20 * MS, loss), options(&[]));
        let flags: Vec<&Finding> =
            report.findings.iter().filter(|finding| finding.rule == Rule::FlagUnfounded).collect();
        if let [finding] = flags[..] {
            assert!(finding.unless.contains("lost"), "seed {seed}: {finding:#?}");
            assert_eq!(finding.severity, Severity::Warning, "seed {seed}");
        }
        reported += flags.len();
    }
    assert!((21..=40).contains(&reported), "{reported} of 40");
}

//= MSG-93, D-56
#[test]
fn a_handshake_that_is_not_answered_is_an_error() {
    for raised in [true, false] {
        let mut world = world(&[]);
        moving(&mut world);
        world.ai_answers = false;
        world.wait(600);
        if !raised {
            world.falsify(def(), HANDSHAKE, 0, 0);
        }
        let late = the(Severity::Violation, Party::Ai, Rule::HandshakeLate, "2.4");
        let missing = violation(Rule::FlagMissing);
        let expected = if raised { vec![late] } else { vec![late, missing] };
        finds(&world, options(&[]), &expected);
        let report = judge(&world.log, options(&[]));
        let found = report.findings.iter().filter(|finding| finding.requirements == ["MSG-93"]).count();
        assert_eq!(found, usize::from(!raised));
    }
}

//= MSG-90, D-59
#[test]
fn another_state_in_120h_violates() {
    for sm_as in [SmAs::Off, SmAs::Ready, SmAs::EmergencyBrake, SmAs::Finished] {
        let world = driving_with("SM_AS", sm_as as i32);
        finds(&world, options(&[]), &[violation(Rule::SmAsDiffers)]);
        let report = judge(&world.log, options(&[]));
        let finding = of_rule(&report, Rule::SmAsDiffers);
        assert_eq!(
            finding.message(),
            format!("120h shows SM_AS {sm_as}, but 520h shows AS_DRIVING; expected the same")
        );
        let (requirements, mut evidence) = shown_by(finding);
        evidence.sort_unstable();
        assert_eq!((requirements, evidence), (vec!["MSG-90"], vec![VcuStatus::ID, Vcu2AiStatus::ID]));
    }
}

/// Of AS_R2D the document gives the name alone.
//= MSG-90, D-59
#[test]
fn ready_to_drive_fits_every_state() {
    for arrive in [World::ready as fn(&mut World), World::driving, World::finished] {
        let mut world = world(&[]);
        arrive(&mut world);
        world.wait(500);
        world.falsify(def(), "SM_AS", 0, SmAs::R2d as i32);
        finds(&world, options(&[]), &[]);
    }
}

/// For a moment one message may be ahead of the other.
//= MSG-90
#[test]
fn another_state_for_a_moment_is_no_violation() {
    let mut world = world(&[]);
    moving(&mut world);
    let since = world.t;
    world.wait(40);
    let signal = def().signal("SM_AS").expect("a signal of 120h");
    let of_120h = |one: &&mut Recorded| one.frame.id == VcuStatus::ID && one.t >= since;
    world
        .log
        .iter_mut()
        .filter(of_120h)
        .for_each(|one| one.frame.data = signal.put(one.frame.data, SmAs::Ready as i32));
    world.wait(500);
    finds(&world, options(&[]), &[]);
}

//= MSG-89, MSG-91, D-58
#[test]
fn another_mode_while_driving_is_a_note() {
    for (signal, raw, shown) in [
        ("SM_SYS", SmSys::DriveManual as i32, "SM_SYS DRIVE_MANUAL"),
        ("SYS_ACTION_STATE", SysActionState::Shutdown as i32, "SYS_ACTION_STATE SHUTDOWN"),
    ] {
        let world = driving_with(signal, raw);
        finds(&world, options(&[]), &[note(Rule::ModeDiffers)]);
        let report = judge(&world.log, options(&[]));
        let message = of_rule(&report, Rule::ModeDiffers).message();
        let expected = format!(
            "120h shows {shown}, but 520h shows AS_DRIVING; expected DRIVE_AUTONOMOUS and DRIVE_AUTO"
        );
        assert_eq!(message, expected);
    }
    // What they are elsewhere no document says.
    let mut ready = world(&[]);
    ready.ready();
    ready.wait(500);
    ready.falsify(def(), "SM_SYS", 0, SmSys::PowertrainEnable as i32);
    finds(&ready, options(&[]), &[]);
}

const WARNINGS: [(&str, Fault); 5] = [
    ("WARN_BRAKE_PLAUSIBILITY", Fault::BrakePlausibilityFault),
    ("WARN_AI_ESTOP_REQ", Fault::AiComputerRequest),
    ("WARN_AI_COMMS_LOST", Fault::AiCommsFault),
    ("WARN_AUTO_BRAKING", Fault::AutonomousBrakingFault),
    ("WARN_MISSION_STATUS", Fault::MissionStatusFault),
];

/// Nothing of what they are about is there; but a warning of lost communication may come before the fault.
//= MSG-94, D-57
#[test]
fn a_warning_of_what_nobody_did_violates() {
    for (signal, fault) in WARNINGS {
        let world = driving_with(signal, 1);
        let severity = if fault == Fault::AiCommsFault { Severity::Warning } else { Severity::Violation };
        let unfounded = the(severity, Party::Vcu, Rule::FlagUnfounded, "2.2");
        let expected = [unfounded, note(Rule::WarningDiffers)];
        finds(&world, options(&[]), &expected);
        let report = judge(&world.log, options(&[]));
        let finding = of_rule(&report, Rule::FlagUnfounded);
        assert_eq!(finding.requirements, ["MSG-94"], "{signal}");
        assert!(finding.message().starts_with(&format!("{signal} was raised, but ")), "{finding:?}");
        assert!(finding.evidence.iter().any(|frame| frame.id == VcuStatus::ID), "{finding:?}");
        assert!(finding.evidence.iter().all(|frame| frame.t_ns <= finding.t_ns), "{finding:?}");
    }
}

/// At rest NEUTRAL and FINISHED are no faults, but a warning of them may be earlier than the fault.
//= MSG-94, D-57
#[test]
fn a_warning_at_rest_is_worth_a_look() {
    let rests = |signal: &str, finished: bool| {
        let mut world = world(&[]);
        if finished {
            world.finished();
        } else {
            world.ready();
        }
        let since = world.t;
        world.wait(500);
        world.falsify(def(), signal, since, 1);
        world
    };
    let expected =
        [the(Severity::Warning, Party::Vcu, Rule::FlagUnfounded, "2.2"), note(Rule::WarningDiffers)];
    finds(&rests("WARN_AUTO_BRAKING", false), options(&[]), &expected);
    finds(&rests("WARN_MISSION_STATUS", true), options(&[]), &expected);
}

/// What the reference VCU shows of faults that there are, and of what only 120h tells, is no finding about 120h.
//= MSG-94, D-57
#[test]
fn warnings_of_faults_that_there_are_say_nothing_more() {
    type Happens = fn(&mut World);
    let faults: [(Happens, Fault); 5] = [
        (
            |world| {
                world.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(100);
                world.ai.brake.hyd_press_f_req = BrakePressure::clamped(20);
            },
            Fault::BrakePlausibilityFault,
        ),
        (|world| world.ai.status.estop_request = true, Fault::AiComputerRequest),
        (|world| world.mutes.push(Ai2VcuBrake::ID), Fault::AiCommsFault),
        (|world| world.set(adsdv_spec::Atom::DirectionNeutral, true), Fault::AutonomousBrakingFault),
        (|world| world.ai.status.mission_status = MissionStatus::Finished, Fault::MissionStatusFault),
    ];
    for (happens, fault) in faults {
        let mut world = world(&[]);
        moving(&mut world);
        happens(&mut world);
        world.wait(500);
        assert_eq!(world.control.state, State::EmergencyBrake, "{fault}");
        let shows = |one: &Recorded| {
            one.frame.id == Vcu2AiStatus::ID
                && Edition::V4_0
                    .bus
                    .decode_as::<Vcu2AiStatus>(one.frame.data())
                    .is_ok_and(|status| Faults::shown_by(&status).has(fault))
        };
        assert!(world.log.iter().any(shows), "{fault}");
        for log in crate::v4_0::recordings(&world) {
            let report = judge(&log.1, options(&[]));
            let vcu = |finding: &&Finding| finding.party == Party::Vcu;
            assert_eq!(report.findings.iter().find(vcu), None, "{fault}, {}", log.0);
        }
    }
    let low = driving_with("WARN_KL15_UNDER_V", 1);
    finds(&low, options(&[]), &[]);
}

/// Under another edition it is no message of the VCU, and nothing of it is judged.
#[test]
fn version_3_0_knows_nothing_of_it() {
    let mut world = world(&[]);
    moving(&mut world);
    world.log.retain(|one| one.frame.id == VcuStatus::ID);
    world.falsify(def(), "SM_AS", 0, SmAs::Off as i32);
    let report = judge(&world.log, JudgeOptions::of(&Edition::V3_0));
    let rules: Vec<Rule> = report.findings.iter().map(|finding| finding.rule).collect();
    assert_eq!(rules, [Rule::Reserved, Rule::OneSided]);
    assert_eq!(AsState::Driving, world.control.state);
}
