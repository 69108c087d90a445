//! The inputs that can be changed, and to which values.

use adsdv_conform::protocol::{Domain, InputField, Protocol};

use crate::interface::Interface;
use crate::model::Model;

/// An input, with the values of it that are worth trying.
#[derive(Clone, Debug)]
pub(crate) struct Dial {
    pub(crate) field: &'static InputField,
    pub(crate) values: Vec<i32>,
}

/// Every input that a program has, but for the handshake, which follows the program's own bit.
pub(crate) fn dials(model: &Model, interface: &Interface) -> Vec<Dial> {
    let edition = model.machine().edition();
    let protocol = Protocol::of(edition);
    let inputs = protocol.inputs().filter(|(field, _)| field.key != "handshake" && interface.has(field.key));
    let of =
        |(field, domain): (&'static InputField, Domain)| Dial { field, values: values(model, field, domain) };
    inputs.map(of).collect()
}

/// The values of an input that are worth trying: all, or those around a number where something may begin to count.
fn values(model: &Model, field: &InputField, domain: Domain) -> Vec<i32> {
    let thresholds = &model.machine().edition().rules.thresholds;
    let (min, max) = match domain {
        Domain::Flag => return vec![0, 1],
        Domain::Names(names) => return names.iter().map(|(raw, _)| *raw).collect(),
        Domain::Number { min, max } => (min, max),
    };
    let around: Vec<i32> = if field.key.ends_with("wheel_speed") {
        let limit = thresholds.wheel_speed.raw();
        vec![0, limit - 1, limit, limit + 1, max]
    } else if field.key == "steer_angle" {
        let limit = thresholds.straight.raw();
        vec![0, limit - 1, limit, 1 - limit, -limit, max]
    } else if let (true, Some(limit)) = (field.part == "ai_silence", thresholds.missed_ms) {
        let limit = i32::from(limit);
        vec![0, limit - 1, limit, limit + 1]
    } else {
        vec![0, 1, max]
    };
    let mut values: Vec<i32> = around.into_iter().map(|raw| raw.clamp(min, max)).collect();
    values.sort_unstable();
    values.dedup();
    values
}
