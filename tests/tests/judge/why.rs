//! Why the VCU stays: what the report says blocks an arrow is what is missing, and nothing else.

use adsdv_oracle::judge::{JudgeOptions, Report};
use adsdv_oracle::why::{Blocked, Stay, Untaken, next_of_mission};
use adsdv_spec::messages::{AmiState, AxleTorqueRequest, EbsState, MissionStatus, SteerAngle};
use adsdv_spec::{AsState, Atom, Atoms, Edition, Machine};
use adsdv_tests::world::{MS, World, judge};

fn failed(blocked: &Blocked) -> Atoms {
    blocked.failed.iter().fold(Atoms::NONE, |all, condition| all.with(condition.atom))
}

/// The state that the recording ends in, and what blocks the way on at the end.
fn last(report: &Report) -> (&Stay, &Untaken, &Blocked) {
    let stay = report.stays.last().expect("a state was seen");
    let on = stay.arrows.iter().find(|arrow| arrow.to == next_of_mission(stay.state)).expect("an arrow");
    (stay, on, on.blocked.last().expect("something blocks"))
}

/// The recording as it is, and as a recorder makes it late by up to 5 ms.
fn reports(world: &World) -> [Report; 2] {
    let options =
        JudgeOptions::of(Edition::ALL.iter().find(|e| **e == world.vcu.edition()).expect("an edition"));
    [world.judge(options), judge(&world.disturbed(3, 5 * MS, 0), options)]
}

/// A switch, and how it is left out.
type LeftOut = (Atom, fn(&mut World));

#[test]
fn what_is_missing_for_as_ready_is_what_blocks_it() {
    let left_out: [LeftOut; 5] = [
        (Atom::Asms, |world| world.inputs.asms = false),
        (Atom::Tsms, |world| world.inputs.tsms = false),
        (Atom::AmiSelected, |world| world.inputs.ami = AmiState::NotSelected),
        (Atom::MissionSelected, |world| world.ai.status.mission_status = MissionStatus::NotSelected),
        (Atom::EbsArmed, |world| world.inputs.ebs = EbsState::Unavailable),
    ];
    for edition in Edition::ALL {
        for (atom, leave_out) in left_out {
            let mut world = World::of(edition);
            world.prepare();
            leave_out(&mut world);
            world.wait(100);
            world.inputs.asms = atom != Atom::Asms;
            world.wait(1000);
            for report in reports(&world) {
                let (stay, on, blocked) = last(&report);
                assert_eq!((stay.state, on.to), (AsState::Off, AsState::Ready));
                assert_eq!(failed(blocked), Atoms::NONE.with(atom), "{}: {atom}", edition.version);
                assert!(blocked.unknown.is_empty(), "{}: {:?}", edition.version, blocked.unknown);
                assert_eq!(blocked.until_ns, report.duration_ns);
                let only = &blocked.failed[0];
                assert_eq!((only.needed, only.values.len()), (true, 1), "{only:?}");
            }
        }
    }
}

#[test]
fn what_is_missing_for_as_driving_is_what_blocks_it() {
    let left_out: [LeftOut; 3] = [
        (Atom::FrontTorqueZero, |world| {
            world.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(10);
        }),
        (Atom::SteerRequestZero, |world| world.ai.steer.steer_request = SteerAngle::clamped(10)),
        (Atom::SteerStraight, |world| world.inputs.vehicle.steer_angle = SteerAngle::clamped(90)),
    ];
    for edition in Edition::ALL {
        for (atom, leave_out) in left_out.into_iter().filter(|(atom, _)| edition.scope().has(*atom)) {
            let mut world = World::of(edition);
            world.dwelt();
            leave_out(&mut world);
            world.wait(1000);
            for report in reports(&world) {
                let (stay, on, blocked) = last(&report);
                assert_eq!((stay.state, on.to), (AsState::Ready, AsState::Driving));
                let failed = failed(blocked).without(Atom::GoEdge);
                assert_eq!(failed, Atoms::NONE.with(atom), "{}", edition.version);
                // Before that, only the dwell and "Go" were missing.
                assert!(on.blocked.iter().any(|time| self::failed(time).has(Atom::DwellElapsed)));
            }
        }
    }
}

#[test]
fn go_that_comes_too_early_is_reported_with_what_failed() {
    let mut world = World::of(&Edition::V2026);
    world.ready();
    world.wait(1000);
    world.inputs.go = true;
    world.wait(1000);
    for report in reports(&world) {
        let [press] = report.go_presses.as_slice() else { panic!("{:?}", report.go_presses) };
        assert_eq!((press.off, press.on), (Atoms::of(&[Atom::DwellElapsed]), Atoms::NONE));
        let ready = report.stays.last().map(|stay| stay.since_ns);
        assert_eq!(Some(press.t_ns - press.ready_for_ns), ready);
    }
}

#[test]
fn go_that_starts_the_mission_is_not_reported_and_go_that_nothing_prevents_is() {
    let mut world = World::of(&Edition::V2026);
    world.driving();
    for report in reports(&world) {
        assert_eq!(report.go_presses, []);
    }
    // A VCU that never drives.
    let mut deaf = World::of(&Edition::V2026);
    deaf.dwelt();
    let dwell = Edition::V2026.rules.timing;
    let never = Edition::V2026.with_timing(adsdv_spec::Timing { ready_dwell_ms: u16::MAX, ..dwell });
    deaf.vcu = Machine::new(never, Edition::V2026.readings);
    deaf.control.in_state_ms = 0;
    deaf.inputs.go = true;
    deaf.wait(1000);
    let report = deaf.judge(JudgeOptions::of(&Edition::V2026));
    let [press] = report.go_presses.as_slice() else { panic!("{:?}", report.go_presses) };
    assert!(!press.is_in_vain(), "{press:?}");
}

#[test]
fn stays_follow_one_another_as_the_transitions_do() {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.finished();
        world.inputs.asms = false;
        world.wait(500);
        for report in reports(&world) {
            let states: Vec<_> = report.stays.iter().map(|stay| (stay.state, stay.left_to)).collect();
            let changes: Vec<_> =
                report.transitions.iter().map(|change| (change.from, Some(change.to))).collect();
            assert_eq!(states[..states.len() - 1], changes, "{}", edition.version);
            assert_eq!(states.last().map(|last| last.1), Some(None));
            for pair in report.stays.windows(2) {
                assert_eq!(pair[0].until_ns, pair[1].since_ns);
            }
            for stay in &report.stays {
                assert!(stay.since_ns <= stay.until_ns);
                for time in stay.arrows.iter().flat_map(|arrow| &arrow.blocked) {
                    assert!(stay.since_ns <= time.since_ns && time.until_ns <= stay.until_ns, "{time:?}");
                    assert!(!time.failed.is_empty() || !time.unknown.is_empty(), "{time:?}");
                }
            }
        }
    }
}

#[test]
fn a_condition_that_comes_and_goes_does_not_fill_the_report() {
    let mut world = World::reference();
    world.prepare();
    for _ in 0..100 {
        world.inputs.tsms = !world.inputs.tsms;
        world.wait(100);
    }
    let report = world.judge(JudgeOptions::default());
    let (_, on, _) = last(&report);
    assert_eq!(on.blocked.len(), 32);
    assert!(on.more > 50, "{}", on.more);
    assert_eq!(on.blocked.last().map(|time| time.until_ns), Some(report.duration_ns));
}
