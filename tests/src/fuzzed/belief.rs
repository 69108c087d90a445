//! The step on what may be, whole: from any belief, glimpse and time around what is so, under any readings of any edition.
//!
//! `adsdv_proofs::belief` proves each of its factors; that they are put together rightly is tried here.

mod loose;

use std::ops::RangeInclusive;

use adsdv_spec::belief::{Belief, Glimpse, KnownFaults, Outlook};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Control, Inputs, Machine, Observation, Reaction, Taken};

use super::{Bytes, step};
use crate::world::Chance;

/// An arrow that was taken, and the edition.
pub type Arrow = (&'static str, Taken);

/// The body.
pub fn body(bytes: &[u8]) {
    taken(bytes);
}

/// Runs the body; the arrows that were taken in it, in their order.
pub fn taken(bytes: &[u8]) -> Vec<Arrow> {
    walk(bytes).unwrap_or_else(|wrong| panic!("{wrong}"))
}

/// Goes from step to step, and looks at each: the arrows that were taken, or what is wrong with a step.
///
/// # Errors
///
/// Fails if a belief does not hold what really is, or the two ways to compute it differ.
pub fn walk(bytes: &[u8]) -> Result<Vec<Arrow>, String> {
    let mut bytes = Bytes::new(bytes);
    let edition = bytes.edition();
    let machine = Machine::new(*edition, bytes.readings(edition));
    let timing = &edition.rules.timing;
    let mut control = if bytes.one_in(2) {
        step::any_control(&mut bytes, timing, machine.readings())
    } else {
        Control::INITIAL
    };
    let mut inputs = Inputs::default();
    let mut taken = Vec::new();
    while bytes.are_left() {
        inputs = step::next(&mut bytes, &machine, control.state, &inputs);
        // Now and then what no inputs look like.
        let seen = if bytes.one_in(8) { bytes.any() } else { inputs.observe(&edition.rules.thresholds) };
        let dt_ms = step::dt_ms(&mut bytes, timing);
        let known = Known::around(&mut bytes, &control, seen, dt_ms);
        let tried = Tried { machine: &machine, control, seen, dt_ms };
        let reaction = tried.react();
        tried.holds(&mut bytes, &known, &reaction).map_err(|wrong| {
            let readings = machine.readings();
            format!(
                "{wrong}: {tried:?}, which comes to {reaction:?}, from {known:?}, {} {readings}",
                edition.version
            )
        })?;
        taken.extend(reaction.taken.map(|taken| (edition.version, taken)));
        control = reaction.control;
    }
    Ok(taken)
}

/// What is known of a step.
#[derive(Clone, Debug)]
struct Known {
    belief: Belief,
    glimpse: Glimpse,
    dt_ms: RangeInclusive<u32>,
}

impl Known {
    /// Anything that allows this step.
    fn around(bytes: &mut Bytes<'_>, control: &Control, seen: Observation, dt_ms: u32) -> Self {
        let exact =
            Self { belief: Belief::exact(control), glimpse: Glimpse::exact(seen), dt_ms: dt_ms..=dt_ms };
        if bytes.one_in(8) { exact } else { exact.less(bytes) }
    }

    /// As much as this, or less.
    fn less(&self, bytes: &mut Bytes<'_>) -> Self {
        Self {
            belief: loose::belief(bytes, &self.belief),
            glimpse: loose::glimpse(bytes, &self.glimpse),
            dt_ms: loose::time(bytes, &self.dt_ms),
        }
    }

    fn outlook(&self, machine: &Machine) -> Outlook {
        machine.outlook(&self.belief, &self.glimpse, self.dt_ms.clone())
    }
}

/// A step.
struct Tried<'a> {
    machine: &'a Machine,
    control: Control,
    seen: Observation,
    dt_ms: u32,
}

impl std::fmt::Debug for Tried<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}, {:?}, {} ms", self.control, self.seen, self.dt_ms)
    }
}

impl Tried<'_> {
    fn react(&self) -> Reaction {
        self.machine.react(&self.control, self.seen, self.dt_ms)
    }

    /// What is claimed of the step on what may be: it is sound, exact and monotone.
    fn holds(&self, bytes: &mut Bytes<'_>, known: &Known, reaction: &Reaction) -> Result<(), String> {
        let Reaction { control: after, faults, .. } = reaction;
        must(known.belief.allows(&self.control) && known.glimpse.allows(self.seen), || "it is not allowed")?;
        let outlook = known.outlook(self.machine);
        let belief = self.machine.react_known(&known.belief, &known.glimpse, known.dt_ms.clone());
        must(belief == outlook.belief(), || "the belief is not that of the outlook")?;
        must(belief.allows(after), || format!("unsound: {belief:?}"))?;
        let shown = outlook.state(after.state).map(|possible| possible.faults);
        must(shown.is_some_and(|shown| shown.allows(*faults)), || format!("unsound faults: {shown:?}"))?;

        let exact = Known {
            belief: Belief::exact(&self.control),
            glimpse: Glimpse::exact(self.seen),
            dt_ms: self.dt_ms..=self.dt_ms,
        };
        let exact = exact.outlook(self.machine);
        must(exact.belief() == Belief::exact(after), || format!("inexact: {:?}", exact.belief()))?;
        let shown = exact.state(after.state).map(|possible| possible.faults);
        must(shown == Some(KnownFaults::exact(*faults)), || format!("inexact faults: {shown:?}"))?;

        let less = known.less(bytes);
        let of_less = less.outlook(self.machine);
        must(covers(&of_less, &outlook), || {
            format!("not monotone: {less:?} comes to {of_less:?}, and not to {outlook:?}")
        })
    }
}

/// Whether one outlook allows all that the other does.
fn covers(one: &Outlook, other: &Outlook) -> bool {
    let faults = |state| match (one.state(state), other.state(state)) {
        (Some(one), Some(other)) => one.faults.covers(other.faults),
        (_, None) => true,
        (None, Some(_)) => false,
    };
    one.belief().covers(&other.belief()) && AsState::ALL.into_iter().all(faults)
}

fn must<T: Into<String>>(so: bool, wrong: impl FnOnce() -> T) -> Result<(), String> {
    if so { Ok(()) } else { Err(wrong().into()) }
}
