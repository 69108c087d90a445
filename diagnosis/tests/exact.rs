//! What a diagnosis names: exactly what a program does otherwise, and nothing else.

use std::collections::HashSet;

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{Answer, SHOWN};
use adsdv_diagnosis::{Deviation, Diagnosis, Model, Remembers, Running, Subject, Wheels, diagnose};
use adsdv_spec::messages::AsState::{self, Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::mutation::{Change, TermChange, Threshold, Time};
use adsdv_spec::{Atom, Choice, Edition, Inputs};

fn found(edition: &Edition, deviations: &[Deviation]) -> Diagnosis {
    let mut program = Model::new(edition, deviations).running();
    diagnose(&mut program, edition).expect("a model answers everything")
}

/// The program does these things otherwise: just these are named, in whatever order. Tells how many experiments that took.
fn names(edition: &Edition, deviations: &[Deviation]) -> usize {
    let found = found(edition, deviations);
    let ids = |these: &[Deviation]| these.iter().map(|one| one.id(edition)).collect::<HashSet<String>>();
    let answers: Vec<Deviation> = found.readings.iter().map(|choice| Deviation::Reads(*choice)).collect();
    assert_eq!(ids(&[found.deviations, answers].concat()), ids(deviations), "{}", edition.version);
    assert!(found.unexplained.is_empty());
    found.experiments
}

#[test]
fn a_program_that_conforms_has_no_deviation() {
    for edition in Edition::ALL {
        let found = found(edition, &[]);
        assert!(found.deviations.is_empty() && found.unexplained.is_empty(), "{found:?}");
        assert!(found.experiments > 1000);
    }
}

#[test]
fn one_deviation_does_not_hide_the_others() {
    let needs = Deviation::Needs { from: Off, to: Ready, key: "ami", raw: 3, is: true };
    let late = Deviation::Late { from: Driving, to: Finished, steps: 2 };
    let comms = Deviation::Changed(Change::Time(Time::Handshake, 450));
    names(&Edition::V4_0, &[needs, late, comms]);
}

#[test]
fn what_a_program_needs_besides_is_distinguished_from_an_arrow_that_it_lacks() {
    let row = |from, to| row(&Edition::V3_0, from, to);
    let dropped = Deviation::Changed(Change::RowDropped(row(EmergencyBrake, Off)));
    let needs = Deviation::Needs { from: EmergencyBrake, to: Off, key: "mission_status", raw: 0, is: true };
    names(&Edition::V3_0, &[dropped]);
    names(&Edition::V3_0, &[needs]);
    let without = Change::Term(row(Ready, Driving), 0, TermChange::LiteralDropped(Atom::SteerStraight));
    names(&Edition::V3_0, &[Deviation::Changed(without), Deviation::Wheels(Wheels::All)]);
}

#[test]
fn times_and_thresholds_are_measured() {
    let dwell = Deviation::Changed(Change::Time(Time::ReadyDwell, -1234));
    let missed = Deviation::Changed(Change::Threshold(Threshold::Missed, 57));
    let speed = Deviation::Changed(Change::Threshold(Threshold::WheelSpeed, 9));
    names(&Edition::V2026, &[dwell, missed, speed]);
}

#[test]
fn a_time_that_is_shorter_by_less_than_a_cycle_is_found() {
    for by in [-1, -3, -9] {
        names(&Edition::V4_0, &[Deviation::Changed(Change::Time(Time::ReadyDwell, by))]);
    }
    names(&Edition::V3_0, &[Deviation::Changed(Change::Time(Time::EbsTimer, -1))]);
}

#[test]
fn a_time_that_is_over_at_once_and_a_vehicle_that_always_moves_are_found() {
    for edition in Edition::ALL {
        let (timing, thresholds) = (&edition.rules.timing, &edition.rules.thresholds);
        let less = |usual: u16| -i16::try_from(usual).expect("a few seconds");
        let speed = i16::try_from(thresholds.wheel_speed.raw()).expect("a few rpm");
        names(edition, &[Deviation::Changed(Change::Time(Time::ReadyDwell, less(timing.ready_dwell_ms)))]);
        names(edition, &[Deviation::Changed(Change::Time(Time::Handshake, less(timing.handshake_ms)))]);
        names(edition, &[Deviation::Changed(Change::Threshold(Threshold::WheelSpeed, -speed))]);
    }
}

/// Where "Go" need not be seen off, the cycle in which it is switched on counts as well.
#[test]
fn the_time_in_as_ready_is_exact_whatever_is_remembered_of_go_meanwhile() {
    let seen_off = Deviation::Remembers(Remembers::GoSeenOff);
    for go in [Deviation::GoLevel, Deviation::Reads(Choice::GoEdgeEnough), seen_off] {
        for by in [2549, 7, -3] {
            let dwell = Deviation::Changed(Change::Time(Time::ReadyDwell, by));
            names(&Edition::V2026, &[go, dwell]);
        }
    }
}

/// The row of an arrow, by its place.
fn row(edition: &Edition, from: AsState, to: AsState) -> usize {
    let rows = edition.rules.table.rows();
    rows.iter().position(|row| (row.from, row.to) == (from, to)).expect("there is such an arrow")
}

#[test]
fn an_arrow_that_needs_something_and_another_time_is_not_taken_for_one_that_is_missing() {
    let needs = |key, raw| Deviation::Needs { from: Ready, to: Driving, key, raw, is: true };
    let dwell = Deviation::Changed(Change::Time(Time::ReadyDwell, 2345));
    names(&Edition::V3_0, &[needs("mission_status", 2), dwell]);
}

#[test]
fn an_arrow_that_is_open_only_before_its_timer_and_needs_two_things_is_found() {
    let edition = &Edition::V3_0;
    let needs = |key, raw| Deviation::Needs { from: EmergencyBrake, to: Off, key, raw, is: true };
    let timer = TermChange::LiteralFlipped(Atom::EbsTimerComplete);
    let before = Deviation::Changed(Change::Term(row(edition, EmergencyBrake, Off), 0, timer));
    names(edition, &[before, needs("vehicle_estop", 0), needs("ami", 0)]);
}

#[test]
fn a_timer_that_runs_otherwise_is_found_behind_an_arrow_that_is_late() {
    let late = Deviation::Late { from: EmergencyBrake, to: Off, steps: 3 };
    let timer = Deviation::Remembers(Remembers::TimerWhileAsmsOff);
    let needs = Deviation::Needs { from: EmergencyBrake, to: Off, key: "mission_status", raw: 2, is: false };
    names(&Edition::V4_0, &[late, timer, needs]);
}

#[test]
fn alternatives_that_have_to_hold_at_once_are_distinguished() {
    let edition = &Edition::V3_0;
    let row = row(edition, Ready, EmergencyBrake);
    let joined = |one, other| Deviation::Joined { row, one, other };
    names(edition, &[joined(0, 1), joined(1, 2)]);
}

#[test]
fn a_state_that_lasts_for_one_step_shows_what_is_wrong_there() {
    let edition = &Edition::V3_0;
    let without =
        Change::Term(row(edition, Driving, EmergencyBrake), 1, TermChange::LiteralDropped(Atom::GoOn));
    // That it comes first is an answer to an open question.
    let first = Deviation::Reads(Choice::DrivingFinishedFirst);
    let speed = Change::Threshold(Threshold::WheelSpeed, -4);
    names(edition, &[Deviation::Changed(without), first, Deviation::Changed(speed)]);
}

#[test]
fn what_is_remembered_and_what_is_shown_are_distinguished() {
    let written = Deviation::Writes { key: "shutdown_cause", value: 2, raw: 7 };
    let outside = Deviation::Writes { key: "as_state", value: 5, raw: 6 };
    let shown = Deviation::Shows { state: Driving, key: "handshake", raw: 0 };
    let dwell = Deviation::Remembers(Remembers::DwellOfAllVisits);
    names(&Edition::V3_0, &[written, outside, dwell]);
    names(&Edition::V2026, &[shown, Deviation::Remembers(Remembers::LatestCause)]);
}

#[test]
fn a_cause_is_named_by_the_state_in_which_the_emergency_begins() {
    let causes = Deviation::Causes { from: Driving, value: 2, raw: 4 };
    let writes = Deviation::Writes { key: "shutdown_cause", value: 2, raw: 4 };
    names(&Edition::V3_0, &[causes]);
    names(&Edition::V3_0, &[writes]);
    let other = Deviation::Causes { from: Ready, value: 6, raw: 3 };
    names(&Edition::V4_0, &[causes, other]);
}

#[test]
fn which_of_two_causes_counts_is_named_by_both_also_where_the_one_is_given_another_number() {
    let prefers = |from, value, raw| Deviation::Prefers { from, value, raw };
    let causes = Deviation::Causes { from: Driving, value: 2, raw: 4 };
    names(&Edition::V3_0, &[prefers(Ready, 1, 6), prefers(Driving, 1, 2), causes]);
    names(&Edition::V2026, &[prefers(Driving, 2, 6), prefers(Driving, 1, 6)]);
}

#[test]
fn flags_that_end_with_their_faults_and_a_handshake_that_counts_from_before_are_found() {
    for edition in Edition::ALL {
        names(edition, &[Remembers::LiveFlags, Remembers::TimeBeforeHandshake].map(Deviation::Remembers));
    }
}

#[test]
fn a_handshake_that_does_not_rest_is_found_beside_what_it_is_remembered_for() {
    let kept = Deviation::Remembers(Remembers::Handshake);
    let limit = Deviation::Changed(Change::Time(Time::Handshake, 50));
    for edition in Edition::ALL {
        names(edition, &[kept]);
        names(edition, &[kept, limit]);
    }
}

#[test]
fn what_remains_of_a_handshake_while_it_rests_and_how_it_begins_are_told_apart() {
    let what = [Remembers::HandshakeBit, Remembers::HandshakeBeginsWithOne, Remembers::CommsLostForGood];
    for one in what {
        names(&Edition::V3_0, &[Deviation::Remembers(one)]);
    }
    names(&Edition::V2026, &what.map(Deviation::Remembers));
}

/// What is like it explains nearly all, and the rest only a third of all experiments more.
#[test]
fn communication_lost_for_good_is_told_from_what_is_like_it_by_few_experiments() {
    let edition = &Edition::V2026;
    let leads = Deviation::Changed(Change::RowLeadsTo(row(edition, EmergencyBrake, Off), Ready));
    let deviations = [Deviation::Remembers(Remembers::CommsLostForGood), leads];
    assert!(names(edition, &deviations) < 10_000);
}

#[test]
fn an_input_that_opens_the_shutdown_circuit_is_named_once_and_not_by_each_arrow() {
    for (edition, key, raw) in
        [(&Edition::V3_0, "tsms", 0), (&Edition::V4_0, "asms", 0), (&Edition::V2026, "batt_soc_low", 1)]
    {
        names(edition, &[Deviation::Opens { key, raw }]);
    }
}

/// The cause that such a program remembers is seen by its flags alone.
#[test]
fn a_cause_that_is_shown_wrongly_hides_no_arrow_that_lacks_a_condition() {
    for edition in [&Edition::V4_0, &Edition::V2026] {
        for wrong in ["brake:shows:shutdown_cause=2", "writes:shutdown_cause:5=3"] {
            let ids = ["driving-brake:5:without:direction-neutral", wrong];
            names(edition, &ids.map(|id| Deviation::find(edition, id).expect("there is such a deviation")));
        }
    }
}

#[test]
fn the_wheels_that_count_are_named_whichever_they_are() {
    for wheels in Wheels::EACH {
        names(&Edition::V3_0, &[Deviation::Wheels(wheels)]);
    }
}

/// A program that shows a cause of its own, which changes with what it sees: no deviation is that.
struct OwnCauses(Running);

impl Subject for OwnCauses {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.0.reset()
    }
    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        let shown = self.0.shown(dt_ms, inputs);
        let place = SHOWN.iter().position(|field| field.key == "shutdown_cause").expect("an output");
        let raw = shown.raw_at(place).unwrap_or_default();
        let own = if raw == 0 { 0 } else { 1 + i32::from(inputs.go) + 2 * i32::from(inputs.tsms) };
        Ok(shown.with(place, own).into())
    }
}

#[test]
fn an_output_that_nothing_explains_does_not_hide_the_deviations() {
    let edition = &Edition::V3_0;
    let needs = Deviation::Needs { from: Off, to: Ready, key: "ami", raw: 3, is: true };
    let kept = Deviation::Remembers(Remembers::Handshake);
    let limit = Deviation::Changed(Change::Time(Time::Handshake, 50));
    let finishes = Deviation::Changed(Change::RowDropped(row(edition, Finished, Off)));
    let deviations = [needs, kept, limit, finishes];
    let mut program = OwnCauses(Model::new(edition, &deviations).running());
    let found = diagnose(&mut program, edition).expect("a model answers everything");
    let ids = |these: &[Deviation]| these.iter().map(|one| one.id(edition)).collect::<HashSet<String>>();
    assert_eq!(ids(&found.deviations), ids(&deviations));
    assert_eq!((found.left_out, found.unexplained.len()), (vec!["shutdown_cause"], 0));
}

#[test]
fn eight_deviations_are_named_one_by_one() {
    let edition = &Edition::V4_0;
    let eight = [
        Deviation::Changed(Change::Threshold(Threshold::WheelSpeed, 20)),
        Deviation::Changed(Change::Term(row(edition, Off, Ready), 0, TermChange::LiteralFlipped(Atom::Tsms))),
        Deviation::Shows { state: Driving, key: "autonomous_braking_fault", raw: 1 },
        Deviation::GoNeedsHandshake,
        Deviation::Writes { key: "shutdown_cause", value: 3, raw: 11 },
        Deviation::Joined { row: row(edition, Driving, EmergencyBrake), one: 0, other: 2 },
        Deviation::Writes { key: "bms_fault", value: 1, raw: 0 },
        Deviation::Also { from: Off, to: Finished, key: "batt_temp_high", raw: 1 },
    ];
    names(edition, &eight);
}

/// A program that answers 100 000 steps a second has its verdict within five seconds: it conforms.
#[test]
fn a_program_that_conforms_is_asked_for_less_than_400_000_steps() {
    struct Counted {
        program: Running,
        steps: u32,
    }
    impl Subject for Counted {
        fn reset(&mut self) -> Result<(), ProgramError> {
            self.program.reset()
        }
        fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
            self.steps += 1;
            self.program.step(dt_ms, inputs)
        }
    }
    for edition in Edition::ALL {
        let mut program = Counted { program: Model::new(edition, &[]).running(), steps: 0 };
        let found = diagnose(&mut program, edition).expect("a model answers everything");
        assert!(found.deviations.is_empty());
        assert!((20_000..400_000).contains(&program.steps), "{}", program.steps);
    }
}

#[test]
fn each_deviation_has_a_name_of_its_own_words_and_requirements_that_there_are() {
    const REQUIREMENTS: &str = include_str!("../../spec/REQUIREMENTS.md");
    for edition in Edition::ALL {
        let every = Deviation::every(edition);
        let mut ids = HashSet::new();
        for one in &every {
            let (id, text) = (one.id(edition), one.text(edition).to_string());
            assert!(ids.insert(id.clone()), "{id} is the name of two");
            assert!(!id.contains(' ') && text.len() > 15 && !text.contains("  "), "{id}: {text}");
            for requirement in one.requirements(edition) {
                assert!(REQUIREMENTS.contains(&format!("**{requirement}**")), "{id}: {requirement}");
            }
        }
        assert!(every.len() > 1000);
    }
    let text = |one: Deviation| one.text(&Edition::V3_0).to_string();
    assert_eq!(
        text(Deviation::Changed(Change::Time(Time::Handshake, 450))),
        "AI_COMMS_LOST after 500 ms; expected 50 ms"
    );
    assert_eq!(
        text(Deviation::Needs { from: Ready, to: Driving, key: "mission_status", raw: 2, is: true }),
        "AS_READY -> AS_DRIVING also needs mission_status == RUNNING"
    );
    assert_eq!(text(Deviation::Late { from: Off, to: Ready, steps: 1 }), "AS_OFF -> AS_READY one step late");
}

#[test]
fn an_arrow_that_wants_two_conditions_the_other_way_round_is_not_taken_for_one_that_is_missing() {
    let edition = &Edition::V4_0;
    let opposite = |atom| {
        let change = Change::Term(row(edition, Ready, Driving), 0, TermChange::LiteralFlipped(atom));
        Deviation::Changed(change)
    };
    names(edition, &[opposite(Atom::DwellElapsed), opposite(Atom::SteerStraight)]);
}

#[test]
fn a_time_is_named_where_an_arrow_also_comes_first_and_a_state_is_left_where_it_should_stay() {
    let edition = &Edition::V4_0;
    let dropped = Deviation::Changed(Change::RowDropped(row(edition, Finished, Off)));
    let first = Deviation::Changed(Change::RowFirst(row(edition, Ready, Driving)));
    let dwell = Deviation::Changed(Change::Time(Time::ReadyDwell, 2402));
    let also = Deviation::Also { from: EmergencyBrake, to: Driving, key: "estop_request", raw: 1 };
    // That the AMI is not looked at is an answer to an open question.
    let selected = Deviation::Reads(Choice::MissionStatusOnly);
    let speed = Deviation::Shows { state: Ready, key: "front_motor_speed_max", raw: 7 };
    let warning = Deviation::Shows { state: Finished, key: "warning_status", raw: 0 };
    names(edition, &[speed, selected, dropped, first, warning, dwell, also]);
}

#[test]
fn a_program_that_drives_only_before_the_time_is_over_is_followed_into_as_driving() {
    let edition = &Edition::V2026;
    let timer = TermChange::LiteralFlipped(Atom::DwellElapsed);
    let before = Deviation::Changed(Change::Term(row(edition, Ready, Driving), 0, timer));
    let late = Deviation::Late { from: Ready, to: Off, steps: 3 };
    let leads = Deviation::Changed(Change::RowLeadsTo(row(edition, EmergencyBrake, Off), Ready));
    let joined = Deviation::Joined { row: row(edition, Driving, EmergencyBrake), one: 2, other: 7 };
    names(edition, &[before, late, leads, joined]);
}

#[test]
fn an_input_that_is_forgotten_is_named_once_and_not_by_each_arrow() {
    let ignores = |key| Deviation::Ignores { key };
    names(&Edition::V3_0, &[ignores("charging")]);
    names(&Edition::V4_0, &[ignores("offboard_charger_fault"), ignores("asms")]);
}
