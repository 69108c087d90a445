//! Which VCU steps: the specification with one answer to every question that the document leaves open.

use core::ffi::c_char;

use adsdv_spec::{Choice, Choices, Edition, Machine, Readings};

use crate::border::{Plain, answer, out, text};
use crate::edition::{self, adsdv_edition};
use crate::error::{Refusal, adsdv_error, adsdv_status};

/// A VCU: an edition of the interface with an answer to every question that it leaves open. It is eight bytes that can be
/// copied, compared and kept.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct adsdv_machine {
    /// The edition.
    pub edition: adsdv_edition,
    /// The readings; adsdv_machine_init and adsdv_machine_init_in write them.
    pub readings: u32,
}

// SAFETY: `repr(C)`, integers only.
unsafe impl Plain for adsdv_machine {}

/// The machine of each edition with all its defaults.
static DEFAULTS: [Machine; edition::COUNT] = {
    let mut machines = [Machine::new(*edition::EDITION, edition::EDITION.readings); edition::COUNT];
    let mut number = 0;
    while number < edition::COUNT {
        machines[number] = Machine::new(*Edition::ALL[number], Edition::ALL[number].readings);
        number += 1;
    }
    machines
};

/// And its readings.
const READINGS: [u32; edition::COUNT] = {
    let mut readings = [0; edition::COUNT];
    let mut number = 0;
    while number < edition::COUNT {
        readings[number] = Edition::ALL[number].readings.choices().bits();
        number += 1;
    }
    readings
};

impl adsdv_machine {
    /// The default edition with all its defaults.
    pub(crate) const REFERENCE: Self =
        Self { edition: edition::DEFAULT, readings: edition::EDITION.readings.choices().bits() };

    /// The edition and the readings; an error where there is no such edition, or the bits are not one choice of each reading
    /// that the edition leaves.
    fn read(self) -> Result<(&'static Edition, Readings), Refusal<'static>> {
        let edition = edition::given(self.edition, "machine.")?;
        let unknown = Refusal::Machine { readings: self.readings };
        let Some(choices) = Choices::from_bits(self.readings) else { return Err(unknown) };
        let readings = choices.iter().fold(edition.readings, Readings::with);
        // Not so if a reading has no choice or several.
        let one_of_each = readings.choices() == choices && choices.is_subset(edition.choices);
        if one_of_each { Ok((edition, readings)) } else { Err(unknown) }
    }

    /// The machine itself, for which there is `room` where it is not kept anyway.
    #[inline(always)]
    pub(crate) fn find(self, room: &mut Option<Machine>) -> Result<&Machine, Refusal<'static>> {
        let place = edition::place(self.edition);
        match DEFAULTS.get(place) {
            Some(machine) if READINGS.get(place) == Some(&self.readings) => Ok(machine),
            _ => self.find_other(room),
        }
    }

    fn find_other(self, room: &mut Option<Machine>) -> Result<&Machine, Refusal<'static>> {
        #[cfg(feature = "std")]
        if let Some(machine) = kept::find(self) {
            return Ok(machine);
        }
        let (edition, readings) = self.read()?;
        Ok(room.insert(Machine::new(*edition, readings)))
    }
}

/// The machines of the first few readings that are asked for. To make one takes longer than a step.
#[cfg(feature = "std")]
mod kept {
    use std::sync::OnceLock;

    use adsdv_spec::Machine;

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
                let (edition, readings) = wanted.read().ok()?;
                place.get_or_init(|| (wanted, Machine::new(*edition, readings)))
            };
            // Somebody else may have been quicker to take the place.
            if *kept == wanted {
                return Some(machine);
            }
        }
        None
    }
}

/// The choices of a list such as `fault-trigger=edge, power-cycle=not-latched`, each of which the edition has to leave.
pub(crate) fn choices<'a>(
    edition: &'static Edition,
    list: &'a str,
) -> impl Iterator<Item = Result<Choice, Refusal<'a>>> {
    let mut given = Choices::NONE;
    list.split([' ', ',', '\t', '\n']).filter(|name| !name.is_empty()).map(move |name| {
        let choice: Choice = name.parse().map_err(|why| Refusal::Reading { given: name, why })?;
        let reading = choice.reading();
        if given.of_reading(reading).next().is_some() {
            return Err(Refusal::Twice(reading));
        }
        if !edition.choices.has(choice) {
            return Err(Refusal::NoChoice { choice, edition });
        }
        given = given.with(choice);
        Ok(choice)
    })
}

/// The choices of such a list; NULL is an empty one.
///
/// The caller promises for the pointer what it promises for every text.
pub(crate) unsafe fn listed<'a, T>(
    edition: &'static Edition,
    list: *const c_char,
    start: T,
    mut add: impl FnMut(T, Choice) -> T,
) -> Result<T, Refusal<'a>> {
    if list.is_null() {
        return Ok(start);
    }
    // SAFETY: the caller promises it.
    let list = unsafe { text(list, "readings")? };
    choices(edition, list).try_fold(start, |so_far, choice| Ok(add(so_far, choice?)))
}

/// A VCU of the default edition that reads the document as this list says, such as
/// "fault-trigger=edge power-cycle=not-latched": readings and their choices, with spaces or commas between them. What is not in
/// the list is read as the default says; NULL and "" are all defaults. adsdv_reading_at tells which there are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_machine_init(
    machine: *mut adsdv_machine,
    readings: *const c_char,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_machine_init_in(edition::DEFAULT, machine, readings, error) }
}

/// A VCU of an edition, likewise. A choice that the edition does not leave is an error (ADSDV_UNKNOWN_NAME);
/// adsdv_reading_at_in tells which there are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_machine_init_in(
    edition: adsdv_edition,
    machine: *mut adsdv_machine,
    readings: *const c_char,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let number = edition;
        let edition = edition::given(number, "")?;
        // SAFETY: the caller promises it for the machine and the text.
        let (place, readings) = unsafe {
            (out(machine, "machine")?, listed(edition, readings, edition.readings, Readings::with)?)
        };
        place.set(adsdv_machine { edition: number, readings: readings.choices().bits() });
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
