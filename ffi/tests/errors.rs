//! Each error says what was found and what was expected; and what is wrong changes nothing.

mod common;

use std::ffi::{CStr, c_char};
use std::ptr::{null, null_mut};

use adsdv::adsdv_status::{self, *};
use adsdv::*;
use adsdv_spec::Edition;
use common::{number, outcome, text};

fn inputs() -> adsdv_inputs {
    let mut inputs = adsdv_inputs::default();
    // SAFETY: the pointer is to what it is said to be.
    outcome(|error| unsafe { adsdv_inputs_init(&raw mut inputs, error) }).unwrap();
    inputs
}

fn control() -> adsdv_control {
    let mut control = adsdv_control::default();
    // SAFETY: the pointer is to what it is said to be.
    outcome(|error| unsafe { adsdv_control_init(&raw mut control, error) }).unwrap();
    control
}

fn frame(id: u16, data: &[u8]) -> adsdv_frame {
    let mut frame = adsdv_frame { id, len: u8::try_from(data.len()).unwrap(), data: [0; 8] };
    frame.data[..data.len()].copy_from_slice(data);
    frame
}

fn refused(call: impl FnOnce(*mut adsdv_error) -> adsdv_status, status: adsdv_status, text: &str) {
    assert_eq!(outcome(call), Err((status, text.to_owned())));
}

/// A step that is refused, and changes nothing.
fn step_refused(machine: u32, control: adsdv_control, inputs: adsdv_inputs, expected: &str) {
    let machine = adsdv_machine { edition: adsdv_edition_default(), readings: machine };
    let (mut after, mut outputs) = (control, adsdv_outputs::default());
    let mut frames = [adsdv_frame::default(); ADSDV_VCU_FRAMES];
    let (shown, sent) = (&raw mut outputs, frames.as_mut_ptr());
    refused(
        // SAFETY: the pointers are to what they are said to be.
        |error| unsafe {
            adsdv_step(&raw const machine, &raw mut after, &raw const inputs, 10, shown, sent, error)
        },
        ADSDV_BAD_VALUE,
        expected,
    );
    assert_eq!((after, outputs), (control, adsdv_outputs::default()));
    assert!(frames.iter().all(|frame| *frame == adsdv_frame::default()));
}

fn reference() -> u32 {
    let mut machine = adsdv_machine { edition: 0, readings: 0 };
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_machine_init(&raw mut machine, null(), error) }).unwrap();
    machine.readings
}

#[test]
fn a_step_names_the_field() {
    let machine = reference();
    let refuse = |change: fn(&mut adsdv_inputs), text| {
        let mut inputs = inputs();
        change(&mut inputs);
        step_refused(machine, control(), inputs, text);
    };
    refuse(|inputs| inputs.asms = 2, "inputs.asms is 2; expected 0 or 1");
    refuse(|inputs| inputs.go = 255, "inputs.go is 255; expected 0 or 1");
    refuse(|inputs| inputs.ebs = 0, "inputs.ebs is 0; expected 1 = UNAVAILABLE, 2 = ARMED, 3 = TRIGGERED");
    refuse(
        |inputs| inputs.steer_angle = -241,
        "inputs.steer_angle is -241; expected -240 to 240 (-24 to 24 deg)",
    );
    refuse(|inputs| inputs.lap_counter = 16, "inputs.lap_counter is 16; expected 0 to 15");
    refuse(
        |inputs| inputs.rear_axle_trq_request = 65535,
        "inputs.rear_axle_trq_request is 65535; expected 0 to 1950 (0 to 195 Nm)",
    );
    let refuse = |change: fn(&mut adsdv_control), text| {
        let mut control = control();
        change(&mut control);
        step_refused(machine, control, inputs(), text);
    };
    refuse(|control| control.handshake_bit = 3, "control.handshake_bit is 3; expected 0 or 1");
    refuse(
        |control| control.state = 0,
        "control.state is 0; expected 1 = AS_OFF, 2 = AS_READY, 3 = AS_DRIVING, 4 = EMERGENCY_BRAKE, 5 = AS_FINISHED",
    );
    for readings in [0, 1, machine | 2, machine ^ 1, u32::MAX, 1 << 31] {
        let text = format!(
            "machine.readings is {readings:#x}; expected what adsdv_machine_init wrote: one choice of each reading"
        );
        step_refused(readings, control(), inputs(), &text);
    }
}

#[test]
fn a_list_of_readings_is_read_or_refused() {
    let mut machine = adsdv_machine { edition: 0, readings: 0 };
    // SAFETY: the pointers are to what they are said to be.
    let mut init =
        |list: &CStr| outcome(|error| unsafe { adsdv_machine_init(&raw mut machine, list.as_ptr(), error) });
    init(c"").unwrap();
    init(c" fault-trigger=edge,\tpower-cycle=not-latched, ").unwrap();
    let mut refuse = |list, status, text: &str| assert_eq!(init(list), Err((status, text.to_owned())));
    refuse(
        c"fault-trigger=slope",
        ADSDV_UNKNOWN_NAME,
        "readings: \"fault-trigger=slope\": no such choice of fault-trigger; expected one of level, edge",
    );
    refuse(
        c"go-edge=edge go-edge=edge",
        ADSDV_BAD_VALUE,
        "readings: go-edge is there twice; expected each once",
    );
    refuse(c"go-edge=\xFF", ADSDV_UNKNOWN_NAME, "readings is not UTF-8; expected text");
    let Err((_, text)) = init(c"edge") else { panic!("no reading") };
    assert!(
        text.starts_with(
            "readings: \"edge\": expected reading=choice, such as fault-trigger=edge; readings: "
        )
    );
    // A list that was refused has not changed the machine.
    let mut again = adsdv_machine { edition: 0, readings: 0 };
    let list = c"power-cycle=not-latched fault-trigger=edge";
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_machine_init(&raw mut again, list.as_ptr(), error) }).unwrap();
    assert_eq!(machine, again);
}

#[test]
fn a_frame_is_received_or_refused() {
    let receive = |inputs: &mut adsdv_inputs, frame: adsdv_frame, taken: &mut u8| {
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_receive(inputs, &raw const frame, taken, error) })
    };
    let (mut inputs, mut taken) = (inputs(), 9);
    receive(&mut inputs, frame(0x513, &[0x9C, 0xFF]), &mut taken).unwrap();
    assert_eq!((inputs.steer_request, taken), (-100, 1));
    receive(&mut inputs, frame(0x520, &[]), &mut taken).unwrap();
    assert_eq!(taken, 0);
    let before = inputs;
    for (frame, status, text) in [
        (
            frame(0x513, &[0xF1, 0x00]),
            ADSDV_BAD_VALUE,
            "AI2VCU_Steer (513h): STEER_REQUEST_deg is 24.1 deg (raw 241), allowed: -24 to 24 deg (raw -240 to 240)",
        ),
        (
            frame(0x513, &[0xF1]),
            ADSDV_TOO_SHORT,
            "AI2VCU_Steer (513h) has 1 bytes, needs 2: STEER_REQUEST_deg is the first signal that does not fit",
        ),
        (
            adsdv_frame { id: 0x513, len: 9, data: [0; 8] },
            ADSDV_BAD_VALUE,
            "frame.len is 9; expected at most 8",
        ),
    ] {
        assert_eq!(receive(&mut inputs, frame, &mut taken), Err((status, text.to_owned())));
        assert_eq!(inputs, before);
    }
    // What was wrong before stays wrong, and is named.
    inputs.ami = 8;
    assert!(
        receive(&mut inputs, frame(0x513, &[0, 0]), &mut taken)
            .unwrap_err()
            .1
            .starts_with("inputs.ami is 8;")
    );
}

#[test]
fn names_are_found_or_refused() {
    let find = |enumeration, name: &str| {
        let mut value = -1;
        let start = name.as_ptr().cast::<c_char>();
        // SAFETY: the pointers are to what they are said to be.
        let call =
            |error| unsafe { adsdv_value_of_name(enumeration, start, name.len(), &raw mut value, error) };
        outcome(call).map(|()| value)
    };
    assert_eq!(find(0, "AS_READY"), Ok(2));
    assert_eq!(find(6, "BMS FAULT"), Ok(10));
    assert_eq!(
        find(4, "NEUTRALLY"),
        Err((
            ADSDV_UNKNOWN_NAME,
            "\"NEUTRALLY\" is no name of a value; expected 0 = NEUTRAL, 1 = FORWARD".into()
        ))
    );
    assert!(find(4, "").is_err());
    let unknown = "enumeration is 7; expected one of adsdv_enumeration";
    assert_eq!(find(7, "NEUTRAL"), Err((ADSDV_BAD_VALUE, unknown.to_owned())));
    assert!(adsdv_value_name(7, 0).is_null() && adsdv_value_name(0, 0).is_null());
    for enumeration in 0..7 {
        let names = (-1..20).filter(|&value| {
            let name = adsdv_value_name(enumeration, value);
            if name.is_null() {
                return false;
            }
            // SAFETY: the library's texts end with a NUL.
            let name = unsafe { CStr::from_ptr(name) }.to_str().unwrap();
            assert_eq!(find(enumeration, name), Ok(value));
            true
        });
        assert!(names.count() >= 2);
    }
}

/// The longest text fits, and one that does not is cut between characters, with its NUL.
#[test]
fn texts_are_cut_where_they_do_not_fit() {
    let long = format!("{}é", "x".repeat(2 * ADSDV_ERROR_TEXT));
    for skip in 0..4 {
        let list = std::ffi::CString::new(long.as_bytes()[skip..].to_vec()).unwrap();
        let mut machine = adsdv_machine { edition: 0, readings: 0 };
        // SAFETY: the pointers are to what they are said to be.
        let call = |error| unsafe { adsdv_machine_init(&raw mut machine, list.as_ptr(), error) };
        assert_eq!(outcome(call).unwrap_err().1.len(), ADSDV_ERROR_TEXT - 1);
    }
    let accents = std::ffi::CString::new("é".repeat(ADSDV_ERROR_TEXT)).unwrap();
    let mut machine = adsdv_machine { edition: 0, readings: 0 };
    // SAFETY: the pointers are to what they are said to be.
    let call = |error| unsafe { adsdv_machine_init(&raw mut machine, accents.as_ptr(), error) };
    assert!(outcome(call).unwrap_err().1.len() >= ADSDV_ERROR_TEXT - 2);
    // The list of all causes is the longest of the errors that name what is allowed.
    let mut control = control();
    control.shutdown_cause = 200;
    for edition in Edition::ALL {
        let mut error = common::no_error();
        let mut machine = adsdv_machine { edition: 0, readings: 0 };
        // SAFETY: the pointers are to what they are said to be, or NULL.
        unsafe {
            let (inputs, error) = (inputs(), &raw mut error);
            adsdv_machine_init_in(number(edition), &raw mut machine, null(), error);
            let vcu = &raw const machine;
            adsdv_step(vcu, &raw mut control, &raw const inputs, 0, null_mut(), null_mut(), error);
        }
        let causes = edition.bus.signal_of("shutdown_cause").unwrap().values;
        let (raw, name) = causes.last().unwrap();
        assert!(text(&error.text).ends_with(&format!("{raw} = {name}")), "{}", text(&error.text));
    }
}

#[test]
fn versions_are_returned() {
    // SAFETY: the library's texts end with a NUL.
    let (library, document) =
        unsafe { (CStr::from_ptr(adsdv_version()), CStr::from_ptr(adsdv_document_version())) };
    assert_eq!(library.to_str(), Ok(env!("CARGO_PKG_VERSION")));
    assert_eq!(document, c"3.0");
}
