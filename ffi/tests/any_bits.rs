//! Whatever bits C hands over: never a panic, never undefined behaviour; and NULL, for each pointer of each function.
//!
//! `cargo +nightly miri test -p adsdv-ffi --test any_bits` watches it.

mod c_border;
mod common;

use std::ffi::c_char;
use std::mem::size_of;
use std::ptr::{null, null_mut};

use adsdv::adsdv_status::*;
use adsdv::*;
use adsdv_tests::world::{Chance, Random};
use c_border::{AnyBits, spoil, zero};
use common::{no_error, text};

fn any<T: AnyBits>(random: &mut Random) -> T {
    c_border::any(|| random.bits().to_le_bytes()[0])
}

/// Few enough for an interpreter, too.
const ROUNDS: u32 = if cfg!(miri) { 50 } else { 20_000 };

#[test]
fn any_bits_are_a_step_or_an_error() {
    let mut random = Random::with_seed(7);
    let (mut fine, mut wrong) = (0, 0);
    for round in 0..ROUNDS {
        let mut machine: adsdv_machine = any(&mut random);
        if random.one_in(2) {
            machine.edition %= adsdv_edition_count();
        }
        let mut control: adsdv_control = any(&mut random);
        let mut inputs: adsdv_inputs = any(&mut random);
        let (mut outputs, mut error): (adsdv_outputs, adsdv_error) = (any(&mut random), any(&mut random));
        let mut frames = [any::<adsdv_frame>(&mut random); ADSDV_VCU_FRAMES];
        // Mostly what can be, with some of it spoilt, so that both ways are taken.
        let right = round % 2 == 0;
        if right {
            // SAFETY: the pointers are to what they are said to be.
            unsafe {
                adsdv_control_init(&raw mut control, &raw mut error);
                adsdv_inputs_init(&raw mut inputs, &raw mut error);
            }
            let field = random.below(size_of::<adsdv_inputs>() as u64 - 1);
            spoil(&mut inputs, usize::try_from(field).unwrap(), random.bits().to_le_bytes()[0]);
        }
        let machine = if right { null() } else { &raw const machine };
        let dt_ms = u32::try_from(random.bits() >> 32).unwrap();
        let (shown, sent) = (&raw mut outputs, frames.as_mut_ptr());
        // SAFETY: the pointers are to what they are said to be, or NULL.
        let status = unsafe {
            adsdv_step(machine, &raw mut control, &raw const inputs, dt_ms, shown, sent, &raw mut error)
        };
        match status {
            ADSDV_OK => fine += 1,
            ADSDV_BAD_VALUE | ADSDV_UNKNOWN_EDITION => {
                wrong += 1;
                assert_eq!(error.status, status as i32);
                let text = text(&error.text);
                assert!(text.contains("expected"), "{text}");
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(fine > ROUNDS / 100 && wrong > ROUNDS / 4, "{fine} fine, {wrong} wrong");
}

#[test]
fn any_frame_is_taken_or_an_error() {
    let mut random = Random::with_seed(8);
    for _ in 0..ROUNDS {
        let mut frame: adsdv_frame = any(&mut random);
        if random.one_in(2) {
            frame.id = random.pick(&[0x500, 0x502, 0x510, 0x511, 0x513, 0x520, 0x524]);
        }
        let mut inputs: adsdv_inputs = zero();
        let mut signals = [zero::<adsdv_signal>(); ADSDV_MOST_SIGNALS];
        let (mut count, mut taken) = (0, 0);
        let mut error = no_error();
        let room = usize::try_from(random.below(ADSDV_MOST_SIGNALS as u64 + 1)).unwrap();
        // SAFETY: the pointers are to what they are said to be.
        unsafe {
            let error = &raw mut error;
            adsdv_inputs_init(&raw mut inputs, error);
            adsdv_receive(&raw mut inputs, &raw const frame, &raw mut taken, error);
            adsdv_decode(&raw const frame, signals.as_mut_ptr(), room, &raw mut count, error);
            adsdv_decode_signal(&raw const frame, c"HANDSHAKE".as_ptr(), &raw mut signals[0], error);
            adsdv_frame_set(&raw mut frame, c"HANDSHAKE".as_ptr(), 1, error);
            adsdv_frame_init(&raw mut frame, u16::try_from(random.below(0x1_0000)).unwrap(), error);
        }
        assert!(count <= room);
    }
}

/// Each function with NULL for each of its pointers in turn, and for all.
#[test]
fn null_is_an_error_for_each_pointer() {
    let (mut machine, mut control, mut inputs): (adsdv_machine, adsdv_control, adsdv_inputs) =
        (zero(), zero(), zero());
    let (mut outputs, mut frame, mut signal) =
        (zero::<adsdv_outputs>(), zero::<adsdv_frame>(), zero::<adsdv_signal>());
    let (mut message, mut reading) = (zero::<adsdv_message>(), zero::<adsdv_reading>());
    let (mut count, mut taken, mut value, mut edition) = (0, 0, 0, 0);
    let mut frames = [zero::<adsdv_frame>(); ADSDV_MOST_VCU_FRAMES];
    let places = frames.len();
    let name = c"HANDSHAKE".as_ptr();
    let room = ADSDV_MOST_SIGNALS;
    let mut signals = [zero::<adsdv_signal>(); ADSDV_MOST_SIGNALS];
    let mut error = no_error();
    // SAFETY: the pointers are to what they are said to be, or NULL.
    unsafe {
        // As they should be, so that it is NULL alone that is refused.
        assert_eq!(adsdv_machine_init(&raw mut machine, null(), null_mut()), ADSDV_OK);
        assert_eq!(adsdv_control_init(&raw mut control, null_mut()), ADSDV_OK);
        assert_eq!(adsdv_inputs_init(&raw mut inputs, null_mut()), ADSDV_OK);
        assert_eq!(adsdv_frame_init(&raw mut frame, 0x510, null_mut()), ADSDV_OK);

        let (control, inputs, frame) = (&raw mut control, &raw mut inputs, &raw mut frame);
        let (outputs, signal, signals) = (&raw mut outputs, &raw mut signal, signals.as_mut_ptr());
        let (sent, counted) = (frames.as_mut_ptr(), &raw mut count);
        for error in [null_mut(), &raw mut error] {
            // Every pointer is as it should be.
            for status in [
                adsdv_step(&raw const machine, control, inputs, 0, outputs, null_mut(), error),
                adsdv_step(null(), control, inputs, 0, null_mut(), null_mut(), error),
                adsdv_step_n(null(), control, inputs, null(), 1, null_mut(), null_mut(), null_mut(), error),
                adsdv_step_each(null(), control, inputs, null(), 1, null_mut(), null_mut(), error),
                adsdv_receive(inputs, frame, &raw mut taken, error),
                adsdv_receive(inputs, frame, null_mut(), error),
                adsdv_decode(frame, signals, room, &raw mut count, error),
                adsdv_decode_signal(frame, name, signal, error),
                adsdv_frame_set(frame, name, 0, error),
                adsdv_message_at(0, &raw mut message, error),
                adsdv_reading_at(0, &raw mut reading, error),
                adsdv_value_of_name(4, c"FORWARD".as_ptr(), 7, &raw mut value, error),
                adsdv_edition_find(c"3.0".as_ptr(), &raw mut edition, error),
                adsdv_step_frames(null(), control, inputs, 0, outputs, sent, places, counted, error),
                adsdv_step_frames(null(), control, inputs, 0, null_mut(), sent, places, counted, error),
            ] {
                assert_eq!(status, ADSDV_OK);
            }
            // One is NULL.
            for (place, status) in [
                adsdv_machine_init(null_mut(), null(), error),
                adsdv_control_init(null_mut(), error),
                adsdv_inputs_init(null_mut(), error),
                adsdv_step(null(), null_mut(), inputs, 0, outputs, null_mut(), error),
                adsdv_step(null(), control, null(), 0, outputs, null_mut(), error),
                adsdv_step_n(null(), null_mut(), inputs, null(), 1, null_mut(), outputs, counted, error),
                adsdv_step_n(null(), control, null(), null(), 1, null_mut(), outputs, counted, error),
                adsdv_step_each(null(), null_mut(), inputs, null(), 1, outputs, counted, error),
                adsdv_step_each(null(), control, null(), null(), 1, outputs, counted, error),
                adsdv_receive(null_mut(), frame, &raw mut taken, error),
                adsdv_receive(inputs, null(), &raw mut taken, error),
                adsdv_decode(null(), signals, room, &raw mut count, error),
                adsdv_decode(frame, null_mut(), room, &raw mut count, error),
                adsdv_decode(frame, signals, room, null_mut(), error),
                adsdv_decode_signal(null(), name, signal, error),
                adsdv_decode_signal(frame, null(), signal, error),
                adsdv_decode_signal(frame, name, null_mut(), error),
                adsdv_frame_init(null_mut(), 0x510, error),
                adsdv_frame_set(null_mut(), name, 0, error),
                adsdv_frame_set(frame, null(), 0, error),
                adsdv_message_at(0, null_mut(), error),
                adsdv_reading_at(0, null_mut(), error),
                adsdv_value_of_name(4, null(), 7, &raw mut value, error),
                adsdv_value_of_name(4, c"FORWARD".as_ptr(), 7, null_mut(), error),
                adsdv_edition_find(null(), &raw mut edition, error),
                adsdv_edition_find(c"3.0".as_ptr(), null_mut(), error),
                adsdv_step_frames(null(), null_mut(), inputs, 0, outputs, sent, places, counted, error),
                adsdv_step_frames(null(), control, null(), 0, outputs, sent, places, counted, error),
                adsdv_step_frames(null(), control, inputs, 0, outputs, null_mut(), places, counted, error),
                adsdv_step_frames(null(), control, inputs, 0, outputs, sent, places, null_mut(), error),
                adsdv_machine_init_in(0, null_mut(), null(), error),
                adsdv_receive_in(0, null_mut(), frame, &raw mut taken, error),
                adsdv_receive_in(0, inputs, null(), &raw mut taken, error),
                adsdv_decode_in(0, null(), signals, room, counted, error),
                adsdv_decode_in(0, frame, null_mut(), room, counted, error),
                adsdv_decode_in(0, frame, signals, room, null_mut(), error),
                adsdv_decode_signal_in(0, null(), name, signal, error),
                adsdv_decode_signal_in(0, frame, null(), signal, error),
                adsdv_decode_signal_in(0, frame, name, null_mut(), error),
                adsdv_frame_init_in(0, null_mut(), 0x510, error),
                adsdv_frame_set_in(0, null_mut(), name, 0, error),
                adsdv_frame_set_in(0, frame, null(), 0, error),
                adsdv_message_at_in(0, 0, null_mut(), error),
                adsdv_reading_at_in(0, 0, null_mut(), error),
                adsdv_value_of_name_in(0, 4, null(), 7, &raw mut value, error),
                adsdv_value_of_name_in(0, 4, c"FORWARD".as_ptr(), 7, null_mut(), error),
            ]
            .into_iter()
            .enumerate()
            {
                assert_eq!(status, ADSDV_BAD_POINTER, "call {place}");
            }
            // A length that no object has.
            assert_eq!(adsdv_value_of_name(4, name, usize::MAX, &raw mut value, error), ADSDV_BAD_VALUE);
        }
        // One is not aligned.
        let odd = inputs.wrapping_byte_add(1);
        assert_eq!(adsdv_inputs_init(odd, &raw mut error), ADSDV_BAD_POINTER);
        assert_eq!(text(&error.text), "inputs is not aligned; expected a pointer to its type");
        assert_eq!(adsdv_inputs_init(odd, (&raw mut error).wrapping_byte_add(1)), ADSDV_BAD_POINTER);
    }
}

#[test]
fn any_number_has_a_name_or_none() {
    let mut random = Random::with_seed(9);
    for _ in 0..100 {
        let (enumeration, value) = (random.bits(), random.bits());
        let (enumeration, value) = ((enumeration >> 32) as u32, (value >> 32) as i32);
        assert!(adsdv_value_name(enumeration, value).is_null());
        assert!(adsdv_value_name_in(value.cast_unsigned(), enumeration, value).is_null());
        adsdv_is_reserved(enumeration);
    }
}

#[cfg(feature = "judge")]
#[test]
fn null_is_an_error_for_each_pointer_of_the_judge() {
    let (mut error, mut report) = (no_error(), adsdv_report::default());
    // SAFETY: numbers and a pointer, of which 0 is one.
    let mut finding: adsdv_finding = unsafe { std::mem::zeroed() };
    // SAFETY: the pointers are to what they are said to be, or NULL.
    unsafe {
        for error in [null_mut(), &raw mut error] {
            assert_eq!(adsdv_judge_options_init(null_mut(), error), ADSDV_BAD_POINTER);
            assert_eq!(adsdv_judge_frame(null_mut(), 0, 0, null(), 0, error), ADSDV_BAD_POINTER);
            assert_eq!(adsdv_judge_other_frame(null_mut(), 0, error), ADSDV_BAD_POINTER);
            assert_eq!(adsdv_judge_finish(null_mut(), &raw mut report, error), ADSDV_BAD_POINTER);
            assert!(!adsdv_judge_next(null_mut(), &raw mut finding));
            let judge = adsdv_judge_new(null(), error);
            assert!(!judge.is_null());
            assert!(!adsdv_judge_next(judge, null_mut()));
            assert!(!adsdv_judge_next(judge, &raw mut finding));
            adsdv_judge_free(judge);
        }
        adsdv_judge_free(null_mut());
    }
}

#[cfg(feature = "judge")]
#[test]
fn any_frame_is_judged() {
    let mut random = Random::with_seed(11);
    // SAFETY: the pointers are to what they are said to be, or NULL.
    unsafe {
        let judge = adsdv_judge_new(null(), null_mut());
        let data: [u8; 64] = std::array::from_fn(|_| random.bits().to_le_bytes()[0]);
        for _ in 0..ROUNDS {
            let id = random.pick(&[0x510, 0x520, 0x502, 0x525, 0x181, u32::MAX, 0x7FF]);
            let t = random
                .pick(&[0, 1, 10_000_000, i64::MAX, i64::MIN, -1])
                .wrapping_add(random.bits().cast_signed() >> 40);
            let len = usize::try_from(random.below(65)).unwrap();
            assert_eq!(adsdv_judge_frame(judge, t, id, data.as_ptr(), len, null_mut()), ADSDV_OK);
        }
        assert_eq!(adsdv_judge_finish(judge, null_mut(), null_mut()), ADSDV_OK);
        adsdv_judge_free(judge);
    }
    let _: *const c_char = adsdv_version();
}
