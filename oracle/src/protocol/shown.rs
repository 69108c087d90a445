//! What a step shows: the signals of 520h, and what reaches the actuators.

use std::fmt;

use adsdv_spec::messages::{SignalValue, Vcu2AiStatus};
use adsdv_spec::{Actuation, Inputs, Outputs};

use super::field::{Domain, Value};

/// Something that a step shows.
#[derive(Clone, Copy, Debug)]
pub struct ShownField {
    /// Its key.
    pub key: &'static str,
    /// Its values. `null` is one more for what is sometimes not there.
    pub domain: Domain,
    /// Whether `null` is one of its values.
    pub nullable: bool,
    /// Its raw value.
    get: fn(&Vcu2AiStatus, &Actuation) -> Option<i32>,
}

const fn domain_of<T: SignalValue>(_: fn(&Vcu2AiStatus, &Actuation) -> Option<T>) -> Domain {
    Domain::of::<T>()
}

macro_rules! shown {
    ($(
        $source:ident => $($field:ident)+ $(, or null $nullable:ident)?;
    )+) => {
        /// Everything that a step shows, in the order in which an answer of this crate has it.
        pub const SHOWN: [ShownField; [$($(stringify!($field),)+ $(stringify!($nullable),)?)+].len()] = [$(
            $(
                ShownField {
                    key: stringify!($field),
                    domain: domain_of(|status, actuation| Some(from!($source status actuation).$field)),
                    nullable: false,
                    get: |status, actuation| Some(SignalValue::to_raw(from!($source status actuation).$field)),
                },
            )+
            $(
                ShownField {
                    key: stringify!($nullable),
                    domain: domain_of(|status, actuation| from!($source status actuation).$nullable)
                        .on_the_bus("steer_request"),
                    nullable: true,
                    get: |status, actuation| {
                        from!($source status actuation).$nullable.map(SignalValue::to_raw)
                    },
                },
            )?
        )+];
    };
}

macro_rules! from {
    (status $status:ident $actuation:ident) => {{
        let _ = $actuation;
        $status
    }};
    (actuation $status:ident $actuation:ident) => {{
        let _ = $status;
        $actuation
    }};
}

shown! {
    status => as_state handshake go_signal steering_status shutdown_cause
        as_switch_status ts_switch_status ami_state shutdown_request
        fault_status ai_estop_request hvil_open_fault hvil_short_fault ebs_fault offboard_charger_fault
        ai_comms_lost autonomous_braking_fault mission_status_fault charge_procedure_fault bms_fault
        warning_status warn_batt_temp_high warn_batt_soc_low;
    actuation => front_axle_trq front_motor_speed_max rear_axle_trq rear_motor_speed_max direction
        hyd_press_f hyd_press_r ebs_triggered, or null steer;
}

/// What a step shows, field by field as in [`SHOWN`]. It displays as a JSON object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shown(pub(super) [Option<i32>; SHOWN.len()]);

impl Shown {
    /// What a step of the specification shows.
    pub fn of(outputs: &Outputs, inputs: &Inputs) -> Self {
        let (status, actuation) = (outputs.messages(inputs).status, outputs.actuation(inputs));
        Self(SHOWN.map(|field| (field.get)(&status, &actuation)))
    }

    /// The value of a field; `None` if there is no such field.
    pub fn get(&self, key: &str) -> Option<Value> {
        let place = SHOWN.iter().position(|field| field.key == key)?;
        Some(Value { domain: SHOWN.get(place)?.domain, raw: *self.0.get(place)? })
    }

    /// Each field with its value.
    pub fn iter(&self) -> impl Iterator<Item = (&'static ShownField, Value)> {
        static FIELDS: [ShownField; SHOWN.len()] = SHOWN;
        let values = self.0;
        FIELDS.iter().zip(values).map(|(field, raw)| (field, Value { domain: field.domain, raw }))
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (field, value)) in self.iter().enumerate() {
            write!(f, "{}\"{}\":", if place == 0 { "{" } else { "," }, field.key)?;
            value.write_json(f)?;
        }
        f.write_str("}")
    }
}
