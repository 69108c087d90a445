//! The open model: any AI Computer, any driver, any fault.
//!
//! Its states are the control states of the VCU, its actions what the VCU can see in a cycle, with the real times of the
//! document. Every action is tried at every state, without a bound.

mod questions;

use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use adsdv_spec::{Control, Machine, Timing};

use crate::look::{Engine, Look, Looker};
use crate::parts::Parts;
use crate::planes::Words;
use crate::vectors::{Cache, Vectors, varied, with_further};

/// A control state, and what the steps out of it show, once somebody asks.
#[derive(Clone, Debug)]
pub struct State {
    control: Control,
    look: OnceLock<Box<Look>>,
}

impl State {
    pub(crate) const fn new(control: Control) -> Self {
        Self { control, look: OnceLock::new() }
    }

    /// The control state.
    pub const fn control(&self) -> &Control {
        &self.control
    }
}

/// States are their control states; what a look shows follows from it.
impl PartialEq for State {
    fn eq(&self, other: &Self) -> bool {
        self.control == other.control
    }
}

impl Eq for State {}

/// All of the control state in one word, which is hashed faster than field by field.
impl Hash for State {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let Control {
            state: as_state,
            in_state_ms,
            go_seen_low,
            was_running,
            was_forward,
            handshake,
            power_cycle_needed,
            shutdown_cause,
        } = self.control;
        let flags =
            [go_seen_low, was_running, was_forward, handshake.active, handshake.bit, power_cycle_needed];
        let small = flags.iter().fold(as_state as u64, |bits, &flag| bits << 1 | u64::from(flag));
        let times = u64::from(in_state_ms) << 16 | u64::from(handshake.unanswered_ms);
        state.write_u64((small << 8 | shutdown_cause as u64) << 32 | times);
    }
}

/// The open model of one machine.
#[derive(Debug)]
pub struct Open {
    machine: Machine,
    document: Timing,
    vectors: Vectors,
    further: usize,
    looker: Looker,
    cache: Cache,
    parts: Option<Parts>,
    seen: Arc<Seen>,
    /// Stateright is asked for no property: see [`Open::unasked`].
    unasked: bool,
}

/// How far an exploration has come, and what it has shown.
#[derive(Debug, Default)]
pub(crate) struct Seen {
    /// Control states that were looked at.
    pub(crate) states: AtomicU64,
    /// Steps that were made.
    pub(crate) steps: AtomicU64,
    /// Control states whose successors were asked for.
    pub(crate) expanded: AtomicU64,
    /// The properties that some step breaks, a bit for each place in [`PROPERTIES`](crate::PROPERTIES).
    pub(crate) broken: AtomicU64,
    /// The goals that some step reaches, a bit for each place in [`goals`](crate::goals()).
    pub(crate) reached: AtomicU64,
}

impl Open {
    /// The open model of a machine; `document` has the times that the properties speak of.
    pub fn new(machine: Machine, document: Timing, vectors: Vectors) -> Self {
        Self {
            machine,
            document,
            vectors,
            further: 0,
            looker: Looker::new(&machine, &document, Engine::default()),
            cache: Cache::default(),
            parts: None,
            seen: Arc::default(),
            unasked: false,
        }
    }

    /// With the steps made by this engine.
    #[must_use]
    pub fn with_engine(self, engine: Engine) -> Self {
        Self { looker: Looker::new(&self.machine, &self.document, engine), ..self }
    }

    /// With so many more conditions varied that nothing depends on.
    #[must_use]
    pub(crate) const fn with_further(mut self, further: usize) -> Self {
        self.further = further;
        self
    }

    /// With a look at the parts of the table: which of them decide a step.
    #[must_use]
    pub(crate) fn with_parts(self) -> Self {
        Self { parts: Some(Parts::of(&self.machine)), ..self }
    }

    /// The machine that is explored.
    pub const fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The times that the properties speak of.
    pub const fn document(&self) -> &Timing {
        &self.document
    }

    /// The parts of the table, and which of them have been shown to matter.
    pub(crate) const fn parts(&self) -> Option<&Parts> {
        self.parts.as_ref()
    }

    /// How far the exploration has come.
    pub(crate) fn seen(&self) -> Arc<Seen> {
        Arc::clone(&self.seen)
    }

    /// The same model, of which stateright is asked for nothing but to go to the end. What a look shows is gathered
    /// anyway, and stateright has to find no examples, which takes it longer than the exploration.
    #[must_use]
    pub(crate) fn unasked(mut self) -> Self {
        self.unasked = true;
        self
    }

    /// What the steps out of a state show.
    pub(crate) fn look<'a>(&self, state: &'a State) -> &'a Look {
        state.look.get_or_init(|| {
            let look = self.looker.look(&state.control, &self.steps(&state.control));
            if let Some(parts) = &self.parts {
                parts.look(&self.machine, &state.control, &self.cache);
            }
            self.seen.states.fetch_add(1, Ordering::Relaxed);
            self.seen.steps.fetch_add(look.steps, Ordering::Relaxed);
            self.seen.broken.fetch_or(look.broken, Ordering::Relaxed);
            self.seen.reached.fetch_or(look.reached, Ordering::Relaxed);
            Box::new(look)
        })
    }

    /// The input vectors that are tried at a control state.
    pub(crate) fn steps(&self, control: &Control) -> Arc<Words> {
        let reads = varied(&self.machine, &self.document, control, self.vectors);
        self.cache.get(with_further(reads, self.further), self.vectors)
    }
}

#[cfg(test)]
mod tests {
    use std::hash::{BuildHasher as _, BuildHasherDefault};

    use adsdv_spec::messages::{AsState, ShutdownCause};
    use adsdv_spec::{Edition, Handshake, Readings};
    use fnv::FnvHasher;

    use super::*;
    use crate::action::Action;
    use crate::reachable::reachable;
    use crate::short_timers::SHORT_TIMERS;

    /// Stateright tells states apart by their hashes alone.
    #[test]
    fn control_states_that_differ_in_anything_have_other_hashes() {
        let one = Control {
            state: AsState::Driving,
            in_state_ms: 7,
            go_seen_low: true,
            was_running: true,
            was_forward: true,
            handshake: Handshake { active: true, bit: true, unanswered_ms: 9 },
            power_cycle_needed: true,
            shutdown_cause: ShutdownCause::HvilOpenFault,
        };
        let shaken = |handshake| Control { handshake, ..one };
        let others = [
            one,
            Control { state: AsState::Ready, ..one },
            Control { in_state_ms: 8, ..one },
            Control { in_state_ms: 7 << 4, ..one },
            Control { go_seen_low: false, ..one },
            Control { was_running: false, ..one },
            Control { was_forward: false, ..one },
            shaken(Handshake { active: false, ..one.handshake }),
            shaken(Handshake { bit: false, ..one.handshake }),
            shaken(Handshake { unanswered_ms: 8, ..one.handshake }),
            Control { power_cycle_needed: false, ..one },
            Control { shutdown_cause: ShutdownCause::NoShutdown, ..one },
        ];
        let hash =
            |control: Control| BuildHasherDefault::<FnvHasher>::default().hash_one(State::new(control));
        for (place, &control) in others.iter().enumerate() {
            for (other_place, &other) in others.iter().enumerate() {
                let same = place == other_place;
                assert_eq!(State::new(control) == State::new(other), same, "{control:?}, {other:?}");
                assert_eq!(hash(control) == hash(other), same, "{control:?}, {other:?}");
            }
        }
    }

    #[test]
    fn each_way_out_of_a_state_leads_elsewhere() {
        let edition = Edition::DEFAULT.with_timing(SHORT_TIMERS);
        let machine = Machine::new(edition, Readings::DEFAULT);
        let model = Open::new(machine, SHORT_TIMERS, Vectors::Few);
        for control in reachable(&machine, SHORT_TIMERS, Vectors::Few) {
            let state = State::new(control);
            let (cycles, steps): (Vec<Action>, Vec<Action>) =
                model.look(&state).ways.iter().partition(|&&way| way == Action::PowerCycle);
            assert_eq!(cycles.is_empty(), control == Control::INITIAL, "{control:?}");
            let mut next: Vec<Control> = Vec::new();
            for after in steps.into_iter().map(|step| step.apply(&machine, &control)) {
                assert!(!next.contains(&after), "{control:?} leads to {after:?} twice");
                next.push(after);
            }
        }
    }
}
