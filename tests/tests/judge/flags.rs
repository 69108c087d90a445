//! Fault flags, the flags that sum them up, and 502h: what 520h shows against what is so.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::messages::{AsState, Vcu2AiStatus, Vcu2LogStatus};
use adsdv_spec::{Atom, Edition};
use adsdv_tests::bus::def_of;
use adsdv_tests::world::{World, judge};

use crate::check::{Blame, blames, is_reported, is_reported_if_seen, is_silent};

/// AS_DRIVING at rest, and the VCU shows something from then on.
fn shows(shows: fn(&mut Vcu2AiStatus)) -> World {
    let mut world = World::reference();
    world.stopped();
    is_silent(&world, JudgeOptions::default(), "before");
    world.shows = shows;
    world.wait(300);
    world
}

fn expect(world: &World, expected: &[Blame], name: &str) {
    is_reported(world, JudgeOptions::default(), Party::Vcu, expected, name);
}

#[test]
fn an_emergency_stop_that_nobody_asked_for() {
    let world = shows(|status| status.ai_estop_request = true);
    expect(&world, &[(Rule::FlagUnfounded, "2.2")], "AI_ESTOP_REQUEST");
}

#[test]
fn a_mission_status_fault_at_rest() {
    let world = shows(|status| (status.mission_status_fault, status.fault_status) = (true, true));
    expect(&world, &[(Rule::FlagUnfounded, "4")], "MISSION_STATUS_FAULT");
}

#[test]
fn an_autonomous_braking_fault_at_rest() {
    let world = shows(|status| (status.autonomous_braking_fault, status.fault_status) = (true, true));
    expect(&world, &[(Rule::FlagUnfounded, "4")], "AUTONOMOUS_BRAKING_FAULT");
}

#[test]
fn a_fault_that_fault_status_does_not_sum_up() {
    let world = |shows: fn(&mut Vcu2AiStatus)| {
        let mut world = World::reference();
        world.stopped();
        world.inputs.reports.hvil_short = true;
        world.shows = shows;
        world.wait(500);
        world
    };
    expect(&world(|status| status.fault_status = false), &[(Rule::StatusSum, "2.2")], "FAULT_STATUS");
    is_silent(&world(|_| {}), JudgeOptions::default(), "FAULT_STATUS");
}

#[test]
fn a_warning_that_warning_status_does_not_sum_up() {
    let world = |shows: fn(&mut Vcu2AiStatus)| {
        let mut world = World::reference();
        world.stopped();
        world.inputs.reports.batt_soc_low = true;
        world.shows = shows;
        world.wait(500);
        world
    };
    expect(&world(|status| status.warning_status = false), &[(Rule::StatusSum, "2.2")], "WARNING_STATUS");
    is_silent(&world(|_| {}), JudgeOptions::default(), "WARNING_STATUS");
}

/// The AI Computer asks for an emergency stop, and nothing follows.
fn ignored_emergency_stop() -> World {
    let mut world = World::reference();
    world.stopped();
    world.hold_state();
    world.shows = |status| status.ai_estop_request = false;
    world.set(Atom::AiEstop, true);
    world.wait(500);
    world
}

#[test]
fn an_emergency_stop_that_is_ignored() {
    let world = ignored_emergency_stop();
    // Neither the flag nor the state follows.
    let both = [(Rule::FlagMissing, "2.2"), (Rule::Due, "3.7")];
    let mut found = blames(&judge(&world.log, JudgeOptions::default()), Party::Vcu);
    found.sort_unstable_by_key(|&(rule, _)| rule != Rule::FlagMissing);
    assert_eq!(found, both);
}

/// The flag is for what the AI Computer asks, wherever the Autonomous System is active.
#[test]
fn an_emergency_stop_whose_flag_is_not_shown_in_any_active_state() {
    for edition in Edition::ALL {
        for (leads, expected) in [
            (World::prepare as fn(&mut World), 0),
            (World::ready, 1),
            (World::driving, 1),
            (World::finished, 1),
        ] {
            let mut world = World::of(edition);
            leads(&mut world);
            world.hold_state();
            world.shows = |status| status.ai_estop_request = false;
            world.set(Atom::AiEstop, true);
            world.wait(500);
            let report = judge(&world.log, JudgeOptions::of(edition));
            let missing = report.findings.iter().filter(|finding| finding.rule == Rule::FlagMissing);
            assert_eq!(missing.count(), expected, "{} in {}", edition.version, world.control.state);
        }
    }
}

/// AS_OFF behind an emergency stop that the AI Computer still asks for, for so long; the VCU shows something from AS_OFF on.
fn asked_for_into_as_off(edition: &Edition, shows: fn(&mut Vcu2AiStatus), ms: i64) -> World {
    let mut world = World::of(edition);
    world.driving();
    world.set(Atom::AiEstop, true);
    world.wait(i64::from(edition.rules.timing.ebs_timer_ms) + 500);
    world.shows = shows;
    world.inputs.asms = false;
    world.wait(ms);
    assert_eq!(world.control.state, AsState::Off);
    world
}

#[test]
fn a_flag_of_an_emergency_stop_stays_as_long_as_it_is_asked_for() {
    for edition in Edition::ALL {
        for (ms, expected) in [(50, 0), (60, 1), (500, 1)] {
            let world = asked_for_into_as_off(edition, |status| status.ai_estop_request = false, ms);
            let report = judge(&world.log, JudgeOptions::of(edition));
            let missing: Vec<_> =
                report.findings.iter().filter(|finding| finding.rule == Rule::FlagMissing).collect();
            assert_eq!(missing.len(), expected, "{} after {ms} ms: {missing:?}", edition.version);
        }
        let mut world = asked_for_into_as_off(edition, |_| {}, 500);
        is_silent(&world, JudgeOptions::of(edition), "the flag stays");
        world.set(Atom::AiEstop, false);
        world.wait(500);
        is_silent(&world, JudgeOptions::of(edition), "the flag goes with what it shows");
    }
}

/// How long it is ignored is reported to the millisecond, and exactly the deadline is not too long.
#[test]
fn an_emergency_stop_that_is_ignored_for_the_deadline() {
    let world = ignored_emergency_stop();
    // The AI Computer asks half a cycle before the VCU's next frame.
    let options = JudgeOptions { deadline_ms: 45, ..JudgeOptions::default() };
    let report = judge(&world.log, options);
    let missing = report.findings.iter().find(|finding| finding.rule == Rule::FlagMissing);
    let said = &missing.expect("it is reported").message();
    assert!(said.contains(" for 55 ms"), "{said}");
}

#[test]
fn the_logger_shows_another_state() {
    let mut world = World::reference();
    world.stopped();
    let since = world.t;
    world.wait(1000);
    is_silent(&world, JudgeOptions::default(), "the same state");
    world.falsify(def_of::<Vcu2LogStatus>(), "State_ASSI", since, AsState::Ready as i32);
    let expected = [(Rule::AssiDiffers, def_of::<Vcu2LogStatus>().section)];
    is_reported_if_seen(&world, JudgeOptions::default(), Party::Vcu, &expected, "State_ASSI");
}

#[test]
fn the_logger_goes_on_to_show_the_state_before() {
    let mut world = World::reference();
    world.prepare();
    world.wait(500);
    world.inputs.asms = true;
    let since = world.t;
    world.wait(1000);
    assert_eq!(world.control.state, AsState::Ready);
    is_silent(&world, JudgeOptions::default(), "the same state");
    // Not a bit of 502h changes.
    world.falsify(def_of::<Vcu2LogStatus>(), "State_ASSI", since, AsState::Off as i32);
    let expected = [(Rule::AssiDiffers, def_of::<Vcu2LogStatus>().section)];
    is_reported_if_seen(&world, JudgeOptions::default(), Party::Vcu, &expected, "State_ASSI");
}

#[test]
fn a_state_that_lasts_for_a_step_is_what_the_logger_shows() {
    let mut world = World::reference();
    world.ready();
    for _ in 0..10 {
        // 502h shows the step in which ASMS is off, and 520h shows it a little later.
        world.inputs.asms = false;
        world.cycle();
        assert_eq!(world.control.state, AsState::Off);
        world.inputs.asms = true;
        world.wait(90);
        assert_eq!(world.control.state, AsState::Ready);
    }
    is_silent(&world, JudgeOptions::default(), "AS_OFF in the steps that 502h shows");
}
