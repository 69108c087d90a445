//! What a step shows: the signals of 520h, and what reaches the actuators.

use std::fmt;

use adsdv_spec::messages::{SignalValue, Vcu2AiStatus};
use adsdv_spec::{Actuation, Bus, Edition, Fault, Inputs, Outputs};

use super::UNSAID;
use super::field::{Domain, Value, Words};
use super::inputs::InputField;

/// Something that a step shows.
#[derive(Clone, Copy, Debug)]
pub struct ShownField {
    /// Its key.
    pub key: &'static str,
    /// Its values in the edition that a program speaks of [where nobody says](UNSAID), or, where that does not have it, those
    /// of its type; those of another edition are in its [`Protocol`](super::Protocol). `null` is one more for what is
    /// sometimes not there.
    pub domain: Domain,
    /// The values of its type, which are those of all editions.
    pub(super) of_type: Domain,
    /// The field of a message whose values these are, if one has them.
    pub(super) signal: &'static str,
    /// Whether `null` is one of its values.
    pub nullable: bool,
    /// The fault whose flag it is.
    pub fault: Option<Fault>,
    /// Its raw value.
    get: fn(&Vcu2AiStatus, &Actuation) -> Option<i32>,
}

impl ShownField {
    /// Whether an edition has it: the flag of a fault only where there is that fault.
    pub const fn is_in(&self, edition: &Edition) -> bool {
        match self.fault {
            Some(fault) => edition.faults.has(fault),
            None => true,
        }
    }

    /// Its values in an edition; `None` where that does not have it.
    pub(super) const fn domain_in(&self, edition: &Edition) -> Option<Domain> {
        if self.is_in(edition) { Some(self.domain_on(&edition.bus)) } else { None }
    }

    /// Its values in the words of a bus.
    pub(super) const fn domain_on(&self, bus: &Bus) -> Domain {
        self.of_type.on_bus(self.signal, bus)
    }
}

/// The fault whose flag has this key: the name of its signal, in small letters.
const fn fault_of(key: &str) -> Option<Fault> {
    let mut i = 0;
    while i < Fault::ALL.len() {
        if Fault::ALL[i].flag().eq_ignore_ascii_case(key) {
            return Some(Fault::ALL[i]);
        }
        i += 1;
    }
    None
}

const fn domain_of<T: SignalValue>(_: fn(&Vcu2AiStatus, &Actuation) -> Option<T>) -> Domain {
    Domain::of::<T>()
}

macro_rules! shown {
    ($(
        $source:ident => $($field:ident)+ $(, or null $nullable:ident)?;
    )+) => {
        /// Everything that a step shows in any edition, in the order in which an answer of this crate has it.
        pub const SHOWN: [ShownField; [$($(stringify!($field),)+ $(stringify!($nullable),)?)+].len()] = [$(
            $(
                ShownField {
                    key: stringify!($field),
                    domain: domain_of(|status, actuation| Some(from!($source status actuation).$field))
                        .on_bus(signal!($source $field), &UNSAID.bus),
                    of_type: domain_of(|status, actuation| Some(from!($source status actuation).$field)),
                    signal: signal!($source $field),
                    nullable: false,
                    fault: fault_of(stringify!($field)),
                    get: |status, actuation| Some(SignalValue::to_raw(from!($source status actuation).$field)),
                },
            )+
            $(
                ShownField {
                    key: stringify!($nullable),
                    domain: domain_of(|status, actuation| from!($source status actuation).$nullable)
                        .on_bus("steer_request", &UNSAID.bus),
                    of_type: domain_of(|status, actuation| from!($source status actuation).$nullable),
                    signal: "steer_request",
                    nullable: true,
                    fault: None,
                    get: |status, actuation| {
                        from!($source status actuation).$nullable.map(SignalValue::to_raw)
                    },
                },
            )?
        )+];
    };
}

/// The field of 520h whose values these are. What reaches the actuators is named as what is measured there, and is not that.
macro_rules! signal {
    (status $field:ident) => {
        stringify!($field)
    };
    (actuation $field:ident) => {
        ""
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
        brake_plausibility_fault
        warning_status warn_batt_temp_high warn_batt_soc_low;
    actuation => front_axle_trq front_motor_speed_max rear_axle_trq rear_motor_speed_max direction
        hyd_press_f hyd_press_r ebs_triggered, or null steer;
}

/// The same, where they stay.
pub(super) static FIELDS: [ShownField; SHOWN.len()] = SHOWN;

/// What a step shows, field by field as in [`SHOWN`]. It displays as a JSON object, in the words of its edition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shown {
    /// The values. What is never `null` and has none is not in the edition.
    pub(super) raw: [Option<i32>; SHOWN.len()],
    pub(super) words: Words,
}

impl Shown {
    /// What a step of an edition's specification shows.
    pub fn of(edition: &Edition, outputs: &Outputs, inputs: &Inputs) -> Self {
        let (status, actuation) = (outputs.messages(inputs).status, outputs.actuation(inputs));
        let raw =
            |field: ShownField| if field.is_in(edition) { (field.get)(&status, &actuation) } else { None };
        Self { raw: SHOWN.map(raw), words: Words(edition.bus) }
    }

    /// The value of a field; `None` if there is no such field.
    pub fn get(&self, key: &str) -> Option<Value> {
        self.iter().find(|(field, _)| field.key == key).map(|(_, value)| value)
    }

    /// Each field that the edition has, with its value.
    pub fn iter(&self) -> impl Iterator<Item = (&'static ShownField, Value)> {
        let Self { raw, words } = *self;
        let there = FIELDS.iter().zip(raw).filter(|(field, raw)| field.nullable || raw.is_some());
        there.map(move |(field, raw)| (field, Value { domain: field.domain_on(&words.0), raw }))
    }

    /// A value of an input, in the same words.
    pub(crate) fn input(&self, field: &InputField, inputs: &Inputs) -> Value {
        Value { domain: field.domain_on(&self.words.0), raw: Some((field.get)(inputs)) }
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
