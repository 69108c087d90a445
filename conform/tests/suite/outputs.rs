//! Whatever is shown wrong, a test fails that names a requirement about just that.

use adsdv_conform::protocol::{Domain, INPUTS, Protocol, SHOWN, Shown, ShownField};
use adsdv_conform::suite::{self, Kind, Test};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Choice, Edition, Inputs, Machine};

use crate::tests;

/// The requirements about an output.
fn requirements(key: &str) -> &'static [&'static str] {
    match key {
        "as_state" => &["MSG-48"],
        "handshake" => &["MSG-42"],
        "go_signal" => &["MSG-46"],
        "steering_status" => &["MSG-47", "D-37"],
        "shutdown_cause" => &["MSG-64"],
        "as_switch_status" => &["MSG-44"],
        "ts_switch_status" => &["MSG-45"],
        "ami_state" => &["MSG-49", "RDY-6"],
        "shutdown_request" => &["MSG-43", "D-38"],
        "op_state" => &["MSG-106", "D-71"],
        "ts_state" => &["MSG-107", "D-72"],
        "ebs_state" => &["MSG-108", "D-73"],
        "fault_status" => &["MSG-50", "D-40"],
        "warning_status" => &["MSG-51", "D-39"],
        "warn_batt_temp_high" => &["MSG-52"],
        "warn_batt_soc_low" => &["MSG-53"],
        "ai_estop_request" => &["MSG-54"],
        "hvil_open_fault" => &["MSG-55"],
        "hvil_short_fault" => &["MSG-56"],
        "ebs_fault" => &["MSG-57"],
        "offboard_charger_fault" => &["MSG-58"],
        "ai_comms_lost" => &["MSG-59"],
        "autonomous_braking_fault" => &["MSG-60", "D-27"],
        "mission_status_fault" => &["MSG-61", "D-27"],
        "charge_procedure_fault" => &["MSG-62"],
        "bms_fault" => &["MSG-63"],
        "brake_plausibility_fault" => &["MSG-84", "IMP-9"],
        "front_axle_trq"
        | "front_motor_speed_max"
        | "rear_axle_trq"
        | "rear_motor_speed_max"
        | "direction" => &["D-21"],
        "steer" => &["D-21", "MSG-25"],
        // An Emergency Braking System that brakes where requests count does not obey them.
        "hyd_press_f" | "hyd_press_r" | "ebs_triggered" => &["D-41", "D-42", "D-43"],
        _ => panic!("{key} has no requirement"),
    }
}

/// The request that an output of the actuators follows.
fn request(key: &str) -> Option<&'static str> {
    Some(match key {
        "front_axle_trq" => "front_axle_trq_request",
        "front_motor_speed_max" => "front_motor_speed_max",
        "rear_axle_trq" => "rear_axle_trq_request",
        "rear_motor_speed_max" => "rear_motor_speed_max",
        "direction" => "direction_request",
        "steer" => "steer_request",
        "hyd_press_f" => "hyd_press_f_req",
        "hyd_press_r" => "hyd_press_r_req",
        _ => return None,
    })
}

/// The output of the other axle.
fn other_axle(key: &str) -> Option<&'static str> {
    Some(match key {
        "front_axle_trq" => "rear_axle_trq",
        "front_motor_speed_max" => "rear_motor_speed_max",
        "rear_axle_trq" => "front_axle_trq",
        "rear_motor_speed_max" => "front_motor_speed_max",
        "hyd_press_f" => "hyd_press_r",
        "hyd_press_r" => "hyd_press_f",
        _ => return None,
    })
}

/// A way to show something wrong.
#[derive(Clone, Copy, Debug)]
enum Wrong {
    /// Always the same.
    Always(Option<i32>),
    /// Another value than it should be, in one state only.
    In(AsState),
    /// The request, in a state in which it does not count.
    PassedThrough(AsState),
    /// The value of the other axle.
    OtherAxle,
    /// The other way round: a turn to the right for one to the left.
    Negated,
    /// Without its sign.
    Unsigned,
}

impl Wrong {
    /// Every way in which an output can be wrong.
    fn all(field: &ShownField, domain: Domain) -> Vec<Self> {
        let mut values = match domain {
            Domain::Flag => vec![Some(0), Some(1)],
            Domain::Names(names) => names.iter().map(|&(raw, _)| Some(raw)).collect(),
            Domain::Number { min, max } => vec![Some(min), Some(0), Some(max)],
        };
        if field.nullable {
            values.push(None);
        }
        // The document has no condition for this one: it is never 1.
        values.retain(|value| field.key != "shutdown_request" || *value == Some(1));
        let mut all: Vec<Self> = values.into_iter().map(Self::Always).collect();
        all.extend(AsState::ALL.map(Self::In));
        if request(field.key).is_some() {
            let obeyed = |state: &AsState| {
                *state == AsState::Driving
                    || field.key.starts_with("hyd") && matches!(state, AsState::Ready | AsState::Finished)
            };
            all.extend(AsState::ALL.into_iter().filter(|state| !obeyed(state)).map(Self::PassedThrough));
        }
        if other_axle(field.key).is_some() {
            all.push(Self::OtherAxle);
        }
        if field.key == "steer" {
            all.extend([Self::Negated, Self::Unsigned]);
        }
        all
    }

    /// What is shown instead.
    fn shown(self, (field, domain): (&ShownField, Domain), right: &Shown, inputs: &Inputs) -> Option<i32> {
        let raw = |key: &str| right.get(key).expect("an output").raw;
        let is_in = |state: AsState| raw("as_state") == Some(state.raw());
        let value = raw(field.key);
        match self {
            Self::Always(value) => value,
            Self::In(state) if is_in(state) => Some(another(domain, value)),
            Self::PassedThrough(state) if is_in(state) => {
                let input = INPUTS.iter().find(|input| Some(input.key) == request(field.key));
                Some((input.expect("a request").get)(inputs))
            }
            Self::OtherAxle => other_axle(field.key).and_then(raw),
            Self::Negated => value.map(|value| -value),
            Self::Unsigned => value.map(i32::abs),
            Self::In(_) | Self::PassedThrough(_) => value,
        }
    }
}

/// A value beside this one.
fn another(domain: Domain, value: Option<i32>) -> i32 {
    match (domain, value) {
        (Domain::Number { max, .. }, Some(value)) if value == max => max - 1,
        (Domain::Number { .. }, value) => value.unwrap_or(-1) + 1,
        (Domain::Flag, value) => 1 - value.unwrap_or_default(),
        (Domain::Names(names), value) => {
            let next = names.iter().map(|&(raw, _)| raw).find(|&raw| Some(raw) > value);
            next.unwrap_or(names[0].0)
        }
    }
}

/// An edition under its default readings, and under each other answer.
fn machines(edition: &Edition) -> impl Iterator<Item = Machine> {
    let others: Vec<Choice> = edition.alternatives().iter().collect();
    let readings = others.into_iter().map(|choice| edition.readings.with(choice));
    std::iter::once(edition.readings).chain(readings).map(|readings| Machine::new(*edition, readings))
}

/// The VCU of an edition that shows a field in more than one way: under its default readings if these allow that, for there
/// may be a fault that they never raise.
fn vcu(edition: &Edition, tests: &[Test], field: &ShownField) -> Machine {
    let raises = |machine: &Machine| {
        let mut steps = tests.iter().flat_map(|test| test.scenario.shown(machine).collect::<Vec<_>>());
        steps.any(|shown| shown.get(field.key).is_some_and(|flag| flag.raw == Some(1)))
    };
    let found = machines(edition).find(|machine| field.fault.is_none() || raises(machine));
    found.unwrap_or_else(|| panic!("{} is never 1", field.key))
}

/// Whether a VCU that shows a field wrong fails a test.
fn fails(machine: &Machine, test: &Test, field: (&ShownField, Domain), wrong: Wrong) -> bool {
    let shown = test.scenario.shown(machine).zip(&test.scenario.steps);
    shown.into_iter().any(|(right, step)| {
        right.get(field.0.key).map(|value| value.raw) != Some(wrong.shown(field, &right, &step.inputs))
    })
}

/// The ways to be wrong that no test of some tests tells, though it names a requirement about the output.
fn not_found(edition: &Edition, tests: &[Test]) -> Vec<(&'static str, Wrong)> {
    let protocol = Protocol::of(edition);
    let mut not_found = Vec::new();
    for (field, domain) in protocol.shown() {
        let vcu = vcu(edition, tests, field);
        let about = requirements(field.key);
        let about = |test: &&Test| test.requirements.iter().any(|id| about.contains(&id.as_str()));
        let about: Vec<&Test> = tests.iter().filter(about).collect();
        let mut wrong = Wrong::all(field, domain);
        wrong.retain(|wrong| !about.iter().any(|test| fails(&vcu, test, (field, domain), *wrong)));
        not_found.extend(wrong.into_iter().map(|wrong| (field.key, wrong)));
    }
    not_found
}

#[test]
fn whatever_is_shown_wrong_fails_a_test_of_a_requirement_about_it() {
    for edition in Edition::ALL {
        let not_found = not_found(edition, &suite::generate(edition));
        assert!(not_found.is_empty(), "{}: {not_found:#?}", edition.version);
    }
}

/// The tests of what is shown are needed for that: without them much goes unnoticed.
#[test]
fn without_the_tests_of_outputs_wrong_outputs_are_not_found() {
    let less: Vec<Test> = tests().into_iter().filter(|test| test.kind != Kind::Output).collect();
    let not_found = not_found(Edition::DEFAULT, &less);
    for key in ["front_axle_trq", "steer", "hyd_press_r", "ami_state", "as_switch_status", "shutdown_request"]
    {
        assert!(not_found.iter().any(|(other, _)| *other == key), "{key}");
    }
}

/// Each state in which requests must not reach the actuators has a requirement of its own, and a test that names it.
#[test]
fn requests_that_reach_the_actuators_in_a_state_fail_the_requirement_of_that_state() {
    for (key, state, id) in [
        ("front_axle_trq", AsState::Ready, "DRV-2"),
        ("rear_motor_speed_max", AsState::Ready, "DRV-2"),
        ("direction", AsState::Ready, "DRV-2"),
        ("steer", AsState::Ready, "DRV-3"),
        ("rear_axle_trq", AsState::Finished, "FIN-5"),
        ("steer", AsState::Finished, "FIN-6"),
        ("hyd_press_f", AsState::Off, "D-42"),
        ("hyd_press_r", AsState::EmergencyBrake, "D-43"),
    ] {
        let field = SHOWN.iter().find(|field| field.key == key).expect(key).to_owned();
        let wrong = Wrong::PassedThrough(state);
        for edition in Edition::ALL {
            let tests = suite::generate(edition).into_iter();
            let vcu = Machine::new(**edition, edition.readings);
            let failed = tests.filter(|test| fails(&vcu, test, (&field, field.domain), wrong));
            let named: Vec<String> = failed.flat_map(|test| test.requirements).collect();
            assert!(named.iter().any(|named| named == id), "{key} in {state}: {named:?}");
        }
    }
}
