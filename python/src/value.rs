//! Python's values from and to the specification's.

use adsdv_conform::protocol::Domain;
use adsdv_spec::messages::SignalValue;
use adsdv_spec::{Choice, Reading};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{
    PyBool, PyByteArray, PyBytes, PyDict, PyInt, PyMapping, PyMemoryView, PySequence, PyString,
};

use crate::error::InputError;

/// The values of a type.
pub(crate) const fn domain<T: SignalValue>() -> Domain {
    if !T::VALUES.is_empty() {
        Domain::Names(T::VALUES)
    } else if T::MIN == 0 && T::MAX == 1 {
        Domain::Flag
    } else {
        Domain::Number { min: T::MIN, max: T::MAX }
    }
}

/// The raw number of a value that was given for `key`.
pub(crate) fn raw(key: &str, given: &Bound<'_, PyAny>, domain: Domain) -> PyResult<i32> {
    raw_or(key, given, domain, domain)
}

/// The same, where a value may have another edition's name as well: what it stands for has to be one of `domain` all the same.
pub(crate) fn raw_or(key: &str, given: &Bound<'_, PyAny>, domain: Domain, other: Domain) -> PyResult<i32> {
    let number = number(given, domain).or_else(|| number(given, other).filter(|&raw| domain.has(raw)));
    number.ok_or_else(|| refused(key, given, domain))
}

fn number(given: &Bound<'_, PyAny>, domain: Domain) -> Option<i32> {
    let is_bool = || given.extract::<bool>().is_ok();
    let number = match domain {
        Domain::Flag => given.extract::<bool>().map(i32::from).ok().or_else(|| small(given)),
        Domain::Names(names) => match text(given) {
            Some(name) => names.iter().find(|(_, known)| *known == name).map(|&(raw, _)| raw),
            None => small(given).filter(|_| !is_bool()),
        },
        Domain::Number { .. } => small(given).filter(|_| !is_bool()),
    };
    number.filter(|&raw| domain.has(raw))
}

fn small(given: &Bound<'_, PyAny>) -> Option<i32> {
    given.extract().ok()
}

/// The text of a `str`; `None` for anything else, and for what is no Unicode.
pub(crate) fn text(given: &Bound<'_, PyAny>) -> Option<String> {
    given.cast::<PyString>().ok()?.extract().ok()
}

/// A raw number as Python has it: a flag as a bool, a named value by its name, a number as an int.
pub(crate) fn python(py: Python<'_>, domain: Domain, raw: Option<i32>) -> Bound<'_, PyAny> {
    let Some(raw) = raw else { return py.None().into_bound(py) };
    let name = match domain {
        Domain::Flag => return PyBool::new(py, raw != 0).to_owned().into_any(),
        Domain::Names(names) => names.iter().find(|&&(value, _)| value == raw),
        Domain::Number { .. } => None,
    };
    match name {
        Some((_, name)) => PyString::intern(py, name).into_any(),
        None => PyInt::new(py, raw).into_any(),
    }
}

/// A whole number from `min` to `max`.
pub(crate) fn whole(key: &str, given: &Bound<'_, PyAny>, min: u32, max: u32) -> PyResult<u32> {
    let number = given.extract::<u32>().ok().filter(|number| (min..=max).contains(number));
    match number {
        Some(number) if !given.is_instance_of::<PyBool>() => Ok(number),
        _ => Err(refused(key, given, format_args!("a whole number from {min} to {max}"))),
    }
}

/// An identifier of 11 bits.
pub(crate) fn id(given: &Bound<'_, PyAny>) -> PyResult<u16> {
    let id = whole("id", given, 0, adsdv_spec::messages::Frame::MAX_ID.into())?;
    u16::try_from(id).map_err(PyErr::from)
}

/// Bytes of any kind: `bytes`, `bytearray`, `memoryview`; `None` for what is none of them.
pub(crate) fn bytes(given: &Bound<'_, PyAny>) -> PyResult<Option<PyBackedBytes>> {
    if given.is_instance_of::<PyMemoryView>() {
        given.call_method0("tobytes")?.extract().map(Some).map_err(PyErr::from)
    } else if given.is_instance_of::<PyBytes>() || given.is_instance_of::<PyByteArray>() {
        given.extract().map(Some).map_err(PyErr::from)
    } else {
        Ok(None)
    }
}

/// The longest data of any frame: that of CAN XL.
const LONGEST: usize = 2048;

/// The data of a frame: bytes of any kind, or a list of numbers.
pub(crate) fn data(given: &Bound<'_, PyAny>) -> PyResult<Vec<u8>> {
    let data = match bytes(given)? {
        Some(bytes) => Some(bytes.to_vec()),
        None if given.cast::<PySequence>().is_ok() => numbers(given),
        None => None,
    };
    data.filter(|data| data.len() <= LONGEST).ok_or_else(|| {
        refused(
            "data",
            given,
            format_args!("bytes, or a list of whole numbers from 0 to 255, at most {LONGEST}"),
        )
    })
}

/// A list of bytes, as far as it may be data: its length is what it says, which may be anything.
fn numbers(given: &Bound<'_, PyAny>) -> Option<Vec<u8>> {
    let numbers = given.try_iter().ok()?.take(LONGEST + 1);
    numbers.map(|number| number.and_then(|number| number.extract::<u8>()).ok()).collect()
}

/// Sets what a mapping and keywords give, each key once.
pub(crate) fn each(
    given: Option<&Bound<'_, PyAny>>,
    keywords: Option<&Bound<'_, PyDict>>,
    mut set: impl FnMut(&str, &Bound<'_, PyAny>) -> PyResult<()>,
) -> PyResult<()> {
    let keywords = keywords.map(Bound::as_any);
    let mut seen: Vec<String> = Vec::new();
    for mapping in [given, keywords].into_iter().flatten() {
        let mapping = mapping
            .cast::<PyMapping>()
            .map_err(|_| PyTypeError::new_err(format!("this is {}; expected a dict", shown(mapping))))?;
        // A list of its own, that nothing changes while it is gone through.
        for item in mapping.items()? {
            let (key, value) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
            let Some(key) = text(&key) else {
                return Err(InputError::new_err(format!("a key is {}; expected a str", shown(&key))));
            };
            if seen.contains(&key) {
                return Err(InputError::new_err(format!("{key:?} is there twice; expected each key once")));
            }
            set(&key, &value)?;
            seen.push(key);
        }
    }
    Ok(())
}

/// The choices that a dict of readings makes.
pub(crate) fn choices(readings: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Choice>> {
    let mut choices = Vec::new();
    each(readings, None, |key, choice| {
        let reading: Reading =
            key.parse().map_err(|unknown| InputError::new_err(format!("{key:?}: {unknown}")))?;
        let known = text(choice).and_then(|choice| Choice::find(reading.id(), &choice));
        let unknown = adsdv_spec::UnknownName::ChoiceOf(reading);
        choices.push(known.ok_or_else(|| InputError::new_err(format!("{}: {unknown}", shown(choice))))?);
        Ok(())
    })?;
    Ok(choices)
}

/// A key that there is not, or not in `place`, which begins with a space where it says anything.
pub(crate) fn unknown_key<'a>(key: &str, place: &str, expected: impl Iterator<Item = &'a str>) -> PyErr {
    let expected: Vec<&str> = expected.collect();
    InputError::new_err(format!("there is no key {key:?}{place}; expected one of {}", expected.join(", ")))
}

/// A value that a key cannot have.
pub(crate) fn refused(key: &str, given: &Bound<'_, PyAny>, expected: impl std::fmt::Display) -> PyErr {
    InputError::new_err(format!("{key:?} is {}; expected {expected}", shown(given)))
}

/// A value as Python prints it, short enough for an error.
pub(crate) fn shown(given: &Bound<'_, PyAny>) -> String {
    const LIMIT: usize = 60;
    let printed = given.repr().ok().and_then(|printed| text(printed.as_any()));
    let printed = match printed {
        Some(printed) => printed,
        None => format!(
            "an object of type {}",
            given.get_type().name().map_or_else(|_| "?".to_owned(), |name| name.to_string())
        ),
    };
    match printed.char_indices().nth(LIMIT) {
        Some((end, _)) => format!("{}...", printed.get(..end).unwrap_or_default()),
        None => printed,
    }
}

/// Nanoseconds as seconds, rounded to whole microseconds, which is what candump writes.
#[expect(clippy::cast_precision_loss, reason = "285 years of microseconds fit")]
pub(crate) fn seconds(ns: i64) -> f64 {
    ns.saturating_add(500).div_euclid(1000) as f64 / 1e6
}
