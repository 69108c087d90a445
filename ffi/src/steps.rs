//! Many steps in one call: those of one VCU, one after the other, or one of each of many VCUs.
//!
//! The call, the search for the machine and, for one VCU, the check of what it remembers are there once and not for each step, and
//! what a step shows is made only where it is asked for.

use adsdv_spec::{Control, Machine};

use crate::border::{Array, answer, array, load, out, slice, some_array};
use crate::control::adsdv_control;
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::inputs::adsdv_inputs;
use crate::machine::adsdv_machine;
use crate::outputs::adsdv_outputs;
use crate::step::{one, which};

/// `count` steps of one VCU, one after the other: what `count` calls of adsdv_step do, in a fraction of the time.
///
/// `machine` is that of adsdv_step. `control` is what the VCU remembers, before the first step and then after the last. Each step has
/// a place of `inputs` and one of `dt_ms`, the milliseconds since the step before; if `dt_ms` is NULL each takes a cycle of the
/// edition, 10 ms. What the VCU remembers after each step goes to `controls`, and what each step shows to `outputs`. They have
/// `count` places each, or are NULL: what is not wanted takes no time. No array may overlap another.
///
/// An error in the inputs of a step names the place and the field, such as "inputs[3].asms is 7; expected 0 or 1", and ends the call
/// there: the steps before it are made, `control` is what the VCU remembers after them, and the places from there on stay as they
/// are. `done`, which may be NULL, is set to how many steps were made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_step_n(
    machine: *const adsdv_machine,
    control: *mut adsdv_control,
    inputs: *const adsdv_inputs,
    dt_ms: *const u32,
    count: usize,
    controls: *mut adsdv_control,
    outputs: *mut adsdv_outputs,
    done: *mut usize,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for all of them.
        let (steps, controls) = unsafe {
            let steps = Steps::of(machine, inputs, dt_ms, count, outputs, done)?;
            (steps, some_array(controls, count, "controls")?)
        };
        // SAFETY: the caller promises it for the control state.
        let (before, after) = unsafe { (load(control, "control")?, out(control, "control")?) };
        let mut room = None;
        let machine = steps.machine.find(&mut room)?;
        let mut control = before.read(steps.machine.edition)?;
        let ended = steps.each(machine, |place, inputs, dt_ms| {
            steps.make(machine, place, &mut control, inputs, dt_ms)?;
            if let Some(controls) = &controls {
                controls.set(place, adsdv_control::from(&control));
            }
            Ok(())
        });
        after.set(adsdv_control::from(&control));
        ended
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// A step of each of `count` VCUs, as adsdv_step makes it: for many runs at once, or, where all remember the same, for all that one
/// VCU might see next.
///
/// `machine` is that of adsdv_step, for all of them. Each VCU has a place of `control`, before and then after the step, one of
/// `inputs`, and one of `dt_ms` and `outputs`, which are those of adsdv_step_n. No array may overlap another.
///
/// An error in what a VCU remembers or sees names its place and the field, such as "control[3].state is 0", and ends the call there:
/// the VCUs before it have made their step. `done`, which may be NULL, is set to how many they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_step_each(
    machine: *const adsdv_machine,
    control: *mut adsdv_control,
    inputs: *const adsdv_inputs,
    dt_ms: *const u32,
    count: usize,
    outputs: *mut adsdv_outputs,
    done: *mut usize,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for all of them.
        let (steps, controls) = unsafe {
            let steps = Steps::of(machine, inputs, dt_ms, count, outputs, done)?;
            (steps, array(control, count, "control")?)
        };
        let (edition, mut room) = (steps.machine.edition, None);
        let machine = steps.machine.find(&mut room)?;
        steps.each(machine, |place, inputs, dt_ms| {
            if let Some(control) = controls.get(place) {
                let mut control = control.read(edition)?;
                steps.make(machine, place, &mut control, inputs, dt_ms)?;
                controls.set(place, adsdv_control::from(&control));
            }
            Ok(())
        })
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// What both are asked for.
struct Steps<'a> {
    machine: adsdv_machine,
    inputs: &'a [adsdv_inputs],
    dt_ms: Option<&'a [u32]>,
    outputs: Option<Array<adsdv_outputs>>,
    done: Option<Array<usize>>,
}

impl Steps<'_> {
    /// The caller promises for the pointers what it promises for all of them.
    unsafe fn of(
        machine: *const adsdv_machine,
        inputs: *const adsdv_inputs,
        dt_ms: *const u32,
        count: usize,
        outputs: *mut adsdv_outputs,
        done: *mut usize,
    ) -> Result<Self, Refusal<'static>> {
        // SAFETY: the caller promises it.
        let done = unsafe { some_array(done, 1, "done")? };
        if let Some(done) = &done {
            done.set(0, 0);
        }
        // SAFETY: the caller promises it for all of them.
        unsafe {
            Ok(Self {
                machine: which(machine)?,
                inputs: slice(inputs, count, "inputs")?,
                dt_ms: if dt_ms.is_null() { None } else { Some(slice(dt_ms, count, "dt_ms")?) },
                outputs: some_array(outputs, count, "outputs")?,
                done,
            })
        }
    }

    /// Makes one after the other, up to the first that is refused: `make` has its place, its inputs and its time.
    #[inline(always)]
    fn each(
        &self,
        machine: &Machine,
        mut make: impl FnMut(usize, &adsdv_inputs, u32) -> Result<(), Refusal<'static>>,
    ) -> Result<(), Refusal<'static>> {
        let cycle_ms = u32::from(machine.edition().rules.timing.cycle_ms);
        let (mut done, mut ended) = (0, Ok(()));
        for (place, inputs) in self.inputs.iter().enumerate() {
            let dt_ms = self.dt_ms.and_then(|dt_ms| dt_ms.get(place)).copied().unwrap_or(cycle_ms);
            if let Err(refusal) = make(place, inputs, dt_ms) {
                ended = Err(refusal.at(place));
                break;
            }
            done += 1;
        }
        if let Some(place) = &self.done {
            place.set(0, done);
        }
        ended
    }

    /// Makes one of them.
    #[inline(always)]
    fn make(
        &self,
        machine: &Machine,
        place: usize,
        control: &mut Control,
        inputs: &adsdv_inputs,
        dt_ms: u32,
    ) -> Result<(), Refusal<'static>> {
        let (edition, shown) =
            (self.machine.edition, self.outputs.as_ref().and_then(|outputs| outputs.at(place)));
        if one(machine, edition, control, inputs, dt_ms, shown) {
            Ok(())
        } else {
            Err(inputs.refusal(edition))
        }
    }
}
