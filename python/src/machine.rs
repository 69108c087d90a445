//! `Machine`, which steps, and `Vcu`, which remembers.

use adsdv_spec::{AiMessages, Edition, Inputs, Readings};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::batch::Batch;
use crate::codec;
use crate::control::Control;
use crate::edition;
use crate::step::Step;
use crate::value;

/// The state machine of a VCU: a pure function from what it remembers and sees to what it remembers and shows.
///
/// readings: where the document allows more than one meaning, the one to follow, such as {"fault-trigger": "edge"};
/// adsdv.readings() lists them. What is not in it is at its default.
/// edition: the edition of the interface, one of adsdv.editions(); None for adsdv.INTERFACE_VERSION.
///
/// >>> import adsdv
/// >>> machine = adsdv.Machine(readings={"fault-trigger": "edge"})
/// >>> control = adsdv.Control()
/// >>> step = machine.step(control, {"asms": True, "tsms": True}, 10)
/// >>> step.control
/// Control(handshake_active=True, handshake_bit=True)
/// >>> adsdv.Machine({"fault-trigger": "edge"}, edition="4.0")
/// Traceback (most recent call last):
///     ...
/// adsdv.InputError: "fault-trigger" is 'edge'; expected in edition 4.0 level
#[pyclass(frozen, eq, hash, module = "adsdv")]
#[derive(Clone, Copy)]
pub(crate) struct Machine {
    machine: adsdv_spec::Machine,
    edition: &'static Edition,
}

/// The same readings of the same edition make the same machine.
impl PartialEq for Machine {
    fn eq(&self, other: &Self) -> bool {
        self.machine.readings() == other.machine.readings() && self.edition.version == other.edition.version
    }
}

impl std::hash::Hash for Machine {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.machine.readings().hash(state);
        self.edition.version.hash(state);
    }
}

impl Machine {
    fn with(readings: Option<&Bound<'_, PyAny>>, edition: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let edition = edition::or_default(edition)?;
        let pins = value::choices(readings)?;
        edition::pinned(edition, &pins)?;
        let readings = pins.into_iter().fold(edition.readings, Readings::with);
        Ok(Self { machine: adsdv_spec::Machine::new(*edition, readings), edition })
    }

    fn take(&self, control: &adsdv_spec::Control, inputs: Inputs, dt_ms: u32) -> Step {
        let (control, outputs) = self.machine.step(control, &inputs, dt_ms);
        Step { control, outputs, inputs, edition: self.edition }
    }

    fn readings_of(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let readings = self.machine.readings();
        self.edition.questions().map(move |reading| (reading.id(), readings.choice(reading).id()))
    }
}

/// Inputs: those of the AI Computer as far as they were received, and what is given.
fn inputs(
    edition: &Edition,
    ai: AiMessages,
    given: Option<&Bound<'_, PyAny>>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Inputs> {
    let mut inputs = Inputs { ai, ..Inputs::default() };
    value::each(given, keywords, |key, given| edition::set_input(edition, &mut inputs, key, given))?;
    Ok(inputs)
}

/// How long a step takes if it is not said: a cycle of the reference VCU.
fn time(edition: &Edition, dt_ms: Option<&Bound<'_, PyAny>>) -> PyResult<u32> {
    match dt_ms {
        Some(dt_ms) => value::whole("dt_ms", dt_ms, 0, u32::MAX),
        None => Ok(edition.rules.timing.cycle_ms.into()),
    }
}

#[pymethods]
impl Machine {
    #[new]
    #[pyo3(signature = (readings=None, edition=None))]
    fn new(readings: Option<&Bound<'_, PyAny>>, edition: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Self::with(readings, edition)
    }

    /// One step: what a VCU that remembers `control` does when it sees these inputs.
    ///
    /// inputs: a flat dict with the keys of adsdv.inputs(edition), or keywords, or both; what is not there is at its default (off,
    /// 0, or the first name). Numbers are raw, as on the bus: a steer angle of -4.9 degrees is -49.
    /// dt_ms: the time since the last step in milliseconds; None for the reference VCU's cycle of 10 ms.
    ///
    /// >>> import adsdv
    /// >>> machine = adsdv.Machine()
    /// >>> step = machine.step(adsdv.Control(state="AS_DRIVING"), {"asms": True, "go": True}, 10, remote_estop=True)
    /// >>> step.outputs["as_state"], step.section, step.outputs["shutdown_cause"]
    /// ('EMERGENCY_BRAKE', '3.7', 'HVIL OPEN FAULT')
    /// >>> machine.step(adsdv.Control(), steer_angle=241)
    /// Traceback (most recent call last):
    ///     ...
    /// adsdv.InputError: "steer_angle" is 241; expected a whole number from -240 to 240
    #[pyo3(signature = (control, inputs=None, dt_ms=None, **keywords))]
    fn step(
        &self,
        control: &Control,
        inputs: Option<&Bound<'_, PyAny>>,
        dt_ms: Option<&Bound<'_, PyAny>>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Step> {
        edition::check_control(self.edition, &control.0)?;
        let inputs = self::inputs(self.edition, AiMessages::default(), inputs, keywords)?;
        Ok(self.take(&control.0, inputs, time(self.edition, dt_ms)?))
    }

    /// Many steps of one VCU, one after the other, in a fraction of the time that as many calls of `step` take; what it remembers
    /// after the last.
    ///
    /// inputs: rows of adsdv.dtype("inputs", edition), one for each step: a structured array of NumPy, or any buffer of their
    /// bytes, such as adsdv.rows makes.
    /// dt_ms: the time since the step before, in milliseconds, a number for all steps or a buffer of uint32 with one for each;
    /// None for the reference VCU's cycle.
    /// controls, outputs: buffers for what it remembers after each step, rows of adsdv.dtype("control", edition), and for what each
    /// step shows, rows of adsdv.dtype("outputs", edition). What is None is not made.
    ///
    /// An error names the row and the field, and nothing is written then.
    ///
    /// >>> import adsdv
    /// >>> machine, inputs = adsdv.Machine(), adsdv.rows("inputs", 100)
    /// >>> machine.step_n(adsdv.Control(state="AS_READY"), inputs, dt_ms=10)
    /// Control()
    /// >>> inputs[3 * len(inputs) // 100] = 7 # the first field of the fourth row
    /// >>> machine.step_n(adsdv.Control(), inputs)
    /// Traceback (most recent call last):
    ///     ...
    /// adsdv.InputError: inputs[3]: "asms" is 7; expected 0 or 1
    #[pyo3(signature = (control, inputs, dt_ms=None, *, controls=None, outputs=None))]
    fn step_n(
        &self,
        control: &Control,
        inputs: &Bound<'_, PyAny>,
        dt_ms: Option<&Bound<'_, PyAny>>,
        controls: Option<&Bound<'_, PyAny>>,
        outputs: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Control> {
        let batch = Batch { machine: &self.machine, edition: self.edition, inputs, dt_ms, outputs };
        batch.one(&control.0, controls).map(Control)
    }

    /// A step of each of many VCUs: for many runs at once, or for all that one VCU might see next.
    ///
    /// controls: rows of adsdv.dtype("control", edition), with what each VCU remembers, before and then after its step.
    /// inputs, dt_ms, outputs: as of step_n, with a row for each VCU.
    ///
    /// An error names the row and the field, and nothing is written then.
    ///
    /// >>> import adsdv
    /// >>> controls, outputs = adsdv.rows("control", 1000), adsdv.rows("outputs", 1000)
    /// >>> adsdv.Machine().step_each(controls, adsdv.rows("inputs", 1000), outputs=outputs)
    /// >>> outputs[0] # as_state
    /// 1
    #[pyo3(signature = (controls, inputs, dt_ms=None, *, outputs=None))]
    fn step_each(
        &self,
        controls: &Bound<'_, PyAny>,
        inputs: &Bound<'_, PyAny>,
        dt_ms: Option<&Bound<'_, PyAny>>,
        outputs: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        Batch { machine: &self.machine, edition: self.edition, inputs, dt_ms, outputs }.each(controls)
    }

    /// The version of the edition that it is of, one of adsdv.editions().
    ///
    /// >>> import adsdv
    /// >>> adsdv.Machine().edition == adsdv.INTERFACE_VERSION
    /// True
    #[getter]
    fn edition(&self) -> &'static str {
        self.edition.version
    }

    /// Every reading that the edition leaves open, with the choice that this machine makes.
    ///
    /// >>> import adsdv
    /// >>> adsdv.Machine({"fault-trigger": "edge"}).readings["fault-trigger"]
    /// 'edge'
    #[getter]
    fn readings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (reading, choice) in self.readings_of() {
            dict.set_item(reading, choice)?;
        }
        Ok(dict)
    }

    fn __repr__(&self) -> String {
        let readings = self.machine.readings();
        let other = self.edition.questions().map(|reading| readings.choice(reading));
        let other: Vec<String> = other
            .filter(|&choice| !self.edition.readings.is(choice))
            .map(|choice| format!("'{}': '{}'", choice.reading().id(), choice.id()))
            .collect();
        let mut given = Vec::new();
        if !other.is_empty() {
            given.push(format!("{{{}}}", other.join(", ")));
        }
        if self.edition != edition::DEFAULT {
            given.push(format!("edition='{}'", self.edition.version));
        }
        format!("Machine({})", given.join(", "))
    }

    #[expect(clippy::type_complexity, reason = "a class, and what makes one of it")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyType>, (Bound<'py, PyDict>, &'static str))> {
        Ok((slf.get_type(), (slf.get().readings(slf.py())?, slf.get().edition.version)))
    }
}

/// A VCU that remembers: a Machine with its Control and the last messages of the AI Computer.
///
/// readings, edition: as of Machine.
///
/// It does not measure for how long messages have been missing, which matters from edition 4.0 on: that is an input of each
/// step ("status_silence_ms" and its like), and 0 where it is not given.
///
/// >>> import adsdv
/// >>> vcu = adsdv.Vcu()
/// >>> vcu.step(asms=True, tsms=True, ami="TRACK_DRIVE", ebs="ARMED", mission_status="SELECTED")
/// <adsdv.Step: AS_OFF -> AS_READY, section 3.1>
/// >>> vcu.state
/// 'AS_READY'
/// >>> vcu.step(asms=False).section
/// '3.6'
#[pyclass(module = "adsdv")]
pub(crate) struct Vcu {
    machine: Machine,
    control: adsdv_spec::Control,
    ai: AiMessages,
}

#[pymethods]
impl Vcu {
    #[new]
    #[pyo3(signature = (readings=None, edition=None))]
    fn new(readings: Option<&Bound<'_, PyAny>>, edition: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let machine = Machine::with(readings, edition)?;
        Ok(Self { machine, control: adsdv_spec::Control::INITIAL, ai: AiMessages::default() })
    }

    /// Steps once, as Machine.step does. Inputs of the AI Computer that are not given are as last received.
    ///
    /// >>> import adsdv
    /// >>> adsdv.Vcu().step({"asms": True}, 10, tsms=True).outputs["ts_switch_status"]
    /// True
    #[pyo3(signature = (inputs=None, dt_ms=None, **keywords))]
    fn step(
        slf: &Bound<'_, Self>,
        inputs: Option<&Bound<'_, PyAny>>,
        dt_ms: Option<&Bound<'_, PyAny>>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Step> {
        // The arguments may run code of their own, which may use this VCU. So it is not held meanwhile.
        let (ai, edition) = {
            let vcu = slf.try_borrow()?;
            (vcu.ai, vcu.machine.edition)
        };
        let inputs = self::inputs(edition, ai, inputs, keywords)?;
        let dt_ms = time(edition, dt_ms)?;
        let mut vcu = slf.try_borrow_mut()?;
        let step = vcu.machine.take(&vcu.control, inputs, dt_ms);
        vcu.control = step.control;
        Ok(step)
    }

    /// Takes over what a frame of the bus says, and tells whether it is a message of the AI Computer that a VCU acts on.
    ///
    /// Data that is no such message changes nothing and is a CodecError.
    ///
    /// >>> import adsdv
    /// >>> vcu = adsdv.Vcu()
    /// >>> vcu.receive(*adsdv.encode("AI2VCU_Brake", HYD_PRESS_F_REQ_pct=50))
    /// True
    /// >>> adsdv.decode(*adsdv.frames(vcu.step())[4])["signals"]["HYD_PRESS_F_REQ_pct"]
    /// 50.0
    fn receive(slf: &Bound<'_, Self>, id: &Bound<'_, PyAny>, data: &Bound<'_, PyAny>) -> PyResult<bool> {
        let (id, data) = (value::id(id)?, value::data(data)?);
        let mut vcu = slf.try_borrow_mut()?;
        let bus = &vcu.machine.edition.bus;
        vcu.ai.receive(bus, id, &data).map_err(|error| codec::error(&error))
    }

    /// Begins anew, as after a power cycle.
    fn reset(&mut self) {
        self.control = adsdv_spec::Control::INITIAL;
        self.ai = AiMessages::default();
    }

    /// What it remembers: a Control. It can be set to one that its edition can have.
    #[getter]
    fn control(&self) -> Control {
        Control(self.control)
    }

    #[setter]
    fn set_control(&mut self, control: &Control) -> PyResult<()> {
        edition::check_control(self.machine.edition, &control.0)?;
        self.control = control.0;
        Ok(())
    }

    /// The state that it is in, such as "AS_OFF".
    #[getter]
    fn state(&self) -> &'static str {
        self.control.state.name()
    }

    /// The Machine that it is.
    #[getter]
    fn machine(&self) -> Machine {
        self.machine
    }

    fn __repr__(&self) -> String {
        format!("<adsdv.Vcu: {}>", self.state())
    }
}
