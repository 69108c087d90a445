//! What a step can depend on: the lemmas on which the model's exploration rests (`model/README.md` names them).
//!
//! Inputs matter only through what they are observed as, the observation only through what can still matter, and a timer
//! only through whether it is full. So the model may enumerate conditions instead of inputs, and leave out what is unread.

use adsdv_spec::messages::{AsState, ShutdownCause};
use adsdv_spec::{Choice, Control, Fault, Faults, Inputs, Machine, Observation, Readings, Reads, Timing};

use crate::prelude::*;

const TIMING: Timing = EDITION.rules.timing;

/// Any inputs that are observed as this.
#[cfg(kani)]
fn any_inputs_seen_as(seen: Observation) -> Inputs {
    kani::any_where(|inputs: &Inputs| subject().observe(inputs) == seen)
}

/// Any inputs, made to look like this: by chance hardly any do.
#[cfg(not(kani))]
fn any_inputs_seen_as(seen: Observation) -> Inputs {
    let all = Reads { atoms: Observation::SCOPE, faults: Observation::FAULTS };
    let inputs = kani::any::<Inputs>().showing(seen, &all, &EDITION.rules.thresholds);
    kani::assume(subject().observe(&inputs) == seen);
    inputs
}

fn inputs_matter_through_their_observation(state: AsState) {
    let one = any_step_from(state);
    let inputs = any_inputs_seen_as(subject().observe(&one.inputs));
    let other = Step::of(one.before, inputs, one.dt_ms);
    kani::cover!(inputs != one.inputs && one.outputs.taken.is_some(), "other inputs, and an arrow is taken");
    kani::cover!(
        inputs.vehicle.wheel_speeds != one.inputs.vehicle.wheel_speeds && inputs.sdc != one.inputs.sdc,
        "other wheel speeds, and another cause"
    );
    assert!(one.after == other.after, "the same control state");
    assert!(one.outputs == other.outputs, "the same arrow, conditions, faults and signals");
}

harnesses! {
    /// **Inputs matter only through their observation** (lemma `observation`). Two steps from the same control state, after the
    /// same time, with inputs that are observed alike, come to the same control state, arrow, conditions, faults and signals.
    ///
    /// Requirements: SM-1.
    unwind 13;
    inputs_matter_in_off_through_their_observation = inputs_matter_through_their_observation(AsState::Off);
    inputs_matter_in_ready_through_their_observation = inputs_matter_through_their_observation(AsState::Ready);
    inputs_matter_in_driving_through_their_observation = inputs_matter_through_their_observation(AsState::Driving);
    inputs_matter_in_finished_through_their_observation = inputs_matter_through_their_observation(AsState::Finished);
    inputs_matter_in_emergency_brake_through_their_observation = inputs_matter_through_their_observation(AsState::EmergencyBrake);
}

/// **A step is its reaction to the observation**: `react`, which models and tests use, is what `step` does.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn a_step_is_the_reaction_to_its_observation() {
    let Step { before, inputs, dt_ms, after, outputs } = any_step();
    let subject = subject();
    let seen = subject.observe(&inputs);
    let reaction = subject.react(&before, seen, dt_ms);
    kani::cover!(reaction.taken.is_some(), "an arrow is taken");
    assert!(reaction.control == after && reaction.taken == outputs.taken, "the same control state and arrow");
    assert!(subject.machine().outputs(before.state, &reaction, inputs.go) == outputs, "the same outputs");
    assert!(seen.is_possible(), "what inputs look like is possible");
}

/// **The next state depends on the atoms alone** (lemma `which-fault`). Observations with the same atoms and other faults
/// lead to the same state and the same memory, but for the number in SHUTDOWN_CAUSE.
///
/// Requirements: SM-1, RTE-1, D-15.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn the_next_state_depends_on_the_atoms_alone() {
    let (before, seen, dt_ms): (Control, Observation, u32) = (any_control(), kani::any(), kani::any());
    let faults: Faults = kani::any();
    let other = Observation::new(seen.atoms(), faults);
    kani::assume(other.atoms() == seen.atoms());
    let one = subject().react(&before, seen, dt_ms);
    let other = subject().react(&before, other, dt_ms);
    kani::cover!(
        one.taken.is_some() && one.control.shutdown_cause != other.control.shutdown_cause,
        "another fault is the cause"
    );
    let but_for_the_cause =
        |control: Control| Control { shutdown_cause: ShutdownCause::NoShutdown, ..control };
    let (a, b) = (one.control.shutdown_cause, other.control.shutdown_cause);
    let none = ShutdownCause::NoShutdown;
    assert!((a == none) == (b == none), "a cause is left by both, or by none");
    assert!(before.shutdown_cause == none || a == b, "a cause that was there stays");
    assert!(one.taken == other.taken && one.atoms == other.atoms, "the same arrow");
    assert!(but_for_the_cause(one.control) == but_for_the_cause(other.control), "the same memory");
}

/// Any observation of which the same is left when everything unread is taken away.
#[cfg(kani)]
fn any_read_as(reads: Reads, seen: Observation) -> Observation {
    kani::any_where(|other: &Observation| reads.of(*other) == reads.of(seen))
}

/// Any observation, with what is read taken from another: by chance hardly any are alike.
#[cfg(not(kani))]
fn any_read_as(reads: Reads, seen: Observation) -> Observation {
    let other: Observation = kani::any();
    let atoms = seen.atoms().intersection(reads.atoms).union(other.atoms().difference(reads.atoms));
    // Of the faults that open the shutdown circuit only the first counts.
    let first = reads.of(seen).faults().intersection(Faults::OPENING);
    let later = Faults::ALL.difference(first).intersection(Faults::OPENING);
    let opening =
        if first.is_empty() { Faults::NONE } else { first.union(other.faults().intersection(later)) };
    let unread = other.faults().difference(reads.faults);
    let request = seen.faults().intersection(reads.faults).difference(Faults::OPENING);
    let other = Observation::new(atoms, opening.union(unread).union(request));
    kani::assume(reads.of(other) == reads.of(seen));
    other
}

/// Claims it of a state; whether a fault may be otherwise that comes behind one that counts.
fn what_is_not_read_does_not_matter(state: AsState) -> bool {
    let (before, seen, dt_ms): (Control, Observation, u32) =
        (any_control_in(state), kani::any(), kani::any());
    let reads = subject().reads(&before, dt_ms);
    let other = any_read_as(reads, seen);
    let one = subject().react(&before, seen, dt_ms);
    let two = subject().react(&before, other, dt_ms);
    kani::cover!(
        one.taken.is_some() && seen != other,
        "an arrow is taken, and something unread is otherwise"
    );
    assert!(one.control == two.control && one.taken == two.taken, "the same control state and arrow");
    seen.faults() != other.faults() && reads.faults.has(Fault::BmsFault)
}

/// The same of a state in which the order of the faults matters.
fn of_which_the_first_fault_counts(state: AsState) {
    let later = what_is_not_read_does_not_matter(state);
    kani::cover!(later, "another fault comes later");
}

harnesses! {
    /// **What is not read does not matter** (lemmas `state-reads`, `unread`, `first-fault`). Observations of which
    /// [`Machine::reads`] leaves the same lead to the same control state along the same arrow.
    ///
    /// Requirements: SM-1, D-16.
    unwind 31;
    what_is_not_read_in_off_does_not_matter = what_is_not_read_does_not_matter(AsState::Off);
    what_is_not_read_in_ready_does_not_matter = of_which_the_first_fault_counts(AsState::Ready);
    what_is_not_read_in_driving_does_not_matter = of_which_the_first_fault_counts(AsState::Driving);
    what_is_not_read_in_finished_does_not_matter = of_which_the_first_fault_counts(AsState::Finished);
    what_is_not_read_in_emergency_brake_does_not_matter = what_is_not_read_does_not_matter(AsState::EmergencyBrake);
}

/// **A running timer matters only through whether it is full** (lemma `short-timers`). From two control states that differ
/// in the time that their AS state has lasted, and in both of which it is not full by the step, or in both of which it is,
/// the step is the same but for that time.
///
/// Requirements: DRV-4, ETO-1.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn a_running_timer_matters_only_when_it_is_full() {
    let (before, seen, dt_ms): (Control, Observation, u32) = (any_control(), kani::any(), kani::any());
    let limit = u64::from(TIMING.in_state_limit(before.state));
    let other = Control { in_state_ms: kani::any(), ..before };
    kani::assume(other.is_consistent(&TIMING, Readings::DEFAULT));
    let full = |control: &Control| u64::from(control.in_state_ms) + u64::from(dt_ms) >= limit;
    kani::assume(full(&before) == full(&other));
    let one = subject().react(&before, seen, dt_ms);
    let two = subject().react(&other, seen, dt_ms);
    kani::cover!(
        before.in_state_ms != other.in_state_ms && one.taken.is_some(),
        "an arrow is taken at another time"
    );
    kani::cover!(before.in_state_ms != other.in_state_ms && full(&before), "full, since another time");
    let but_for_the_time = |control: Control| Control { in_state_ms: 0, ..control };
    assert!(one.taken == two.taken && one.atoms == two.atoms, "the same arrow");
    assert!(
        but_for_the_time(one.control) == but_for_the_time(two.control),
        "the same memory, but for the time"
    );
}

/// The reference, with the raw switch as GO_SIGNAL.
const RAW_GO_SIGNAL: Machine = Machine::new(*EDITION, Readings::DEFAULT.with(Choice::GoRaw));

/// **The reading `go-signal` changes what 520h tells, and no control state** (lemma `go-signal`).
///
/// Requirements: D-7.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn the_go_signal_changes_no_control_state() {
    let one = any_step();
    let (after, outputs) = subject().step_of(&RAW_GO_SIGNAL, &one.before, &one.inputs, one.dt_ms);
    kani::cover!(outputs.go_signal != one.outputs.go_signal, "520h tells another GO_SIGNAL");
    kani::cover!(one.leads(AsState::Ready, AsState::Driving), "AS_DRIVING is entered");
    assert!(after == one.after && outputs.taken == one.outputs.taken, "the same control state and arrow");
}

theorems![
    inputs_matter_in_off_through_their_observation,
    inputs_matter_in_ready_through_their_observation,
    inputs_matter_in_driving_through_their_observation,
    inputs_matter_in_finished_through_their_observation,
    inputs_matter_in_emergency_brake_through_their_observation,
    a_step_is_the_reaction_to_its_observation,
    the_next_state_depends_on_the_atoms_alone,
    what_is_not_read_in_off_does_not_matter,
    what_is_not_read_in_ready_does_not_matter,
    what_is_not_read_in_driving_does_not_matter,
    what_is_not_read_in_finished_does_not_matter,
    what_is_not_read_in_emergency_brake_does_not_matter,
    a_running_timer_matters_only_when_it_is_full,
    the_go_signal_changes_no_control_state,
];
