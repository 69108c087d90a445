//! What only an unseen frame could excuse: a flag, "Go" that is not shown, and a state that lasts for a step only.
//!
//! That a transition was due is in [`not_taken`](super::not_taken).

use adsdv_oracle::judge::{Finding, JudgeOptions, Party, Rule, Severity};
use adsdv_spec::messages::{Ai2VcuSteer, AnyMessage, ShutdownCause, Vcu2AiStatus};
use adsdv_spec::{AsState, Atom, Choice, Edition, Machine, Mutation};
use adsdv_tests::world::{MS, Recorded, World, judge};

/// The log without the first 520h from `from` on for which `is` holds; `None` if it holds for none.
fn without(world: &World, from: usize, is: impl Fn(&Vcu2AiStatus) -> bool) -> Option<Vec<Recorded>> {
    let bus = world.vcu.edition().bus;
    let is_wanted = |recorded: &Recorded| match bus.decode(recorded.frame.id, recorded.frame.data()) {
        Ok(AnyMessage::Vcu2AiStatus(status)) => is(&status),
        _ => false,
    };
    let first = world.log.iter().skip(from).position(is_wanted)?;
    let mut log = world.log.clone();
    log.remove(from + first);
    Some(log)
}

/// What is said of the VCU.
fn said(log: &[Recorded], options: JudgeOptions) -> Vec<Finding> {
    let findings = judge(log, options).findings;
    findings.into_iter().filter(|finding| finding.party == Party::Vcu).collect()
}

/// One warning by a rule, which names the frame that is missing; and where none is, a violation.
fn is_warned_of(log: Option<Vec<Recorded>>, edition: &'static Edition, rule: Rule, name: &str) {
    let log = log.expect(name);
    let options = JudgeOptions::of(edition);
    let of_rule = |options| {
        let found: Vec<Finding> =
            said(&log, options).into_iter().filter(|finding| finding.rule == rule).collect();
        let [finding] = &found[..] else { panic!("{name}: {found:#?}") };
        finding.clone()
    };
    let warning = of_rule(options);
    assert_eq!(warning.severity, Severity::Warning, "{name}");
    assert!(warning.unless.contains("(520h: no frame from "), "{name}: {}", warning.unless);
    let complete = of_rule(JudgeOptions { complete: true, ..options });
    assert_eq!((complete.severity, complete.unless.as_str()), (Severity::Violation, ""), "{name}");
}

type Shows = fn(&mut Vcu2AiStatus);
type Begins = fn(&mut World);

#[test]
fn a_flag_without_a_reason_is_a_warning_where_the_frame_that_raised_it_may_be_lost() {
    let flags: [(&str, Shows); 3] = [
        ("AI_ESTOP_REQUEST", |status| status.ai_estop_request = true),
        ("MISSION_STATUS_FAULT", |status| {
            (status.mission_status_fault, status.fault_status) = (true, true);
        }),
        ("AUTONOMOUS_BRAKING_FAULT", |status| {
            (status.autonomous_braking_fault, status.fault_status) = (true, true);
        }),
    ];
    for edition in Edition::ALL {
        for (name, shows) in flags {
            let mut world = World::of(edition);
            world.stopped();
            let from = world.log.len();
            world.shows = shows;
            world.wait(300);
            let name = format!("{}: {name}", edition.version);
            is_warned_of(without(&world, from, |_| true), edition, Rule::FlagUnfounded, &name);
        }
    }
}

/// Of lost communication the last answer tells, if it is recent: how recent it is seen to be is a matter of chance.
#[test]
fn communication_that_is_there_by_all_that_was_recorded_and_is_shown_as_lost_is_mostly_a_warning() {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.stopped();
        world.shows = |status| status.ai_comms_lost = true;
        world.wait(300);
        let is_said = |seed: &u64| {
            let said = said(&world.disturbed(*seed, 20 * MS, 0), JudgeOptions::of(edition));
            said.iter().any(|finding| finding.rule == Rule::FlagUnfounded)
        };
        let reported = (1..=40).filter(is_said).count();
        assert!(reported > 20, "{}: {reported} of 40", edition.version);
    }
}

#[test]
fn a_flag_with_a_reason_is_no_warning_where_the_frame_that_raised_it_is_lost() {
    for edition in Edition::ALL {
        let begins: [(&str, Begins); 2] = [
            ("AI_ESTOP_REQUEST", |world| world.set(Atom::AiEstop, true)),
            ("AI_COMMS_LOST", |world| world.ai_answers = false),
        ];
        for (name, begins) in begins {
            let mut world = World::of(edition);
            world.stopped();
            let from = world.log.len();
            begins(&mut world);
            world.wait(500);
            let log = without(&world, from, |status| status.ai_estop_request || status.ai_comms_lost);
            let said = said(&log.expect(name), JudgeOptions::of(edition));
            assert!(said.is_empty(), "{}: {name}: {said:#?}", edition.version);
        }
    }
}

/// An answer that comes as late as the flag is no sign that communication was there.
#[test]
fn an_answer_that_comes_with_the_flag_is_no_reason_for_a_warning() {
    for edition in Edition::ALL {
        let mut lost = 0;
        for silent in (40..=300).step_by(10) {
            let mut world = World::of(edition);
            world.stopped();
            let from = world.log.len();
            world.ai_answers = false;
            world.wait(silent);
            world.ai_answers = true;
            world.wait(300);
            let Some(log) = without(&world, from, |status| status.ai_comms_lost) else { continue };
            let said = said(&log, JudgeOptions::of(edition));
            lost += 1;
            assert!(said.is_empty(), "{}: silent for {silent} ms: {said:#?}", edition.version);
        }
        assert!(lost > 0, "{}: communication is lost in some of them", edition.version);
    }
}

/// A silence that is over when the flag is seen was long enough all the same.
#[test]
fn a_message_that_comes_back_with_the_flag_is_no_reason_for_a_warning() {
    for edition in Edition::ALL.iter().filter(|edition| edition.rules.thresholds.missed_ms.is_some()) {
        let mut lost = 0;
        for silent in (100..=150).step_by(10) {
            let mut world = World::of(edition);
            world.stopped();
            world.mutes = vec![Ai2VcuSteer::ID];
            world.wait(silent);
            world.mutes.clear();
            world.wait(300);
            lost += usize::from(without(&world, 0, |status| status.ai_comms_lost).is_some());
            for seed in 1..=10 {
                let said = said(&world.disturbed(seed, 20 * MS, 0), JudgeOptions::of(edition));
                let flags = said.iter().filter(|finding| finding.rule == Rule::FlagUnfounded).count();
                assert_eq!(flags, 0, "{}: silent for {silent} ms, seed {seed}", edition.version);
            }
        }
        assert!(lost > 0, "{}: the flag is raised in some of them", edition.version);
    }
}

/// A recorder that loses frames may have lost all of one message while the others came: the AI Computer and the VCU are warned of it.
#[test]
fn a_message_that_is_missed_by_all_that_was_recorded_and_not_shown_as_lost_is_mostly_a_warning_of_both() {
    for edition in Edition::ALL.iter().filter(|edition| edition.rules.thresholds.missed_ms.is_some()) {
        for is_missed in [true, false] {
            let mut world = World::of(edition);
            world.stopped();
            world.hold_state();
            world.shows = |status| status.ai_comms_lost = false;
            world.mutes = if is_missed { vec![Ai2VcuSteer::ID] } else { Vec::new() };
            world.wait(500);
            let is_said = |seed: u64, party: Party, rule: Rule| {
                let findings = judge(&world.disturbed(seed, 20 * MS, 10), JudgeOptions::of(edition)).findings;
                let warned = |one: &&Finding| one.party == party && one.rule == rule;
                let excuses: Vec<&str> =
                    findings.iter().filter(warned).map(|one| one.unless.as_str()).collect();
                match excuses[..] {
                    [] | [""] => false,
                    [excuse] => excuse.contains("(513h: no frame from "),
                    _ => panic!("{} of {rule:?}, seed {seed}: {findings:#?}", edition.version),
                }
            };
            for (party, rule) in [(Party::Ai, Rule::MessageMissed), (Party::Vcu, Rule::CommsLostDue)] {
                let warned = (1..=40).filter(|&seed| is_said(seed, party, rule)).count();
                assert_eq!(warned > 20, is_missed, "{}: {rule:?} in {warned} of 40", edition.version);
                assert!(is_missed || warned == 0, "{}: {rule:?} in {warned} of 40", edition.version);
            }
        }
    }
}

#[test]
fn a_cause_that_changes_is_a_warning_where_a_frame_may_be_lost_in_between() {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.stopped();
        world.set(Atom::AiEstop, true);
        world.wait(300);
        let from = world.log.len();
        world.shows = |status| status.shutdown_cause = ShutdownCause::AiCommsFault;
        world.wait(300);
        is_warned_of(without(&world, from, |_| true), edition, Rule::CauseChanged, edition.version);
    }
}

#[test]
fn a_cause_without_its_flag_is_a_warning_where_the_frame_that_named_it_may_be_lost() {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.stopped();
        let from = world.log.len();
        world.set(Atom::AiEstop, true);
        world.shows = |status| status.ai_estop_request = false;
        world.wait(300);
        let log = without(&world, from, |status| status.shutdown_cause != ShutdownCause::NoShutdown);
        is_warned_of(log, edition, Rule::CauseWithoutFlag, edition.version);
    }
}

/// In a recording that is late no frame is certain to be the next one, so that nothing lasts for certain.
#[test]
fn a_sum_that_is_0_in_every_frame_of_a_late_recording_is_at_least_a_warning() {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.stopped();
        world.inputs.reports.batt_soc_low = true;
        world.shows = |status| status.warning_status = false;
        world.wait(500);
        for seed in 1..=10 {
            let said = said(&world.disturbed(seed, 20 * MS, 0), JudgeOptions::of(edition));
            let sums = said.iter().filter(|finding| finding.rule == Rule::StatusSum).count();
            assert!((1..=2).contains(&sums), "{}, seed {seed}: {sums}", edition.version);
        }
    }
}

/// A request that is short, in whichever state: once, and never of a VCU that shows it.
#[test]
fn a_flag_that_does_not_follow_a_short_emergency_stop_is_a_warning_in_a_late_recording() {
    for edition in Edition::ALL {
        for arrive in [World::ready as fn(&mut World), World::finished] {
            for follows in [false, true] {
                let mut world = World::of(edition);
                arrive(&mut world);
                world.hold_state();
                if !follows {
                    world.shows = |status| status.ai_estop_request = false;
                }
                world.set(Atom::AiEstop, true);
                world.wait(100);
                world.set(Atom::AiEstop, false);
                world.wait(500);
                let missing = |seed| {
                    let said = said(&world.disturbed(seed, 20 * MS, 0), JudgeOptions::of(edition));
                    said.iter().filter(|finding| finding.rule == Rule::FlagMissing).count()
                };
                let counts: Vec<usize> = (1..=20).map(missing).collect();
                let name = format!("{} in {}, {counts:?}", edition.version, world.control.state);
                if follows {
                    assert!(counts.iter().all(|&count| count == 0), "{name}");
                } else {
                    assert!(counts.iter().all(|&count| count == 1), "{name}");
                }
            }
        }
    }
}

#[test]
fn go_that_is_not_shown_is_a_warning_where_a_frame_may_be_lost_that_shows_it() {
    for edition in Edition::ALL.iter().filter(|edition| edition.bus.devices.is_empty()) {
        let mut world = World::of(edition);
        world.dwelt();
        let from = world.log.len();
        world.inputs.go = true;
        world.shows = |status| status.go_signal = false;
        world.wait(100);
        let driving = |status: &Vcu2AiStatus| status.as_state == AsState::Driving;
        is_warned_of(without(&world, from, driving), edition, Rule::GoDiffers, edition.version);
    }
}

/// However short a state lasts: what counts is what was shown before it.
#[test]
fn a_state_that_is_left_in_the_next_step_without_a_reason_is_a_warning_in_a_recording_that_is_late() {
    for edition in Edition::ALL {
        let leaves =
            Mutation::all(edition).find(|mutation| mutation.to_string() == "3.6 term 0: asms dropped");
        let leaves = leaves.expect("AS_READY is left for AS_OFF where ASMS is off");
        let mut world = World::new(Machine::new(leaves.apply(edition), edition.readings));
        world.ready();
        for seed in 1..=5 {
            let said = said(&world.disturbed(seed, 20 * MS, 0), JudgeOptions::of(edition));
            let rules: Vec<Rule> = said.iter().map(|finding| finding.rule).collect();
            assert!(rules.contains(&Rule::Unjustified), "{}, seed {seed}: {rules:?}", edition.version);
        }
    }
}

/// The remote control shows "Go" in each of its frames, and of a late recording any two may have one between them.
#[test]
fn go_that_a_vcu_does_not_hear_is_at_least_a_warning_in_a_late_recording_of_the_remote_control() {
    let edition = &Edition::V2026;
    let deaf = Mutation::all(edition).find(|mutation| mutation.to_string() == "3.2: dropped");
    let deaf = deaf.expect("AS_READY is never left for AS_DRIVING");
    let mut world = World::new(Machine::new(deaf.apply(edition), edition.readings));
    world.dwelt();
    world.inputs.go = true;
    world.wait(1000);
    let is_said = |seed: &u64| {
        let said = said(&world.disturbed(*seed, 20 * MS, 0), JudgeOptions::of(edition));
        said.iter().any(|finding| finding.rule == Rule::Due)
    };
    let reported = (1..=20).filter(is_said).count();
    assert!(reported > 10, "{reported} of 20");
}

/// In how many of twenty late recordings the VCU is warned of by one of these rules.
fn warned_when_late(options: JudgeOptions, world: &World, rules: &[Rule]) -> usize {
    let is_warned = |seed: &u64| {
        let said = said(&world.disturbed(*seed, 20 * MS, 0), options);
        said.iter().any(|one| one.severity == Severity::Warning && rules.contains(&one.rule))
    };
    (1..=20).filter(is_warned).count()
}

/// The AI Computer answers what is shown, and the VCU waits for what is not.
#[test]
fn a_handshake_that_is_stuck_is_mostly_a_warning_in_a_late_recording() {
    for edition in Edition::ALL {
        let stuck: [Shows; 2] = [|status| status.handshake = false, |status| status.handshake = true];
        for shows in stuck {
            let mut world = World::of(edition);
            world.stopped();
            world.shows = shows;
            world.wait(500);
            let warned = warned_when_late(
                JudgeOptions::of(edition),
                &world,
                &[Rule::FlagUnfounded, Rule::HandshakeEdge],
            );
            assert!(warned > 10, "{}: {warned} of 20", edition.version);
        }
    }
}

/// With the tractive system off the VCU rests, and shows what nobody has to answer.
#[test]
fn a_tsms_that_is_shown_on_where_it_is_off_is_a_warning_in_a_late_recording() {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.shows = |status| status.ts_switch_status = true;
        world.wait(1000);
        let warned = warned_when_late(JudgeOptions::of(edition), &world, &[Rule::HandshakeEdge]);
        assert!(warned > 10, "{}: {warned} of 20", edition.version);
        // Once, however long it lasts.
        let said = said(&world.disturbed(1, 20 * MS, 0), JudgeOptions::of(edition));
        assert_eq!(said.iter().filter(|one| one.rule == Rule::HandshakeEdge).count(), 1, "{said:#?}");
    }
}

/// Where the readings leave no handshake without it.
#[test]
fn communication_that_is_lost_while_tsms_is_shown_off_is_a_warning_in_a_late_recording() {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.stopped();
        world.shows = |status| status.ts_switch_status = false;
        world.wait(300);
        world.ai_answers = false;
        world.wait(300);
        let options = JudgeOptions { readings: edition.readings.choices(), ..JudgeOptions::of(edition) };
        let warned = warned_when_late(options, &world, &[Rule::FlagUnfounded]);
        assert!(warned > 10, "{}: {warned} of 20", edition.version);
    }
}

/// A VCU may watch the messages while the tractive system is off.
#[test]
fn messages_that_are_missed_while_tsms_is_off_are_a_reason_for_the_flag() {
    for edition in Edition::ALL.iter().filter(|edition| edition.rules.thresholds.missed_ms.is_some()) {
        let readings = edition.readings.with(Choice::WatchAlways);
        let mut world = World::new(Machine::new(**edition, readings));
        world.wait(500);
        world.mutes = vec![Ai2VcuSteer::ID];
        world.wait(500);
        let lost = without(&world, 0, |status| status.ai_comms_lost && !status.ts_switch_status);
        assert!(lost.is_some(), "{}: the flag is raised", edition.version);
        let options = JudgeOptions { readings: readings.choices(), ..JudgeOptions::of(edition) };
        assert_eq!(warned_when_late(options, &world, &[Rule::FlagUnfounded]), 0, "{}", edition.version);
    }
}

/// There is no edge of "Go" without a 0 before it, and of a late recording any frame may be the one that showed it.
#[test]
fn as_driving_behind_a_go_signal_that_was_never_0_in_as_ready_is_mostly_a_warning_in_a_late_recording() {
    for edition in Edition::ALL.iter().filter(|edition| edition.bus.devices.is_empty()) {
        let drives = |shows: Shows| {
            let mut world = World::of(edition);
            world.shows = shows;
            world.dwelt();
            world.inputs.go = true;
            world.wait(300);
            warned_when_late(JudgeOptions::of(edition), &world, &[Rule::Unjustified])
        };
        let stuck = drives(|status| status.go_signal |= status.as_state == AsState::Ready);
        assert!(stuck > 10, "{}: {stuck} of 20", edition.version);
        assert_eq!(drives(|_| {}), 0, "{}", edition.version);
    }
}
