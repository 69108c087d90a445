//! A transition that does not come though a term of its guard holds.

use adsdv_oracle::judge::{Finding, JudgeOptions, Party, Rule, Severity};
use adsdv_spec::messages::Vcu2AiStatus;
use adsdv_spec::{AsState, Atom, Atoms, Edition, Truth};
use adsdv_tests::world::{MS, Recorded, World, judge, violations};

use crate::cases::{self, Case};
use crate::check::{Blame, blames, is_at, is_reported, is_reported_if_seen, is_silent, only};

/// What the AI Computer is blamed for where a term holds only through its fault.
fn blames_of_the_ai(case: Case) -> &'static [Blame] {
    let needs = |atom| case.term.on.has(atom);
    // In 3.0 the readings of what is forbidden at speed meet in section 3.7; in 4.0 they are one, of section 4.
    let at_speed =
        |in_3_0, in_4_0| if case.edition.version == Edition::V3_0.version { in_3_0 } else { in_4_0 };
    if needs(Atom::AiCommsLost) {
        &[(Rule::HandshakeLate, "2.4")]
    } else if needs(Atom::Moving) && (needs(Atom::MissionFinished) || needs(Atom::MissionFinishedEdge)) {
        at_speed(&[(Rule::FinishedMoving, "3.7")], &[(Rule::FinishedMoving, "4")])
    } else if needs(Atom::Moving) {
        at_speed(&[(Rule::NeutralMoving, "3.7")], &[(Rule::NeutralMoving, "4")])
    } else if case.term.off.has(Atom::BrakeRequestZero) {
        &[(Rule::BrakeAndTorque, "4")]
    } else {
        &[]
    }
}

/// The term begins to hold, and goes on to hold. Tells when the reference takes the transition.
fn term_holds(case: Case, mut world: World) -> (World, i64) {
    // What shows late, and what the other conditions are about, comes first.
    let first = |atom| case.shows_slowly(atom) || atom == Atom::Moving;
    for (atom, value) in case.wanted(None).filter(|&(atom, _)| first(atom)) {
        world.set(atom, value);
        world.wait(500);
    }
    case.set(&mut world, None);
    let mut taken = world.t;
    for _ in 0..70 {
        if world.control.state == case.row.from {
            taken = world.t;
        }
        world.cycle();
    }
    (world, taken)
}

#[test]
fn every_term_that_is_passed_over_is_reported() {
    for case in cases::all() {
        let (_, taken) = term_holds(case, case.world(None));
        let mut world = case.world(None);
        world.hold_state();
        let (world, _) = term_holds(case, world);

        let report = judge(&world.log, case.options());
        let finding = only(&report);
        let deadline = i64::from(case.options().deadline_ms) * MS;
        is_at(&finding, taken + deadline, 20);
        assert!(finding.message().contains(case.row.to.name()), "{}: {}", case.name(), finding.message());
        assert_eq!(blames(&report, Party::Ai), blames_of_the_ai(case), "{}", case.name());
        let expected = [(Rule::Due, case.row.section)];
        if case.term.on.has(Atom::GoEdge) {
            // It shows once only, and six messages must be complete around it.
            is_reported_if_seen(&world, case.options(), Party::Vcu, &expected, &case.name());
        } else {
            is_reported(&world, case.options(), Party::Vcu, &expected, &case.name());
        }
    }
}

//= SM-9 to SM-17, RDY-5, DTE-1 to DTE-5, FIN-4, RTE-1, RTO-1, FTO-1, FTE-1, ETO-2
#[test]
fn every_term_that_the_reference_follows_is_justified() {
    for case in cases::all() {
        let (world, _) = term_holds(case, case.world(None));
        assert_eq!(world.control.state, case.row.to, "{}", case.name());
        is_silent(&world, case.options(), &case.name());
        let report = judge(&world.log, case.options());
        let last = report.transitions.last().expect("the transition is listed");
        assert_eq!((last.from, last.to), (case.row.from, case.row.to), "{}", case.name());
        // The exact moment at which the 50 ms are over does not show.
        let certain = if case.term.on.has(Atom::AiCommsLost) { Truth::Unknown } else { Truth::True };
        assert_eq!(last.justified, certain, "{}: {:#?}", case.name(), violations(&report));
    }
}

/// What the judge says of a transition that is due in a recording that is late by up to so much, and has lost one in `loss` frames.
fn severities(case: Case, world: &World, jitter: i64, loss: u64, complete: bool) -> Vec<Option<Severity>> {
    let options = JudgeOptions { complete, ..case.options() };
    let said = |seed| {
        let report = judge(&world.disturbed(seed, jitter * MS, loss), options);
        let due = report.findings.iter().filter(|finding| finding.rule == Rule::Due);
        due.map(|finding| finding.severity).min()
    };
    (1..=3).map(said).collect()
}

#[test]
fn what_only_an_unseen_frame_could_excuse_is_a_warning_and_a_violation_where_none_is_missing() {
    for case in cases::all() {
        let mut world = case.world(None);
        world.hold_state();
        let (world, _) = term_holds(case, world);
        for jitter in [5, 20] {
            let complete = severities(case, &world, jitter, 0, true);
            assert_eq!(complete, [Some(Severity::Violation); 3], "{}: late by {jitter} ms", case.name());
        }
        // A change is there for one step, and which one that was a late recording does not tell.
        let changes = Atoms::of(&[Atom::GoEdge, Atom::MissionFinishedEdge, Atom::DirectionNeutralEdge]);
        if case.term.on.intersection(changes).is_empty() {
            for loss in [0, 10] {
                let excused = severities(case, &world, 20, loss, false);
                assert!(excused.iter().all(Option::is_some), "{}: {excused:?}, loss {loss}", case.name());
            }
        }
    }
}

/// What is said of a VCU that passes over `ESTOP_REQUEST` for so long, in a recording that is late by up to 20 ms.
fn late_by(edition: &'static Edition, ms: i64, seed: u64) -> Vec<Severity> {
    let mut world = World::of(edition);
    world.driving();
    let vcu = world.vcu;
    world.hold_state();
    world.set(Atom::AiEstop, true);
    world.wait(ms);
    assert_eq!(world.control.state, AsState::Driving, "{}: it passes over it", edition.version);
    world.vcu = vcu;
    world.wait(300);
    assert_eq!(world.control.state, AsState::EmergencyBrake, "{}: it has left", edition.version);
    let report = judge(&world.disturbed(seed, 20 * MS, 0), JudgeOptions::of(edition));
    let due = report.findings.iter().filter(|finding| finding.rule == Rule::Due);
    due.map(|finding| finding.severity).collect()
}

/// How late it is seen to be is a matter of chance.
#[test]
fn what_is_taken_too_late_by_all_that_was_recorded_is_mostly_said_though_the_state_is_left_by_then() {
    for edition in Edition::ALL {
        let said = (1..=40).filter(|&seed| {
            let in_time = late_by(edition, 50, seed);
            assert_eq!(in_time, [], "{}: seed {seed}, within the deadline", edition.version);
            late_by(edition, 110, seed) == [Severity::Warning]
        });
        let said = said.count();
        assert!(said > 35, "{}: {said} of 40", edition.version);
    }
}

#[test]
fn a_state_that_may_have_been_left_in_time_where_no_frame_of_the_vcu_was_recorded_is_not_said_to_be_left_late()
 {
    for edition in Edition::ALL {
        let mut world = World::of(edition);
        world.driving();
        world.set(Atom::AiEstop, true);
        let (since, until) = (world.t, world.t + 200 * MS);
        world.wait(500);
        let is_lost = |recorded: &Recorded| {
            recorded.frame.id == Vcu2AiStatus::ID && (since..until).contains(&recorded.t)
        };
        let log: Vec<Recorded> = world.log.iter().filter(|recorded| !is_lost(recorded)).copied().collect();
        let report = judge(&log, JudgeOptions::of(edition));
        assert!(
            report.transitions.iter().any(|seen| seen.to == AsState::EmergencyBrake),
            "{}",
            edition.version
        );
        let late: Vec<&Finding> =
            report.findings.iter().filter(|finding| finding.rule == Rule::Due).collect();
        assert!(late.is_empty(), "{}: {late:#?}", edition.version);
    }
}
