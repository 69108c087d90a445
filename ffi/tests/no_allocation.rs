//! Nothing allocates but the judge: steps, frames, names and errors, counted by an allocator.

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ptr::{null, null_mut};

use adsdv::adsdv_status::*;
use adsdv::*;
use adsdv_spec::Control;
use common::{Run, no_error};

struct Counting;

thread_local! {
    /// The tests of other threads do not count.
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: the system's allocator does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller promises the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller promises the same.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often something is allocated.
fn allocations(work: impl FnOnce()) -> u64 {
    let before = COUNT.get();
    work();
    COUNT.get() - before
}

#[test]
fn the_count_counts() {
    assert_eq!(allocations(|| drop(std::hint::black_box(Box::new(1)))), 1);
    // SAFETY: the pointers are to what they are said to be, or NULL.
    #[cfg(feature = "judge")]
    assert!(allocations(|| unsafe { adsdv_judge_free(adsdv_judge_new(null(), null_mut())) }) > 0);
}

#[test]
fn nothing_allocates_but_the_judge() {
    // What a run needs is made before anything is counted.
    let mut run = Run::new(3);
    let mut control = Control::INITIAL;
    let script: Vec<(u32, adsdv_inputs)> = (0..2000)
        .map(|_| {
            let (dt_ms, inputs) = run.next(&control);
            control = adsdv_spec::Machine::REFERENCE.step(&control, &inputs, dt_ms).0;
            (dt_ms, adsdv_inputs::from(&inputs))
        })
        .collect();
    // SAFETY: all their fields are numbers, of which 0 is one.
    let (mut message, mut reading, mut signals): (
        adsdv_message,
        adsdv_reading,
        [adsdv_signal; ADSDV_MOST_SIGNALS],
    ) = unsafe { (std::mem::zeroed(), std::mem::zeroed(), std::mem::zeroed()) };

    let seen = adsdv_inputs::from(&adsdv_spec::Inputs::default());
    let count = allocations(|| {
        let mut machine = adsdv_machine { edition: 0, readings: 0 };
        let (mut control, mut outputs) = (adsdv_control::default(), adsdv_outputs::default());
        let mut frames = [adsdv_frame::default(); ADSDV_MOST_VCU_FRAMES];
        let (mut count, mut taken, mut value) = (0, 0, 0);
        let mut error = no_error();
        // SAFETY: the pointers are to what they are said to be, or NULL.
        unsafe {
            let error = &raw mut error;
            for index in 0..ADSDV_CHOICES {
                assert_eq!(adsdv_reading_at(index, &raw mut reading, error), ADSDV_OK);
                let name = reading.name.as_ptr();
                assert_eq!(adsdv_machine_init(&raw mut machine, name, error), ADSDV_OK);
                assert_eq!(adsdv_control_init(&raw mut control, error), ADSDV_OK);
                for (dt_ms, inputs) in &script {
                    let mut inputs = *inputs;
                    let sent = frames.as_mut_ptr();
                    let (vcu, shown) = (&raw const machine, &raw mut outputs);
                    let status =
                        adsdv_step(vcu, &raw mut control, &raw const inputs, *dt_ms, shown, sent, error);
                    assert_eq!(status, ADSDV_OK);
                    let first = &raw const frames[0];
                    assert_eq!(adsdv_receive(&raw mut inputs, first, &raw mut taken, error), ADSDV_OK);
                }
                for frame in frames.iter().take(ADSDV_VCU_FRAMES) {
                    let places = signals.as_mut_ptr();
                    assert_eq!(
                        adsdv_decode(frame, places, ADSDV_MOST_SIGNALS, &raw mut count, error),
                        ADSDV_OK
                    );
                }
            }
            for index in 0..ADSDV_MESSAGES {
                assert_eq!(adsdv_message_at(index, &raw mut message, error), ADSDV_OK);
                assert_eq!(adsdv_frame_init(&raw mut frames[0], message.id, error), ADSDV_OK);
            }
            for edition in 0..adsdv_edition_count() {
                let (places, room, count) = (frames.as_mut_ptr(), frames.len(), &raw mut count);
                assert_eq!(adsdv_machine_init_in(edition, &raw mut machine, null(), error), ADSDV_OK);
                let (vcu, inputs) = (&raw const machine, &raw const seen);
                let control = &raw mut control;
                for _ in 0..100 {
                    let shown = null_mut();
                    let status =
                        adsdv_step_frames(vcu, control, inputs, 10, shown, places, room, count, error);
                    assert_eq!(status, ADSDV_OK);
                }
                let (shown, done) = (&raw mut outputs, null_mut());
                let status = adsdv_step_n(vcu, control, inputs, null(), 1, null_mut(), shown, done, error);
                assert_eq!(status, ADSDV_OK);
                assert_eq!(adsdv_step_each(vcu, control, inputs, null(), 1, shown, done, error), ADSDV_OK);
                assert!(!adsdv_edition_version(edition).is_null());
                assert_eq!(adsdv_frame_init_in(edition, places, 0x513, error), ADSDV_OK);
            }
            // And what is refused, in words.
            let nowhere = adsdv_edition_count();
            assert_eq!(adsdv_frame_init_in(nowhere, &raw mut frames[0], 0x513, error), ADSDV_UNKNOWN_EDITION);
            let (name, frame) = (c"fault-trigger=slope".as_ptr(), &raw mut frames[0]);
            assert_eq!(adsdv_machine_init(&raw mut machine, name, error), ADSDV_UNKNOWN_NAME);
            assert_eq!(adsdv_frame_init(frame, 1, error), ADSDV_UNKNOWN_ID);
            assert_eq!(adsdv_frame_set(frame, name, 1, error), ADSDV_UNKNOWN_NAME);
            assert_eq!(adsdv_decode_signal(frame, name, signals.as_mut_ptr(), error), ADSDV_UNKNOWN_NAME);
            assert_eq!(adsdv_value_of_name(0, name, 5, &raw mut value, error), ADSDV_UNKNOWN_NAME);
            assert_eq!(adsdv_inputs_init(null_mut(), error), ADSDV_BAD_POINTER);
            control.state = 77;
            let inputs = &raw const script[0].1;
            let status = adsdv_step(null(), &raw mut control, inputs, 10, null_mut(), null_mut(), error);
            assert_eq!(status, ADSDV_BAD_VALUE);
            assert!(!adsdv_value_name(0, 2).is_null() && !adsdv_version().is_null());
            assert!(adsdv_is_reserved(0));
        }
    });
    assert_eq!(count, 0);
}
