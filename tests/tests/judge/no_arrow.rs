//! Transitions for which Figure 2 has no arrow.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::messages::{AsState, Vcu2AiStatus};
use adsdv_spec::{Atom, Edition, Truth};
use adsdv_tests::world::{World, judge};

use crate::check::{is_at, is_reported, is_silent, only};

/// Every ordered pair of states without an arrow.
fn pairs(edition: &Edition) -> impl Iterator<Item = (AsState, AsState)> {
    let all = AsState::ALL.iter().flat_map(|&from| AsState::ALL.iter().map(move |&to| (from, to)));
    all.filter(move |&(from, to)| {
        from != to && !edition.rules.table.rows().iter().any(|row| (row.from, row.to) == (from, to))
    })
}

/// Sets the switches such that no arrow leads out of the state.
fn settle(world: &mut World, state: AsState) {
    world.set(Atom::Asms, state != AsState::Off);
    world.set(Atom::GoOn, state == AsState::Driving);
    world.set(Atom::MissionRunning, state == AsState::Driving);
    if state == AsState::Driving {
        // Since 4.0 an EBS that is not there ends driving.
        world.set(Atom::EbsArmed, true);
    }
}

//= SM-18
#[test]
fn every_arrow_that_does_not_exist_is_reported() {
    for &edition in Edition::ALL {
        assert_eq!(pairs(edition).count(), 11, "20 pairs, 9 arrows");
        for (from, to) in pairs(edition) {
            let arrow = format!("{from} -> {to}");
            let name = format!("{}: {arrow}", edition.version);
            let mut world = World::of(edition);
            world.arrive(from);
            let forced = world.t;
            world.force(to);
            settle(&mut world, to);
            world.wait(300);

            let report = judge(&world.log, JudgeOptions::of(edition));
            let finding = only(&report);
            is_at(&finding, forced, 10);
            assert!(finding.message().starts_with(&arrow), "{name}: {}", finding.message());
            let last = report.transitions.last().expect("the transition is listed");
            assert_eq!((last.from, last.to, last.justified), (from, to, Truth::False));
            is_reported(&world, JudgeOptions::of(edition), Party::Vcu, &[(Rule::NoArrow, "Figure 2")], &name);
        }
    }
}

/// AS_READY for one step only, between AS_OFF and EMERGENCY_BRAKE.
#[test]
fn a_state_that_only_a_lost_frame_shows_is_an_arrow_between() {
    for &edition in Edition::ALL {
        let mut world = World::of(edition);
        world.prepare();
        world.inputs.asms = true;
        let ready = world.t;
        world.cycle();
        assert_eq!(world.control.state, AsState::Ready);
        world.inputs.sdc.remote_estop = true;
        world.wait(300);
        assert_eq!(world.control.state, AsState::EmergencyBrake);
        is_silent(&world, JudgeOptions::of(edition), &format!("{}: AS_READY for a step", edition.version));
        world.log.retain(|recorded| recorded.frame.id != Vcu2AiStatus::ID || recorded.t != ready);
        is_silent(
            &world,
            JudgeOptions::of(edition),
            &format!("{}: AS_READY in a frame that is lost", edition.version),
        );
        let report = judge(&world.log, JudgeOptions::of(edition));
        let [only] = &report.transitions[..] else { panic!("{:#?}", report.transitions) };
        assert_eq!(
            (only.from, only.to, only.justified),
            (AsState::Off, AsState::EmergencyBrake, Truth::Unknown)
        );
    }
}
