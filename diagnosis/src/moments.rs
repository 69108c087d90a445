//! The moment at which a time is over: just before it, at it, and just after it, whatever step ends then.

use adsdv_conform::ProgramError;
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Term};

use crate::experiments::Experiments;
use crate::pilot::Pilot;

/// So many of the shortest steps are looked at around the moment.
const AROUND: u32 = 2;

/// When "Go" is on, by the time that is left when it is switched.
#[derive(Clone, Copy)]
enum Go {
    /// Off, and switched on then.
    Comes(u32),
    /// On from the beginning.
    Stays,
    /// On from the beginning, off for a moment, and on again then.
    Blinks(u32),
    /// On for a moment at the beginning, and switched on then.
    CameBefore(u32),
}

impl Experiments<'_> {
    /// An arrow that waits for a time, by steps that are as short as can be.
    pub(crate) fn at_the_moment(
        &mut self,
        state: AsState,
        term: &Term,
        to: AsState,
    ) -> Result<(), ProgramError> {
        if term.on.has(Atom::DwellElapsed) {
            let switched = (0..=AROUND).flat_map(|left| [Go::Comes(left), Go::Blinks(left)]);
            for go in switched.chain([Go::Stays, Go::CameBefore(1), Go::CameBefore(0)]) {
                self.try_it(state, |pilot| {
                    pilot.ready(term, to);
                    passes(pilot, go)
                })?;
            }
        }
        if term.on.has(Atom::EbsTimerComplete) {
            for early_ms in 0..=AROUND {
                self.try_it(state, |pilot| {
                    pilot.ready(term, to);
                    let left = pilot.left_ms();
                    pilot.step(left.saturating_sub(early_ms).max(1))?;
                    (0..=AROUND).try_for_each(|_| pilot.step(1))
                })?;
            }
        }
        Ok(())
    }
}

/// The time of a state passes, and "Go" is switched as it says.
fn passes(pilot: &mut Pilot<'_>, go: Go) -> Result<(), ProgramError> {
    pilot.inputs.go = !matches!(go, Go::Comes(_));
    pilot.step(1)?;
    if matches!(go, Go::CameBefore(_)) {
        pilot.inputs.go = false;
    }
    let left = match go {
        Go::Comes(left) | Go::Blinks(left) | Go::CameBefore(left) => left,
        Go::Stays => AROUND,
    };
    let before = pilot.left_ms().saturating_sub(left);
    if matches!(go, Go::Blinks(_)) {
        pilot.step(before.saturating_sub(1).max(1))?;
        pilot.inputs.go = false;
        pilot.step(1)?;
    } else {
        pilot.step(before.max(1))?;
    }
    pilot.inputs.go = true;
    (0..=2 * AROUND).try_for_each(|_| pilot.step(1))
}
