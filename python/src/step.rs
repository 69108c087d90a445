//! `Step`: what one step did.

use adsdv_conform::protocol::Shown;
use adsdv_spec::messages::Frame;
use adsdv_spec::{Edition, Inputs, Outputs, Row, Term};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::control::Control;
use crate::value;

/// What one step of a VCU did: what it remembers now, what it shows, and why.
///
/// >>> import adsdv
/// >>> step = adsdv.Machine().step(adsdv.Control(), {"asms": True}, 10)
/// >>> step
/// <adsdv.Step: AS_OFF stays>
/// >>> step.outputs["as_switch_status"]
/// True
#[pyclass(frozen, module = "adsdv")]
pub(crate) struct Step {
    pub(crate) control: adsdv_spec::Control,
    pub(crate) outputs: Outputs,
    pub(crate) inputs: Inputs,
    pub(crate) edition: &'static Edition,
}

impl Step {
    fn taken_row(&self) -> Option<&'static Row> {
        self.outputs.taken?.row(&self.edition.rules.table)
    }

    fn taken_term(&self) -> Option<&'static Term> {
        self.outputs.taken?.term(&self.edition.rules.table)
    }

    /// The frames that the VCU sends after the step.
    pub(crate) fn frames<'py>(&self, py: Python<'py>) -> Vec<(u16, Bound<'py, PyBytes>)> {
        let frames = self.outputs.messages(&self.inputs).frames(&self.edition.bus);
        frames.map(|frame: Frame| (frame.id, PyBytes::new(py, frame.data()))).collect()
    }
}

#[pymethods]
impl Step {
    /// What the VCU remembers after the step: a Control.
    #[getter]
    fn control(&self) -> Control {
        Control(self.control)
    }

    /// What the step shows, as a dict with the keys of adsdv.outputs(edition): the signals of 520h and what reaches the
    /// actuators. Flags are bools, named values strs, numbers raw ints as on the bus; "steer" is None while the steering is
    /// not active.
    ///
    /// >>> import adsdv
    /// >>> outputs = adsdv.Vcu().step().outputs
    /// >>> outputs["as_state"], outputs["handshake"], outputs["front_axle_trq"], outputs["steer"]
    /// ('AS_OFF', False, 0, None)
    #[getter]
    fn outputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (field, shown) in Shown::of(self.edition, &self.outputs, &self.inputs).iter() {
            dict.set_item(field.key, value::python(py, shown.domain, shown.raw))?;
        }
        Ok(dict)
    }

    /// The state after the step, such as "AS_READY".
    #[getter]
    fn state(&self) -> &'static str {
        self.outputs.state.name()
    }

    /// The state before the step.
    #[getter]
    fn before(&self) -> &'static str {
        self.outputs.from.name()
    }

    /// The number of the row of Figure 2 that was taken, from 0; None if the state stays.
    ///
    /// >>> import adsdv
    /// >>> print(adsdv.Vcu().step().row)
    /// None
    #[getter]
    fn row(&self) -> Option<u8> {
        self.outputs.taken.map(|taken| taken.row)
    }

    /// The section of the document that describes the arrow that was taken, such as "3.1"; None if the state stays.
    #[getter]
    fn section(&self) -> Option<&'static str> {
        self.taken_row().map(|row| row.section)
    }

    /// The conditions that decided, in the words of Figure 2; empty if the state stays.
    ///
    /// >>> import adsdv
    /// >>> ready = adsdv.Control(state="AS_READY")
    /// >>> adsdv.Machine().step(ready, asms=False).conditions
    /// ['AS master switch OFF']
    #[getter]
    fn conditions(&self) -> Vec<String> {
        let conditions = self.taken_term().into_iter().flat_map(Term::literals);
        conditions.map(|(atom, value)| self.edition.rules.text(atom, value).to_string()).collect()
    }

    fn __repr__(&self) -> String {
        match self.section() {
            Some(section) => {
                format!("<adsdv.Step: {} -> {}, section {section}>", self.before(), self.state())
            }
            None => format!("<adsdv.Step: {} stays>", self.state()),
        }
    }
}
