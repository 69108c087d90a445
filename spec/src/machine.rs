//! The transition function: the table of Figure 2, evaluated.
//!
//! ```text
//! Inputs --observe--> Observation --react--> Control, Outputs
//!                                    ^
//!                                 Control, time
//! ```
//!
//! `step.rs` puts them together, and makes the outputs.
//!
//! A step takes some twelve nanoseconds, and half as much again if its parts are calls that hand each other whole
//! structs through memory. So they are inlined, up to the caller, which the compiler would not do by itself.
#![expect(clippy::inline_always, reason = "measured: see benches/spec.rs")]

use crate::atoms::{Atom, Atoms};
use crate::control::Control;
use crate::derives::data;
use crate::edition::{Edition, Rules};
use crate::faults::{Fault, Faults};
use crate::handshake::{Handshake, count_up};
use crate::kept::{Kept, Literals};
use crate::masks::TermMasks;
use crate::messages::{AsState, ShutdownCause};
use crate::observation::Observation;
use crate::readings::{Choice, Readings};
use crate::table::{MAX_ROWS, MAX_TERMS, Row, Table, Term};
use crate::truth::{Knowledge, Truth};

/// How many states there are; states count from 1.
const STATES: usize = AsState::ALL.len();

/// An edition with one answer to every open question: ready to step.
#[derive(Clone, Copy, Debug)]
pub struct Machine {
    edition: Edition,
    readings: Readings,
    /// The conditions of the inputs that the edition has at all.
    scope: Atoms,
    /// The terms that these readings have, row by row, in the order of evaluation.
    arrows: [Arrow; MAX_ROWS * MAX_TERMS],
    /// Where the arrows of each state begin; those of state `n` end where those of `n + 1` begin.
    begins: [u8; STATES + 2],
    /// What must hold before the "Go" edge counts: the guard of AS_READY to AS_DRIVING without "Go".
    go_conditions: Option<TermMasks>,
    /// What must hold for a step to arm the "Go" edge; `None` where none does.
    go_low: Option<Literals>,
}

#[derive(Clone, Copy, Debug)]
struct Arrow {
    masks: TermMasks,
    to: AsState,
    taken: Taken,
}

data!(
    /// Which row of the table was taken, and which alternative of its guard decided.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub struct Taken {
        /// The index into [`Table::rows`].
        pub row: u8,
        /// The index into [`Row::terms`].
        pub term: u8,
    }
);

impl Taken {
    /// The row that was taken.
    pub fn row(self, table: &Table) -> Option<&Row> {
        table.rows().get(usize::from(self.row))
    }

    /// The term that decided.
    pub fn term(self, table: &Table) -> Option<&Term> {
        self.row(table)?.terms().get(usize::from(self.term))
    }
}

/// What a step does when it sees an [`Observation`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Reaction {
    /// The control state after the step.
    pub control: Control,
    /// The row taken; `None` if the state stays.
    pub taken: Option<Taken>,
    /// All atoms as the guards saw them.
    pub atoms: Atoms,
    /// The faults that 520h shows.
    pub faults: Faults,
}

/// What a step has found out before it remembers anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Noticed {
    /// All atoms as the guards see them.
    pub atoms: Atoms,
    /// The faults of the inputs.
    pub faults: Faults,
    /// How long the state has lasted now, up to its limit.
    pub in_state_ms: u16,
    /// The handshake after the step.
    pub handshake: Handshake,
    /// Whether communication with the AI Computer is lost.
    pub comms_lost: bool,
}

impl Machine {
    /// The reference: the [default edition](Edition::DEFAULT) with the default readings.
    pub const REFERENCE: Self = Self::new(*Edition::DEFAULT, Edition::DEFAULT.readings);

    /// A machine for an edition and an answer to every open question; where the edition does not have the answer, its
    /// default holds.
    pub const fn new(edition: Edition, readings: Readings) -> Self {
        let readings = edition.admit(readings);
        let nowhere = Arrow { masks: TermMasks::EMPTY, to: AsState::Off, taken: Taken { row: 0, term: 0 } };
        let mut machine = Self {
            edition,
            readings,
            scope: edition.scope(),
            arrows: [nowhere; MAX_ROWS * MAX_TERMS],
            begins: [0; STATES + 2],
            go_conditions: None,
            go_low: None,
        };
        let rows = edition.rules.table.rows();
        let mut filled = 0;
        let mut state = 0;
        while state < STATES {
            let from = AsState::ALL[state];
            machine.begins[from as usize] = filled as u8;
            // The row that a reading lets overtake comes first; then the others in the table's order.
            //= D-3 to D-5
            let first = overtaking(&edition.rules, from, readings);
            if let Some(row) = first {
                filled = machine.add(row, filled);
            }
            let mut row = 0;
            while row < rows.len() {
                let already = matches!(first, Some(first) if first == row);
                if rows[row].from as u8 == from as u8 && !already {
                    filled = machine.add(row, filled);
                }
                row += 1;
            }
            state += 1;
        }
        machine.begins[STATES + 1] = filled as u8;
        machine.go_low = match machine.go_conditions {
            //= SM-2, DRV-11, D-6
            Some(_) if readings.is(Choice::GoEdgeEnough) => Some(Literals::EVER.and_off(Atom::GoOn)),
            // Conditions that ask for "Go" are never seen while it is off.
            Some(conditions) if !conditions.on().has(Atom::GoOn) => {
                let off = conditions.care().difference(conditions.on());
                Some(Literals { on: conditions.on(), off }.and_off(Atom::GoOn))
            }
            _ => None,
        };
        machine
    }

    const fn add(&mut self, row: usize, mut filled: usize) -> usize {
        let Row { from, to, .. } = self.edition.rules.table.rows()[row];
        let mut term = 0;
        while term < self.edition.rules.table.rows()[row].terms().len() {
            let Term { on, off, readings, .. } = self.edition.rules.table.rows()[row].terms()[term];
            // A term that asks for an atom to be both on and off never holds.
            if readings.is_subset(self.readings.choices()) && on.intersection(off).is_empty() {
                let masks = TermMasks::new(on, off);
                self.arrows[filled] = Arrow { masks, to, taken: Taken { row: row as u8, term: term as u8 } };
                filled += 1;
                if matches!((from, to), (AsState::Ready, AsState::Driving)) && self.go_conditions.is_none() {
                    self.go_conditions = Some(masks.without(Atom::GoEdge));
                }
            }
            term += 1;
        }
        filled
    }

    /// The edition.
    pub const fn edition(&self) -> &Edition {
        &self.edition
    }

    /// The answers to the open questions.
    pub const fn readings(&self) -> Readings {
        self.readings
    }

    /// The conditions of the inputs that can matter: [`Edition::scope`].
    pub const fn scope(&self) -> Atoms {
        self.scope
    }

    /// The part of a step behind [`Inputs::observe`](crate::Inputs::observe): the same for all inputs with the same observation.
    #[inline(always)]
    pub const fn react(&self, control: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        let inputs = self.atoms_of(seen);
        let (handshake, comms_lost) = self.hear(control.handshake, inputs, dt_ms);
        let limit = self.edition.rules.timing.in_state_limit(control.state);
        let in_state_ms = count_up(control.in_state_ms, dt_ms, limit);

        let atoms = inputs.union(self.control_atoms(control, in_state_ms, comms_lost, inputs));
        let taken = self.first_arrow(control.state, atoms);
        let noticed = Noticed { atoms, faults: seen.faults(), in_state_ms, handshake, comms_lost };
        self.remember(control, &noticed, taken)
    }

    /// What a step hears of the AI Computer, whose signals are among these atoms: the handshake after it, and whether
    /// communication is lost. It goes by the atoms of [`HEARD`](Self::HEARD) alone.
    #[inline(always)]
    pub const fn hear(&self, before: Handshake, inputs: Atoms, dt_ms: u32) -> (Handshake, bool) {
        let limit_ms = self.edition.rules.timing.handshake_ms;
        //= HS-1, D-8
        let active = self.readings.is(Choice::HandshakeAlways) || inputs.has(Atom::Tsms);
        let handshake = before.step(active, inputs.has(Atom::AiHandshake), dt_ms, limit_ms);
        //= HS-18
        let missed = inputs.has(Atom::AiMessagesMissed) && self.watches_messages(active);
        (handshake, handshake.is_lost(limit_ms) || missed)
    }

    /// The atoms by which [`hear`](Self::hear) goes.
    pub const HEARD: [Atom; 3] = [Atom::Tsms, Atom::AiHandshake, Atom::AiMessagesMissed];

    /// The last part of a step: what is remembered, and what 520h shows of the faults, when this was noticed and `taken` is the
    /// arrow that was taken, with the state that it leads to.
    #[inline(always)]
    pub const fn remember(
        &self,
        control: &Control,
        noticed: &Noticed,
        taken: Option<(Taken, AsState)>,
    ) -> Reaction {
        let Noticed { atoms, in_state_ms, handshake, comms_lost, .. } = *noticed;
        let state = match taken {
            Some((_, to)) => to,
            None => control.state, //= SM-18, D-36
        };

        //= D-17, D-18
        let mut faults = noticed.faults.union(Faults::when(Fault::AiCommsFault, comms_lost));
        let mut shutdown_cause = control.shutdown_cause;
        let mut power_cycle_needed = control.power_cycle_needed;
        if let (Some((taken, AsState::EmergencyBrake)), true) = (taken, state as u8 != control.state as u8) {
            let reasons = self.reasons(control.state, taken, atoms, noticed.faults);
            faults = faults.union(reasons);
            //= D-15
            if matches!(shutdown_cause, ShutdownCause::NoShutdown) {
                shutdown_cause = reasons.cause();
            }
            //= ETO-3, D-11
            power_cycle_needed = self.readings.is(Choice::PowerCycleLatched);
        }

        let stays = state as u8 == control.state as u8;
        let kept = self.kept(state);
        let control = Control {
            state,
            in_state_ms: if stays { in_state_ms } else { 0 },
            go_seen_low: Literals::some_hold(kept.go_seen_low, atoms),
            was_running: Literals::some_hold(kept.was_running, atoms),
            was_forward: Literals::some_hold(kept.was_forward, atoms),
            handshake,
            power_cycle_needed,
            shutdown_cause,
        };
        Reaction {
            control,
            taken: match taken {
                Some((taken, _)) => Some(taken),
                None => None,
            },
            atoms,
            faults: faults.union(Faults::of_cause(shutdown_cause)), //= D-17
        }
    }

    /// The atoms of an observation that the edition has, as these readings have them.
    #[inline(always)]
    pub const fn atoms_of(&self, seen: Observation) -> Atoms {
        let atoms = seen.atoms().intersection(self.scope);
        let closed = seen.faults().intersection(self.opening()).is_empty();
        atoms.difference(Atoms::when(Atom::SdcOpen, closed))
    }

    /// The faults that open the shutdown circuit, as the guards see it.
    #[inline(always)]
    pub const fn opening(&self) -> Faults {
        //= D-54
        if self.readings.is(Choice::BmsDriving) {
            Faults::OPENING.without(Fault::BmsFault)
        } else {
            Faults::OPENING
        }
    }

    /// Whether a message of the AI Computer that is missed is a fault, while the handshake is performed or is not.
    pub(crate) const fn watches_messages(&self, handshake: bool) -> bool {
        //= D-51
        handshake || self.readings.is(Choice::WatchAlways)
    }

    /// The atoms that the control state decides, some of them together with the inputs, which are seen as `seen`: for how long
    /// the state has lasted now, and whether communication is lost, are those of this step.
    #[inline(always)]
    pub const fn control_atoms(
        &self,
        control: &Control,
        in_state_ms: u16,
        comms_lost: bool,
        seen: Atoms,
    ) -> Atoms {
        let elapsed = match Atom::of_timer(control.state) {
            Some(atom) => {
                Atoms::when(atom, in_state_ms >= self.edition.rules.timing.in_state_limit(control.state))
            }
            None => Atoms::NONE,
        };
        let mission_edge = control.was_running && seen.has(Atom::MissionFinished);
        let direction_edge = control.was_forward && seen.has(Atom::DirectionNeutral);
        elapsed
            .union(Atoms::when(Atom::GoEdge, control.go_seen_low && seen.has(Atom::GoOn)))
            .union(Atoms::when(Atom::MissionFinishedEdge, mission_edge))
            .union(Atoms::when(Atom::DirectionNeutralEdge, direction_edge))
            .union(Atoms::when(Atom::AiCommsLost, comms_lost))
            .union(Atoms::when(Atom::PowerCycleNeeded, control.power_cycle_needed))
    }

    /// The alternatives that lead out of a state under these readings, in the order of evaluation.
    pub fn arrows(&self, from: AsState) -> impl Iterator<Item = Taken> + '_ {
        let range = usize::from(self.begins[from as usize])..usize::from(self.begins[from as usize + 1]);
        self.arrows.get(range).unwrap_or_default().iter().map(|arrow| arrow.taken)
    }

    /// The first arrow of a state whose guard holds, and where it leads; `None` if none does, so that the state stays.
    //= SM-1
    #[inline(always)]
    pub const fn first_arrow(&self, state: AsState, atoms: Atoms) -> Option<(Taken, AsState)> {
        let end = self.begins[state as usize + 1];
        let mut i = self.begins[state as usize];
        while i < end {
            let arrow = &self.arrows[i as usize];
            if arrow.masks.holds(atoms) {
                return Some((arrow.taken, arrow.to));
            }
            i += 1;
        }
        None
    }

    /// The arrow at a place in the order of evaluation of a state, and where it leads.
    pub(crate) fn arrow_at(&self, from: AsState, place: usize) -> Option<(TermMasks, (Taken, AsState))> {
        let place = usize::from(self.begins[from as usize]) + place;
        if place >= usize::from(self.begins[from as usize + 1]) {
            return None;
        }
        self.arrows.get(place).map(|arrow| (arrow.masks, (arrow.taken, arrow.to)))
    }

    /// What must hold before the "Go" edge counts.
    pub(crate) const fn go_conditions(&self) -> Option<TermMasks> {
        self.go_conditions
    }

    /// The faults for which a row of a state is taken: those of every term of it that holds.
    #[cold]
    const fn reasons(&self, from: AsState, taken: Taken, atoms: Atoms, seen: Faults) -> Faults {
        let mut faults = Faults::NONE;
        let end = self.begins[from as usize + 1];
        let mut i = self.begins[from as usize];
        while i < end {
            let arrow = &self.arrows[i as usize];
            if arrow.taken.row == taken.row && arrow.masks.holds(atoms) {
                let term = &self.edition.rules.table.rows()[arrow.taken.row as usize].terms()
                    [arrow.taken.term as usize];
                faults = faults.union(match term.fault {
                    Some(fault) => Faults::NONE.with(fault),
                    None => seen.intersection(Faults::OPENING),
                });
            }
            i += 1;
        }
        faults
    }

    /// The atoms that the control state decides at a step, were these all that is seen.
    pub const fn memory_atoms(&self, control: &Control, dt_ms: u32, seen: Atoms) -> Atoms {
        let limit = self.edition.rules.timing.in_state_limit(control.state);
        self.control_atoms(control, count_up(control.in_state_ms, dt_ms, limit), false, seen)
    }

    /// What decides whether a step arms the "Go" edge, as far as is known: the switch, and the conditions that must
    /// hold while it is seen off, unless one is known to fail.
    pub(crate) fn arming_reads(&self, known: Knowledge) -> Atoms {
        let go = Atoms::NONE.with(Atom::GoOn);
        match self.go_conditions {
            Some(_) if self.readings.is(Choice::GoEdgeEnough) => go,
            Some(conditions) if !matches!(conditions.truth(known), Truth::False) => {
                go.union(conditions.care())
            }
            _ => Atoms::NONE,
        }
    }

    /// What a step that leads to this state keeps of what its guards see, until the next one.
    ///
    /// ```
    /// use adsdv_spec::{AsState, Atom, Machine};
    ///
    /// // AS_READY remembers that "Go" was off while all else was in order (section 3.2, item 3).
    /// let armed = Machine::REFERENCE.kept(AsState::Ready).go_seen_low.unwrap();
    /// assert!(armed.off.has(Atom::GoOn) && armed.on.has(Atom::DirectionNeutral));
    /// assert_eq!(Machine::REFERENCE.kept(AsState::Off).go_seen_low, None);
    /// ```
    #[inline(always)]
    pub const fn kept(&self, to: AsState) -> Kept {
        match to {
            AsState::Ready => Kept { go_seen_low: self.go_low, ..Kept::NOTHING },
            AsState::Driving if self.readings.is(Choice::FaultEdge) => Kept::OF_EDGES,
            _ => Kept::NOTHING,
        }
    }
}

impl Default for Machine {
    fn default() -> Self {
        Self::REFERENCE
    }
}

/// The row of a state that a reading lets overtake the others.
const fn overtaking(rules: &Rules, from: AsState, readings: Readings) -> Option<usize> {
    let Rules { table, priorities, .. } = rules;
    let rows = table.rows();
    let mut i = 0;
    while i < priorities.len() {
        let priority = &priorities[i];
        if priority.from as u8 == from as u8 && readings.is(priority.choice) {
            let mut row = 0;
            while row < rows.len() {
                if rows[row].from as u8 == from as u8 && rows[row].to as u8 == priority.first as u8 {
                    return Some(row);
                }
                row += 1;
            }
        }
        i += 1;
    }
    None
}
