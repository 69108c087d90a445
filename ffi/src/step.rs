//! One step of the VCU.

use adsdv_spec::messages::Node;

use crate::EDITION;
use crate::border::{answer, check, fill, get, load, out};
use crate::control::adsdv_control;
use crate::error::{adsdv_error, adsdv_status};
use crate::frame::adsdv_frame;
use crate::inputs::adsdv_inputs;
use crate::machine::adsdv_machine;
use crate::outputs::adsdv_outputs;

/// How many frames the VCU sends after a step.
pub const ADSDV_VCU_FRAMES: usize = 9;

const _: () = {
    let messages = EDITION.bus.messages;
    let (mut frames, mut i) = (0, 0);
    while i < messages.len() {
        frames += matches!(messages[i].sender, Node::Vcu) as usize;
        i += 1;
    }
    assert!(frames == ADSDV_VCU_FRAMES, "a place for each frame that the VCU sends");
};

/// One step of the VCU: what it does when it sees these inputs `dt_ms` milliseconds after its last step.
///
/// `machine` says how the document is read; NULL is the reference, with all defaults. `control` is what the VCU
/// remembers, before and then after the step. What the step shows goes to `outputs`, and the frames that the VCU sends,
/// 520h to 526h, 500h and 502h, to `frames`, which has ADSDV_VCU_FRAMES places; either may be NULL.
///
/// A field with a value that it cannot have is an error that names it, and nothing is changed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_step(
    machine: *const adsdv_machine,
    control: *mut adsdv_control,
    inputs: *const adsdv_inputs,
    dt_ms: u32,
    outputs: *mut adsdv_outputs,
    frames: *mut adsdv_frame,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let machine = if machine.is_null() {
            adsdv_machine::REFERENCE
        } else {
            // SAFETY: the caller promises it for the machine.
            unsafe { load(machine, "machine")? }
        };
        // SAFETY: the caller promises it for the control state and the inputs.
        let (before, after, inputs) =
            unsafe { (load(control, "control")?, out(control, "control")?, get(inputs, "inputs")?) };
        // Nothing is changed by a function that fails: so all that can be wrong comes first.
        let shown = if outputs.is_null() {
            None
        } else {
            // SAFETY: the caller promises it for the outputs.
            Some(unsafe { out(outputs, "outputs")? })
        };
        if !frames.is_null() {
            check(frames, "frames")?;
        }
        let (before, inputs) = (before.read()?, inputs.read()?);
        let mut room = None;
        let machine = machine.find(&mut room)?;

        let (next, stepped) = machine.step(&before, &inputs, dt_ms);
        let messages = stepped.messages(&inputs);
        after.set(adsdv_control::from(&next));
        if let Some(shown) = shown {
            shown.set(adsdv_outputs::of(machine, &inputs, &stepped, messages.status));
        }
        if !frames.is_null() {
            let mut all = messages.frames(&machine.edition().bus);
            let sent: [_; ADSDV_VCU_FRAMES] = core::array::from_fn(|_| all.next().unwrap_or_default());
            // SAFETY: the caller promises that many places.
            unsafe { fill(frames, ADSDV_VCU_FRAMES, "frames", sent.into_iter().map(adsdv_frame::from))? };
        }
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
