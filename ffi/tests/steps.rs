//! Many steps in one call are what as many calls are, also where one of them is refused.

mod common;

use std::ffi::CString;
use std::ptr::{null, null_mut};

use adsdv::{
    adsdv_control, adsdv_error, adsdv_inputs, adsdv_machine, adsdv_machine_init_in, adsdv_outputs,
    adsdv_status, adsdv_step, adsdv_step_each, adsdv_step_n,
};
use adsdv_spec::{Choice, Control, Edition, Machine};
use adsdv_tests::world::{Chance, Random};
use common::{Run, no_error, number, outcome, text};

/// Inputs that no edition has, one field or another of them.
const SPOILT: [fn(&mut adsdv_inputs); 6] = [
    |inputs| inputs.asms = 2,
    |inputs| inputs.ebs = 0,
    |inputs| inputs.lap_counter = 16,
    |inputs| inputs.steer_angle = -32_768,
    |inputs| inputs.rear_axle_trq_max = 1951,
    |inputs| inputs.speed = 255,
];

fn machine(edition: &Edition, readings: &str) -> adsdv_machine {
    let mut machine = adsdv_machine { edition: 0, readings: 0 };
    let (list, edition) = (CString::new(readings).unwrap(), number(edition));
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_machine_init_in(edition, &raw mut machine, list.as_ptr(), error) })
        .unwrap();
    machine
}

/// What a VCU sees over some steps, with the times between them; it is led through all states.
struct Script {
    inputs: Vec<adsdv_inputs>,
    dt_ms: Vec<u32>,
}

impl Script {
    fn of(vcu: &Machine, seed: u64, steps: usize) -> Self {
        let (mut run, mut control) =
            (Run::of(Edition::find(vcu.edition().version).unwrap(), seed), Control::INITIAL);
        let mut script = Self { inputs: Vec::new(), dt_ms: Vec::new() };
        for _ in 0..steps {
            let (dt_ms, inputs) = run.next(&control);
            script.inputs.push(adsdv_inputs::from(&inputs));
            script.dt_ms.push(dt_ms);
            // It is led on as if it had been power-cycled.
            control =
                if Run::is_over(&control) { Control::INITIAL } else { vcu.step(&control, &inputs, dt_ms).0 };
        }
        script
    }
}

/// What came of steps: what was remembered and shown after each, how many were made, and what ended them.
#[derive(Debug, PartialEq)]
struct Made {
    last: adsdv_control,
    controls: Vec<adsdv_control>,
    outputs: Vec<adsdv_outputs>,
    done: usize,
    ended: Option<(adsdv_status, String)>,
}

/// What a place has that no step fills.
fn unwritten() -> (adsdv_control, adsdv_outputs) {
    (
        adsdv_control { state: 99, ..adsdv_control::default() },
        adsdv_outputs { from: 99, ..adsdv_outputs::default() },
    )
}

/// The steps of one VCU, call by call.
fn one_by_one(machine: &adsdv_machine, start: &Control, script: &Script) -> Made {
    let mut control = adsdv_control::from(start);
    let count = script.inputs.len();
    let (mut controls, mut outputs) = (vec![unwritten().0; count], vec![unwritten().1; count]);
    for (place, (inputs, dt_ms)) in script.inputs.iter().zip(&script.dt_ms).enumerate() {
        let shown = &raw mut outputs[place];
        // SAFETY: the pointers are to what they are said to be.
        let stepped = outcome(|error| unsafe {
            adsdv_step(machine, &raw mut control, inputs, *dt_ms, shown, null_mut(), error)
        });
        if let Err((status, text)) = stepped {
            let text = text.replace("inputs.", &format!("inputs[{place}]."));
            return Made { last: control, controls, outputs, done: place, ended: Some((status, text)) };
        }
        controls[place] = control;
    }
    Made { last: control, controls, outputs, done: count, ended: None }
}

/// The same in one call.
fn at_once(machine: &adsdv_machine, start: &Control, script: &Script) -> Made {
    let mut last = adsdv_control::from(start);
    let count = script.inputs.len();
    let (mut controls, mut outputs, mut done) =
        (vec![unwritten().0; count], vec![unwritten().1; count], usize::MAX);
    let (inputs, dt_ms) = (script.inputs.as_ptr(), script.dt_ms.as_ptr());
    let (remembered, shown, made) = (controls.as_mut_ptr(), outputs.as_mut_ptr(), &raw mut done);
    // SAFETY: the pointers are to what they are said to be.
    let ended = outcome(|error| unsafe {
        adsdv_step_n(machine, &raw mut last, inputs, dt_ms, count, remembered, shown, made, error)
    });
    Made { last, controls, outputs, done, ended: ended.err() }
}

#[test]
fn many_steps_are_as_many_calls() {
    let mut random = Random::with_seed(21);
    let (mut ended, mut states) = (0, std::collections::HashSet::new());
    for &edition in Edition::ALL {
        let choices = edition.choices.iter().map(Some).chain([None]);
        for (seed, choice) in (0..).zip(choices) {
            let readings = choice.map_or(edition.readings, |choice: Choice| edition.readings.with(choice));
            let vcu = Machine::new(*edition, readings);
            let machine = machine(edition, &choice.map_or(String::new(), |choice| choice.to_string()));
            for round in 0..6 {
                let steps = usize::try_from(random.below(400)).unwrap();
                let mut script = Script::of(&vcu, seed * 10 + round, steps);
                if let Some(inputs) = script.inputs.get_mut(usize::try_from(random.below(600)).unwrap()) {
                    random.pick(&SPOILT)(inputs);
                }
                let made = one_by_one(&machine, &Control::INITIAL, &script);
                assert_eq!(at_once(&machine, &Control::INITIAL, &script), made);
                ended += usize::from(made.ended.is_some());
                states.extend(made.controls.iter().map(|control| control.state));
            }
        }
    }
    assert!(ended > 20, "{ended} were to end early");
    assert!(states.len() > 5, "the runs were to go through all states: {states:?}");
}

#[test]
fn a_step_of_each_is_a_call_for_each() {
    let mut random = Random::with_seed(22);
    let mut ended = 0;
    for &edition in Edition::ALL {
        let (vcu, machine) = (Machine::new(*edition, edition.readings), machine(edition, ""));
        for round in 0..20 {
            let mut script = Script::of(&vcu, 100 + round, 300);
            let before = one_by_one(&machine, &Control::INITIAL, &script).controls;
            let (count, place) = (script.inputs.len(), usize::try_from(random.below(600)).unwrap());
            let mut controls = before.clone();
            if place < count {
                ended += 1;
                if random.one_in(2) {
                    random.pick(&SPOILT)(&mut script.inputs[place]);
                } else {
                    controls[place].state = 6;
                }
            }
            let (mut expected, mut shown) = (controls.clone(), vec![unwritten().1; count]);
            let mut refused = None;
            for place in 0..count {
                let (control, outputs) = (&raw mut expected[place], &raw mut shown[place]);
                let (inputs, dt_ms) = (&raw const script.inputs[place], script.dt_ms[place]);
                // SAFETY: the pointers are to what they are said to be.
                let stepped = outcome(|error| unsafe {
                    adsdv_step(&raw const machine, control, inputs, dt_ms, outputs, null_mut(), error)
                });
                if let Err((status, text)) = stepped {
                    let (of, field) = text.split_once('.').unwrap();
                    refused = Some((place, status, format!("{of}[{place}].{field}")));
                    break;
                }
            }
            let (mut outputs, mut done) = (vec![unwritten().1; count], usize::MAX);
            let (inputs, dt_ms) = (script.inputs.as_ptr(), script.dt_ms.as_ptr());
            // SAFETY: the pointers are to what they are said to be.
            let all = outcome(|error| unsafe {
                let (controls, outputs) = (controls.as_mut_ptr(), outputs.as_mut_ptr());
                adsdv_step_each(
                    &raw const machine,
                    controls,
                    inputs,
                    dt_ms,
                    count,
                    outputs,
                    &raw mut done,
                    error,
                )
            });
            let all = all.err().map(|(status, text)| (done, status, text));
            assert_eq!((controls, outputs, all), (expected, shown, refused.clone()));
            assert_eq!(done, refused.map_or(count, |(place, ..)| place));
        }
    }
    assert!(ended > 10, "{ended} were to end early");
}

/// A time that is not given is a cycle, and nothing else is needed but what goes in.
#[test]
fn what_is_not_wanted_may_be_null() {
    for &edition in Edition::ALL {
        let (vcu, machine) = (Machine::new(*edition, edition.readings), machine(edition, ""));
        let mut script = Script::of(&vcu, 5, 200);
        script.dt_ms.fill(edition.rules.timing.cycle_ms.into());
        let made = one_by_one(&machine, &Control::INITIAL, &script);
        let (mut control, inputs, count) =
            (adsdv_control::from(&Control::INITIAL), script.inputs.as_ptr(), script.inputs.len());
        // SAFETY: the pointers are to what they are said to be, or NULL where that is allowed.
        let status = unsafe {
            let control = &raw mut control;
            adsdv_step_n(
                &raw const machine,
                control,
                inputs,
                null(),
                count,
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
            )
        };
        assert_eq!((status, control), (adsdv_status::ADSDV_OK, made.last));
        let mut each = vec![adsdv_control::from(&Control::INITIAL); count];
        // SAFETY: the pointers are to what they are said to be, or NULL where that is allowed.
        let status = unsafe {
            let each = each.as_mut_ptr();
            adsdv_step_each(
                &raw const machine,
                each,
                inputs,
                null(),
                count,
                null_mut(),
                null_mut(),
                null_mut(),
            )
        };
        assert_eq!(status, adsdv_status::ADSDV_OK);
        assert_eq!(each[0], made.controls[0]);
        // No step needs no array.
        let mut done = 1;
        // SAFETY: as above.
        let status = unsafe {
            let (control, done) = (&raw mut control, &raw mut done);
            adsdv_step_n(null(), control, null(), null(), 0, null_mut(), null_mut(), done, null_mut())
        };
        assert_eq!((status, control, done), (adsdv_status::ADSDV_OK, made.last, 0));
        // SAFETY: as above.
        let status = unsafe {
            adsdv_step_each(null(), null_mut(), null(), null(), 0, null_mut(), null_mut(), null_mut())
        };
        assert_eq!(status, adsdv_status::ADSDV_OK);
    }
}

#[test]
fn what_no_step_is_made_from_is_named_without_a_place() {
    let inputs = [adsdv_inputs::from(&adsdv_spec::Inputs::default()); 3];
    let (mut control, mut error): (_, adsdv_error) = (adsdv_control::from(&Control::INITIAL), no_error());
    control.handshake_bit = 3;
    let (before, mut done) = (control, 7);
    // SAFETY: the pointers are to what they are said to be, or NULL where that is allowed.
    let refused = |machine: *const adsdv_machine,
                   control: *mut adsdv_control,
                   inputs,
                   done,
                   error: *mut adsdv_error| unsafe {
        adsdv_step_n(machine, control, inputs, null(), 3, null_mut(), null_mut(), done, error)
    };
    let (none, made) = (inputs.as_ptr(), &raw mut done);
    let said = |status, expected: &str, error: &adsdv_error| {
        assert_eq!((error.status, text(&error.text).as_str()), (status as i32, expected));
    };
    assert_eq!(refused(null(), &raw mut control, none, made, &raw mut error), adsdv_status::ADSDV_BAD_VALUE);
    said(adsdv_status::ADSDV_BAD_VALUE, "control.handshake_bit is 3; expected 0 or 1", &error);
    assert_eq!((done, control), (0, before));
    let unknown = adsdv_machine { edition: 99, readings: 0 };
    assert_eq!(
        refused(&raw const unknown, &raw mut control, none, null_mut(), &raw mut error),
        adsdv_status::ADSDV_UNKNOWN_EDITION
    );
    let unknown = format!("machine.edition is 99; expected less than {}", Edition::ALL.len());
    said(adsdv_status::ADSDV_UNKNOWN_EDITION, &unknown, &error);
    control = adsdv_control::from(&Control::INITIAL);
    assert_eq!(
        refused(null(), null_mut(), none, null_mut(), &raw mut error),
        adsdv_status::ADSDV_BAD_POINTER
    );
    said(adsdv_status::ADSDV_BAD_POINTER, "control is NULL; expected a pointer", &error);
    assert_eq!(
        refused(null(), &raw mut control, null(), null_mut(), &raw mut error),
        adsdv_status::ADSDV_BAD_POINTER
    );
    said(adsdv_status::ADSDV_BAD_POINTER, "inputs is NULL; expected a pointer", &error);
    // SAFETY: the pointers are to what they are said to be, or NULL where that is allowed.
    let status = unsafe {
        let (control, inputs, error) = (&raw mut control, inputs.as_ptr(), &raw mut error);
        adsdv_step_n(null(), control, inputs, null(), usize::MAX, null_mut(), null_mut(), null_mut(), error)
    };
    assert_eq!(status, adsdv_status::ADSDV_BAD_VALUE);
    assert!(text(&error.text).starts_with("inputs is 18446744073709551615; expected at most "));
}
