//! `Machine`, which steps, and `Vcu`, which remembers.

use adsdv_oracle::protocol::INPUTS;
use adsdv_spec::{AiMessages, Inputs, Readings};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::EDITION;
use crate::codec;
use crate::control::Control;
use crate::step::Step;
use crate::value;

/// The state machine of a VCU: a pure function from what it remembers and sees to what it remembers and shows.
///
/// readings: where the document allows more than one meaning, the one to follow, such as {"fault-trigger": "edge"};
/// adsdv.readings() lists them. What is not in it is at its default.
///
/// >>> import adsdv
/// >>> machine = adsdv.Machine(readings={"fault-trigger": "edge"})
/// >>> control = adsdv.Control()
/// >>> step = machine.step(control, {"asms": True, "tsms": True}, 10)
/// >>> step.control
/// Control(handshake_active=True, handshake_bit=True)
#[pyclass(frozen, eq, hash, module = "adsdv")]
#[derive(Clone, Copy)]
pub(crate) struct Machine(adsdv_spec::Machine);

/// The same readings make the same machine.
impl PartialEq for Machine {
    fn eq(&self, other: &Self) -> bool {
        self.0.readings() == other.0.readings()
    }
}

impl std::hash::Hash for Machine {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.readings().hash(state);
    }
}

impl Machine {
    fn with(readings: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let readings = value::choices(readings)?.into_iter().fold(EDITION.readings, Readings::with);
        Ok(Self(adsdv_spec::Machine::new(*EDITION, readings)))
    }

    fn take(&self, control: &adsdv_spec::Control, inputs: Inputs, dt_ms: u32) -> Step {
        let (control, outputs) = self.0.step(control, &inputs, dt_ms);
        Step { control, outputs, inputs }
    }

    fn readings_of(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let readings = self.0.readings();
        EDITION.questions().map(move |reading| (reading.id(), readings.choice(reading).id()))
    }
}

/// Inputs: those of the AI Computer as far as they were received, and what is given.
fn inputs(
    ai: AiMessages,
    given: Option<&Bound<'_, PyAny>>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Inputs> {
    let mut inputs = Inputs { ai, ..Inputs::default() };
    value::each(given, keywords, |key, given| {
        let mut fields = INPUTS.iter().filter(|field| field.is_in(crate::EDITION));
        let known = fields.clone().map(|field| field.key);
        let field = fields.find(|field| field.key == key).ok_or_else(|| value::unknown_key(key, known))?;
        let set = (field.set)(&mut inputs, value::raw(key, given, field.domain)?);
        if set { Ok(()) } else { Err(value::refused(key, given, field.domain)) }
    })?;
    Ok(inputs)
}

/// How long a step takes if it is not said: a cycle of the reference VCU.
fn time(dt_ms: Option<&Bound<'_, PyAny>>) -> PyResult<u32> {
    match dt_ms {
        Some(dt_ms) => value::whole("dt_ms", dt_ms, 0, u32::MAX),
        None => Ok(EDITION.rules.timing.cycle_ms.into()),
    }
}

#[pymethods]
impl Machine {
    #[new]
    #[pyo3(signature = (readings=None))]
    fn new(readings: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Self::with(readings)
    }

    /// One step: what a VCU that remembers `control` does when it sees these inputs.
    ///
    /// inputs: a flat dict with the keys of adsdv.inputs(), or keywords, or both; what is not there is at its default (off,
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
        let inputs = self::inputs(AiMessages::default(), inputs, keywords)?;
        Ok(self.take(&control.0, inputs, time(dt_ms)?))
    }

    /// Every reading with the choice that this machine makes.
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
        let usual = adsdv_spec::Machine::REFERENCE.readings();
        let other = EDITION.questions().map(|reading| self.0.readings().choice(reading));
        let other: Vec<String> = other
            .filter(|&choice| !usual.is(choice))
            .map(|choice| format!("'{}': '{}'", choice.reading().id(), choice.id()))
            .collect();
        if other.is_empty() { "Machine()".to_owned() } else { format!("Machine({{{}}})", other.join(", ")) }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyType>, (Bound<'py, PyDict>,))> {
        Ok((slf.get_type(), (slf.get().readings(slf.py())?,)))
    }
}

/// A VCU that remembers: a Machine with its Control and the last messages of the AI Computer.
///
/// readings: as of Machine.
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
    #[pyo3(signature = (readings=None))]
    fn new(readings: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let machine = Machine::with(readings)?;
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
        let ai = slf.try_borrow()?.ai;
        let inputs = self::inputs(ai, inputs, keywords)?;
        let dt_ms = time(dt_ms)?;
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
        slf.try_borrow_mut()?.ai.receive(&EDITION.bus, id, &data).map_err(|error| codec::error(&error))
    }

    /// Begins anew, as after a power cycle.
    fn reset(&mut self) {
        self.control = adsdv_spec::Control::INITIAL;
        self.ai = AiMessages::default();
    }

    /// What it remembers: a Control. It can be set.
    #[getter]
    fn control(&self) -> Control {
        Control(self.control)
    }

    #[setter]
    fn set_control(&mut self, control: &Control) {
        self.control = control.0;
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
