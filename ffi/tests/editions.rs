//! The editions through the C interface: they are found and listed, each has its own rules, and what one cannot say is an error.

mod common;

use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

use adsdv::adsdv_status::{self, *};
use adsdv::*;
use adsdv_spec::Edition;
use common::{number, outcome, text};

fn find(version: &CStr) -> Result<adsdv_edition, (adsdv_status, String)> {
    let mut edition = 77;
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_edition_find(version.as_ptr(), &raw mut edition, error) })
        .map(|()| edition)
}

fn machine(edition: adsdv_edition, readings: &CStr) -> Result<adsdv_machine, (adsdv_status, String)> {
    let mut machine = adsdv_machine { edition: 0, readings: 0 };
    let place = &raw mut machine;
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_machine_init_in(edition, place, readings.as_ptr(), error) })
        .map(|()| machine)
}

/// A VCU, and an AI Computer that does not answer the handshake.
struct Vcu {
    machine: adsdv_machine,
    control: adsdv_control,
    inputs: adsdv_inputs,
}

impl Vcu {
    fn of(version: &CStr) -> Self {
        let (mut control, mut inputs) = (adsdv_control::default(), adsdv_inputs::default());
        // SAFETY: the pointers are to what they are said to be.
        unsafe {
            outcome(|error| adsdv_control_init(&raw mut control, error)).unwrap();
            outcome(|error| adsdv_inputs_init(&raw mut inputs, error)).unwrap();
        }
        inputs.tsms = 1;
        Self { machine: machine(find(version).unwrap(), c"").unwrap(), control, inputs }
    }

    fn step(&mut self, dt_ms: u32) -> Result<(adsdv_outputs, Vec<adsdv_frame>), (adsdv_status, String)> {
        let mut outputs = adsdv_outputs::default();
        let mut frames = [adsdv_frame::default(); ADSDV_MOST_VCU_FRAMES];
        let (mut count, room, sent) = (0, frames.len(), frames.as_mut_ptr());
        let Self { machine, control, inputs } = self;
        outcome(|error| {
            let (machine, inputs, shown) = (&raw const *machine, &raw const *inputs, &raw mut outputs);
            // SAFETY: the pointers are to what they are said to be, and there is as much room.
            unsafe {
                adsdv_step_frames(machine, control, inputs, dt_ms, shown, sent, room, &raw mut count, error)
            }
        })?;
        Ok((outputs, frames[..count].to_vec()))
    }

    /// Whether communication is lost after this many cycles of 10 ms.
    fn lost_after(mut self, cycles: u32) -> bool {
        (0..cycles).map(|_| self.step(10).unwrap().0.ai_comms_lost).last() == Some(1)
    }
}

fn name(edition: adsdv_edition, enumeration: adsdv_enumeration, value: i32) -> Option<&'static str> {
    let name = adsdv_value_name_in(edition, enumeration as u32, value);
    // SAFETY: the library's texts end with a NUL, and stay.
    (!name.is_null()).then(|| unsafe { CStr::from_ptr(name) }.to_str().unwrap())
}

#[test]
fn every_edition_is_found_by_its_version_and_listed() {
    assert_eq!(usize::try_from(adsdv_edition_count()).unwrap(), Edition::ALL.len());
    for (place, edition) in Edition::ALL.iter().enumerate() {
        assert_eq!(usize::try_from(number(edition)).unwrap(), place);
        // SAFETY: the library's texts end with a NUL.
        let version = unsafe { CStr::from_ptr(adsdv_edition_version(number(edition))) };
        assert_eq!(version.to_str(), Ok(edition.version));
    }
    assert_eq!(adsdv_edition_default(), number(Edition::DEFAULT));
    // SAFETY: the library's texts end with a NUL.
    let document = unsafe { CStr::from_ptr(adsdv_document_version()) };
    assert_eq!(find(document), Ok(adsdv_edition_default()));
    assert!(adsdv_edition_version(adsdv_edition_count()).is_null());
    assert!(adsdv_edition_version(adsdv_edition::MAX).is_null());
}

#[test]
fn an_edition_that_there_is_not_is_refused_with_those_that_there_are() {
    let versions: Vec<&str> = Edition::ALL.iter().map(|edition| edition.version).collect();
    for version in [c"2.9", c"", c"4", c"4.0 "] {
        let said = format!("there is no edition {version:?}; expected one of {}", versions.join(", "));
        assert_eq!(find(version), Err((ADSDV_UNKNOWN_EDITION, said)));
    }
    assert_eq!(find(c"\xFF").unwrap_err().0, ADSDV_UNKNOWN_NAME, "it is no text");
}

/// A number that is no edition's, for every function that takes one.
#[test]
fn a_number_of_no_edition_is_refused_everywhere() {
    let count = adsdv_edition_count();
    let (mut machine, mut frame) = (adsdv_machine { edition: 0, readings: 0 }, adsdv_frame::default());
    let (mut inputs, mut control) = (adsdv_inputs::default(), adsdv_control::default());
    // SAFETY: numbers and arrays of `char`, of which 0 is one.
    let (mut message, mut reading, mut signal): (adsdv_message, adsdv_reading, adsdv_signal) =
        unsafe { (std::mem::zeroed(), std::mem::zeroed(), std::mem::zeroed()) };
    let (mut length, mut value, mut frames) = (0, 0, [adsdv_frame::default(); ADSDV_MOST_VCU_FRAMES]);
    let name = c"HANDSHAKE".as_ptr();
    for number in [count, adsdv_edition::MAX] {
        // SAFETY: the pointers are to what they are said to be.
        let refused = unsafe {
            outcome(|error| adsdv_inputs_init(&raw mut inputs, error)).unwrap();
            outcome(|error| adsdv_control_init(&raw mut control, error)).unwrap();
            [
                outcome(|error| adsdv_machine_init_in(number, &raw mut machine, null(), error)),
                outcome(|error| {
                    adsdv_receive_in(number, &raw mut inputs, &raw const frame, null_mut(), error)
                }),
                outcome(|error| adsdv_frame_init_in(number, &raw mut frame, 0x510, error)),
                outcome(|error| adsdv_frame_set_in(number, &raw mut frame, name, 0, error)),
                outcome(|error| adsdv_message_at_in(number, 0, &raw mut message, error)),
                outcome(|error| adsdv_reading_at_in(number, 0, &raw mut reading, error)),
                outcome(|error| {
                    adsdv_decode_in(number, &raw const frame, &raw mut signal, 1, &raw mut length, error)
                }),
                outcome(|error| {
                    adsdv_decode_signal_in(number, &raw const frame, name, &raw mut signal, error)
                }),
                outcome(|error| adsdv_value_of_name_in(number, 0, name, 9, &raw mut value, error)),
            ]
        };
        let said = format!("edition is {number}; expected less than {count}");
        for (place, refused) in refused.into_iter().enumerate() {
            assert_eq!(refused, Err((ADSDV_UNKNOWN_EDITION, said.clone())), "call {place}");
        }
        let machine = adsdv_machine { edition: number, readings: 0 };
        let (sent, room, count) = (frames.as_mut_ptr(), frames.len(), &raw mut length);
        let (vcu, seen) = (&raw const machine, &raw const inputs);
        // SAFETY: the pointers are to what they are said to be, or NULL.
        for refused in unsafe {
            [
                outcome(|error| adsdv_step(vcu, &raw mut control, seen, 10, null_mut(), null_mut(), error)),
                outcome(|error| adsdv_step(vcu, &raw mut control, seen, 10, null_mut(), sent, error)),
                outcome(|error| {
                    adsdv_step_frames(vcu, &raw mut control, seen, 10, null_mut(), sent, room, count, error)
                }),
            ]
        } {
            assert_eq!(refused, Err((ADSDV_UNKNOWN_EDITION, format!("machine.{said}"))));
        }
        assert_eq!((adsdv_message_count(number), adsdv_reading_count(number)), (0, 0));
        assert!(adsdv_value_name_in(number, 0, 1).is_null() && !adsdv_is_reserved_in(number, 0));
    }
}

#[test]
fn an_answer_to_the_handshake_after_60_ms_is_a_fault_in_3_0_alone() {
    assert!(Vcu::of(c"3.0").lost_after(7) && !Vcu::of(c"4.0").lost_after(7));
    assert!(!Vcu::of(c"4.0").lost_after(10) && Vcu::of(c"4.0").lost_after(11));
}

#[test]
fn a_message_that_is_missing_is_a_fault_in_4_0_alone() {
    for (version, lost) in [(c"3.0", 0), (c"4.0", 1)] {
        let mut vcu = Vcu::of(version);
        vcu.step(10).unwrap();
        (vcu.inputs.handshake, vcu.inputs.brake_silence_ms) = (1, 100);
        assert_eq!(vcu.step(10).unwrap().0.ai_comms_lost, lost, "{version:?}");
    }
}

#[test]
fn the_frames_are_those_that_the_edition_has() {
    for edition in Edition::ALL {
        let version = CString::new(edition.version).unwrap();
        let (_, frames) = Vcu::of(&version).step(10).unwrap();
        for frame in &frames {
            let def = edition.bus.message(frame.id).expect("a message of the edition");
            assert_eq!(frame.len, def.len, "{:X}h in {}", frame.id, edition.version);
        }
        let sent = edition.bus.messages.iter().filter(|def| def.sender == adsdv_spec::messages::Node::Vcu);
        assert_eq!(frames.len(), sent.count());
    }
    let ids = |version: &CStr| -> Vec<u16> {
        Vcu::of(version).step(10).unwrap().1.iter().map(|frame| frame.id).collect()
    };
    assert!(!ids(c"3.0").contains(&0x120) && ids(c"4.0").contains(&0x120));
}

/// adsdv_step has room for the default edition's frames; another number is neither cut off nor filled up.
#[test]
fn frames_that_do_not_fit_are_refused_and_nothing_is_changed() {
    let unwritten = adsdv_frame { id: 0xFFFF, len: 99, data: [0xAA; 8] };
    let mut frames = [unwritten; ADSDV_MOST_VCU_FRAMES];
    let mut vcu = Vcu::of(c"4.0");
    let (before, sent, mut count) = (vcu.control, frames.as_mut_ptr(), 99);
    let (machine, inputs) = (&raw const vcu.machine, &raw const vcu.inputs);
    let control = &raw mut vcu.control;
    let mut outputs = adsdv_outputs::default();
    // SAFETY: the pointers are to what they are said to be.
    let refused = unsafe {
        [
            outcome(|error| adsdv_step(machine, control, inputs, 10, &raw mut outputs, sent, error)),
            outcome(|error| {
                let (shown, count) = (&raw mut outputs, &raw mut count);
                adsdv_step_frames(machine, control, inputs, 10, shown, sent, 9, count, error)
            }),
        ]
    };
    for refused in refused {
        assert_eq!(refused, Err((ADSDV_NO_ROOM, "frames has room for 9; expected 10".to_owned())));
    }
    assert_eq!((vcu.control, outputs, count), (before, adsdv_outputs::default(), 99));
    assert!(frames.iter().all(|frame| *frame == unwritten));
    let (machine, inputs, control) = (&raw const vcu.machine, &raw const vcu.inputs, &raw mut vcu.control);
    // SAFETY: the pointers are to what they are said to be, or NULL where that is allowed.
    outcome(|error| unsafe { adsdv_step(machine, control, inputs, 10, null_mut(), null_mut(), error) })
        .unwrap();
    assert_ne!(vcu.control, before, "without frames it steps");
}

#[test]
fn fields_are_held_to_the_ranges_and_names_of_the_edition() {
    let refused = |version: &CStr, spoil: fn(&mut Vcu)| {
        let mut vcu = Vcu::of(version);
        spoil(&mut vcu);
        vcu.step(10).map(|_| ()).unwrap_err()
    };
    let too_far = "inputs.steer_angle is 211; expected -210 to 210 (-21 to 21 deg)";
    assert_eq!(refused(c"4.0", |vcu| vcu.inputs.steer_angle = 211), (ADSDV_BAD_VALUE, too_far.to_owned()));
    let mut vcu = Vcu::of(c"3.0");
    vcu.inputs.steer_angle = 211;
    assert!(vcu.step(10).is_ok());
    let (status, said) = refused(c"4.0", |vcu| vcu.inputs.ami = 8);
    assert_eq!(status, ADSDV_BAD_VALUE);
    assert!(said.ends_with("7 = AUTONOMOUS DEMO"), "{said}");
    // The cause that 4.0 added.
    let (status, said) = refused(c"3.0", |vcu| vcu.control.shutdown_cause = 11);
    assert_eq!(status, ADSDV_BAD_VALUE);
    assert!(said.starts_with("control.shutdown_cause is 11; expected 0 = NO SHUTDOWN, "), "{said}");
    assert!(said.ends_with("10 = BMS FAULT"), "{said}");
    let mut vcu = Vcu::of(c"4.0");
    vcu.control.shutdown_cause = 11;
    assert_eq!(vcu.step(10).unwrap().0.shutdown_cause, 11);
}

#[test]
fn names_are_those_of_the_edition_and_those_of_the_default_are_understood() {
    let (older, newer) = (find(c"3.0").unwrap(), find(c"4.0").unwrap());
    let missions = adsdv_enumeration::ADSDV_AMI_STATE;
    assert_eq!(
        (name(older, missions, 4), name(newer, missions, 4)),
        (Some("TRACK_DRIVE"), Some("TRACK DRIVE"))
    );
    let causes = adsdv_enumeration::ADSDV_SHUTDOWN_CAUSE;
    assert_eq!((name(older, causes, 11), name(newer, causes, 11)), (None, Some("BRAKE_PLAUSIBILITY_FAULT")));
    let value = |edition, enumeration: adsdv_enumeration, name: &str| {
        let (mut value, start) = (-1, name.as_ptr().cast::<c_char>());
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe {
            adsdv_value_of_name_in(edition, enumeration as u32, start, name.len(), &raw mut value, error)
        })
        .map(|()| value)
    };
    assert_eq!(
        (value(newer, missions, "TRACK DRIVE"), value(newer, missions, "TRACK_DRIVE")),
        (Ok(4), Ok(4))
    );
    assert_eq!(value(older, missions, "TRACK_DRIVE"), Ok(4));
    assert!(value(older, missions, "TRACK DRIVE").unwrap_err().1.ends_with("7 = AUTONOMOUS_DEMO"));
    assert_eq!(value(newer, causes, "BRAKE_PLAUSIBILITY_FAULT"), Ok(11));
    assert_eq!(value(older, causes, "BRAKE_PLAUSIBILITY_FAULT").unwrap_err().0, ADSDV_UNKNOWN_NAME);
    // Each name that an edition has is found, and is its own.
    for edition in Edition::ALL {
        for enumeration in [missions, causes, adsdv_enumeration::ADSDV_AS_STATE] {
            let named = (0..32).filter_map(|raw| Some((raw, name(number(edition), enumeration, raw)?)));
            assert!(named.clone().count() >= 5);
            for (raw, named) in named {
                assert_eq!(value(number(edition), enumeration, named), Ok(raw));
            }
        }
    }
}

#[test]
fn a_reading_that_the_edition_settles_is_refused() {
    let newer = find(c"4.0").unwrap();
    let said = "readings: fault-trigger=edge is no answer in edition 4.0; expected fault-trigger=level";
    assert_eq!(machine(newer, c"fault-trigger=edge"), Err((ADSDV_UNKNOWN_NAME, said.to_owned())));
    assert!(machine(find(c"3.0").unwrap(), c"fault-trigger=edge").is_ok());
    assert!(machine(newer, c"fault-trigger=level").is_ok());
    // The readings of one edition are not those of another, though the bits may be.
    let older = machine(find(c"3.0").unwrap(), c"fault-trigger=edge").unwrap();
    let mut vcu = Vcu::of(c"4.0");
    vcu.machine = adsdv_machine { edition: newer, ..older };
    let (status, said) = vcu.step(10).map(|_| ()).unwrap_err();
    assert_eq!(status, ADSDV_BAD_VALUE);
    assert!(said.starts_with("machine.readings is 0x"), "{said}");
}

#[test]
fn a_frame_is_received_as_the_edition_has_it() {
    let frame = adsdv_frame { id: 0x511, len: 4, data: [0x9E, 0x07, 0xA0, 0x0F, 0, 0, 0, 0] };
    let newer = find(c"4.0").unwrap();
    let steer = adsdv_frame { id: 0x513, len: 2, data: [0xD3, 0, 0, 0, 0, 0, 0, 0] };
    let mut inputs = Vcu::of(c"4.0").inputs;
    inputs.drive_f_silence_ms = 90;
    let mut receive = |edition, frame: &adsdv_frame| {
        let mut taken = 9;
        let (place, frame) = (&raw mut inputs, std::ptr::from_ref(frame));
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_receive_in(edition, place, frame, &raw mut taken, error) })
            .map(|()| taken)
    };
    assert_eq!(receive(newer, &frame), Ok(1));
    let (status, said) = receive(newer, &steer).unwrap_err();
    assert_eq!(status, ADSDV_BAD_VALUE);
    assert!(said.contains("allowed: -21 to 21 deg"), "{said}");
    assert_eq!(receive(find(c"3.0").unwrap(), &steer), Ok(1));
    assert_eq!(
        (
            inputs.front_axle_trq_request,
            inputs.front_motor_speed_max,
            inputs.drive_f_silence_ms,
            inputs.steer_request
        ),
        (1950, 4000, 0, 211)
    );
}

#[test]
fn a_signal_that_4_0_added_is_read_by_it_alone() {
    let newer = find(c"4.0").unwrap();
    // BRAKE_PLAUSIBILITY_FAULT is bit 50 of 520h.
    let frame = adsdv_frame { id: 0x520, len: 8, data: [0, 0, 2, 0, 0, 0, 4, 0] };
    let name = c"BRAKE_PLAUSIBILITY_FAULT".as_ptr();
    // SAFETY: all its fields are numbers, of which 0 is one.
    let mut signal: adsdv_signal = unsafe { std::mem::zeroed() };
    let place = &raw mut signal;
    // SAFETY: the pointers are to what they are said to be.
    unsafe {
        outcome(|error| adsdv_decode_signal_in(newer, &raw const frame, name, place, error)).unwrap();
        let refused = outcome(|error| adsdv_decode_signal(&raw const frame, name, place, error));
        assert_eq!(refused.unwrap_err().0, ADSDV_UNKNOWN_NAME);
    }
    assert_eq!((signal.raw, text(&signal.name).as_str()), (1, "BRAKE_PLAUSIBILITY_FAULT"));
}
