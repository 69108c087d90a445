//! `Table`: rows for pandas, polars, DuckDB and Arrow.

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{
    Array, BooleanArray, Float64Array, Int64Array, ListArray, RecordBatch, RecordBatchIterator, StringArray,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyList};

/// Rows of flat columns, which pandas, polars, DuckDB and pyarrow take as they are, without a copy of each row.
///
/// It speaks Arrow's PyCapsule interface: pyarrow.table(table), polars.DataFrame(table), pandas.DataFrame.from_arrow(table) (pandas 3),
/// DuckDB's "SELECT * FROM table". Without any of these, columns() has lists.
///
/// >>> import adsdv
/// >>> adsdv.check_many([]).findings
/// <adsdv.Table: 0 rows of path, t, severity, party, section, rule, requirements, message, seen, expected, unless>
#[pyclass(frozen, module = "adsdv")]
pub(crate) struct Table(pub(super) RecordBatch);

impl Table {
    fn names(&self) -> Vec<String> {
        self.0.schema_ref().fields().iter().map(|field| field.name().clone()).collect()
    }
}

#[pymethods]
impl Table {
    /// The names of the columns, in order.
    ///
    /// >>> import adsdv
    /// >>> adsdv.check_many([]).logs.column_names[:3]
    /// ['path', 'verdict', 'violations']
    #[getter]
    fn column_names(&self) -> Vec<String> {
        self.names()
    }

    /// Each column as a list, by its name: what pandas.DataFrame and polars.DataFrame take as well.
    ///
    /// >>> import adsdv
    /// >>> adsdv.check_many([]).logs.columns()["verdict"]
    /// []
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (name, column) in self.names().iter().zip(self.0.columns()) {
            dict.set_item(name, list(py, column.as_ref())?)?;
        }
        Ok(dict)
    }

    /// The rows as a stream of Arrow, for libraries that take one. The schema that is asked for is not looked at: they cast.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let _ = requested_schema;
        let reader = RecordBatchIterator::new([Ok(self.0.clone())], self.0.schema());
        let stream = FFI_ArrowArrayStream::new(Box::new(reader));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    fn __len__(&self) -> usize {
        self.0.num_rows()
    }

    fn __repr__(&self) -> String {
        let rows = self.0.num_rows();
        format!(
            "<adsdv.Table: {rows} row{} of {}>",
            if rows == 1 { "" } else { "s" },
            self.names().join(", ")
        )
    }
}

/// What a column holds, of the types that the tables have.
fn list<'py>(py: Python<'py>, column: &dyn Array) -> PyResult<Bound<'py, PyList>> {
    let any = column.as_any();
    if let Some(texts) = any.downcast_ref::<StringArray>() {
        PyList::new(py, texts)
    } else if let Some(numbers) = any.downcast_ref::<Int64Array>() {
        PyList::new(py, numbers)
    } else if let Some(numbers) = any.downcast_ref::<Float64Array>() {
        PyList::new(py, numbers)
    } else if let Some(flags) = any.downcast_ref::<BooleanArray>() {
        PyList::new(py, flags)
    } else if let Some(lists) = any.downcast_ref::<ListArray>() {
        let all = PyList::empty(py);
        for one in lists {
            all.append(one.map(|one| list(py, one.as_ref())).transpose()?)?;
        }
        Ok(all)
    } else {
        Err(PyTypeError::new_err(format!("a column of {} has no list", column.data_type())))
    }
}
