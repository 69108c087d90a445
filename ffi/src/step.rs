//! One step of the VCU.

use adsdv_spec::messages::Node;
use adsdv_spec::{Bus, Control, Edition, Machine, Outputs, VcuMessages};

use crate::border::{Out, answer, check, fill, get, load, out};
use crate::control::adsdv_control;
use crate::edition::{self, adsdv_edition};
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::frame::adsdv_frame;
use crate::inputs::adsdv_inputs;
use crate::limits::Checked;
use crate::machine::adsdv_machine;
use crate::outputs::adsdv_outputs;

/// How many frames the VCU of the default edition sends after a step.
pub const ADSDV_VCU_FRAMES: usize = 9;
/// Room for the frames that the VCU of any edition sends after a step.
pub const ADSDV_MOST_VCU_FRAMES: usize = 16;

/// How many frames the VCU of each edition sends after a step.
const FRAMES: [usize; edition::COUNT] = {
    let mut frames = [0; edition::COUNT];
    let mut number = 0;
    while number < edition::COUNT {
        let messages = Edition::ALL[number].bus.messages;
        let mut i = 0;
        while i < messages.len() {
            frames[number] += matches!(messages[i].sender, Node::Vcu) as usize;
            i += 1;
        }
        assert!(frames[number] <= ADSDV_MOST_VCU_FRAMES, "a place for each frame that the VCU sends");
        number += 1;
    }
    frames
};

const _: () = assert!(
    FRAMES[edition::DEFAULT as usize] == ADSDV_VCU_FRAMES,
    "a place for each frame that the VCU sends"
);

/// One step of the VCU: what it does when it sees these inputs `dt_ms` milliseconds after its last step.
///
/// `machine` says of which edition it is and how the document is read; NULL is the default edition with all defaults. `control`
/// is what the VCU remembers, before and then after the step. What the step shows goes to `outputs`, and the frames that the
/// VCU of the default edition sends, 520h to 526h, 500h and 502h, to `frames`, which has ADSDV_VCU_FRAMES places; either may be
/// NULL. A machine of an edition whose VCU sends another number of frames is refused (ADSDV_NO_ROOM) unless `frames` is NULL:
/// adsdv_step_frames tells how many there are.
///
/// A field with a value that it cannot have in the edition is an error that names it, and nothing is changed.
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
        let places = (!frames.is_null()).then_some(Places { frames, room: ADSDV_VCU_FRAMES, exactly: true });
        // SAFETY: the caller promises it for all of them.
        unsafe { step(machine, control, inputs, dt_ms, outputs, places)? };
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// One step, like adsdv_step, of a VCU of any edition. The frames that it sends go to `frames`, which has `room` places
/// (ADSDV_MOST_VCU_FRAMES are always enough), and their number to `count`; the other places stay as they are. `outputs` may be
/// NULL. Too little room is an error (ADSDV_NO_ROOM), and nothing is changed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_step_frames(
    machine: *const adsdv_machine,
    control: *mut adsdv_control,
    inputs: *const adsdv_inputs,
    dt_ms: u32,
    outputs: *mut adsdv_outputs,
    frames: *mut adsdv_frame,
    room: usize,
    count: *mut usize,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the count.
        let count = unsafe { out(count, "count")? };
        let places = Some(Places { frames, room, exactly: false });
        // SAFETY: the caller promises it for all of them.
        count.set(unsafe { step(machine, control, inputs, dt_ms, outputs, places)? });
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// Where the frames go.
struct Places {
    frames: *mut adsdv_frame,
    room: usize,
    /// Whether all the room has to be filled.
    exactly: bool,
}

impl Places {
    /// Whether the frames of an edition go there.
    fn check(&self, edition: adsdv_edition) -> Result<(), Refusal<'static>> {
        let needed = FRAMES.get(edition::place(edition)).copied().unwrap_or_default();
        if needed > self.room || self.exactly && needed != self.room {
            return Err(Refusal::NoRoom { what: "frames", given: self.room, needed });
        }
        Ok(())
    }

    /// Writes the frames, and tells how many. The caller promises that there is as much room as is said.
    unsafe fn write(&self, messages: &VcuMessages, bus: &Bus) -> Result<usize, Refusal<'static>> {
        let mut sent = [adsdv_frame::default(); ADSDV_MOST_VCU_FRAMES];
        let mut count = 0;
        for (place, frame) in sent.iter_mut().zip(messages.frames(bus)) {
            *place = frame.into();
            count += 1;
        }
        // SAFETY: the caller promises it.
        unsafe { fill(self.frames, self.room, "frames", sent.iter().take(count).copied())? };
        Ok(count)
    }
}

/// A step, and how many frames were written. The caller promises for the pointers what it promises for all of them.
#[inline(always)]
unsafe fn step(
    machine: *const adsdv_machine,
    control: *mut adsdv_control,
    inputs: *const adsdv_inputs,
    dt_ms: u32,
    outputs: *mut adsdv_outputs,
    places: Option<Places>,
) -> Result<usize, Refusal<'static>> {
    // SAFETY: the caller promises it for the machine.
    let machine = unsafe { which(machine)? };
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
    if let Some(places) = &places {
        check(places.frames, "frames")?;
    }
    let edition = machine.edition;
    let mut room = None;
    let machine = machine.find(&mut room)?;
    let mut control = before.read(edition)?;
    if let Some(places) = &places {
        places.check(edition)?;
    }

    let Some(places) = places else {
        if !one(machine, edition, &mut control, inputs, dt_ms, shown) {
            return Err(inputs.refusal(edition));
        }
        after.set(adsdv_control::from(&control));
        return Ok(0);
    };
    let made = make(machine, edition, &mut control, inputs, dt_ms, |inputs, stepped| {
        if let Some(shown) = shown {
            shown.set(adsdv_outputs::of(machine, inputs, stepped));
        }
        // SAFETY: the caller promises it for the frames.
        unsafe { places.write(&stepped.messages(&inputs.read()), &machine.edition().bus) }
    });
    let count = made.ok_or_else(|| inputs.refusal(edition))??;
    after.set(adsdv_control::from(&control));
    Ok(count)
}

/// Makes a step, if the edition allows its inputs: from what the VCU remembers to what it remembers then. What it shows goes where
/// that is wanted. Whether it was made.
// A call: where it is a part of a loop, what it remembers is packed into registers and out of them again.
#[inline(never)]
pub(crate) fn one(
    machine: &Machine,
    edition: adsdv_edition,
    control: &mut Control,
    inputs: &adsdv_inputs,
    dt_ms: u32,
    shown: Option<Out<adsdv_outputs>>,
) -> bool {
    let show = |inputs: Checked<'_, _>, stepped| {
        if let Some(shown) = shown {
            shown.set(adsdv_outputs::of(machine, inputs, stepped));
        }
    };
    make(machine, edition, control, inputs, dt_ms, show).is_some()
}

/// The same, with what is done with its inputs and with what it shows.
#[inline(always)]
fn make<T>(
    machine: &Machine,
    edition: adsdv_edition,
    control: &mut Control,
    inputs: &adsdv_inputs,
    dt_ms: u32,
    show: impl FnOnce(Checked<'_, adsdv_inputs>, Outputs) -> T,
) -> Option<T> {
    let inputs = inputs.check(edition)?;
    let (next, stepped) = machine.step(control, &inputs.read(), dt_ms);
    *control = next;
    Some(show(inputs, stepped))
}

/// The machine that is asked for. The caller promises for the pointer what it promises for all of them.
#[inline(always)]
pub(crate) unsafe fn which(machine: *const adsdv_machine) -> Result<adsdv_machine, Refusal<'static>> {
    if machine.is_null() {
        return Ok(adsdv_machine::REFERENCE);
    }
    // SAFETY: the caller promises it.
    unsafe { load(machine, "machine") }
}
