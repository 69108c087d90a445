//! How time counts: in one long step or in several short ones, and for ever without overflowing.
//!
//! The document fixes what has happened after a time, not how often the VCU looks. So two short steps are one long one
//! wherever nothing happens at the end of the first that another look would change: no arrow is taken, and no edge of the
//! handshake is answered or begun.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Choice, Control, Inputs, Machine, Outputs, Readings, Timing};

use crate::prelude::*;

const TIMING: Timing = EDITION.rules.timing;

/// Whether a handshake that was running still waits for the answer to the same edge, or rests as it did.
fn handshake_goes_on(before: &Control, after: &Control) -> bool {
    before.handshake.active == after.handshake.active && before.handshake.bit == after.handshake.bit
}

/// What a step shows, but for the conditions. Of these an edge of "Go" that is not accepted is seen at the first look only.
fn shown(outputs: &Outputs) -> Outputs {
    Outputs { atoms: Atoms::NONE, ..*outputs }
}

/// Claims it of a state; whether the second step takes an arrow.
fn two_steps_are_one(state: AsState) -> bool {
    let Step { before, inputs, dt_ms: a, after: between, outputs: first } = any_step_that_may_stay(state);
    let b: u32 = kani::any();
    kani::assume(first.taken.is_none() && handshake_goes_on(&before, &between) && a.checked_add(b).is_some());
    let two = Step::of(between, inputs, b);
    let one = Step::of(before, inputs, a + b);
    kani::cover!(
        two.after.handshake.unanswered_ms == 50 && between.handshake.unanswered_ms > 0,
        "lost meanwhile"
    );
    assert!(two.after == one.after, "the same control state");
    assert!(shown(&two.outputs) == shown(&one.outputs), "the same arrow, faults and signals");
    two.outputs.taken.is_some() && a > 0 && b > 0
}

/// The same of a state that time alone may end.
fn two_steps_lead_where_one_does(state: AsState) {
    let leads = two_steps_are_one(state);
    kani::cover!(leads, "the second step takes an arrow");
}

harnesses! {
    /// **`a` and then `b` is `a + b`.** A step after `a` that takes no arrow and finds the handshake as it was, and another
    /// after `b` with the same inputs, come to the same control state, arrow, faults and signals as one step after `a + b`.
    ///
    /// So it is under the default readings; [`two_steps_are_one_where_an_edge_is_enough`] has the one reading under which it takes
    /// more.
    ///
    /// Requirements: DRV-4, ETO-1, HS-9, HS-15.
    unwind 13;
    two_steps_in_off_are_one = two_steps_are_one(AsState::Off);
    two_steps_in_ready_are_one = two_steps_lead_where_one_does(AsState::Ready);
    two_steps_in_driving_are_one = two_steps_lead_where_one_does(AsState::Driving);
    two_steps_in_finished_are_one = two_steps_lead_where_one_does(AsState::Finished);
    two_steps_in_emergency_brake_are_one = two_steps_lead_where_one_does(AsState::EmergencyBrake);
}

/// **`a` and then `b` is `a + b`, where any edge of "Go" counts** (`go-edge=edge`), in AS_READY, the one state in which that
/// matters: but for an edge of "Go" at the first step, before the 5 seconds are over. The first step uses it up; a single step
/// at the end of them sees it only then, and drives.
///
/// Requirements: D-6, DRV-4, HS-9, HS-15.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn two_steps_are_one_where_an_edge_is_enough() {
    const READINGS: Readings = Readings::DEFAULT.with(Choice::GoEdgeEnough);
    const MACHINE: Machine = Machine::new(*EDITION, READINGS);
    let keeps =
        |control: &Control| control.state == AsState::Ready && control.is_consistent(&TIMING, READINGS);
    // "Go" may have been seen off at any time in that state.
    let before = Control { state: AsState::Ready, go_seen_low: kani::any(), ..kani::any_where(keeps) };
    // With others the first step takes an arrow.
    let inputs = kani::any_where(|inputs: &Inputs| inputs.asms && !inputs.ai.status.estop_request);
    let (a, b): (u32, u32) = (kani::any(), kani::any());
    kani::assume(a.checked_add(b).is_some());
    let (between, first) = subject().step_of(&MACHINE, &before, &inputs, a);
    kani::assume(first.taken.is_none() && handshake_goes_on(&before, &between));
    let edge = first.atoms.has(Atom::GoEdge);
    let too_early = edge & !first.atoms.has(Atom::DwellElapsed);
    let (after_two, two) = subject().step_of(&MACHINE, &between, &inputs, b);
    let (after_one, one) = subject().step_of(&MACHINE, &before, &inputs, a + b);
    let drives = one.state == AsState::Driving;
    kani::cover!(too_early & drives, "only who looks once drives");
    kani::assume(!too_early);
    kani::cover!(edge, "an edge comes in time, and another condition is missing");
    let brakes = two.state == AsState::EmergencyBrake;
    kani::cover!(brakes, "the second step takes an arrow");
    assert!(after_two == after_one, "the same control state");
    assert!(shown(&two) == shown(&one), "the same arrow, faults and signals");
}

/// **Timers saturate without changing anything.** A timer that has reached its limit, and one that would have gone on
/// counting for any time beyond it, make the same of every step. So a model whose timers stop is finite and loses nothing.
///
/// Requirements: DRV-4, ETO-1, HS-9.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn saturated_timers_change_nothing() {
    let before = any_control();
    kani::assume(before.in_state_ms == TIMING.in_state_limit(before.state));
    kani::assume(!before.handshake.active || before.handshake.unanswered_ms == TIMING.handshake_ms);
    let (inputs, dt_ms, longer_ms): (_, u32, u32) = (kani::any(), kani::any(), kani::any());
    let one = Step::of(before, inputs, dt_ms);
    let other = Step::of(before, inputs, longer_ms);
    kani::cover!(
        before.state == AsState::EmergencyBrake && dt_ms == 0 && longer_ms == u32::MAX,
        "49 days more"
    );
    kani::cover!(before.handshake.active, "the handshake is lost");
    assert!(one.after == other.after && one.outputs == other.outputs, "time makes no difference any more");
}

/// Any time of which a timer that stops at a limit would show this.
fn any_true_time(shown_ms: u16, limit_ms: u64) -> u64 {
    let beyond_ms: u32 = kani::any();
    let shown_ms = u64::from(shown_ms);
    if shown_ms < limit_ms { shown_ms } else { shown_ms + u64::from(beyond_ms) }
}

/// **A timer is the time that has passed, up to its limit.** With the true time since the state was entered, and since the
/// edge that is unanswered, kept beside it without a limit, the control state's timers are their smaller ones after every
/// step; and a timed arrow is taken only when the true time has come.
///
/// Requirements: DRV-4, ETO-1, HS-9, HS-16.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn timers_are_the_time_that_has_passed() {
    let before = any_control();
    let limit = u64::from(TIMING.in_state_limit(before.state));
    let lost = u64::from(TIMING.handshake_ms);
    let in_state_ms = any_true_time(before.in_state_ms, limit);
    let unanswered_ms = any_true_time(before.handshake.unanswered_ms, lost);

    let Step { dt_ms, after, outputs, .. } = Step::of(before, kani::any(), kani::any());
    let now_ms = in_state_ms + u64::from(dt_ms);
    kani::cover!(
        now_ms > 65_535 && outputs.taken.is_none() && limit > 0,
        "longer than the timer could count"
    );
    if outputs.taken.is_none() {
        assert!(u64::from(after.in_state_ms) == now_ms.min(limit), "the time in the state");
    } else {
        assert!(after.in_state_ms == 0, "the next state begins now");
        let timed = matches!(
            (before.state, after.state),
            (AsState::Ready, AsState::Driving) | (AsState::EmergencyBrake, AsState::Off)
        );
        kani::cover!(timed && now_ms == limit, "a timed arrow, not a millisecond too late");
        assert!(!timed || now_ms >= limit, "the time has come");
    }
    if before.handshake.active && after.handshake.active && before.handshake.bit == after.handshake.bit {
        let waited_ms = unanswered_ms + u64::from(dt_ms);
        assert!(
            u64::from(after.handshake.unanswered_ms) == waited_ms.min(lost),
            "the time without an answer"
        );
    }
}

/// Claims it of a state; whether the second look takes an arrow.
fn a_faster_cycle_takes_nothing_that_a_slower_one_forbids(state: AsState) -> bool {
    let fast = any_step_that_may_stay(state);
    let b: u32 = kani::any();
    kani::assume(fast.dt_ms.checked_add(b).is_some());
    let slow = Step::of(fast.before, fast.inputs, fast.dt_ms + b);
    kani::cover!(fast.outputs.taken.is_some() && b > 0, "an arrow, seen at once");
    let lost = slow.after.handshake.is_lost(TIMING.handshake_ms);
    assert!(
        fast.outputs.taken.is_none() || slow.outputs.taken == fast.outputs.taken || lost,
        "what is taken early is taken late as well"
    );
    let fast_lost = fast.after.handshake.is_lost(TIMING.handshake_ms);
    assert!(!fast_lost || lost, "and what is lost early is lost late");

    // The second look of the faster one.
    kani::assume(fast.outputs.taken.is_none() && handshake_goes_on(&fast.before, &fast.after));
    let again = Step::of(fast.after, fast.inputs, b);
    assert!(again.outputs.taken == slow.outputs.taken, "the second look takes what the only look takes");
    again.outputs.taken.is_some()
}

/// The same of a state that time alone may end.
fn a_second_look_takes_what_the_only_one_does(state: AsState) {
    let again = a_faster_cycle_takes_nothing_that_a_slower_one_forbids(state);
    kani::cover!(again, "an arrow, seen at the second look");
}

harnesses! {
    /// **Looking more often takes nothing that looking less often forbids.** If a VCU that looks after `a` and again after `b`
    /// leaves the state along an arrow that waits for a timer, then one that looks only after `a + b` sees the timer full as
    /// well: it takes the same arrow, unless the handshake is lost by then.
    ///
    /// Requirements: DRV-4, ETO-1, SM-11, SM-17.
    unwind 13;
    a_faster_cycle_in_off_takes_nothing_that_a_slower_one_forbids = a_faster_cycle_takes_nothing_that_a_slower_one_forbids(AsState::Off);
    a_faster_cycle_in_ready_takes_nothing_that_a_slower_one_forbids = a_second_look_takes_what_the_only_one_does(AsState::Ready);
    a_faster_cycle_in_driving_takes_nothing_that_a_slower_one_forbids = a_second_look_takes_what_the_only_one_does(AsState::Driving);
    a_faster_cycle_in_finished_takes_nothing_that_a_slower_one_forbids = a_second_look_takes_what_the_only_one_does(AsState::Finished);
    a_faster_cycle_in_emergency_brake_takes_nothing_that_a_slower_one_forbids = a_second_look_takes_what_the_only_one_does(AsState::EmergencyBrake);
}

theorems![
    two_steps_in_off_are_one,
    two_steps_in_ready_are_one,
    two_steps_in_driving_are_one,
    two_steps_in_finished_are_one,
    two_steps_in_emergency_brake_are_one,
    two_steps_are_one_where_an_edge_is_enough,
    saturated_timers_change_nothing,
    timers_are_the_time_that_has_passed,
    a_faster_cycle_in_off_takes_nothing_that_a_slower_one_forbids,
    a_faster_cycle_in_ready_takes_nothing_that_a_slower_one_forbids,
    a_faster_cycle_in_driving_takes_nothing_that_a_slower_one_forbids,
    a_faster_cycle_in_finished_takes_nothing_that_a_slower_one_forbids,
    a_faster_cycle_in_emergency_brake_takes_nothing_that_a_slower_one_forbids,
];
