//! The step on what may be.

use core::ops::RangeInclusive;

use crate::atoms::{Atom, Atoms};
use crate::belief::memory::{EachState, place};
use crate::belief::{Belief, Causes, Glimpse, Handshakes, KnownFaults, Memory, Outcome, Span};
use crate::faults::{Fault, Faults};
use crate::machine::{Machine, Taken};
use crate::messages::AsState;
use crate::readings::Choice;
use crate::truth::{Knowledge, Truth};

/// What a step may come to in one AS state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Possible {
    /// What is remembered then.
    pub memory: Memory,
    /// What is known of the faults that 520h shows.
    pub faults: KnownFaults,
}

impl Possible {
    fn or(self, other: Self) -> Self {
        Self { memory: self.memory.or(other.memory), faults: self.faults.or(other.faults) }
    }
}

/// What a step may come to: for each AS state that it may lead to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outlook {
    of: EachState<Possible>,
}

impl Outlook {
    const NONE: Self = Self { of: [None; AsState::ALL.len()] };

    /// What it may come to in this state; `None` if it cannot lead there.
    pub const fn state(&self, state: AsState) -> Option<&Possible> {
        self.of[place(state)].as_ref()
    }

    /// What the VCU may be in afterwards.
    pub fn belief(&self) -> Belief {
        let mut belief = Belief::NONE;
        for state in AsState::ALL {
            if let Some(possible) = self.state(state) {
                belief = belief.with(state, possible.memory);
            }
        }
        belief
    }

    fn add(&mut self, state: AsState, possible: Possible) {
        let of = &mut self.of[place(state)];
        *of = Some(match *of {
            Some(before) => before.or(possible),
            None => possible,
        });
    }
}

/// What is known at a step of what the guards see and the memory keeps: the twin of what a step knows of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Now {
    /// All conditions.
    pub atoms: Knowledge,
    /// The faults of the inputs.
    pub faults: KnownFaults,
    /// How long the state has lasted.
    pub in_state: Span,
    /// The handshake.
    pub handshake: Handshakes,
    /// Whether communication is lost.
    pub comms_lost: bool,
}

impl Machine {
    /// One step of a VCU that is not seen whole: what it may be in `dt_ms` milliseconds after it may have been in `before`,
    /// when this is what is known of what it sees. A time range that is empty gives nothing.
    ///
    /// ```
    /// use adsdv_spec::{AsState, Control, Edition, Inputs, Machine, Truth};
    /// use adsdv_spec::belief::{Belief, Glimpse};
    ///
    /// let vcu = Machine::REFERENCE;
    /// let seen = Glimpse::exact(Inputs::default().observe(&vcu.edition().rules.thresholds));
    /// // Nothing is switched on: whatever the VCU was in, it does not come to AS_READY.
    /// let before = Belief::anything(&vcu.edition().rules.timing);
    /// let after = vcu.react_known(&before, &seen, 8..=12);
    /// assert!(after.memory(AsState::Off).is_some());
    /// assert!(before.given(AsState::Off).states().eq([AsState::Off]));
    /// assert!(vcu.react_known(&Belief::exact(&Control::INITIAL), &seen, 8..=12).states().eq([AsState::Off]));
    /// ```
    #[must_use]
    pub fn react_known(&self, before: &Belief, seen: &Glimpse, dt_ms: RangeInclusive<u32>) -> Belief {
        self.outlook(before, seen, dt_ms).belief()
    }

    /// What a step may come to: [`react_known`](Self::react_known), with what 520h shows of the faults.
    #[must_use]
    pub fn outlook(&self, before: &Belief, seen: &Glimpse, dt_ms: RangeInclusive<u32>) -> Outlook {
        let mut outlook = Outlook::NONE;
        let Some(dt_ms) = Span::of(&dt_ms) else { return outlook };
        for from in AsState::ALL {
            if let Some(memory) = before.memory(from) {
                self.outlook_from(from, memory, seen, dt_ms, &mut outlook);
            }
        }
        outlook
    }

    /// A step from one state: every case of whether communication is lost and whether the state's time has come is taken by
    /// itself, so that what is remembered in it fits.
    fn outlook_from(
        &self,
        from: AsState,
        memory: &Memory,
        seen: &Glimpse,
        dt_ms: Span,
        outlook: &mut Outlook,
    ) {
        let timing = &self.edition().rules.timing;
        let inputs = self.known_atoms_of(seen);
        let active =
            if self.readings().is(Choice::HandshakeAlways) { Truth::True } else { inputs.of(Atom::Tsms) };
        let answer = inputs.of(Atom::AiHandshake);
        let handshake = memory.handshake.step(active, answer, dt_ms, timing.handshake_ms);
        let watched = if self.watches_messages(false) { Truth::True } else { active };
        let missed = inputs.of(Atom::AiMessagesMissed).and(watched);
        let limit = timing.in_state_limit(from);
        let in_state = memory.in_state.counted_up(dt_ms, limit);
        for comms_lost in [false, true] {
            let handshake = match (comms_lost, missed) {
                (false, Truth::True) => continue,
                // A message that is missed is enough.
                (true, Truth::True | Truth::Unknown) => handshake,
                _ => handshake.given_lost(timing.handshake_ms, comms_lost),
            };
            for elapsed in [false, true] {
                let in_state = match (Atom::of_timer(from), elapsed) {
                    (Some(_), _) => in_state.given(limit, elapsed),
                    (None, false) => Some(in_state),
                    (None, true) => None,
                };
                let Some(in_state) = in_state.filter(|_| !handshake.is_empty()) else { continue };
                let atoms = self.known_atoms(from, memory, inputs, elapsed, comms_lost);
                let now = Now { atoms, faults: seen.faults(), in_state, handshake, comms_lost };
                for Outcome { taken, known } in self.outcomes(from, atoms) {
                    let to = taken.map_or(from, |(_, to)| to);
                    let now = Now { atoms: known, ..now };
                    outlook.add(to, self.remember_known(from, memory, &now, taken));
                }
            }
        }
    }

    /// What is known of the conditions of a glimpse that the edition has, as these readings have them: the twin of what an
    /// observation's are.
    pub fn known_atoms_of(&self, seen: &Glimpse) -> Knowledge {
        let atoms = seen.atoms().learn(Atoms::ALL.difference(self.scope()), Atoms::NONE);
        //= D-54
        if !self.readings().is(Choice::BmsDriving) || atoms.of(Atom::SdcOpen) == Truth::False {
            return atoms;
        }
        match seen.faults().any_of(Faults::OPENING.without(Fault::BmsFault)) {
            Truth::False => atoms.set(Atom::SdcOpen, Truth::False),
            // Something opens it, and only the battery may be that by itself.
            Truth::Unknown if seen.faults().of(Fault::BmsFault) != Truth::False => {
                atoms.set(Atom::SdcOpen, Truth::Unknown)
            }
            _ => atoms,
        }
    }

    /// All conditions, when `inputs` is what is known of those of the inputs: with those that the memory decides.
    pub fn known_atoms(
        &self,
        from: AsState,
        memory: &Memory,
        inputs: Knowledge,
        elapsed: bool,
        comms_lost: bool,
    ) -> Knowledge {
        let timer = match Atom::of_timer(from) {
            Some(timer) => Atoms::when(timer, elapsed),
            None => Atoms::NONE,
        };
        let certain = timer.union(Atoms::when(Atom::AiCommsLost, comms_lost));
        let edge = |was: Truth, is| was.and(inputs.of(is));
        inputs
            .learn(Atoms::ALL.difference(crate::Observation::SCOPE), certain)
            .set(Atom::GoEdge, edge(memory.go_seen_low, Atom::GoOn))
            .set(Atom::MissionFinishedEdge, edge(memory.was_running, Atom::MissionFinished))
            .set(Atom::DirectionNeutralEdge, edge(memory.was_forward, Atom::DirectionNeutral))
            .set(Atom::PowerCycleNeeded, memory.power_cycle_needed)
    }

    /// What is remembered after a step, and the faults that it shows, when this is what is taken: the twin of what a reaction is.
    pub fn remember_known(
        &self,
        from: AsState,
        memory: &Memory,
        now: &Now,
        taken: Option<(Taken, AsState)>,
    ) -> Possible {
        let state = taken.map_or(from, |(_, to)| to);
        let mut faults =
            now.faults.together(KnownFaults::exact(Faults::when(Fault::AiCommsFault, now.comms_lost)));
        let (mut shutdown_cause, mut power_cycle_needed) = (memory.shutdown_cause, memory.power_cycle_needed);
        if let (Some((taken, AsState::EmergencyBrake)), true) = (taken, state != from) {
            let (reasons, some) = self.known_reasons(from, taken, now);
            faults = faults.together(reasons);
            shutdown_cause = shutdown_cause.then(Causes::first_of(reasons, some));
            power_cycle_needed = self.readings().is(Choice::PowerCycleLatched).into();
        }
        let edges = Truth::from(state == AsState::Driving && self.readings().is(Choice::FaultEdge));
        let memory = Memory {
            in_state: if state == from { now.in_state } else { Span::exact(0) },
            go_seen_low: Truth::from(state == AsState::Ready).and(self.known_go_low(now.atoms)),
            was_running: edges.and(now.atoms.of(Atom::MissionRunning)),
            was_forward: edges.and(now.atoms.of(Atom::DirectionNeutral).not()),
            handshake: now.handshake,
            power_cycle_needed,
            shutdown_cause,
        };
        Possible { memory, faults: faults.together(shutdown_cause.shown()) }
    }

    /// The faults for which a row is taken, as far as is known, and whether there is one at least.
    fn known_reasons(&self, from: AsState, taken: Taken, now: &Now) -> (KnownFaults, bool) {
        let never = KnownFaults::exact(Faults::NONE);
        let (mut reasons, mut some) = (never, false);
        let mut place = 0;
        while let Some((masks, (other, _))) = self.arrow_at(from, place) {
            place += 1;
            if other.row != taken.row {
                continue;
            }
            // What was taken holds, whether or not it is known.
            let holds = if other.term == taken.term { Truth::True } else { masks.truth(now.atoms) };
            let fault = other.term(&self.edition().rules.table).and_then(|term| term.fault);
            let these = if let Some(fault) = fault {
                KnownFaults::exact(Faults::NONE.with(fault))
            } else {
                some |= holds == Truth::True && now.atoms.of(Atom::SdcOpen) == Truth::True;
                now.faults.of_these(Faults::OPENING)
            };
            reasons = match holds {
                Truth::True => reasons.together(these),
                Truth::Unknown => reasons.together(these.or(never)),
                Truth::False => reasons,
            };
        }
        (reasons, some)
    }

    /// Whether a step arms the "Go" edge, as far as is known.
    fn known_go_low(&self, known: Knowledge) -> Truth {
        let conditions = match self.go_conditions() {
            Some(_) if self.readings().is(Choice::GoEdgeEnough) => Truth::True,
            Some(conditions) => conditions.truth(known),
            None => Truth::False,
        };
        conditions.and(known.of(Atom::GoOn).not())
    }
}
