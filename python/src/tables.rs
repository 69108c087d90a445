//! The tables of an edition as lists of flat dicts: inputs, outputs, messages and readings.

use adsdv_conform::protocol::Domain;
use adsdv_spec::Inputs;
use adsdv_spec::messages::SignalDef;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::edition;
use crate::value;

pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(inputs, module)?)?;
    module.add_function(wrap_pyfunction!(outputs, module)?)?;
    module.add_function(wrap_pyfunction!(messages, module)?)?;
    module.add_function(wrap_pyfunction!(readings, module)?)
}

/// The inputs of a step: key, part (what it is an input of), kind ("flag", "name" or "number"), min and max (of a number),
/// names (of a name), unit (the size of one raw step), and default.
///
/// edition: one of adsdv.editions(); None for adsdv.INTERFACE_VERSION.
///
/// >>> import adsdv
/// >>> adsdv.inputs()[0]
/// {'key': 'asms', 'part': '', 'kind': 'flag', 'min': None, 'max': None, 'names': None, 'unit': '', 'default': False}
/// >>> [input["key"] for input in adsdv.inputs() if input["unit"] == "0.1 deg"]
/// ['steer_request', 'steer_angle']
#[pyfunction]
#[pyo3(signature = (edition=None))]
fn inputs<'py>(py: Python<'py>, edition: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyList>> {
    let edition = edition::or_default(edition)?;
    let usual = Inputs::default();
    let list = PyList::empty(py);
    for (field, domain) in edition::protocol(edition).inputs() {
        let dict = PyDict::new(py);
        dict.set_item("key", field.key)?;
        dict.set_item("part", field.part)?;
        set_domain(&dict, domain)?;
        dict.set_item("unit", (field.unit)())?;
        dict.set_item("default", value::python(py, domain, Some((field.get)(&usual))))?;
        list.append(dict)?;
    }
    Ok(list)
}

/// What a step shows: key, kind, min, max and names, as of inputs(), and nullable (whether it may be None).
///
/// edition: as of inputs.
///
/// >>> import adsdv
/// >>> adsdv.outputs()[0]["names"]
/// ['AS_OFF', 'AS_READY', 'AS_DRIVING', 'EMERGENCY_BRAKE', 'AS_FINISHED']
/// >>> [output["key"] for output in adsdv.outputs() if output["nullable"]]
/// ['steer']
#[pyfunction]
#[pyo3(signature = (edition=None))]
fn outputs<'py>(py: Python<'py>, edition: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyList>> {
    let edition = edition::or_default(edition)?;
    let list = PyList::empty(py);
    for (field, domain) in edition::protocol(edition).shown() {
        let dict = PyDict::new(py);
        dict.set_item("key", field.key)?;
        set_domain(&dict, domain)?;
        dict.set_item("nullable", field.nullable)?;
        list.append(dict)?;
    }
    Ok(list)
}

fn set_domain(dict: &Bound<'_, PyDict>, domain: Domain) -> PyResult<()> {
    let (kind, min, max, names) = match domain {
        Domain::Flag => ("flag", None, None, None),
        Domain::Names(names) => {
            ("name", None, None, Some(names.iter().map(|&(_, name)| name).collect::<Vec<_>>()))
        }
        Domain::Number { min, max } => ("number", Some(min), Some(max), None),
    };
    dict.set_item("kind", kind)?;
    dict.set_item("min", min)?;
    dict.set_item("max", max)?;
    dict.set_item("names", names)
}

/// The signals of every message, one dict each: message, id, sender, length, signal, start and width (in bits, little
/// endian), signed, scale, unit, min and max (raw), values (names by raw value) and doc.
///
/// edition: as of inputs.
///
/// >>> import adsdv
/// >>> steer = next(signal for signal in adsdv.messages() if signal["id"] == 0x513)
/// >>> steer["signal"], steer["scale"], steer["unit"], steer["min"], steer["max"]
/// ('STEER_REQUEST_deg', 0.1, 'deg', -240, 240)
#[pyfunction]
#[pyo3(signature = (edition=None))]
fn messages<'py>(py: Python<'py>, edition: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyList>> {
    let edition = edition::or_default(edition)?;
    let list = PyList::empty(py);
    for message in edition.bus.messages {
        for signal in message.signals {
            let dict = PyDict::new(py);
            dict.set_item("message", message.name)?;
            dict.set_item("id", message.id)?;
            dict.set_item("sender", message.sender.name())?;
            dict.set_item("length", message.len)?;
            set_signal(&dict, signal)?;
            list.append(dict)?;
        }
    }
    Ok(list)
}

fn set_signal(dict: &Bound<'_, PyDict>, signal: &SignalDef) -> PyResult<()> {
    dict.set_item("signal", signal.name)?;
    dict.set_item("start", signal.start)?;
    dict.set_item("width", signal.width)?;
    dict.set_item("signed", signal.signed)?;
    dict.set_item("scale", signal.physical(1))?;
    dict.set_item("unit", signal.unit)?;
    dict.set_item("min", signal.min)?;
    dict.set_item("max", signal.max)?;
    let values = PyDict::new(dict.py());
    for (raw, name) in signal.values {
        values.set_item(raw, name)?;
    }
    dict.set_item("values", values)?;
    dict.set_item("doc", signal.doc)
}

/// Where the document allows more than one meaning: id, section, question, choices (their texts by id) and default.
///
/// edition: as of inputs.
///
/// >>> import adsdv
/// >>> {reading["id"]: list(reading["choices"]) for reading in adsdv.readings()}["fault-trigger"]
/// ['level', 'edge']
#[pyfunction]
#[pyo3(signature = (edition=None))]
fn readings<'py>(py: Python<'py>, edition: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyList>> {
    let edition = edition::or_default(edition)?;
    let list = PyList::empty(py);
    for reading in edition.questions() {
        let (dict, choices) = (PyDict::new(py), PyDict::new(py));
        for choice in edition.choices.of_reading(reading) {
            choices.set_item(choice.id(), choice.text())?;
        }
        dict.set_item("id", reading.id())?;
        dict.set_item("section", reading.section())?;
        dict.set_item("question", reading.question())?;
        dict.set_item("choices", choices)?;
        dict.set_item("default", edition.readings.choice(reading).id())?;
        list.append(dict)?;
    }
    Ok(list)
}
