//! Which VCU steps: the specification with one answer to every question that the document leaves open.

use core::ffi::c_char;

use adsdv_spec::{Choice, Choices, Machine, Readings};

use crate::EDITION;
use crate::border::{Plain, answer, out, text};
use crate::error::{Refusal, adsdv_error, adsdv_status};

/// A VCU: the interface with an answer to every question that the document leaves open. It is four bytes that can be
/// copied, compared and kept.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct adsdv_machine {
    /// The readings; adsdv_machine_init writes them.
    pub readings: u32,
}

// SAFETY: `repr(C)`, an integer.
unsafe impl Plain for adsdv_machine {}

static REFERENCE: Machine = Machine::REFERENCE;

impl adsdv_machine {
    pub(crate) const REFERENCE: Self = Self { readings: EDITION.readings.choices().bits() };

    /// The readings; an error where the bits are not one choice of each.
    fn read(self) -> Result<Readings, Refusal<'static>> {
        let unknown = Refusal::Machine { readings: self.readings };
        let Some(choices) = Choices::from_bits(self.readings) else { return Err(unknown) };
        let readings = choices.iter().fold(EDITION.readings, Readings::with);
        // Not so if a reading has no choice or several.
        if readings.choices() == choices { Ok(readings) } else { Err(unknown) }
    }

    /// The machine itself, for which there is `room` where it is not kept anyway.
    #[inline(always)]
    pub(crate) fn find(self, room: &mut Option<Machine>) -> Result<&Machine, Refusal<'static>> {
        if self == Self::REFERENCE { Ok(&REFERENCE) } else { self.find_other(room) }
    }

    fn find_other(self, room: &mut Option<Machine>) -> Result<&Machine, Refusal<'static>> {
        #[cfg(feature = "std")]
        if let Some(machine) = kept::find(self) {
            return Ok(machine);
        }
        Ok(room.insert(Machine::new(*EDITION, self.read()?)))
    }
}

/// The machines of the first few readings that are asked for. To make one takes longer than a step.
#[cfg(feature = "std")]
mod kept {
    use std::sync::OnceLock;

    use adsdv_spec::Machine;

    use crate::EDITION;

    use super::adsdv_machine;

    /// Who compares readings compares a few.
    const COUNT: usize = 16;

    static KEPT: [OnceLock<(adsdv_machine, Machine)>; COUNT] = [const { OnceLock::new() }; COUNT];

    /// The machine, which is kept from now on if there is room; `None` if there is none, or no such machine.
    pub(super) fn find(wanted: adsdv_machine) -> Option<&'static Machine> {
        for place in &KEPT {
            let (kept, machine) = if let Some(kept) = place.get() {
                kept
            } else {
                let readings = wanted.read().ok()?;
                place.get_or_init(|| (wanted, Machine::new(*EDITION, readings)))
            };
            // Somebody else may have been quicker to take the place.
            if *kept == wanted {
                return Some(machine);
            }
        }
        None
    }
}

/// The choices of a list such as `fault-trigger=edge, power-cycle=not-latched`.
pub(crate) fn choices(list: &str) -> impl Iterator<Item = Result<Choice, Refusal<'_>>> {
    let mut given = Choices::NONE;
    list.split([' ', ',', '\t', '\n']).filter(|name| !name.is_empty()).map(move |name| {
        let choice: Choice = name.parse().map_err(|why| Refusal::Reading { given: name, why })?;
        let reading = choice.reading();
        if given.of_reading(reading).next().is_some() {
            return Err(Refusal::Twice(reading));
        }
        given = given.with(choice);
        Ok(choice)
    })
}

/// The choices of such a list; NULL is an empty one.
///
/// The caller promises for the pointer what it promises for every text.
pub(crate) unsafe fn listed<'a, T>(
    list: *const c_char,
    start: T,
    mut add: impl FnMut(T, Choice) -> T,
) -> Result<T, Refusal<'a>> {
    if list.is_null() {
        return Ok(start);
    }
    // SAFETY: the caller promises it.
    let list = unsafe { text(list, "readings")? };
    choices(list).try_fold(start, |so_far, choice| Ok(add(so_far, choice?)))
}

/// A VCU that reads the document as this list says, such as "fault-trigger=edge power-cycle=not-latched": readings and
/// their choices, with spaces or commas between them. What is not in the list is read as the default says; NULL and ""
/// are all defaults. adsdv_reading tells which there are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_machine_init(
    machine: *mut adsdv_machine,
    readings: *const c_char,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the machine and the text.
        let (place, readings) =
            unsafe { (out(machine, "machine")?, listed(readings, EDITION.readings, Readings::with)?) };
        place.set(adsdv_machine { readings: readings.choices().bits() });
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
