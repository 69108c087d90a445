//! The exceptions. Each is a `ValueError`; what cannot be read is an `OSError` of Python's own.

// The macro documents what it makes for Python, not for Rust.
#![allow(missing_docs, unreachable_pub)]

use std::io;

use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::{create_exception, intern};

create_exception!(
    adsdv,
    AdsdvError,
    PyValueError,
    "Something that was given is not what was expected. The base of this module's exceptions; a ValueError."
);
create_exception!(
    adsdv,
    InputError,
    AdsdvError,
    "An input, a reading or another argument that there is not, or a value that it cannot have."
);
create_exception!(
    adsdv,
    CodecError,
    AdsdvError,
    "Data that is no message of the document, or signals that cannot be sent."
);
create_exception!(
    adsdv,
    RulesError,
    InputError,
    "Rules of one's own that are wrong, or name what the edition has not. line and column say where the first mistake is, both from 1; mistakes lists the first twenty, and more counts the others."
);
create_exception!(
    adsdv,
    StackError,
    AdsdvError,
    "A program under exam that does not keep to the protocol, ends or hangs, so that there is no verdict."
);
create_exception!(adsdv, LogError, AdsdvError, "A log that holds nothing to judge.");

pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("AdsdvError", py.get_type::<AdsdvError>())?;
    module.add("InputError", py.get_type::<InputError>())?;
    module.add("RulesError", py.get_type::<RulesError>())?;
    module.add("CodecError", py.get_type::<CodecError>())?;
    module.add("StackError", py.get_type::<StackError>())?;
    module.add("LogError", py.get_type::<LogError>())
}

/// An `OSError`, or that subclass of it that the number stands for, such as `FileNotFoundError`.
pub(crate) fn os_error(py: Python<'_>, error: &io::Error, file: &Bound<'_, PyAny>) -> PyErr {
    let Some(number) = error.raw_os_error() else { return PyOSError::new_err(error.to_string()) };
    let text =
        py.import(intern!(py, "os")).and_then(|os| os.call_method1(intern!(py, "strerror"), (number,)));
    match text {
        Ok(text) => PyOSError::new_err((number, text.unbind(), file.clone().unbind())),
        Err(error) => error,
    }
}
