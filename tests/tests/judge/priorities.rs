//! Two arrows open at once, and the wrong one taken: a violation where the reading is pinned, and only there.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::messages::AsState;
use adsdv_spec::table::Priority;
use adsdv_spec::{Atom, Choice, Edition};
use adsdv_tests::world::{World, judge};

use crate::check::{blames, is_reported, is_silent, pinned};

/// The emergencies that a log shows.
const EMERGENCIES: [Atom; 2] = [Atom::AiEstop, Atom::SdcOpen];

/// The same question, answered the document's way: EMERGENCY_BRAKE first.
fn brake_first(priority: Priority) -> Choice {
    priority.choice.reading().choices()[0]
}

/// With the reading of `ai-estop` under which a request is an emergency in every state.
fn pinned_to(choice: Choice) -> JudgeOptions {
    let options = pinned(choice);
    JudgeOptions { readings: options.readings.pin(Choice::EstopEveryState), ..options }
}

fn section(from: AsState, to: AsState) -> &'static str {
    Edition::DEFAULT
        .rules
        .table
        .rows()
        .iter()
        .find(|row| (row.from, row.to) == (from, to))
        .map_or("", |row| row.section)
}

/// An emergency and the other arrow at once; after 50 ms the VCU goes to one of the two states.
fn both_open(priority: Priority, emergency: Atom, to: AsState) -> World {
    let other = match priority.first {
        AsState::Finished => (Atom::MissionFinished, true),
        _ => (Atom::Asms, false),
    };
    let mut world = World::reference();
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

fn each(test: impl Fn(Priority, Atom, &str)) {
    for &priority in Edition::DEFAULT.rules.priorities {
        for emergency in EMERGENCIES {
            test(priority, emergency, &format!("{} with {emergency}", priority.from));
        }
    }
}

#[test]
fn the_emergency_is_passed_over() {
    each(|priority, emergency, name| {
        let world = both_open(priority, emergency, priority.first);
        let expected = [(Rule::Unjustified, section(priority.from, priority.first))];
        is_reported(&world, pinned_to(brake_first(priority)), Party::Vcu, &expected, name);
        is_silent(&world, pinned_to(priority.choice), name);
        is_silent(&world, JudgeOptions::default(), name);
    });
}

#[test]
fn the_emergency_overtakes() {
    each(|priority, emergency, name| {
        let world = both_open(priority, emergency, AsState::EmergencyBrake);
        let expected = [(Rule::Unjustified, section(priority.from, AsState::EmergencyBrake))];
        // Under jitter a frame may be missing that showed the other state, from which the emergency leads here.
        let report = judge(&world.log, pinned_to(priority.choice));
        assert_eq!(blames(&report, Party::Vcu), expected, "{name}");
        is_silent(&world, pinned_to(brake_first(priority)), name);
        is_silent(&world, JudgeOptions::default(), name);
    });
}

#[test]
fn finished_with_the_master_switch_off() {
    let mut world = World::reference();
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
    is_reported(&world, pinned(Choice::DrivingBrakeFirst), Party::Vcu, &expected, "ASMS off");
    is_silent(&world, JudgeOptions::default(), "ASMS off");
}
