//! `SHUTDOWN_CAUSE`: with its flag, with its shutdown, and for good.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule, Severity};
use adsdv_spec::Choice;
use adsdv_spec::messages::{AsState, MissionStatus, ShutdownCause, Vcu2AiStatus};
use adsdv_tests::bus::def_of;
use adsdv_tests::world::{World, judge};

use crate::check::{Blame, is_reported, is_silent, pinned};

fn expect(world: &World, expected: &[Blame], name: &str) {
    is_reported(world, JudgeOptions::default(), Party::Vcu, expected, name);
}

/// AS_DRIVING, then an emergency of which the VCU shows this.
fn emergency(shows: fn(&mut Vcu2AiStatus)) -> World {
    let mut world = World::reference();
    world.stopped();
    world.inputs.sdc.remote_estop = true;
    world.shows = shows;
    world.wait(500);
    world
}

#[test]
fn an_emergency_as_it_should_be() {
    is_silent(&emergency(|_| {}), JudgeOptions::default(), "an emergency");
}

#[test]
fn a_cause_without_its_flag() {
    let world = emergency(|status| (status.hvil_open_fault, status.fault_status) = (false, false));
    expect(&world, &[(Rule::CauseWithoutFlag, "2.2")], "the flag of the cause is 0");
}

#[test]
fn a_cause_while_driving_goes_on() {
    let mut world = World::reference();
    // A flag that was there before AS_READY is no reason to leave AS_DRIVING.
    world.shows = |status| (status.ebs_fault, status.fault_status) = (true, true);
    world.stopped();
    is_silent(&world, JudgeOptions::default(), "a flag from before");
    world.shows = |status| {
        (status.ebs_fault, status.fault_status) = (true, true);
        status.shutdown_cause = ShutdownCause::EbsFault;
    };
    world.wait(500);
    expect(&world, &[(Rule::CauseWithoutShutdown, "2.2")], "a cause in AS_DRIVING");
}

/// FINISHED at speed, which a VCU with this reading answers with EMERGENCY_BRAKE.
fn finished_at_speed(go_signal: Choice, shows: fn(&mut Vcu2AiStatus)) -> World {
    let mut world = World::with_reading(go_signal);
    world.driving();
    world.ai.status.mission_status = MissionStatus::Finished;
    world.shows = shows;
    world.wait(500);
    world
}

#[test]
fn no_cause_for_finished_at_speed() {
    let options = pinned(Choice::FaultLevel);
    let no_cause: fn(&mut Vcu2AiStatus) = |status| status.shutdown_cause = ShutdownCause::NoShutdown;
    let world = finished_at_speed(Choice::GoRaw, no_cause);
    is_reported(&world, options, Party::Vcu, &[(Rule::CauseMissing, "2.2")], "no cause");
    is_silent(&finished_at_speed(Choice::GoRaw, |_| {}), options, "a cause");

    // "Go" off has no number. A GO_SIGNAL that ends with AS_DRIVING does not show that this was not the reason.
    let world = finished_at_speed(Choice::GoAccepted, no_cause);
    is_silent(&world, options, "no cause");
    let report = judge(&world.log, options);
    assert!(report.findings.iter().any(|f| (f.rule, f.severity) == (Rule::CauseMissing, Severity::Warning)));
}

#[test]
fn a_cause_that_changes() {
    let mut world = emergency(|_| {});
    world.inputs.reports.ebs_fault = true;
    world.wait(500);
    is_silent(&world, JudgeOptions::default(), "a second fault");
    world.shows = |status| status.shutdown_cause = ShutdownCause::EbsFault;
    world.wait(500);
    expect(&world, &[(Rule::CauseChanged, "2.2")], "a second cause");
}

#[test]
fn an_undefined_cause_hides_nothing_else() {
    let mut world = World::reference();
    world.stopped();
    let since = world.t;
    world.wait(300);
    world.inputs.go = false;
    let stopped = world.t;
    world.wait(500);
    let signal = def_of::<Vcu2AiStatus>().signal("SHUTDOWN_CAUSE").expect("a signal of 520h");
    let undefined = signal.max + 1;
    for recorded in world.log.iter_mut().filter(|r| r.t >= since && r.frame.id == Vcu2AiStatus::ID) {
        recorded.frame.data = signal.put(recorded.frame.data, undefined);
    }
    expect(&world, &[(Rule::Value, "2.2")], "cause 11");
    let report = judge(&world.log, JudgeOptions::default());
    let last = report.transitions.last().expect("the transition is listed");
    assert_eq!((last.t_ns, last.to), (stopped, AsState::EmergencyBrake));
    assert!(report.findings.iter().any(|f| f.rule == Rule::Value && f.message().contains("SHUTDOWN_CAUSE")));
}
