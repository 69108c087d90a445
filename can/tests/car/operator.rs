//! The operator: what is missing for the next arrow, and what each switch does.

use super::*;

fn words(missing: &Missing) -> Vec<String> {
    missing.conditions.iter().map(ToString::to_string).collect()
}

/// What the operator can do about what is missing.
fn actions(missing: &Missing) -> Vec<Option<String>> {
    let conditions = missing.conditions.iter().chain(&missing.then);
    conditions.map(|condition| condition.action.map(|action| action.to_string())).collect()
}

#[test]
fn missing_lists_the_way_out_of_an_emergency_up_to_the_power_cycle() {
    let (mut car, drives) = driving();
    act(&mut car, &["remote_estop on"]);
    cycles(&mut car, 100, drives);
    let out = missing(&car).expect("EMERGENCY_BRAKE leads to AS_OFF");
    assert_eq!(
        out.to_string(),
        "AS_OFF (section 3.9) still needs: EBS timer complete (in 14.1 s), AS master switch OFF; then a power cycle"
    );
    assert_eq!(actions(&out), [None, Some("asms off".to_owned()), Some("power cycle".to_owned())]);
    // To wait for AS_OFF is not to wait for the power cycle.
    let off = missing_for(&car, AsState::Off).expect("the same arrow");
    assert_eq!((off.conditions, off.then), (out.conditions, None));
    cycles(&mut car, 1500, drives);
    assert_eq!(words(&missing(&car).expect("the arrow")), ["AS master switch OFF"]);
    act(&mut car, &["asms off", "remote_estop off"]);
    cycles(&mut car, 1, drives);
    act(&mut car, &["asms on"]);
    let selected = status(MissionStatus::Selected, DirectionRequest::Neutral);
    cycles(&mut car, 1, selected);
    let left = missing(&car).expect("AS_OFF leads to AS_READY");
    assert_eq!((state(&car), words(&left)), (Some(AsState::Off), vec!["a power cycle".to_owned()]));
    assert_eq!((actions(&left), left.then), (vec![Some("power cycle".to_owned())], None));
}

/// Without the latch there is no power cycle to tell of.
#[test]
fn the_way_out_is_that_of_the_reading() {
    let readings = Readings::DEFAULT.with(Choice::PowerCycleNotLatched);
    let mut car = Car::new(Machine::new(*Edition::DEFAULT, readings));
    for action in ["ami SKIDPAD", "ebs ARMED", "tsms on", "asms on"] {
        act(&mut car, &[action]);
    }
    let selected = status(MissionStatus::Selected, DirectionRequest::Neutral);
    cycles(&mut car, 10, selected);
    act(&mut car, &["crash_sensor on"]);
    cycles(&mut car, 10, selected);
    let out = missing(&car).expect("EMERGENCY_BRAKE leads to AS_OFF");
    assert_eq!((state(&car), out.then), (Some(AsState::EmergencyBrake), None));
}

#[test]
fn missing_lists_what_any_state_still_needs() {
    let (mut car, drives) = driving();
    let finished = missing_for(&car, AsState::Finished).expect("AS_DRIVING leads to AS_FINISHED");
    assert_eq!((finished.to, finished.section), (AsState::Finished, "3.3"));
    assert!(words(&finished).contains(&"MISSION_STATUS == FINISHED".to_owned()), "{finished}");
    // The way to AS_OFF is not that through an emergency.
    assert_eq!(missing_for(&car, AsState::Off), Some(finished));
    let emergency = missing_for(&car, AsState::EmergencyBrake).expect("there is an arrow");
    assert_eq!(emergency.to, AsState::EmergencyBrake);
    assert_eq!(missing_for(&car, AsState::Driving), None);
    while car.vehicle().speed_mps() > 0.0 {
        let pressure = BrakePressure::MAX;
        let brake = Ai2VcuBrake { hyd_press_f_req: pressure, hyd_press_r_req: pressure };
        let none = [encoded(Ai2VcuDriveF::default()), encoded(Ai2VcuDriveR::default()), encoded(brake)];
        for frame in none {
            assert_eq!(car.receive(&frame), Ok(true));
        }
        cycles(&mut car, 1, drives);
    }
    cycles(&mut car, 3, status(MissionStatus::Finished, DirectionRequest::Neutral));
    let off = missing(&car).expect("AS_FINISHED leads to AS_OFF");
    assert_eq!(state(&car), Some(AsState::Finished));
    assert_eq!(off.to_string(), "AS_OFF (section 3.4) still needs: AS master switch OFF");
    assert_eq!(actions(&off), [Some("asms off".to_owned())]);
}

/// A condition that the operator has a switch for holds once the switch is set.
#[test]
fn what_the_operator_can_do_does_it() {
    let mut car = Car::new(Machine::REFERENCE);
    let selected = status(MissionStatus::Selected, DirectionRequest::Neutral);
    let (mut done, mut seen) = (Vec::new(), Vec::new());
    for _ in 0..60 {
        cycles(&mut car, 10, selected);
        seen.push(state(&car));
        let next =
            missing(&car).and_then(|missing| missing.conditions.into_iter().find_map(|left| left.action));
        if let Some(action) = next.filter(|action| !done.contains(action)) {
            car.act(&action);
            done.push(action);
        }
    }
    let done: Vec<String> = done.iter().map(ToString::to_string).collect();
    assert_eq!(done, ["asms on", "tsms on", "ami ACCELERATION", "ebs ARMED", "go on"]);
    // "Go" came before the five seconds were over, and is asked for again.
    assert_eq!(seen.last(), Some(&Some(AsState::Ready)));
    let left = missing(&car).expect("AS_READY leads to AS_DRIVING");
    assert_eq!(words(&left), ["\"Go\" signal OFF -> ON"]);
    assert_eq!(actions(&left), [Some("go on".to_owned())]);
}

#[test]
fn every_switch_has_a_few_words() {
    let mut texts: Vec<&str> = Switch::all().map(Switch::about).chain([Action::ABOUT_POWER_CYCLE]).collect();
    assert!(texts.iter().all(|about| !about.is_empty() && !about.contains('|')), "{texts:?}");
    texts.sort_unstable();
    texts.dedup();
    assert_eq!(texts.len(), Switch::all().count() + 1);
}

#[test]
fn what_is_missing_is_what_keeps_the_car_from_the_next_arrow() {
    let mut car = Car::new(Machine::REFERENCE);
    let waits = status(MissionStatus::Selected, DirectionRequest::Neutral);
    let left = |car: &Car| missing(car).map(|missing| (missing.to, words(&missing)));
    for action in ["ami SKIDPAD", "ebs ARMED", "tsms on"] {
        act(&mut car, &[action]);
        cycles(&mut car, 1, waits);
    }
    assert_eq!(left(&car), Some((AsState::Ready, vec!["AS master switch ON".to_owned()])));
    act(&mut car, &["asms on"]);
    cycles(&mut car, 1, waits);
    let (to, conditions) = left(&car).expect("AS_READY leads to AS_DRIVING");
    assert_eq!(
        (to, conditions.contains(&"5 second timer elapsed (in 5.0 s)".to_owned())),
        (AsState::Driving, true)
    );
    cycles(&mut car, 510, waits);
    assert_eq!(left(&car), Some((AsState::Driving, vec!["\"Go\" signal OFF -> ON".to_owned()])));
    act(&mut car, &["go on"]);
    cycles(&mut car, 1, waits);
    assert_eq!((state(&car), left(&car)), (Some(AsState::Driving), None));
}

#[test]
fn every_position_of_every_switch_is_read_as_it_is_written_and_takes_effect() {
    let mut count = 0;
    for switch in Switch::all() {
        for raw in switch.positions() {
            let action = Action::Set(switch, raw);
            assert_eq!(action.to_string().parse::<Action>(), Ok(action));
            let mut car = Car::new(Machine::REFERENCE);
            car.act(&action);
            assert_eq!(switch.get(car.inputs()), raw, "{action}");
            count += 1;
        }
    }
    assert!(count > 40, "{count}");
    assert_eq!(" power \t cycle ".parse::<Action>(), Ok(Action::PowerCycle));
}

#[test]
fn a_wrong_action_is_refused_with_its_place() {
    let error = |text: &str| text.parse::<Action>().expect_err("no action");
    let cases = [
        ("", 0, "found nothing, expected an action such as asms on"),
        ("  ASMS on", 2, "found \"ASMS\", expected the name of a switch; did you mean asms?"),
        (
            "bat_soc_low on",
            0,
            "found \"bat_soc_low\", expected the name of a switch; did you mean batt_soc_low?",
        ),
        ("\u{fc} on", 0, "found \"\u{fc}\", expected power cycle, or one of asms, tsms, "),
        ("power cycle now", 12, "found \"now\", expected nothing behind power cycle"),
        ("asms", 4, "found nothing, expected asms to be off or on"),
        ("asms  true", 6, "found \"true\", expected asms to be off or on"),
        ("asms on off", 5, "found \"on off\", expected asms to be off or on"),
        ("ebs armed", 4, "found \"armed\", expected ebs to be UNAVAILABLE, ARMED or TRIGGERED"),
        ("power", 0, "found \"power\", expected power cycle"),
        ("go \u{1b}[2J", 3, "found \"\\u{1b}[2J\", expected go to be off or on"),
        ("steer_request 5", 0, "found \"steer_request\", expected power cycle, or one of "),
    ];
    for (text, at, expected) in cases {
        let UnknownSwitch { at: found_at, .. } = error(text);
        assert_eq!(found_at, at, "{text:?}");
        assert!(error(text).to_string().starts_with(expected), "{text:?}: {}", error(text));
    }
    let long = error(&format!("asms {}", "o".repeat(100_000))).to_string();
    assert!(long.len() < 100 && long.contains("...\", ") | long.contains("\"..., "), "{long}");
}
