//! The names of the values of the enumerations, both ways.

use core::ffi::c_char;

use adsdv_spec::Edition;
use adsdv_spec::messages::{
    AmiState, AsState, DirectionRequest, EbsState, MissionStatus, ServiceBrake, ShutdownCause, SignalValue,
};

use crate::allowed::Allowed;
use crate::border::{answer, out, slice};
use crate::edition::{self, EDITION, adsdv_edition};
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::text;

/// The enumerations of the interface. Their numbers say the same in all editions; their names need not.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_enumeration {
    /// See adsdv_as_state.
    ADSDV_AS_STATE = 0,
    /// See adsdv_ami_state.
    ADSDV_AMI_STATE = 1,
    /// See adsdv_ebs_state.
    ADSDV_EBS_STATE = 2,
    /// See adsdv_mission_status.
    ADSDV_MISSION_STATUS = 3,
    /// See adsdv_direction.
    ADSDV_DIRECTION = 4,
    /// See adsdv_service_brake.
    ADSDV_SERVICE_BRAKE = 5,
    /// See adsdv_shutdown_cause.
    ADSDV_SHUTDOWN_CAUSE = 6,
}

/// The room for a name and its NUL: enough for the longest.
const NAME: usize = 32;

/// A value and its name.
type Named = (i32, [c_char; NAME]);

/// The most values that an enumeration has.
const MOST: usize = 16;

/// The names of a type's values in an edition, each with a NUL at its end: those of the signal that this field has there.
#[derive(Clone, Copy)]
struct Names {
    rows: [Named; MOST],
    count: usize,
}

impl Names {
    const fn of<T: SignalValue>(edition: &Edition, field: &str) -> Self {
        let values = match edition.bus.signal_of(field) {
            Some(signal) if !signal.values.is_empty() => signal.values,
            _ => T::VALUES,
        };
        assert!(values.len() <= MOST, "there is no room for all the names");
        let mut names = Self { rows: [(0, [0; NAME]); MOST], count: values.len() };
        let mut i = 0;
        while i < values.len() {
            names.rows[i] = (values[i].0, text::known(values[i].1));
            i += 1;
        }
        names
    }

    /// Edition by edition.
    const fn of_all<T: SignalValue>(field: &str) -> [Self; edition::COUNT] {
        let mut all = [Self { rows: [(0, [0; NAME]); MOST], count: 0 }; edition::COUNT];
        let mut number = 0;
        while number < edition::COUNT {
            all[number] = Self::of::<T>(Edition::ALL[number], field);
            number += 1;
        }
        all
    }

    fn of_value(&self, value: i32) -> Option<&[c_char; NAME]> {
        self.rows.iter().take(self.count).find(|(number, _)| *number == value).map(|(_, name)| name)
    }
}

/// What is known of an enumeration.
struct Enumeration {
    names: &'static [Names; edition::COUNT],
    /// The field whose signal has the values.
    field: &'static str,
    allowed: Allowed,
}

impl Enumeration {
    /// What an edition has of it.
    fn allowed(&self, edition: &Edition) -> Allowed {
        self.allowed.on_bus(edition.bus.signal_of(self.field))
    }
}

macro_rules! enumerations {
    ($($constant:ident = $type:ident of $field:literal;)+) => {
        /// The enumeration with this number.
        fn enumeration(number: u32) -> Option<Enumeration> {
            $(
                if number == adsdv_enumeration::$constant as u32 {
                    static NAMES: [Names; edition::COUNT] = Names::of_all::<$type>($field);
                    return Some(Enumeration { names: &NAMES, field: $field, allowed: Allowed::of::<$type>() });
                }
            )+
            None
        }
    };
}

enumerations! {
    ADSDV_AS_STATE = AsState of "as_state";
    ADSDV_AMI_STATE = AmiState of "ami_state";
    ADSDV_EBS_STATE = EbsState of "state_ebs";
    ADSDV_MISSION_STATUS = MissionStatus of "mission_status";
    ADSDV_DIRECTION = DirectionRequest of "direction_request";
    ADSDV_SERVICE_BRAKE = ServiceBrake of "state_service_brake";
    ADSDV_SHUTDOWN_CAUSE = ShutdownCause of "shutdown_cause";
}

/// The default edition's name of a value, such as "AS_READY" for 2 of ADSDV_AS_STATE; NULL if the value has none, or there is
/// no such enumeration. The text is the library's, and stays.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_value_name(enumeration: u32, value: i32) -> *const c_char {
    adsdv_value_name_in(edition::DEFAULT, enumeration, value)
}

/// An edition's name of a value, likewise; NULL if there is no such edition.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_value_name_in(edition: adsdv_edition, enumeration: u32, value: i32) -> *const c_char {
    let names = self::enumeration(enumeration).map(|enumeration| enumeration.names);
    let name = names.and_then(|names| names.get(edition::place(edition))?.of_value(value));
    name.map_or(core::ptr::null(), |name| name.as_ptr())
}

/// The value of a name of the default edition, such as 2 for "AS_READY" of ADSDV_AS_STATE. The name has `length` bytes, and
/// needs no NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_value_of_name(
    enumeration: u32,
    name: *const c_char,
    length: usize,
    value: *mut i32,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_value_of_name_in(edition::DEFAULT, enumeration, name, length, value, error) }
}

/// The value of a name in an edition, likewise. The default edition's name for a value that the edition has is understood.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_value_of_name_in(
    edition: adsdv_edition,
    enumeration: u32,
    name: *const c_char,
    length: usize,
    value: *mut i32,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let edition = edition::given(edition, "")?;
        // SAFETY: the caller promises it for `length` bytes and for the value.
        let (name, value) = unsafe { (slice(name.cast::<u8>(), length, "name")?, out(value, "value")?) };
        let Some(enumeration) = self::enumeration(enumeration) else {
            return Err(Refusal::NoEnumeration(enumeration));
        };
        let given = core::str::from_utf8(name).map_err(|_| Refusal::NotText("name"))?;
        let allowed = enumeration.allowed(edition);
        let of = |allowed: Allowed| allowed.values.iter().find(|(_, name)| *name == given);
        let has = |number: i32| allowed.values.iter().any(|(allowed, _)| *allowed == number);
        let by_default = || of(enumeration.allowed(EDITION)).filter(|(number, _)| has(*number));
        match of(allowed).or_else(by_default) {
            Some(&(number, _)) => value.set(number),
            None => return Err(Refusal::NoSuchValue { given, allowed }),
        }
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
