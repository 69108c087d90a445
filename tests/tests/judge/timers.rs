//! The dwell of AS_READY and the EBS timer: left too early, and in time.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::Edition;
use adsdv_spec::messages::AsState;
use adsdv_tests::world::{MS, World};

use crate::check::{Blame, is_reported, is_silent};

/// What is tried after this many milliseconds less than the timer takes.
const EARLY_MS: [(i64, bool); 2] = [(100, false), (0, true)];

fn expected(in_time: bool, section: &'static str) -> Vec<Blame> {
    if in_time { Vec::new() } else { vec![(Rule::Unjustified, section)] }
}

/// Waits until so many milliseconds after the state was entered.
fn wait_in_state(world: &mut World, entered: i64, ms: i64) {
    let left = entered + ms * MS - world.t;
    world.wait(left / MS);
}

//= DRV-4
#[test]
fn ready_lasts_five_seconds() {
    for &edition in Edition::ALL {
        let dwell = i64::from(edition.rules.timing.ready_dwell_ms);
        for (early, in_time) in EARLY_MS {
            let mut world = World::of(edition);
            world.prepare();
            world.inputs.asms = true;
            let entered = world.t;
            wait_in_state(&mut world, entered, dwell - early);
            world.inputs.go = true;
            world.force(AsState::Driving);
            world.wait(300);
            let name = format!("{}: AS_READY left {early} ms early", edition.version);
            is_reported(&world, JudgeOptions::of(edition), Party::Vcu, &expected(in_time, "3.2"), &name);
        }
    }
}

//= ETO-1
#[test]
fn emergency_brake_lasts_fifteen_seconds() {
    for &edition in Edition::ALL {
        let timer = i64::from(edition.rules.timing.ebs_timer_ms);
        for (early, in_time) in EARLY_MS {
            let mut world = World::of(edition);
            world.driving();
            world.inputs.sdc.remote_estop = true;
            let entered = world.t;
            world.wait(1000);
            world.inputs.asms = false;
            wait_in_state(&mut world, entered, timer - early);
            world.force(AsState::Off);
            world.wait(300);
            let name = format!("{}: EMERGENCY_BRAKE left {early} ms early", edition.version);
            is_reported(&world, JudgeOptions::of(edition), Party::Vcu, &expected(in_time, "3.9"), &name);
        }
    }
}

//= ETO-2, D-23
#[test]
fn emergency_brake_ends_when_the_timer_does() {
    for &edition in Edition::ALL {
        let mut world = World::of(edition);
        world.driving();
        world.inputs.sdc.remote_estop = true;
        world.wait(1000);
        world.inputs.asms = false;
        world.hold_state();
        world.wait(i64::from(edition.rules.timing.ebs_timer_ms));
        is_reported(
            &world,
            JudgeOptions::of(edition),
            Party::Vcu,
            &[(Rule::Due, "3.9")],
            &format!("{}: the EBS timer is over", edition.version),
        );
    }
}

/// A recorder whose clock is set forward makes a timer look longer than it was.
#[test]
fn a_clock_that_is_set_forward_makes_no_timer_longer() {
    for &edition in Edition::ALL {
        for hold in [false, true] {
            let mut world = World::of(edition);
            world.driving();
            world.inputs.sdc.remote_estop = true;
            world.wait(1000);
            world.inputs.asms = false;
            let set = world.t;
            if hold {
                world.hold_state();
            }
            world.wait(i64::from(edition.rules.timing.ebs_timer_ms));
            for recorded in world.log.iter_mut().filter(|recorded| recorded.t >= set) {
                recorded.t += 400 * MS;
            }
            if hold {
                is_reported(
                    &world,
                    JudgeOptions::of(edition),
                    Party::Vcu,
                    &[(Rule::Due, "3.9")],
                    &format!("{}: set forward, and held", edition.version),
                );
            } else {
                is_silent(&world, JudgeOptions::of(edition), &format!("{}: set forward", edition.version));
            }
        }
    }
}
