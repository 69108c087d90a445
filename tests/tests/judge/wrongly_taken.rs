//! A transition that is taken though one literal of the guard is false.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule};
use adsdv_spec::messages::{AsState, EbsState, Vcu2LogStatus};
use adsdv_spec::{Atom, Row, Truth};
use adsdv_tests::bus::def_of;
use adsdv_tests::world::{MS, World, judge};

use crate::cases::{self, Case, HISTORY};
use crate::check::{is_at, is_reported, is_silent, only};

/// The rows that no log can show to be wrongly taken: the shutdown circuit alone may be the reason, and a log does not
/// show that it was closed. What comes before them is another matter: see `priorities.rs`.
const NEVER_UNJUSTIFIED: [(AsState, AsState); 3] = [
    (AsState::Ready, AsState::EmergencyBrake),
    (AsState::Driving, AsState::EmergencyBrake),
    (AsState::Finished, AsState::EmergencyBrake),
];

fn can_be_unjustified(row: &Row) -> bool {
    !NEVER_UNJUSTIFIED.contains(&(row.from, row.to))
}

/// Every literal whose failure a log can show.
fn literals() -> impl Iterator<Item = (Case, Atom)> {
    cases::all()
        .filter(|case| can_be_unjustified(case.row))
        .flat_map(|case| case.term.literals().map(move |(atom, _)| (case, atom)))
}

/// The value that the literal has while it fails.
fn fails_as(case: Case, literal: Atom) -> bool {
    case.term.off.has(literal)
}

/// The vehicle with one literal false, for long enough that every message has shown it.
fn world_without(case: Case, literal: Atom) -> World {
    let mut world = case.world(Some(literal));
    // The literal first, lest all hold for a moment.
    world.set(literal, fails_as(case, literal));
    world.wait(500);
    case.set(&mut world, Some(literal));
    world.wait(500);
    assert_eq!(world.control.state, case.row.from, "{}, without {literal}", case.name());
    world
}

#[test]
fn every_literal_that_fails_is_reported() {
    let mut count = 0;
    for (case, literal) in literals() {
        let name = format!("{}, without {literal}", case.name());
        let mut world = world_without(case, literal);
        let forced = world.t;
        world.force(case.row.to);
        // Long enough for the window, short enough for nothing to become due in the new state.
        world.wait(if case.shows_slowly(literal) { 300 } else { 40 });
        if !HISTORY.has(literal) {
            world.set(literal, !fails_as(case, literal));
        }
        world.wait(300);

        let report = judge(&world.log, case.options());
        let finding = only(&report);
        is_at(&finding, forced, 10);
        let last = report.transitions.last().expect("the transition is listed");
        assert_eq!(
            (last.from, last.to, last.justified),
            (case.row.from, case.row.to, Truth::False),
            "{name}"
        );
        let text = case.edition.rules.text(literal, fails_as(case, literal)).to_string();
        assert!(finding.message().contains(&text), "{name}: {}", finding.message());
        is_reported(&world, case.options(), Party::Vcu, &[(Rule::Unjustified, case.row.section)], &name);
        count += 1;
    }
    assert!(count > 20, "the table has literals");
}

#[test]
fn the_reference_stays_while_a_literal_fails() {
    for (case, literal) in literals() {
        let mut world = world_without(case, literal);
        world.wait(340);
        assert_eq!(world.control.state, case.row.from);
        is_silent(&world, case.options(), &format!("{}, without {literal}", case.name()));
    }
}

#[test]
fn no_log_shows_that_the_shutdown_circuit_was_closed() {
    for case in cases::all() {
        let hidden = case.row.terms().iter().any(|term| term.on.has(Atom::SdcOpen));
        assert_eq!(hidden, !can_be_unjustified(case.row), "{}", case.name());
        if !hidden {
            continue;
        }
        let mut world = World::of(case.edition);
        world.arrive(case.row.from);
        world.force(case.row.to);
        world.wait(300);
        is_silent(&world, case.options(), &case.name());
        let report = judge(&world.log, case.options());
        assert_ne!(report.transitions.last().map(|last| last.justified), Some(Truth::False));
    }
}

/// To AS_READY with an EBS that is not ARMED but TRIGGERED.
//= RDY-4
#[test]
fn an_ebs_that_is_triggered_is_not_armed() {
    let mut world = World::reference();
    world.prepare();
    world.inputs.ebs = EbsState::Triggered;
    world.inputs.asms = true;
    world.wait(500);
    assert_eq!(world.control.state, AsState::Off);
    world.force(AsState::Ready);
    world.wait(500);
    is_reported(&world, JudgeOptions::default(), Party::Vcu, &[(Rule::Unjustified, "3.1")], "EBS TRIGGERED");
}

/// In EMERGENCY_BRAKE 502h shows TRIGGERED whatever the EBS itself reports: an EBS that became ARMED since the sample before may
/// have let the VCU go to AS_READY, and does not show.
//= D-28
#[test]
fn an_ebs_that_emergency_brake_hides_blames_nobody() {
    let mut world = World::reference();
    world.prepare();
    world.inputs.ebs = EbsState::Unavailable;
    world.inputs.asms = true;
    world.wait(500);
    // 502h has just shown it, and comes again in 100 ms.
    world.wait(100 - world.t / MS % 100 + 10);
    assert_eq!(world.control.state, AsState::Off);
    world.inputs.ebs = EbsState::Armed;
    world.wait(20);
    assert_eq!(world.control.state, AsState::Ready);
    world.inputs.sdc.remote_estop = true;
    world.wait(500);
    assert_eq!(world.control.state, AsState::EmergencyBrake);
    is_silent(&world, JudgeOptions::default(), "ARMED between two samples");
}

/// 502h comes every 100 ms: where two samples differ, the EBS may have changed at any time in between.
#[test]
fn an_ebs_that_changes_between_two_samples_is_not_known_there() {
    let mut world = World::reference();
    world.prepare();
    world.wait(100 - world.t / MS % 100 + 10);
    world.inputs.asms = true;
    world.wait(20);
    assert_eq!(world.control.state, AsState::Ready);
    let justified = |world: &World| {
        let transitions = judge(&world.log, JudgeOptions::default()).transitions;
        transitions.first().expect("AS_OFF -> AS_READY").justified
    };
    let mut armed = world.clone();
    armed.wait(500);
    assert_eq!(justified(&armed), Truth::True);
    world.inputs.ebs = EbsState::Unavailable;
    world.wait(500);
    assert_eq!(world.control.state, AsState::Ready);
    assert_eq!(justified(&world), Truth::Unknown);
}

/// An EBS that cannot be read says nothing of the arrow to AS_READY.
#[test]
fn an_ebs_that_cannot_be_read_is_not_known() {
    let mut world = World::reference();
    world.prepare();
    world.inputs.asms = true;
    world.wait(500);
    assert_eq!(world.control.state, AsState::Ready);
    world.falsify(def_of::<Vcu2LogStatus>(), "State_EBS", 0, 0);
    is_silent(&world, JudgeOptions::default(), "an EBS that cannot be read");
}

/// What cannot be read of 502h besides says nothing of the EBS.
#[test]
fn an_ebs_is_read_whatever_else_cannot_be() {
    let mut world = World::reference();
    world.prepare();
    world.inputs.ebs = EbsState::Unavailable;
    world.inputs.asms = true;
    world.wait(500);
    world.force(AsState::Ready);
    world.wait(500);
    world.falsify(def_of::<Vcu2LogStatus>(), "State_ASSI", 0, 0);
    let expected = [(Rule::Unjustified, "3.1")];
    is_reported(&world, JudgeOptions::default(), Party::Vcu, &expected, "EBS UNAVAILABLE, and no State_ASSI");
}

/// How often it comes shows only from the second sample on; where nothing is missing, the edition says when that is.
#[test]
fn an_ebs_of_which_one_sample_has_come_is_not_known_until_the_next() {
    let mut world = World::reference();
    world.prepare();
    world.inputs.ebs = EbsState::Unavailable;
    world.wait(100 - world.t / MS % 100 + 10);
    let since = world.t - 20 * MS;
    world.inputs.asms = true;
    world.wait(30);
    world.inputs.ebs = EbsState::Armed;
    world.wait(500);
    assert_eq!(world.control.state, AsState::Ready);
    world.log.retain(|recorded| recorded.t >= since);
    for complete in [false, true] {
        is_silent(&world, JudgeOptions { complete, ..JudgeOptions::default() }, "one sample");
    }
}
