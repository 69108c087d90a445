//! A step through the C interface is the specification's step: every input arrives, and everything is shown.

mod common;

use std::collections::HashSet;
use std::ffi::CString;
use std::ptr::{null, null_mut};

use adsdv::{
    adsdv_control, adsdv_control_init, adsdv_frame, adsdv_inputs, adsdv_machine, adsdv_machine_init,
    adsdv_outputs, adsdv_step,
};
use adsdv_oracle::protocol::{Domain, INPUTS, Shown};
use adsdv_spec::{Choice, Control, Edition, Inputs, Machine, Readings};
use common::{Run, fields, outcome, text};

/// A step through the C interface.
fn step(
    machine: Option<&adsdv_machine>,
    control: &mut adsdv_control,
    inputs: &adsdv_inputs,
    dt_ms: u32,
) -> (adsdv_outputs, [adsdv_frame; 9]) {
    let (mut outputs, mut frames) = (adsdv_outputs::default(), [adsdv_frame::default(); 9]);
    let machine = machine.map_or(null(), std::ptr::from_ref);
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe {
        adsdv_step(machine, control, inputs, dt_ms, &raw mut outputs, frames.as_mut_ptr(), error)
    })
    .unwrap();
    (outputs, frames)
}

fn machine(readings: &str) -> adsdv_machine {
    let mut machine = adsdv_machine { readings: 0 };
    let list = CString::new(readings).unwrap();
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_machine_init(&raw mut machine, list.as_ptr(), error) }).unwrap();
    machine
}

/// Holds a run of steps against the specification's.
fn agrees(ours: Option<&adsdv_machine>, vcu: &Machine, seed: u64, steps: u32) {
    let mut run = Run::new(seed);
    let mut control = Control::INITIAL;
    let mut plain = adsdv_control::from(&control);
    let (mut states, mut rows) = (HashSet::new(), HashSet::new());
    for _ in 0..steps {
        if Run::is_over(&control) {
            control = Control::INITIAL;
            // SAFETY: the pointer is to what it is said to be.
            outcome(|error| unsafe { adsdv_control_init(&raw mut plain, error) }).unwrap();
        }
        let (dt_ms, inputs) = run.next(&control);
        let (next, outputs) = vcu.step(&control, &inputs, dt_ms);
        let (shown, frames) = step(ours, &mut plain, &adsdv_inputs::from(&inputs), dt_ms);

        assert_eq!(plain, adsdv_control::from(&next), "{control:?} {inputs:?}");
        let mut fields = fields(&shown);
        for (field, value) in Shown::of(vcu.edition(), &outputs, &inputs).iter() {
            let found = fields.remove(field.key);
            assert_eq!(found, Some(value.raw.unwrap_or(0).into()), "{}", field.key);
            if field.key == "steer" {
                assert_eq!(fields.remove("steer_active"), Some(value.raw.is_some().into()));
            }
        }
        // A later version has it.
        assert_eq!(fields.remove("brake_plausibility_fault"), Some(0));
        // What is left is not on the bus: which arrow was taken.
        let (row, term) = (outputs.row(vcu), outputs.term(vcu));
        assert_eq!(fields.remove("from"), Some(outputs.from.raw().into()));
        assert_eq!(fields.remove("taken"), Some(row.is_some().into()));
        assert_eq!(fields.remove("row"), Some(outputs.taken.map_or(0, |taken| taken.row.into())));
        assert_eq!(fields.remove("term"), Some(outputs.taken.map_or(0, |taken| taken.term.into())));
        assert_eq!(text(&shown.section), row.map_or("", |row| row.section));
        assert_eq!(text(&shown.term_section), term.map_or("", |term| term.section));
        fields.retain(|name, _| name != "section" && name != "term_section");
        assert!(fields.is_empty(), "more is shown than there is: {fields:?}");
        let sent = outputs.messages(&inputs).frames(&vcu.edition().bus).map(adsdv_frame::from);
        assert!(sent.eq(frames));

        states.insert(next.state);
        rows.extend(outputs.taken);
        control = next;
    }
    assert_eq!(states.len(), 5, "the run was to go through all states: {states:?}");
    assert!(rows.len() > 8, "the run was to take many arrows: {rows:?}");
}

#[test]
fn the_reference_steps_alike() {
    agrees(None, &Machine::REFERENCE, 1, 20_000);
    agrees(Some(&machine("")), &Machine::REFERENCE, 2, 20_000);
}

#[test]
fn every_reading_steps_alike() {
    // More than are kept ready, and each twice.
    for seed in [3, 4] {
        for &choice in Choice::ALL {
            let vcu = Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice));
            agrees(Some(&machine(&choice.to_string())), &vcu, seed, 3000);
        }
    }
}

#[test]
fn every_input_of_the_protocol_is_a_field_and_arrives() {
    for input in INPUTS {
        let raws = match input.domain {
            Domain::Flag => vec![0, 1],
            Domain::Names(names) => names.iter().map(|&(raw, _)| raw).collect(),
            Domain::Number { min, max } => vec![min, 0, 1, max],
        };
        for raw in raws {
            let mut inputs = Inputs::default();
            assert!((input.set)(&mut inputs, raw), "{} = {raw}", input.key);
            let plain = adsdv_inputs::from(&inputs);
            assert_eq!(fields(&plain).get(input.key), Some(&raw.into()), "{}", input.key);
            // It is read back: receiving a frame of nobody changes nothing.
            let mut back = plain;
            let frame = adsdv_frame::default();
            // SAFETY: the pointers are to what they are said to be.
            outcome(|error| unsafe {
                adsdv::adsdv_receive(&raw mut back, &raw const frame, null_mut(), error)
            })
            .unwrap();
            assert_eq!(back, plain, "{} = {raw}", input.key);
        }
    }
}

/// Machines are made and found by many threads at once.
#[test]
fn threads_step_alike() {
    std::thread::scope(|scope| {
        for seed in 10..14 {
            scope.spawn(move || {
                for &choice in Choice::ALL.iter().rev() {
                    let vcu = Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice));
                    agrees(Some(&machine(&choice.to_string())), &vcu, seed, 3000);
                }
            });
        }
    });
}
