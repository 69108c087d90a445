//! `Control`: what a VCU remembers between two steps.

use adsdv_conform::protocol::Domain;
use adsdv_spec::Edition;
use adsdv_spec::messages::SignalValue;
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::value;

/// One thing that a VCU remembers.
pub(crate) struct Field {
    pub(crate) key: &'static str,
    pub(crate) domain: Domain,
    pub(crate) get: fn(&adsdv_spec::Control) -> i32,
    pub(crate) set: fn(&mut adsdv_spec::Control, i32) -> bool,
}

const fn domain_of<T: SignalValue>(_: fn(&adsdv_spec::Control) -> T) -> Domain {
    value::domain::<T>()
}

macro_rules! fields {
    ($($key:ident = $($place:ident).+;)+) => {
        pub(crate) const FIELDS: &[Field] = &[$(
            Field {
                key: stringify!($key),
                domain: domain_of(|control| control.$($place).+),
                get: |control| SignalValue::to_raw(control.$($place).+),
                set: |control, raw| match SignalValue::from_raw(raw) {
                    Some(value) => {
                        control.$($place).+ = value;
                        true
                    }
                    None => false,
                },
            },
        )+];
    };
}

fields! {
    state = state;
    in_state_ms = in_state_ms;
    go_seen_low = go_seen_low;
    was_running = was_running;
    was_forward = was_forward;
    handshake_active = handshake.active;
    handshake_bit = handshake.bit;
    handshake_unanswered_ms = handshake.unanswered_ms;
    power_cycle_needed = power_cycle_needed;
    shutdown_cause = shutdown_cause;
}

/// What a VCU remembers between two steps; as it is made, the VCU after a power cycle.
///
/// It never changes: Machine.step makes a new one. It can be compared, hashed, copied and pickled. Its attributes can be
/// given as keywords, or as a dict such as to_dict gives. It is of no edition: a Machine refuses one that its edition cannot
/// have.
///
/// state: the state of Figure 2, such as "AS_READY".
/// in_state_ms: how long that state has lasted, in milliseconds, up to where it stops to matter; 0 to 65535.
/// go_seen_low: AS_READY only: "Go" was seen off, so that a rising edge is accepted now (section 3.2).
/// was_running, was_forward: AS_DRIVING only, under the reading fault-trigger=edge: what the AI Computer asked for.
/// handshake_active, handshake_bit, handshake_unanswered_ms: the handshake (section 2.4).
/// power_cycle_needed: the vehicle must be power-cycled before it can drive again (section 3.9).
/// shutdown_cause: the fault that shut the vehicle down first (section 2.2), such as "EBS FAULT", by
/// the name that any edition has for it.
///
/// >>> import adsdv
/// >>> adsdv.Control()
/// Control()
/// >>> control = adsdv.Control(state="AS_READY", in_state_ms=4990)
/// >>> control
/// Control(state='AS_READY', in_state_ms=4990)
/// >>> control.state
/// 'AS_READY'
/// >>> control == adsdv.Control(control.to_dict())
/// True
#[pyclass(frozen, eq, hash, module = "adsdv")]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Control(pub(crate) adsdv_spec::Control);

/// The raw number of what was given for a field, which may be by the name that any edition has for it.
fn raw(field: &Field, given: &Bound<'_, PyAny>) -> PyResult<i32> {
    let names = |edition: &Edition| edition.bus.signal_of(field.key).map(|signal| signal.values);
    let names = Edition::ALL.iter().filter_map(|edition| names(edition)).filter(|names| !names.is_empty());
    let known = |names| value::raw_or(field.key, given, field.domain, Domain::Names(names)).ok();
    match names.filter(|_| matches!(field.domain, Domain::Names(_))).find_map(known) {
        Some(raw) => Ok(raw),
        None => value::raw(field.key, given, field.domain),
    }
}

#[pymethods]
impl Control {
    #[new]
    #[pyo3(signature = (fields=None, /, **keywords))]
    fn new(fields: Option<&Bound<'_, PyAny>>, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut control = adsdv_spec::Control::INITIAL;
        value::each(fields, keywords, |key, given| {
            let field = FIELDS
                .iter()
                .find(|field| field.key == key)
                .ok_or_else(|| value::unknown_key(key, "", FIELDS.iter().map(|field| field.key)))?;
            let set = (field.set)(&mut control, raw(field, given)?);
            if set { Ok(()) } else { Err(value::refused(key, given, field.domain)) }
        })?;
        Ok(Self(control))
    }

    /// The attributes as a dict.
    ///
    /// >>> import adsdv
    /// >>> adsdv.Control().to_dict()["state"]
    /// 'AS_OFF'
    #[expect(clippy::wrong_self_convention, reason = "Python has references alone")]
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for field in FIELDS {
            dict.set_item(field.key, value::python(py, field.domain, Some((field.get)(&self.0))))?;
        }
        Ok(dict)
    }

    fn __getattr__<'py>(&self, py: Python<'py>, name: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let field = value::text(name).and_then(|name| FIELDS.iter().find(|field| field.key == name));
        match field {
            Some(field) => Ok(value::python(py, field.domain, Some((field.get)(&self.0)))),
            None => {
                Err(PyAttributeError::new_err(format!("a Control has no attribute {}", value::shown(name))))
            }
        }
    }

    fn __dir__(slf: &Bound<'_, Self>) -> PyResult<Vec<String>> {
        let mut names: Vec<String> = slf.get_type().dir()?.extract()?;
        names.extend(FIELDS.iter().map(|field| field.key.to_owned()));
        Ok(names)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let usual = adsdv_spec::Control::INITIAL;
        let mut given = Vec::new();
        for field in FIELDS.iter().filter(|field| (field.get)(&self.0) != (field.get)(&usual)) {
            let value = value::python(py, field.domain, Some((field.get)(&self.0)));
            given.push(format!("{}={}", field.key, value.repr()?));
        }
        Ok(format!("Control({})", given.join(", ")))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyType>, (Bound<'py, PyDict>,))> {
        Ok((slf.get_type(), (slf.get().to_dict(slf.py())?,)))
    }
}
