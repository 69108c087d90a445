//! Many steps in one call, on rows in buffers: `Machine.step_n`, `Machine.step_each`, and what the rows are made of.
//!
//! ```text
//! mod.rs      dtype, numbers, rows, and the steps themselves
//! layout.rs   the fields of a row, made of the lists that single steps have
//! buffer.rs   from Python's buffers and back
//! ```
//!
//! A single step takes its inputs from a dict and has a dict made of what it shows, which takes a thousand times as long as the step.

mod buffer;
mod layout;

use adsdv_spec::{Control, Edition, Machine};
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyDict};

use crate::edition;
use crate::value;
use buffer::Buffer;
use layout::{Of, Reader, Remembered, Showed};

pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(dtype, module)?)?;
    module.add_function(wrap_pyfunction!(rows, module)?)?;
    module.add_function(wrap_pyfunction!(numbers, module)?)
}

/// What the rows of Machine.step_n and Machine.step_each are made of, as numpy.dtype takes it: keys with the type of each.
///
/// of: "inputs", with the keys of adsdv.inputs(edition); "outputs", with those of adsdv.outputs(edition), after one that may be None
/// whether it is there ("steer_active"), and at the end "row", the row of Figure 2 that was taken, or -1; or "control", with the
/// attributes of a Control.
/// edition: one of adsdv.editions(); None for adsdv.INTERFACE_VERSION.
///
/// Flags are bools, and names are the numbers of adsdv.numbers; numbers are raw, as on the bus. There is no gap between the fields, and the lowest
/// byte of a number comes first.
///
/// >>> import adsdv
/// >>> adsdv.dtype("control")[:3]
/// [('state', '|u1'), ('in_state_ms', '<u2'), ('go_seen_low', '|b1')]
/// >>> dict(adsdv.dtype("inputs"))["steer_request"]
/// '<i2'
#[pyfunction]
#[pyo3(signature = (of, edition=None))]
fn dtype(of: &Bound<'_, PyAny>, edition: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<(String, &'static str)>> {
    let edition = edition::or_default(edition)?;
    Ok(Of::named(of)?.dtype(edition))
}

/// The number that stands for each name in the rows of adsdv.dtype.
///
/// of, edition: as of adsdv.dtype. key: a field of those rows whose values have names.
///
/// >>> import adsdv
/// >>> adsdv.numbers("inputs", "ebs")
/// {'UNAVAILABLE': 1, 'ARMED': 2, 'TRIGGERED': 3}
#[pyfunction]
#[pyo3(signature = (of, key, edition=None))]
fn numbers<'py>(
    py: Python<'py>,
    of: &Bound<'_, PyAny>,
    key: &Bound<'_, PyAny>,
    edition: Option<&Bound<'_, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = Of::named(of)?.names(edition::or_default(edition)?);
    let known = value::text(key).and_then(|key| fields.iter().find(|(known, _)| *known == key));
    let Some((_, names)) = known else {
        let keys: Vec<&str> = fields.iter().map(|&(key, _)| key).collect();
        return Err(value::refused("key", key, format_args!("one of {}", keys.join(", "))));
    };
    let dict = PyDict::new(py);
    names.iter().try_for_each(|(number, name)| dict.set_item(name, number))?;
    Ok(dict)
}

/// So many rows as a bytearray, each at its default: inputs with everything off, a VCU after a power cycle, no outputs.
///
/// of, edition: as of adsdv.dtype.
///
/// >>> import adsdv
/// >>> len(adsdv.rows("control", 1000))
/// 12000
/// >>> inputs = adsdv.rows("inputs", 3) # numpy.frombuffer(inputs, adsdv.dtype("inputs")) has it as an array
/// >>> machine = adsdv.Machine()
/// >>> machine.step_n(adsdv.Control(), inputs)
/// Control()
#[pyfunction]
#[pyo3(signature = (of, count, edition=None))]
fn rows<'py>(
    py: Python<'py>,
    of: &Bound<'_, PyAny>,
    count: &Bound<'_, PyAny>,
    edition: Option<&Bound<'_, PyAny>>,
) -> PyResult<Bound<'py, PyByteArray>> {
    let edition = edition::or_default(edition)?;
    let (of, count) = (Of::named(of)?, value::whole("count", count, 0, u32::MAX)?);
    // Python says where there is no room for them.
    let rows = PyByteArray::new(py, &of.usual(edition)).as_any().mul(count)?;
    rows.cast_into().map_err(PyErr::from)
}

/// Many steps: where they take their inputs from, and where what they show goes.
pub(crate) struct Batch<'a, 'py> {
    pub(crate) machine: &'a Machine,
    pub(crate) edition: &'static Edition,
    pub(crate) inputs: &'a Bound<'py, PyAny>,
    pub(crate) dt_ms: Option<&'a Bound<'py, PyAny>>,
    pub(crate) outputs: Option<&'a Bound<'py, PyAny>>,
}

/// Where steps begin.
#[derive(Clone, Copy)]
enum Start<'a> {
    /// Each where the one before has ended.
    One(Control),
    /// Each in a row of its own.
    Each(&'a [u8]),
}

impl<'py> Batch<'_, 'py> {
    /// The steps of one VCU, one after the other, and what it remembers after the last; what it remembers after each of them goes to
    /// `controls`. Nothing is written where a step is refused.
    pub(crate) fn one(&self, control: &Control, controls: Option<&Bound<'_, PyAny>>) -> PyResult<Control> {
        edition::check_control(self.edition, control)?;
        let inputs = self.rows("inputs", Of::Inputs, self.inputs)?;
        let fillable = |given| self.rows("controls", Of::Control, given)?.fillable(inputs.count);
        let controls = controls.map(fillable).transpose()?;
        self.make(&inputs, Start::One(*control), controls)
    }

    /// A step of each of many VCUs; what they remember is in `controls`, before and then after it.
    pub(crate) fn each(&self, controls: &Bound<'_, PyAny>) -> PyResult<()> {
        let inputs = self.rows("inputs", Of::Inputs, self.inputs)?;
        let controls = self.rows("controls", Of::Control, controls)?.fillable(inputs.count)?;
        let before = controls.bytes()?;
        self.make(&inputs, Start::Each(&before), Some(controls)).map(drop)
    }

    fn rows<'b, 'c>(
        &self,
        name: &'static str,
        of: Of,
        given: &'b Bound<'c, PyAny>,
    ) -> PyResult<Buffer<'b, 'c>> {
        Buffer::of(name, given, of, self.edition)
    }

    fn make(
        &self,
        inputs: &Buffer<'_, 'py>,
        start: Start<'_>,
        controls: Option<Buffer<'_, '_>>,
    ) -> PyResult<Control> {
        let outputs =
            self.outputs.map(|given| self.rows("outputs", Of::Outputs, given)?.fillable(inputs.count));
        let outputs = outputs.transpose()?;
        let dt_ms = match self.dt_ms {
            Some(given) => buffer::times(given, inputs.count)?,
            None => vec![self.edition.rules.timing.cycle_ms.into(); inputs.count],
        };
        let (bytes, count) = (inputs.bytes()?, inputs.count);
        let (machine, edition, wanted) =
            (self.machine, self.edition, (controls.is_some(), outputs.is_some()));
        let (remembered, shown, last) =
            self.inputs.py().detach(|| steps(machine, edition, &bytes, &dt_ms, start, count, wanted))?;
        if let Some(controls) = controls {
            controls.fill(&remembered)?;
        }
        if let Some(outputs) = outputs {
            outputs.fill(&shown)?;
        }
        Ok(last)
    }
}

/// What a VCU remembers after each step, and what each shows, as rows, as far as that is wanted; and what it remembers after the last.
fn steps(
    machine: &Machine,
    edition: &Edition,
    inputs: &[u8],
    dt_ms: &[u32],
    start: Start<'_>,
    count: usize,
    (controls, outputs): (bool, bool),
) -> PyResult<(Vec<u8>, Vec<u8>, Control)> {
    let size = |of: Of| of.size(edition);
    let room = |wanted: bool, of| vec![0; if wanted { count * size(of) } else { 0 }];
    let (mut remembered, mut shown) = (room(controls, Of::Control), room(outputs, Of::Outputs));
    let mut to_remember = remembered.chunks_exact_mut(size(Of::Control));
    let mut to_show = shown.chunks_exact_mut(size(Of::Outputs));
    let (writer, showed) = (Remembered::new(), Showed::of(edition));
    let mut of_inputs = Reader::of_inputs("inputs", edition);
    let mut of_control = Reader::of_control("controls", edition);
    let (mut last, each) = match start {
        Start::One(control) => (control, [].as_slice()),
        Start::Each(rows) => (Control::INITIAL, rows),
    };
    let mut each = each.chunks_exact(size(Of::Control));
    for (number, (row, &dt_ms)) in inputs.chunks_exact(size(Of::Inputs)).zip(dt_ms).enumerate() {
        if let Some(row) = each.next() {
            last = *of_control.read(number, row)?;
        }
        let inputs = of_inputs.read(number, row)?;
        let (next, stepped) = machine.step(&last, inputs, dt_ms);
        last = next;
        if let Some(row) = to_remember.next() {
            writer.write(row, &last);
        }
        if let Some(row) = to_show.next() {
            showed.write(row, &stepped, inputs);
        }
    }
    Ok((remembered, shown, last))
}
