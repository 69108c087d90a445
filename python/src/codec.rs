//! The codec: `decode`, `encode`, the frames of a step, and the reserved identifiers.

use adsdv_spec::Edition;
use adsdv_spec::messages::{Decimal, DecodeError, Frame, MessageDef, Scale, SignalDef};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyFloat, PyInt};

use crate::edition;
use crate::error::CodecError;
use crate::step::Step;
use crate::value;

pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(decode, module)?)?;
    module.add_function(wrap_pyfunction!(encode, module)?)?;
    module.add_function(wrap_pyfunction!(frames, module)?)?;
    module.add_function(wrap_pyfunction!(is_reserved, module)?)
}

pub(crate) fn error(error: &DecodeError) -> PyErr {
    CodecError::new_err(error.to_string())
}

/// Reads the data of a frame with this identifier.
///
/// The answer is a dict: the message's "name", "id" and "sender" ("AI" or "VCU"); its "signals" in physical units; the same
/// "raw", as on the bus; and the "names" of those values that have one. Data that is no message of the edition, is too
/// short, or has a signal with a value that the edition does not allow, is a CodecError.
///
/// edition: one of adsdv.editions(); None for adsdv.INTERFACE_VERSION.
///
/// >>> import adsdv
/// >>> adsdv.decode(0x513, bytes.fromhex("9CFF"))
/// {'name': 'AI2VCU_Steer', 'id': 1299, 'sender': 'AI', 'signals': {'STEER_REQUEST_deg': -10.0}, 'raw': {'STEER_REQUEST_deg': -100}, 'names': {}}
/// >>> adsdv.decode(0x520, bytes.fromhex("0000020000000000"))["names"]["AS_STATE"]
/// 'AS_READY'
/// >>> adsdv.decode(0x513, bytes.fromhex("F100"))
/// Traceback (most recent call last):
///     ...
/// adsdv.CodecError: AI2VCU_Steer (513h): STEER_REQUEST_deg is 24.1 deg (raw 241), allowed: -24 to 24 deg (raw -240 to 240)
/// >>> adsdv.decode(0x511, bytes(4), edition="4.0")["signals"]
/// {'FRONT_AXLE_TRQ_REQUEST': 0.0, 'FRONT_MOTOR_SPEED_MAX': 0}
#[pyfunction]
#[pyo3(signature = (id, data, edition=None))]
fn decode<'py>(
    py: Python<'py>,
    id: &Bound<'py, PyAny>,
    data: &Bound<'py, PyAny>,
    edition: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let edition = edition::or_default(edition)?;
    let (id, data) = (value::id(id)?, value::data(data)?);
    edition.bus.decode(id, &data).map_err(|wrong| error(&wrong))?;
    let def = by_id(edition, id)?;
    let (signals, raws, names) = (PyDict::new(py), PyDict::new(py), PyDict::new(py));
    for signal in def.signals {
        let Some(raw) = signal.raw(&data) else { continue };
        signals.set_item(signal.name, physical(py, signal, raw))?;
        raws.set_item(signal.name, raw)?;
        if let Some(name) = signal.value_name(raw) {
            names.set_item(signal.name, name)?;
        }
    }
    let message = PyDict::new(py);
    message.set_item("name", def.name)?;
    message.set_item("id", def.id)?;
    message.set_item("sender", def.sender.name())?;
    message.set_item("signals", signals)?;
    message.set_item("raw", raws)?;
    message.set_item("names", names)?;
    Ok(message)
}

/// A raw value in its unit: a whole number where one raw step is one unit.
fn physical<'py>(py: Python<'py>, signal: &SignalDef, raw: i32) -> Bound<'py, PyAny> {
    if signal.scale == Scale::ONE {
        PyInt::new(py, raw).into_any()
    } else {
        PyFloat::new(py, signal.physical(raw)).into_any()
    }
}

/// The frame of a message, as its identifier and data; `message` is its name or its identifier.
///
/// Signals are given as keywords: in physical units, or by the name of a value. A physical value becomes the nearest raw one.
/// A signal that is not given is 0, or the first of its values where 0 is none. What the edition does not allow is a
/// CodecError.
///
/// edition: as of decode.
///
/// >>> import adsdv
/// >>> adsdv.encode("AI2VCU_Steer", STEER_REQUEST_deg=-10.0)
/// (1299, b'\x9c\xff\x00\x00\x00\x00\x00\x00')
/// >>> id, data = adsdv.encode(0x510, HANDSHAKE=True, MISSION_STATUS="RUNNING")
/// >>> adsdv.decode(id, data)["names"]["MISSION_STATUS"]
/// 'RUNNING'
/// >>> adsdv.encode("AI2VCU_Steer", STEER_REQUEST_deg=24.1)
/// Traceback (most recent call last):
///     ...
/// adsdv.CodecError: AI2VCU_Steer (513h): STEER_REQUEST_deg is 24.1 deg (raw 241), allowed: -24 to 24 deg (raw -240 to 240)
/// >>> adsdv.encode("AI2VCU_Steer", edition="4.0", STEER_REQUEST=-10.0)
/// (1299, b'\x9c\xff')
#[pyfunction]
#[pyo3(signature = (message, /, *, edition=None, **signals))]
fn encode<'py>(
    py: Python<'py>,
    message: &Bound<'py, PyAny>,
    edition: Option<&Bound<'py, PyAny>>,
    signals: Option<&Bound<'py, PyDict>>,
) -> PyResult<(u16, Bound<'py, PyBytes>)> {
    let def = find(edition::or_default(edition)?, message)?;
    // What is not given: the first value that is allowed, from 0 on.
    let mut data = def.signals.iter().fold([0; 8], |data, signal| {
        let first = signal.values.first().map_or(signal.min, |&(first, _)| first);
        signal.put(data, if signal.allows(0) { 0 } else { first })
    });
    value::each(None, signals, |name, given| {
        let signal = def
            .signal_known_as(name)
            .ok_or_else(|| CodecError::new_err(format!("{} has {}", label(def), no_signal(def, name))))?;
        data = signal.put(data, raw(def, signal, given)?);
        Ok(())
    })?;
    let frame = Frame { id: def.id, len: def.len, data };
    Ok((frame.id, PyBytes::new(py, frame.data())))
}

fn label(def: &MessageDef) -> String {
    format!("{} ({:03X}h)", def.name, def.id)
}

fn no_signal(def: &MessageDef, name: &str) -> String {
    let names: Vec<&str> = def.signals.iter().map(|signal| signal.name).collect();
    format!("no signal {name:?}; expected one of {}", names.join(", "))
}

/// The message of this name, in any edition, or of this identifier.
fn find(edition: &Edition, message: &Bound<'_, PyAny>) -> PyResult<&'static MessageDef> {
    let Some(name) = value::text(message) else {
        return by_id(edition, value::id(message)?);
    };
    edition.bus.known_as(&name).ok_or_else(|| {
        let names: Vec<&str> = edition.bus.messages.iter().map(|def| def.name).collect();
        CodecError::new_err(format!("there is no message {name:?}; expected one of {}", names.join(", ")))
    })
}

/// The message of this identifier.
fn by_id(edition: &Edition, id: u16) -> PyResult<&'static MessageDef> {
    edition.bus.message(id).ok_or_else(|| error(&DecodeError::UnknownId { id }))
}

/// The raw value of what was given for a signal.
fn raw(def: &MessageDef, signal: &'static SignalDef, given: &Bound<'_, PyAny>) -> PyResult<i32> {
    let refused = |expected: &str| {
        let (label, name) = (label(def), signal.name);
        CodecError::new_err(format!("{label}: {name} is {}; expected {expected}", value::shown(given)))
    };
    if let Some(name) = value::text(given) {
        let known = signal.values.iter().find(|(_, known)| *known == name);
        return known.map(|&(raw, _)| raw).ok_or_else(|| refused(&allowed(signal)));
    }
    let is_flag = signal.min == 0 && signal.max == 1;
    let raw = match given.extract::<bool>() {
        Ok(flag) if is_flag => i32::from(flag),
        Ok(_) => return Err(refused(&allowed(signal))),
        Err(_) => {
            let physical: f64 = given.extract().map_err(|_| refused(&allowed(signal)))?;
            nearest(signal.scale, physical).ok_or_else(|| refused(&allowed(signal)))?
        }
    };
    signal.check(raw).map_err(|wrong| CodecError::new_err(format!("{}: {wrong}", label(def))))?;
    Ok(raw)
}

/// The nearest raw value; `None` if no signal could hold it.
fn nearest(scale: Scale, physical: f64) -> Option<i32> {
    let steps = (physical * f64::from(scale.den()) / f64::from(scale.num())).round();
    #[expect(clippy::cast_possible_truncation, reason = "it is whole, and within the range")]
    (steps.abs() <= f64::from(i32::MAX)).then_some(steps as i32)
}

/// What a signal may be, in words.
fn allowed(signal: &SignalDef) -> String {
    let unit = if signal.unit.is_empty() { String::new() } else { format!(" {}", signal.unit) };
    let number = |raw| Decimal { raw, scale: signal.scale };
    if signal.values.is_empty() {
        return format!("a number from {} to {}{unit}", number(signal.min), number(signal.max));
    }
    let names: Vec<String> = signal.values.iter().map(|(raw, name)| format!("{name:?} or {raw}")).collect();
    names.join(", ")
}

/// The frames that a VCU sends after a step, as pairs of identifier and data: 520h first, 502h last; those of the edition of
/// the VCU.
///
/// 502h is sent less often than the others by a VCU: every 100 ms.
///
/// >>> import adsdv
/// >>> frames = adsdv.frames(adsdv.Vcu().step())
/// >>> [f"{id:03X}" for id, data in frames]
/// ['520', '521', '522', '523', '524', '525', '526', '500', '502']
/// >>> frames[0][1].hex()
/// '0000010000000000'
/// >>> frames = adsdv.frames(adsdv.Vcu(edition="4.0").step())
/// >>> [f"{id:03X}" for id, data in frames]
/// ['520', '521', '522', '523', '524', '525', '526', '500', '120', '502']
#[pyfunction]
fn frames<'py>(py: Python<'py>, step: &Step) -> Vec<(u16, Bound<'py, PyBytes>)> {
    step.frames(py)
}

/// Whether the AI Computer must not send this identifier of 11 bits (section 2.3).
///
/// edition: as of decode.
///
/// >>> import adsdv
/// >>> adsdv.is_reserved(0x181), adsdv.is_reserved(0x510)
/// (True, False)
#[pyfunction]
#[pyo3(signature = (id, edition=None))]
fn is_reserved(id: &Bound<'_, PyAny>, edition: Option<&Bound<'_, PyAny>>) -> PyResult<bool> {
    Ok(edition::or_default(edition)?.bus.is_reserved(value::id(id)?))
}
