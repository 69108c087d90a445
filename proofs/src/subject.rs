//! What the theorems are about: the specification, function by function.
//!
//! Kani proves them of [`Specification`]. Tests put something else in its place, a mutant, to see that a theorem can fail.

use adsdv_network::Network;
use adsdv_spec::belief::{
    Belief, Causes, Glimpse, Handshakes, KnownFaults, Look, Memory, Now, Possible, Span,
};
use adsdv_spec::messages::{AsState, Frame, Node, SignalDef};
use adsdv_spec::{
    Actuation, AiMessages, Atom, Atoms, Control, Edition, Handshake, Inputs, Knowledge, Machine, Observation,
    Outputs, Reaction, Readings, Reads, Taken, Term, Truth, VcuMessages,
};

use crate::document::{Layouts, MACHINE};

/// The functions that theorems speak of. What is not written otherwise is the specification.
pub trait Subject {
    /// Figure 2, the times, the thresholds and the readings.
    fn machine(&self) -> &Machine {
        MACHINE
    }

    /// The same of version 4.0, with its default readings.
    fn machine_of_4_0(&self) -> &Machine {
        const MACHINE: &Machine = &Machine::new(Edition::V4_0, Edition::V4_0.readings);
        MACHINE
    }

    /// The same of the vehicle of 2026, with its default readings.
    fn machine_of_2026(&self) -> &Machine {
        const MACHINE: &Machine = &Machine::new(Edition::V2026, Edition::V2026.readings);
        MACHINE
    }

    /// [`Control::INITIAL`].
    fn initial(&self) -> Control {
        Control::INITIAL
    }

    /// [`Control::is_consistent`], with the times of the interface.
    fn is_consistent(&self, control: &Control, readings: Readings) -> bool {
        control.is_consistent(&self.machine().edition().rules.timing, readings)
    }

    /// [`Machine::step`].
    fn step(&self, before: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        self.step_of(self.machine(), before, inputs, dt_ms)
    }

    /// [`Machine::step`] of a machine with other readings.
    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        state_by_state(before, |before| machine.step(before, inputs, dt_ms))
    }

    /// [`Machine::react`].
    fn react(&self, before: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        state_by_state(before, |before| self.machine().react(before, seen, dt_ms))
    }

    /// [`Machine::react`] of this machine.
    fn react_of(&self, machine: &Machine, before: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        state_by_state(before, |before| machine.react(before, seen, dt_ms))
    }

    /// [`Network::new`].
    fn network(&self, machine: &Machine) -> Network {
        Network::new(machine)
    }

    /// [`Machine::reads`].
    fn reads(&self, before: &Control, dt_ms: u32) -> Reads {
        state_by_state(before, |before| self.machine().reads(before, dt_ms))
    }

    /// [`Inputs::observe`].
    fn observe(&self, inputs: &Inputs) -> Observation {
        inputs.observe(&self.machine().edition().rules.thresholds)
    }

    /// [`Handshake::step`], with the time of the interface.
    fn handshake(&self, before: Handshake, active: bool, answer: bool, dt_ms: u32) -> Handshake {
        before.step(active, answer, dt_ms, self.machine().edition().rules.timing.handshake_ms)
    }

    /// [`Outputs::actuation`].
    fn actuation(&self, outputs: &Outputs, inputs: &Inputs) -> Actuation {
        outputs.actuation(inputs)
    }

    /// [`Outputs::messages`].
    fn messages(&self, outputs: &Outputs, inputs: &Inputs) -> VcuMessages {
        outputs.messages(inputs)
    }

    /// The data of a frame as its decoder sees it: [`Layout::decode`](adsdv_spec::messages::Layout::decode) gets what comes out of here.
    fn received(&self, _id: u16, data: [u8; 9]) -> [u8; 9] {
        data
    }

    /// A frame as it is sent: what [`Layout::encode`](adsdv_spec::messages::Layout::encode) makes goes through here.
    fn sent(&self, frame: Frame) -> Frame {
        frame
    }

    /// [`SignalDef::put`].
    fn put(&self, row: &SignalDef, data: [u8; 8], raw: i32) -> [u8; 8] {
        row.put(data, raw)
    }

    /// [`Frame::new`].
    fn frame(&self, id: u16, data: &[u8]) -> Option<Frame> {
        Frame::new(id, data)
    }

    /// [`AiMessages::receive_with`], of version 3.0.
    fn receive(&self, ai: &mut AiMessages, id: u16, data: &[u8]) -> bool {
        matches!(ai.receive_with(Layouts::read, id, data), Ok(true))
    }

    /// [`Bus::is_reserved`](adsdv_spec::Bus::is_reserved).
    fn is_reserved(&self, id: u16) -> bool {
        self.machine().edition().bus.is_reserved(id)
    }

    /// [`Bus::may_send`](adsdv_spec::Bus::may_send).
    fn may_send(&self, node: Node, id: u16) -> bool {
        self.machine().edition().bus.may_send(node, id)
    }

    /// [`Term::truth`].
    fn truth(&self, term: &Term, known: Knowledge) -> Truth {
        term.truth(known)
    }

    /// [`Truth::and`], [`Truth::or`] and [`Truth::agree`].
    fn join(&self, one: Truth, other: Truth) -> (Truth, Truth, Truth) {
        (one.and(other), one.or(other), one.agree(other))
    }

    /// [`Knowledge::learn`].
    fn learn(&self, known: Knowledge, scope: Atoms, values: Atoms) -> Knowledge {
        known.learn(scope, values)
    }

    /// [`Knowledge::set`].
    fn set(&self, known: Knowledge, atom: Atom, value: Truth) -> Knowledge {
        known.set(atom, value)
    }

    /// [`Knowledge::meet`].
    fn meet(&self, one: Knowledge, other: Knowledge) -> Knowledge {
        one.meet(other)
    }

    /// [`Span::counted_up`].
    fn counted_up(&self, timer: Span, dt_ms: Span, limit_ms: u16) -> Span {
        timer.counted_up(dt_ms, limit_ms)
    }

    /// [`Span::given`].
    fn span_given(&self, span: Span, limit_ms: u16, reached: bool) -> Option<Span> {
        span.given(limit_ms, reached)
    }

    /// [`Span::reaches`].
    fn span_reaches(&self, span: Span, limit_ms: u16) -> Truth {
        span.reaches(limit_ms)
    }

    /// [`Span::or`] and [`Span::and`].
    fn join_spans(&self, one: Span, other: Span) -> (Span, Option<Span>) {
        (one.or(other), one.and(other))
    }

    /// [`Handshakes::step`].
    fn handshakes_step(
        &self,
        before: &Handshakes,
        active: Truth,
        answer: Truth,
        dt_ms: Span,
        limit_ms: u16,
    ) -> Handshakes {
        before.step(active, answer, dt_ms, limit_ms)
    }

    /// [`Handshakes::given_lost`].
    fn handshakes_given_lost(&self, handshakes: &Handshakes, limit_ms: u16, lost: bool) -> Handshakes {
        handshakes.given_lost(limit_ms, lost)
    }

    /// [`Handshakes::given_bit`].
    fn handshakes_given_bit(&self, handshakes: &Handshakes, bit: bool) -> Handshakes {
        handshakes.given_bit(bit)
    }

    /// [`Handshakes::is_lost`].
    fn handshakes_lost(&self, handshakes: &Handshakes, limit_ms: u16) -> Truth {
        handshakes.is_lost(limit_ms)
    }

    /// [`Glimpse::new`].
    fn glimpse(&self, atoms: Knowledge, faults: KnownFaults) -> Glimpse {
        Glimpse::new(atoms, faults)
    }

    /// [`Machine::known_atoms_of`].
    fn known_atoms_of(&self, machine: &Machine, seen: &Glimpse) -> Knowledge {
        machine.known_atoms_of(seen)
    }

    /// [`Machine::known_atoms`].
    fn known_atoms(
        &self,
        from: AsState,
        memory: &Memory,
        inputs: Knowledge,
        elapsed: bool,
        comms_lost: bool,
    ) -> Knowledge {
        self.machine().known_atoms(from, memory, inputs, elapsed, comms_lost)
    }

    /// [`Machine::look`].
    fn look(&self, machine: &Machine, from: AsState, place: usize, known: Knowledge) -> Look {
        machine.look(from, place, known)
    }

    /// [`Machine::remember_known`].
    fn remember_known(
        &self,
        machine: &Machine,
        from: AsState,
        memory: &Memory,
        now: &Now,
        taken: Option<(Taken, AsState)>,
    ) -> Possible {
        machine.remember_known(from, memory, now, taken)
    }

    /// [`Causes::first_of`].
    fn first_cause(&self, faults: KnownFaults, some: bool) -> Causes {
        Causes::first_of(faults, some)
    }

    /// [`Causes::then`].
    fn cause_then(&self, before: Causes, later: Causes) -> Causes {
        before.then(later)
    }

    /// [`Causes::shown`].
    fn cause_shown(&self, causes: Causes) -> KnownFaults {
        causes.shown()
    }

    /// [`KnownFaults::or`] and [`KnownFaults::together`].
    fn join_faults(&self, one: KnownFaults, other: KnownFaults) -> (KnownFaults, KnownFaults) {
        (one.or(other), one.together(other))
    }

    /// [`Glimpse::or`].
    fn join_glimpses(&self, one: &Glimpse, other: &Glimpse) -> Glimpse {
        one.or(other)
    }

    /// [`Memory::or`].
    fn join_memories(&self, one: Memory, other: Memory) -> Memory {
        one.or(other)
    }

    /// [`Memory::covers`].
    fn memory_covers(&self, one: &Memory, other: &Memory) -> bool {
        one.covers(other)
    }

    /// [`Belief::or`].
    fn join_beliefs(&self, one: Belief, other: &Belief) -> Belief {
        one.or(other)
    }

    /// [`Belief::covers`].
    fn belief_covers(&self, one: &Belief, other: &Belief) -> bool {
        one.covers(other)
    }
}

/// What is done with a control state, written once for each AS state.
///
/// It comes to the same. But in each of the five cases the AS state is a constant, and with it the rows of the table that
/// are looked at: so a proof need not reason about a table at a place that it does not know.
fn state_by_state<T>(control: &Control, act: impl Fn(&Control) -> T) -> T {
    match control.state {
        AsState::Off => act(&Control { state: AsState::Off, ..*control }),
        AsState::Ready => act(&Control { state: AsState::Ready, ..*control }),
        AsState::Driving => act(&Control { state: AsState::Driving, ..*control }),
        AsState::EmergencyBrake => act(&Control { state: AsState::EmergencyBrake, ..*control }),
        AsState::Finished => act(&Control { state: AsState::Finished, ..*control }),
    }
}

/// The specification itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct Specification;

impl Subject for Specification {}

/// What the theorems are about at present.
#[cfg(kani)]
pub fn subject() -> Specification {
    Specification
}

#[cfg(not(kani))]
pub use replaced::{subject, with};

#[cfg(not(kani))]
mod replaced {
    use std::cell::RefCell;
    use std::rc::Rc;

    use super::{Specification, Subject};

    thread_local! {
        static SUBJECT: RefCell<Rc<dyn Subject>> = RefCell::new(Rc::new(Specification));
    }

    /// What the theorems are about at present, on this thread.
    pub fn subject() -> Rc<dyn Subject> {
        SUBJECT.with_borrow(Rc::clone)
    }

    /// Does something while the theorems are about another subject, on this thread.
    pub fn with<T>(other: impl Subject + 'static, run: impl FnOnce() -> T) -> T {
        /// Puts back what was there, whether `run` returns or panics.
        struct Back(Option<Rc<dyn Subject>>);
        impl Drop for Back {
            fn drop(&mut self) {
                if let Some(subject) = self.0.take() {
                    SUBJECT.set(subject);
                }
            }
        }
        let _back = Back(Some(SUBJECT.replace(Rc::new(other))));
        run()
    }
}
