//! The cause of an emergency, and the flags of the faults, as deviations have them.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Control, Fault, Faults, Noticed, Reaction};

use crate::deviation::Remembers;
use crate::rest::Rest;

/// Changes what a step gave that began in this control state, and noticed this.
pub(crate) fn apply(
    deviations: &[Rest],
    remembers: impl Fn(Remembers) -> bool,
    (before, noticed): (&Control, &Noticed),
    reaction: &mut Reaction,
) {
    let braking = |control: &Control| control.state == AsState::EmergencyBrake;
    let begins = braking(&reaction.control) && !braking(before);
    let live = noticed.faults.union(Faults::when(Fault::AiCommsFault, noticed.comms_lost));
    let forgets = remembers(Remembers::CauseUntilLeft) && !braking(&reaction.control);
    if forgets {
        reaction.control.shutdown_cause = ShutdownCause::NoShutdown;
    }
    if forgets || remembers(Remembers::LiveFlags) && !begins {
        reaction.faults = live;
    }
    // What was remembered before stays what it is.
    if !begins || before.shutdown_cause != ShutdownCause::NoShutdown {
        return;
    }
    let usual = reaction.control.shutdown_cause;
    let preferred = deviations.iter().fold(usual, |cause, rest| match *rest {
        Rest::Prefers { from, value, raw } if (from, value) == (before.state, cause) => {
            let arises = !reaction.faults.intersection(Faults::of_cause(raw)).is_empty();
            if arises { raw } else { cause }
        }
        _ => cause,
    });
    let given = deviations.iter().find_map(|rest| match *rest {
        Rest::Causes { from, value, raw } => Some(raw).filter(|_| (from, value) == (before.state, preferred)),
        _ => None,
    });
    let cause = given.unwrap_or(preferred);
    if cause != usual {
        reaction.control.shutdown_cause = cause;
        reaction.faults = live.union(Faults::of_cause(cause));
    }
}
