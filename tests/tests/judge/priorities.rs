//! Two arrows open at once, and the wrong one taken: a violation where the reading is pinned, and only there.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::messages::AsState;
use adsdv_spec::table::Priority;
use adsdv_spec::{Atom, Choice, Edition};
use adsdv_tests::world::{World, judge};

use crate::check::{blames, is_reported, is_silent, pinned_in};

/// The emergencies that a log shows.
const EMERGENCIES: [Atom; 2] = [Atom::AiEstop, Atom::SdcOpen];

/// The same question, answered the document's way: EMERGENCY_BRAKE first.
fn brake_first(priority: Priority) -> Choice {
    priority.choice.reading().choices()[0]
}

/// With the reading of `ai-estop` under which a request is an emergency in every state.
fn pinned_to(edition: &'static Edition, choice: Choice) -> JudgeOptions {
    pinned_in(edition, &[choice, Choice::EstopEveryState])
}

fn section(edition: &Edition, from: AsState, to: AsState) -> &'static str {
    edition
        .rules
        .table
        .rows()
        .iter()
        .find(|row| (row.from, row.to) == (from, to))
        .map_or("", |row| row.section)
}

/// An emergency and the other arrow at once; after 50 ms the VCU goes to one of the two states.
fn both_open(edition: &Edition, priority: Priority, emergency: Atom, to: AsState) -> World {
    let other = match priority.first {
        AsState::Finished => (Atom::MissionFinished, true),
        _ => (Atom::Asms, false),
    };
    let mut world = World::of(edition);
    world.arrive(priority.from);
    world.hold_state();
    world.set(emergency, true);
    world.set(other.0, other.1);
    world.wait(50);
    world.force(to);
    world.wait(40);
    world.set(emergency, false);
    world.wait(300);
    world
}

fn each(test: impl Fn(&'static Edition, Priority, Atom, &str)) {
    for &edition in Edition::ALL {
        for &priority in edition.rules.priorities {
            for emergency in EMERGENCIES {
                let name = format!("{}: {} with {emergency}", edition.version, priority.from);
                test(edition, priority, emergency, &name);
            }
        }
    }
}

#[test]
fn the_emergency_is_passed_over() {
    each(|edition, priority, emergency, name| {
        let world = both_open(edition, priority, emergency, priority.first);
        let expected = [(Rule::Unjustified, section(edition, priority.from, priority.first))];
        is_reported(&world, pinned_to(edition, brake_first(priority)), Party::Vcu, &expected, name);
        is_silent(&world, pinned_to(edition, priority.choice), name);
        is_silent(&world, JudgeOptions::of(edition), name);
    });
}

#[test]
fn the_emergency_overtakes() {
    each(|edition, priority, emergency, name| {
        let world = both_open(edition, priority, emergency, AsState::EmergencyBrake);
        let expected = [(Rule::Unjustified, section(edition, priority.from, AsState::EmergencyBrake))];
        // Under jitter a frame may be missing that showed the other state, from which the emergency leads here.
        let report = judge(&world.log, pinned_to(edition, priority.choice));
        assert_eq!(blames(&report, Party::Vcu), expected, "{name}");
        is_silent(&world, pinned_to(edition, brake_first(priority)), name);
        is_silent(&world, JudgeOptions::of(edition), name);
    });
}

#[test]
fn finished_with_the_master_switch_off() {
    for &edition in Edition::ALL {
        let mut world = World::of(edition);
        world.stopped();
        world.hold_state();
        world.set(Atom::Asms, false);
        world.set(Atom::MissionFinished, true);
        world.wait(50);
        world.force(AsState::Finished);
        world.wait(40);
        world.set(Atom::Asms, true);
        world.wait(300);
        let expected = [(Rule::Unjustified, "3.3")];
        let (options, name) = (pinned_in(edition, &[Choice::DrivingBrakeFirst]), edition.version);
        is_reported(&world, options, Party::Vcu, &expected, &format!("{name}: ASMS off"));
        is_silent(&world, JudgeOptions::of(edition), &format!("{name}: ASMS off"));
    }
}
