//! The names of the values of the enumerations, both ways.

use core::ffi::c_char;

use adsdv_spec::messages::{
    AmiState, AsState, DirectionRequest, EbsState, MissionStatus, ServiceBrake, ShutdownCause, SignalValue,
};

use crate::border::{answer, out, slice};
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::plain::Allowed;
use crate::text;

/// The enumerations of the interface.
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

/// The names of a type's values, with a NUL at the end of each.
const fn names<T: SignalValue, const COUNT: usize>() -> [Named; COUNT] {
    let mut rows = [(0, [0; NAME]); COUNT];
    let mut i = 0;
    while i < COUNT {
        let (value, name) = T::VALUES[i];
        rows[i] = (value, text::known(name));
        i += 1;
    }
    rows
}

/// What is known of an enumeration.
struct Enumeration {
    names: &'static [Named],
    allowed: Allowed,
}

macro_rules! enumerations {
    ($($constant:ident = $type:ident;)+) => {
        /// The enumeration with this number.
        fn enumeration(number: u32) -> Option<Enumeration> {
            $(
                if number == adsdv_enumeration::$constant as u32 {
                    static NAMES: [Named; <$type as SignalValue>::VALUES.len()] = names::<$type, _>();
                    return Some(Enumeration { names: &NAMES, allowed: Allowed::of::<$type>() });
                }
            )+
            None
        }
    };
}

enumerations! {
    ADSDV_AS_STATE = AsState;
    ADSDV_AMI_STATE = AmiState;
    ADSDV_EBS_STATE = EbsState;
    ADSDV_MISSION_STATUS = MissionStatus;
    ADSDV_DIRECTION = DirectionRequest;
    ADSDV_SERVICE_BRAKE = ServiceBrake;
    ADSDV_SHUTDOWN_CAUSE = ShutdownCause;
}

/// The document's name of a value, such as "AS_READY" for 2 of ADSDV_AS_STATE; NULL if the value has none, or there is
/// no such enumeration. The text is the library's, and stays.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_value_name(enumeration: u32, value: i32) -> *const c_char {
    let names = self::enumeration(enumeration).map(|enumeration| enumeration.names).unwrap_or_default();
    let name = names.iter().find(|(number, _)| *number == value);
    name.map_or(core::ptr::null(), |(_, name)| name.as_ptr())
}

/// The value of a name, such as 2 for "AS_READY" of ADSDV_AS_STATE. The name has `length` bytes, and needs no NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_value_of_name(
    enumeration: u32,
    name: *const c_char,
    length: usize,
    value: *mut i32,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for `length` bytes and for the value.
        let (name, value) = unsafe { (slice(name.cast::<u8>(), length, "name")?, out(value, "value")?) };
        let Some(Enumeration { allowed, .. }) = self::enumeration(enumeration) else {
            return Err(Refusal::NoEnumeration(enumeration));
        };
        let given = core::str::from_utf8(name).map_err(|_| Refusal::NotText("name"))?;
        match allowed.values.iter().find(|(_, name)| *name == given) {
            Some(&(number, _)) => value.set(number),
            None => return Err(Refusal::NoSuchValue { given, allowed }),
        }
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
