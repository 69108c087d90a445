//! Rows from Python's buffers and back.
//!
//! The stable interface of Python before 3.11 has no buffers: a `memoryview` reads, and `io.BytesIO` writes.

use adsdv_spec::Edition;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyMemoryView};

use crate::error::InputError;
use crate::value;

use super::layout::Of;

/// A buffer that was given as rows.
pub(super) struct Buffer<'a, 'py> {
    name: &'static str,
    given: &'a Bound<'py, PyAny>,
    view: Bound<'py, PyMemoryView>,
    /// How many rows it has.
    pub(super) count: usize,
}

impl<'a, 'py> Buffer<'a, 'py> {
    /// Rows of the edition, or an error that says what they are.
    pub(super) fn of(
        name: &'static str,
        given: &'a Bound<'py, PyAny>,
        of: Of,
        edition: &Edition,
    ) -> PyResult<Self> {
        let expected = || format!("rows of adsdv.dtype({:?}, {:?})", of.name(), edition.version);
        let refused = |found: String| {
            InputError::new_err(format!("{name:?} {found}; expected {}, or their bytes", expected()))
        };
        let Ok(view) = PyMemoryView::from(given) else {
            return Err(refused(format!("is {}", value::shown(given))));
        };
        let py = given.py();
        let is_bytes = view.getattr(intern!(py, "itemsize"))?.extract::<usize>()? == 1;
        if let (Ok(dtype), false) = (given.getattr(intern!(py, "dtype")), is_bytes) {
            let of_numpy = py.import(intern!(py, "numpy"))?.getattr(intern!(py, "dtype"))?;
            if !of_numpy.call1((of.dtype(edition),))?.eq(&dtype)? {
                return Err(refused(format!("has the dtype {}", value::shown(&dtype))));
            }
        } else if !is_bytes {
            let format = view.getattr(intern!(py, "format"))?;
            return Err(refused(format!("has items of the format {}", value::shown(&format))));
        }
        let (bytes, size) = (view.getattr(intern!(py, "nbytes"))?.extract::<usize>()?, of.size(edition));
        if bytes % size != 0 {
            return Err(refused(format!("has {bytes} bytes, which no number of rows of {size} bytes has")));
        }
        Ok(Self { name, given, view, count: bytes / size })
    }

    /// Its bytes, as they are now.
    pub(super) fn bytes(&self) -> PyResult<PyBackedBytes> {
        self.view.call_method0(intern!(self.given.py(), "tobytes"))?.extract().map_err(PyErr::from)
    }

    /// The same, if it can be filled: it has a row for each of `inputs`.
    pub(super) fn fillable(self, inputs: usize) -> PyResult<Self> {
        let (name, count) = (self.name, self.count);
        let is = |what: &str| self.view.getattr(what)?.extract::<bool>();
        if count != inputs {
            return Err(InputError::new_err(format!(
                "{name:?} has {count} rows; expected {inputs}, one for each of \"inputs\""
            )));
        }
        if is("readonly")? {
            return Err(InputError::new_err(format!(
                "{name:?} cannot be written; expected a buffer that can, such as a bytearray or an array of NumPy"
            )));
        }
        if !is("c_contiguous")? {
            return Err(InputError::new_err(format!(
                "{name:?} has gaps between its rows; expected one behind the other, such as numpy.ascontiguousarray has them"
            )));
        }
        Ok(self)
    }

    /// Fills all its rows.
    pub(super) fn fill(self, rows: &[u8]) -> PyResult<()> {
        let py = self.given.py();
        drop(self.view);
        let source = py.import(intern!(py, "io"))?.getattr(intern!(py, "BytesIO"))?;
        source
            .call1((PyBytes::new(py, rows),))?
            .call_method1(intern!(py, "readinto"), (self.given,))
            .map(drop)
    }
}

/// The time of each step: a number for all of them, or a buffer of as many.
pub(super) fn times(given: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<u32>> {
    let py = given.py();
    let Ok(view) = PyMemoryView::from(given) else {
        return Ok(vec![value::whole("dt_ms", given, 0, u32::MAX)?; count]);
    };
    let of = |what| view.getattr(what);
    let (format, size) = (of("format")?.extract::<String>()?, of("itemsize")?.extract::<usize>()?);
    let is_u32 = size == 4 && matches!(format.trim_start_matches(['@', '=', '<']), "I" | "L");
    let bytes: PyBackedBytes = view.call_method0(intern!(py, "tobytes"))?.extract()?;
    let times: Vec<u32> = bytes.as_chunks().0.iter().map(|&four| u32::from_ne_bytes(four)).collect();
    if !is_u32 || times.len() != count {
        return Err(InputError::new_err(format!(
            "\"dt_ms\" has {} items of the format {format:?}; expected {count} of \"I\" (numpy.uint32), one for each of \
             \"inputs\", or a whole number",
            bytes.len() / size.max(1)
        )));
    }
    Ok(times)
}
