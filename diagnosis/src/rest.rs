//! What a program does otherwise that is no change of Figure 2, of a time or of a threshold, ready to be applied.

use adsdv_conform::protocol::{INPUTS, InputField, SHOWN};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Fault, Faults};

use crate::deviation::{Deviation, Remembers, Wheels};

/// What is no change of the rules, ready to be applied.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Rest {
    Needs { from: AsState, to: AsState, field: &'static InputField, raw: i32, is: bool },
    Also { from: AsState, to: AsState, field: &'static InputField, raw: i32 },
    Late { from: AsState, to: AsState, steps: u8 },
    Ignores { field: &'static InputField },
    Opens { field: &'static InputField, raw: i32 },
    Wheels(Wheels),
    GoLevel,
    GoNeedsHandshake,
    Remembers(Remembers),
    Causes { from: AsState, value: ShutdownCause, raw: ShutdownCause },
    Prefers { from: AsState, value: ShutdownCause, raw: ShutdownCause },
    Shows { state: AsState, place: usize, raw: i32 },
    Writes { place: usize, value: i32, raw: i32 },
}

/// The place of an output in [`SHOWN`].
fn place_of(key: &str) -> Option<usize> {
    SHOWN.iter().position(|field| field.key == key)
}

/// The places of the outputs that tell what a program remembers.
pub(crate) const AS_STATE: usize = place("as_state");
pub(crate) const SHUTDOWN_CAUSE: usize = place("shutdown_cause");
pub(crate) const HANDSHAKE: usize = place("handshake");

/// The place of an output that there is; another does not compile.
const fn place(key: &str) -> usize {
    let mut place = 0;
    while !SHOWN[place].key.eq_ignore_ascii_case(key) {
        place += 1;
    }
    place
}

/// The places of the faults' flags, fault by fault.
const FLAGS: [usize; Fault::ALL.len()] = {
    let mut places = [0; Fault::ALL.len()];
    let mut i = 0;
    while i < places.len() {
        places[i] = place(Fault::ALL[i].flag());
        i += 1;
    }
    places
};

/// The faults whose flags are on, of outputs by their places.
pub(crate) fn flags(shown: impl Fn(usize) -> Option<i32>) -> Faults {
    let on = |place: usize| shown(place) == Some(true.into());
    let faults = Fault::ALL.iter().zip(FLAGS);
    faults.fold(Faults::NONE, |all, (fault, place)| all.union(Faults::when(*fault, on(place))))
}

impl Rest {
    /// That of a deviation; `None` for a change of the rules.
    pub(crate) fn of(deviation: &Deviation) -> Option<Self> {
        let field = |key: &str| INPUTS.iter().find(|field| field.key == key);
        Some(match *deviation {
            Deviation::Changed(_) | Deviation::Joined { .. } | Deviation::Reads(_) => return None,
            Deviation::Needs { from, to, key, raw, is } => {
                Self::Needs { from, to, field: field(key)?, raw, is }
            }
            Deviation::Also { from, to, key, raw } => Self::Also { from, to, field: field(key)?, raw },
            Deviation::Late { from, to, steps } => Self::Late { from, to, steps },
            Deviation::Ignores { key } => Self::Ignores { field: field(key)? },
            Deviation::Opens { key, raw } => Self::Opens { field: field(key)?, raw },
            Deviation::Wheels(wheels) => Self::Wheels(wheels),
            Deviation::GoLevel => Self::GoLevel,
            Deviation::GoNeedsHandshake => Self::GoNeedsHandshake,
            Deviation::Remembers(what) => Self::Remembers(what),
            Deviation::Causes { from, value, raw } => Self::Causes {
                from,
                value: ShutdownCause::from_raw(value)?,
                raw: ShutdownCause::from_raw(raw)?,
            },
            Deviation::Prefers { from, value, raw } => Self::Prefers {
                from,
                value: ShutdownCause::from_raw(value)?,
                raw: ShutdownCause::from_raw(raw)?,
            },
            Deviation::Shows { state, key, raw } => Self::Shows { state, place: place_of(key)?, raw },
            Deviation::Writes { key, value, raw } => Self::Writes { place: place_of(key)?, value, raw },
        })
    }
}
