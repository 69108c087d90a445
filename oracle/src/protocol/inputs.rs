//! The inputs of a step that a program under test is told: everything that decides what it shows.

use adsdv_spec::messages::{SignalDef, SignalValue};
use adsdv_spec::{Bus, Edition, Inputs};

use super::field::Domain;

/// One input.
#[derive(Clone, Copy, Debug)]
pub struct InputField {
    /// Its key.
    pub key: &'static str,
    /// Its values.
    pub domain: Domain,
    /// What it is of: the part of [`Inputs`] that it stands in, such as `ai.status`; empty for the inputs themselves.
    pub part: &'static str,
    /// The unit of a number, with the size of one raw step, such as `0.1 deg`; empty where there is none.
    pub unit: fn() -> String,
    /// Its raw value.
    pub get: fn(&Inputs) -> i32,
    /// Sets it to a raw value; false if that is none of its values.
    pub set: fn(&mut Inputs, i32) -> bool,
}

const fn domain_of<T: SignalValue>(_: fn(&Inputs) -> &T) -> Domain {
    Domain::of::<T>()
}

const BUS: &Bus = &Edition::DEFAULT.bus;

/// Whether a raw value is in the range that the edition gives to a signal.
fn in_range(raw: i32, signal: Option<&SignalDef>) -> bool {
    signal.is_none_or(|signal| (signal.min..=signal.max).contains(&raw))
}

fn unit_of<T: SignalValue>(_: fn(&Inputs) -> &T) -> String {
    if T::UNIT.is_empty() { String::new() } else { format!("{} {}", T::SCALE, T::UNIT) }
}

/// A field of some part of the inputs.
macro_rules! at {
    ($inputs:ident () $field:ident) => { $inputs.$field };
    ($inputs:ident ($($part:ident).+) $field:ident) => { $inputs.$($part).+.$field };
}

/// The name of a part.
macro_rules! name {
    (()) => {
        ""
    };
    (($part:ident)) => {
        stringify!($part)
    };
    (($part:ident.$inner:ident)) => {
        concat!(stringify!($part), ".", stringify!($inner))
    };
}

macro_rules! inputs {
    // Each field beside its part.
    ($($part:tt => $($field:ident)+;)+) => {
        inputs! { @fields [] $($part => $($field)+;)+ }
    };
    (@fields [$($done:tt)*] $part:tt => $field:ident $($more:ident)+; $($rest:tt)*) => {
        inputs! { @fields [$($done)* $part $field,] $part => $($more)+; $($rest)* }
    };
    (@fields [$($done:tt)*] $part:tt => $field:ident; $($rest:tt)*) => {
        inputs! { @fields [$($done)* $part $field,] $($rest)* }
    };
    (@fields [$($part:tt $field:ident,)+]) => {
        /// Every input, in the order in which a request has them. What a request does not have is at its default: off, 0,
        /// or the first of the names.
        pub const INPUTS: &[InputField] = &[$(
            InputField {
                key: stringify!($field),
                domain: domain_of(|inputs| &at!(inputs $part $field)).on_the_bus(stringify!($field)),
                part: name!($part),
                unit: || unit_of(|inputs| &at!(inputs $part $field)),
                get: |inputs| SignalValue::to_raw(at!(inputs $part $field)),
                set: |inputs, raw| match SignalValue::from_raw(raw) {
                    Some(value) if in_range(raw, const { BUS.signal_of(stringify!($field)) }) => {
                        at!(inputs $part $field) = value;
                        true
                    }
                    _ => false,
                },
            },
        )+];
    };
}

inputs! {
    () => asms tsms ami ebs go;
    (sdc) => remote_estop res_link_lost vehicle_estop crash_sensor critical_fault bms_fault mpp_dongle_removed;
    (reports) => hvil_open hvil_short ebs_fault offboard_charger_fault charging batt_temp_high batt_soc_low;
    (ai.status) => handshake estop_request mission_status direction_request;
    (ai.drive_f) => front_axle_trq_request front_motor_speed_max;
    (ai.drive_r) => rear_axle_trq_request rear_motor_speed_max;
    (ai.steer) => steer_request;
    (ai.brake) => hyd_press_f_req hyd_press_r_req;
    (vehicle) => steer_angle;
    (vehicle.wheel_speeds) => fl_wheel_speed fr_wheel_speed rl_wheel_speed rr_wheel_speed;
}
