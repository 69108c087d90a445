//! A step through the C interface is the specification's step: every input arrives, and everything is shown.

mod common;

use std::collections::HashSet;
use std::ffi::CString;
use std::ptr::{null, null_mut};

use adsdv::{
    ADSDV_MOST_VCU_FRAMES, ADSDV_VCU_FRAMES, adsdv_control, adsdv_control_init, adsdv_edition_default,
    adsdv_frame, adsdv_inputs, adsdv_machine, adsdv_machine_init_in, adsdv_outputs, adsdv_step,
    adsdv_step_frames,
};
use adsdv_conform::protocol::{Domain, InputField, Protocol, Shown};
use adsdv_spec::{Choice, Control, Edition, Inputs, Machine, Readings};
use common::{Run, fields, number, outcome, take, text};

/// A frame that nobody sends: what a place has that is not written.
const UNWRITTEN: adsdv_frame = adsdv_frame { id: 0xFFFF, len: 99, data: [0xAA; 8] };

/// A step through the C interface.
fn step(
    machine: Option<&adsdv_machine>,
    control: &mut adsdv_control,
    inputs: &adsdv_inputs,
    dt_ms: u32,
) -> (adsdv_outputs, Vec<adsdv_frame>) {
    let (mut outputs, mut frames) = (adsdv_outputs::default(), [UNWRITTEN; ADSDV_MOST_VCU_FRAMES]);
    let is_default = machine.is_none_or(|machine| machine.edition == adsdv_edition_default());
    let machine = machine.map_or(null(), std::ptr::from_ref);
    let (shown, sent, mut count) = (&raw mut outputs, frames.as_mut_ptr(), 99);
    if is_default {
        let mut again = *control;
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_step(machine, &raw mut again, inputs, dt_ms, shown, sent, error) })
            .unwrap();
        count = ADSDV_VCU_FRAMES;
        assert!(frames[count..].iter().all(|frame| *frame == UNWRITTEN));
        let (by_step, mut by_frames) = (frames, [UNWRITTEN; ADSDV_MOST_VCU_FRAMES]);
        let (sent, counted) = (by_frames.as_mut_ptr(), &raw mut count);
        outcome(|error| {
            // SAFETY: the pointers are to what they are said to be, and there is as much room.
            unsafe {
                adsdv_step_frames(
                    machine,
                    control,
                    inputs,
                    dt_ms,
                    shown,
                    sent,
                    ADSDV_VCU_FRAMES,
                    counted,
                    error,
                )
            }
        })
        .unwrap();
        assert_eq!((by_step, again), (by_frames, *control));
    } else {
        outcome(|error| {
            let (room, count) = (frames.len(), &raw mut count);
            // SAFETY: the pointers are to what they are said to be, and there is as much room.
            unsafe { adsdv_step_frames(machine, control, inputs, dt_ms, shown, sent, room, count, error) }
        })
        .unwrap();
    }
    let (sent, rest) = frames.split_at(count);
    assert!(rest.iter().all(|frame| *frame == UNWRITTEN), "a place was filled for which there is no frame");
    (outputs, sent.to_vec())
}

fn machine(edition: &Edition, readings: &str) -> adsdv_machine {
    let mut machine = adsdv_machine { edition: 0, readings: 0 };
    let (list, edition) = (CString::new(readings).unwrap(), number(edition));
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_machine_init_in(edition, &raw mut machine, list.as_ptr(), error) })
        .unwrap();
    machine
}

/// Holds a run of steps against the specification's.
fn agrees(ours: Option<&adsdv_machine>, vcu: &Machine, seed: u64, steps: u32) {
    let mut run = Run::of(Edition::find(vcu.edition().version).unwrap(), seed);
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
        let by_name = format!("{shown:?}");
        let mut fields = fields(&by_name);
        for (field, value) in Shown::of(vcu.edition(), &outputs, &inputs).iter() {
            let found = take(&mut fields, field.key);
            assert_eq!(found, Some(value.raw.unwrap_or(0).into()), "{}", field.key);
            if field.key == "steer" {
                assert_eq!(take(&mut fields, "steer_active"), Some(value.raw.is_some().into()));
            }
        }
        // Not every edition has it.
        assert_eq!(take(&mut fields, "brake_plausibility_fault").unwrap_or(0), 0);
        // These are shown in every edition, and sent since 2026.
        let of_520h = outputs.messages(&inputs).status;
        for (name, raw) in [
            ("op_state", of_520h.op_state.raw()),
            ("ts_state", of_520h.ts_state.raw()),
            ("ebs_state", of_520h.ebs_state.raw()),
        ] {
            assert!(take(&mut fields, name).is_none_or(|found| found == i64::from(raw)), "{name}");
        }
        // What is left is not on the bus: which arrow was taken.
        let (row, term) = (outputs.row(vcu), outputs.term(vcu));
        assert_eq!(take(&mut fields, "from"), Some(outputs.from.raw().into()));
        assert_eq!(take(&mut fields, "taken"), Some(row.is_some().into()));
        assert_eq!(take(&mut fields, "row"), Some(outputs.taken.map_or(0, |taken| taken.row.into())));
        assert_eq!(take(&mut fields, "term"), Some(outputs.taken.map_or(0, |taken| taken.term.into())));
        assert_eq!(text(&shown.section), row.map_or("", |row| row.section));
        assert_eq!(text(&shown.term_section), term.map_or("", |term| term.section));
        fields.retain(|(name, _)| !["section", "term_section"].contains(name));
        assert!(fields.is_empty(), "more is shown than there is: {fields:?}");
        let sent = outputs.messages(&inputs).frames(&vcu.edition().bus).map(adsdv_frame::from);
        assert!(sent.eq(frames.iter().copied()), "{frames:?}");

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
    agrees(Some(&machine(Edition::DEFAULT, "")), &Machine::REFERENCE, 2, 20_000);
}

#[test]
fn the_reference_of_each_edition_steps_alike() {
    for &edition in Edition::ALL {
        let vcu = Machine::new(*edition, edition.readings);
        agrees(Some(&machine(edition, "")), &vcu, 5, 20_000);
    }
}

/// Each choice of each edition.
fn choices() -> Vec<(&'static Edition, Choice)> {
    Edition::ALL.iter().flat_map(|edition| edition.choices.iter().map(|choice| (*edition, choice))).collect()
}

fn reading(edition: &Edition, choice: Choice) -> Machine {
    Machine::new(*edition, Readings::with(edition.readings, choice))
}

#[test]
fn every_reading_steps_alike() {
    // More than are kept ready, and each twice.
    for seed in [3, 4] {
        for (edition, choice) in choices() {
            agrees(Some(&machine(edition, &choice.to_string())), &reading(edition, choice), seed, 2000);
        }
    }
}

#[test]
fn every_input_of_the_protocol_is_a_field_and_arrives() {
    for &edition in Edition::ALL {
        for (input, domain) in Protocol::of(edition).inputs() {
            arrives(edition, input, domain);
        }
    }
}

fn arrives(edition: &Edition, input: &InputField, domain: Domain) {
    let raws = match domain {
        Domain::Flag => vec![0, 1],
        Domain::Names(names) => names.iter().map(|&(raw, _)| raw).collect(),
        Domain::Number { min, max } => vec![min, 0, 1, max],
    };
    for raw in raws {
        let mut inputs = Inputs::default();
        assert!((input.set)(&mut inputs, raw), "{} = {raw}", input.key);
        let plain = adsdv_inputs::from(&inputs);
        assert_eq!(take(&mut fields(&format!("{plain:?}")), input.key), Some(raw.into()), "{}", input.key);
        // It is read back: receiving a frame of nobody changes nothing.
        let mut back = plain;
        let frame = adsdv_frame::default();
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe {
            adsdv::adsdv_receive_in(number(edition), &raw mut back, &raw const frame, null_mut(), error)
        })
        .unwrap();
        assert_eq!(back, plain, "{} = {raw}", input.key);
    }
}

/// Machines are made and found by many threads at once.
#[test]
fn threads_step_alike() {
    std::thread::scope(|scope| {
        for seed in 10..14 {
            scope.spawn(move || {
                for (edition, choice) in choices().into_iter().rev() {
                    agrees(
                        Some(&machine(edition, &choice.to_string())),
                        &reading(edition, choice),
                        seed,
                        1000,
                    );
                }
            });
        }
    });
}
