//! Which edition of the interface is spoken of: what a caller names, and what an edition lets say.

use std::sync::LazyLock;

use adsdv_conform::protocol::{Domain, INPUTS, InputField, Protocol};
use adsdv_spec::{Choice, Choices, Control, Edition, Inputs};
use pyo3::prelude::*;

use crate::error::InputError;
use crate::value;

/// The edition where none is named: this module names it here and nowhere else.
pub(crate) const DEFAULT: &Edition = Edition::DEFAULT;

pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("INTERFACE_VERSION", DEFAULT.version)?;
    module.add_function(wrap_pyfunction!(editions, module)?)
}

/// The versions of the editions of the interface that there are, the oldest first.
///
/// Whatever depends on the edition takes one of them as `edition`; None is INTERFACE_VERSION, but for check, which
/// recognises the edition of a log.
///
/// >>> import adsdv
/// >>> adsdv.INTERFACE_VERSION, adsdv.editions()[:2]
/// ('3.0', ['3.0', '4.0'])
/// >>> adsdv.Vcu(edition="2.9") # doctest: +ELLIPSIS
/// Traceback (most recent call last):
///     ...
/// adsdv.InputError: "edition" is '2.9'; expected one of "3.0", "4.0"...
#[pyfunction]
fn editions() -> Vec<&'static str> {
    Edition::ALL.iter().map(|edition| edition.version).collect()
}

/// The edition of this version; the default for `None`.
pub(crate) fn or_default(given: Option<&Bound<'_, PyAny>>) -> PyResult<&'static Edition> {
    given.map_or(Ok(DEFAULT), named)
}

/// The edition of this version.
pub(crate) fn named(given: &Bound<'_, PyAny>) -> PyResult<&'static Edition> {
    let edition = value::text(given).and_then(|version| Edition::find(&version));
    edition.ok_or_else(|| {
        let versions: Vec<String> =
            Edition::ALL.iter().map(|edition| format!("{:?}", edition.version)).collect();
        value::refused("edition", given, format_args!("one of {}", versions.join(", ")))
    })
}

/// The inputs and outputs of an edition, with their values.
pub(crate) fn protocol(edition: &Edition) -> &'static Protocol {
    /// Those of all editions, in their order: to make one takes longer than a step.
    static PROTOCOLS: LazyLock<Vec<(&'static str, Protocol)>> = LazyLock::new(|| {
        Edition::ALL.iter().map(|edition| (edition.version, Protocol::of(edition))).collect()
    });
    /// For an edition that is not in the list, which nobody can name.
    static OTHER: Protocol = Protocol::of(DEFAULT);
    PROTOCOLS.iter().find(|(version, _)| *version == edition.version).map_or(&OTHER, |(_, protocol)| protocol)
}

/// Sets an input to what was given, if the edition has that.
pub(crate) fn set_input(
    edition: &Edition,
    inputs: &mut Inputs,
    key: &str,
    given: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let protocol = protocol(edition);
    let Some((field, domain)) = protocol.inputs().find(|(field, _)| field.key == key) else {
        return Err(unknown_input(edition, protocol, key));
    };
    let set = (field.set)(inputs, value::raw_or(key, given, domain, field.domain)?);
    if set { Ok(()) } else { Err(value::refused(key, given, domain)) }
}

fn unknown_input(edition: &Edition, protocol: &Protocol, key: &str) -> PyErr {
    let has = |field: &&InputField| field.key == key;
    let place = if INPUTS.iter().any(|field| has(&field)) {
        format!(" in edition {}", edition.version)
    } else {
        String::new()
    };
    value::unknown_key(key, &place, protocol.inputs().map(|(field, _)| field.key))
}

/// Refuses a control state that a VCU of the edition cannot be in: one with a fault that the edition does not have.
pub(crate) fn check_control(edition: &Edition, control: &Control) -> PyResult<()> {
    let cause = control.shutdown_cause;
    let Some(signal) = edition.bus.signal_of("shutdown_cause") else { return Ok(()) };
    if signal.allows(cause.raw()) {
        return Ok(());
    }
    Err(InputError::new_err(format!(
        "\"shutdown_cause\" is {:?}; expected in edition {} {}",
        cause.name(),
        edition.version,
        Domain::Names(signal.values)
    )))
}

/// The edition's choices with those that a dict of readings makes; an error where the edition does not leave one open.
pub(crate) fn pinned(edition: &Edition, pins: &[Choice]) -> PyResult<Choices> {
    match pins.iter().find(|pin| !edition.choices.has(**pin)) {
        Some(pin) => Err(refused(edition, *pin)),
        None => Ok(pins.iter().copied().fold(edition.choices, Choices::pin)),
    }
}

/// The same where the edition is not recognised yet: the choices have to be those of one edition at least.
pub(crate) fn pinned_in_some(default: &Edition, pins: &[Choice]) -> PyResult<Choices> {
    if Edition::ALL.iter().any(|edition| pins.iter().all(|pin| edition.choices.has(*pin))) {
        return Ok(pins.iter().copied().fold(default.choices, Choices::pin));
    }
    pinned(default, pins)
}

/// A choice that the edition does not leave open.
fn refused(edition: &Edition, pin: Choice) -> PyErr {
    let left: Vec<&str> = edition.choices.of_reading(pin.reading()).map(Choice::id).collect();
    InputError::new_err(format!(
        "{:?} is '{}'; expected in edition {} {}",
        pin.reading().id(),
        pin.id(),
        edition.version,
        left.join(" or ")
    ))
}
