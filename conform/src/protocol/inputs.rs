//! The inputs of a step that a program under test gets: everything that decides what it shows.

use adsdv_spec::messages::SignalValue;
use adsdv_spec::{Bus, Edition, Inputs};

use super::field::Domain;
use super::unsaid::UNSAID;

/// One input.
#[derive(Clone, Copy, Debug)]
pub struct InputField {
    /// Its key.
    pub key: &'static str,
    /// Its values in the edition that a program speaks of [where nobody says](UNSAID), or, where that does not have it, those
    /// of its type; those of another edition are in its [`Protocol`](super::Protocol).
    pub domain: Domain,
    /// The values of its type, which are those of all editions.
    pub(super) of_type: Domain,
    /// What it is of: the part of [`Inputs`] that it stands in, such as `ai.status`; empty for the inputs themselves.
    pub part: &'static str,
    /// The unit of a number, with the size of one raw step, such as `0.1 deg`; empty where there is none.
    pub unit: fn() -> String,
    /// Its raw value.
    pub get: fn(&Inputs) -> i32,
    /// Sets it to a raw value; false if that is none of its values in any edition.
    pub set: fn(&mut Inputs, i32) -> bool,
}

impl InputField {
    /// The input with this key. One that there is not does not compile where a constant asks for it.
    pub(crate) const fn of(key: &str) -> &'static Self {
        let mut i = 0;
        while !INPUTS[i].key.eq_ignore_ascii_case(key) {
            i += 1;
        }
        &INPUTS[i]
    }

    /// Whether an edition has it: that a message is missing is an input only where there is a limit to that.
    pub const fn is_in(&self, edition: &Edition) -> bool {
        !is_silence(self.part) || edition.rules.thresholds.missed_ms.is_some()
    }

    /// Its values in an edition; `None` where that does not have it.
    pub(super) const fn domain_in(&self, edition: &Edition) -> Option<Domain> {
        if self.is_in(edition) { Some(on_bus(self.of_type, self.key, &edition.bus)) } else { None }
    }

    /// Its values in the words of a bus.
    pub(super) const fn domain_on(&self, bus: &Bus) -> Domain {
        on_bus(self.of_type, self.key, bus)
    }
}

/// Whether a part is how long messages have been missing.
const fn is_silence(part: &str) -> bool {
    matches!(part.as_bytes(), b"ai_silence")
}

/// The values of the input with this key, with the range or the names that a bus gives to its signal.
const fn on_bus(of_type: Domain, key: &str, bus: &Bus) -> Domain {
    // The bus shows the mission that is selected under another name.
    let field = if matches!(key.as_bytes(), b"ami") { "ami_state" } else { key };
    of_type.on_bus(field, bus)
}

const fn domain_of<T: SignalValue>(_: fn(&Inputs) -> &T) -> Domain {
    Domain::of::<T>()
}

fn unit_of<T: SignalValue>(part: &str, _: fn(&Inputs) -> &T) -> String {
    if is_silence(part) {
        return "1 ms".to_owned();
    }
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
        /// Every input of any edition, in the order in which a request has them. What a request does not have is at its
        /// default: off, 0, or the first of the names.
        pub const INPUTS: &[InputField] = &[$(
            InputField {
                key: stringify!($field),
                domain: on_bus(domain_of(|inputs| &at!(inputs $part $field)), stringify!($field), &UNSAID.bus),
                of_type: domain_of(|inputs| &at!(inputs $part $field)),
                part: name!($part),
                unit: || unit_of(name!($part), |inputs| &at!(inputs $part $field)),
                get: |inputs| SignalValue::to_raw(at!(inputs $part $field)),
                set: |inputs, raw| match SignalValue::from_raw(raw) {
                    Some(value) => {
                        at!(inputs $part $field) = value;
                        true
                    }
                    None => false,
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
    (ai_silence) => status_silence_ms drive_f_silence_ms drive_r_silence_ms steer_silence_ms brake_silence_ms;
    (vehicle) => steer_angle;
    (vehicle.wheel_speeds) => fl_wheel_speed fr_wheel_speed rl_wheel_speed rr_wheel_speed;
}
