//! The handshake of section 2.4 and Figure 1: when it is lost, and when it is not.

use adsdv_spec::Handshake;

use crate::prelude::*;

const LIMIT_MS: u16 = EDITION.rules.timing.handshake_ms;

/// A handshake at some step, with the true time that its edge has been unanswered for, which no timer cuts short.
///
/// `since_ms` is the time since the VCU sent its bit as it stands; it means nothing while the handshake rests.
#[derive(Clone, Copy)]
struct Edge {
    vcu: Handshake,
    since_ms: u64,
}

impl Edge {
    /// Any: a handshake whose timer agrees with the true time. The proofs below show that every step keeps that.
    fn any() -> Self {
        let vcu: Handshake = kani::any();
        let shown_ms = u64::from(vcu.unanswered_ms);
        // A timer that stands at its limit may have got there long ago.
        let beyond_ms: u32 = kani::any();
        let since_ms = if shown_ms < 50 { shown_ms } else { shown_ms + u64::from(beyond_ms) };
        let edge = Self { vcu, since_ms };
        kani::assume(edge.is_true());
        edge
    }

    fn is_true(&self) -> bool {
        let Handshake { active, bit, unanswered_ms } = self.vcu;
        if active { u64::from(unanswered_ms) == self.since_ms.min(50) } else { !bit && unanswered_ms == 0 }
    }

    /// A step `dt_ms` later, in which the AI Computer's bit is `answer`: the edge that was sent is answered, or goes on
    /// waiting, or a first edge begins to wait.
    fn step(&self, active: bool, answer: bool, dt_ms: u32) -> Self {
        let vcu = subject().handshake(self.vcu, active, answer, dt_ms);
        let goes_on = self.vcu.active && vcu.active && answer != self.vcu.bit;
        Self { vcu, since_ms: if goes_on { self.since_ms + u64::from(dt_ms) } else { 0 } }
    }

    /// AI_COMMS_LOST.
    fn is_lost(&self) -> bool {
        self.vcu.is_lost(LIMIT_MS)
    }
}

/// **AI_COMMS_LOST is raised if and only if an edge has stayed unanswered for 50 ms**, however long or uneven the steps are;
/// the timer is the true time since that edge, wherever the last answer before it came.
///
/// Requirements: HS-9, HS-15, HS-16, D-26, D-44.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn lost_if_and_only_if_unanswered_for_50_ms() {
    let before = Edge::any();
    let (active, answer, dt_ms): (bool, bool, u32) = (kani::any(), kani::any(), kani::any());
    let after = before.step(active, answer, dt_ms);
    let waits = before.vcu.active && active && answer != before.vcu.bit;
    kani::cover!(after.is_lost() && !before.is_lost() && after.since_ms == 50, "lost at exactly 50 ms");
    kani::cover!(waits && after.since_ms == 49, "not lost at 49 ms");
    kani::cover!(before.is_lost() && !after.is_lost() && active, "answered at last");
    assert!(after.is_true(), "the timer is the true time");
    assert!(after.is_lost() == (waits && after.since_ms >= 50), "lost if and only if 50 ms have passed");
}

/// **The bit alternates.** An active handshake holds its bit until the AI Computer sends the same, and then turns it; it
/// begins with a rising edge from rest, and rests at 0 while it is not active.
///
/// Requirements: HS-1, HS-3, HS-4, HS-6, HS-7, HS-8, HS-12, HS-15, D-8, D-18.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn the_bit_turns_when_it_is_answered() {
    let before = Edge::any();
    let (active, answer, dt_ms): (bool, bool, u32) = (kani::any(), kani::any(), kani::any());
    let after = before.step(active, answer, dt_ms).vcu;
    kani::cover!(active && answer == before.vcu.bit && before.is_lost(), "the fault clears with the answer");
    kani::cover!(!before.vcu.active && after.bit, "the first edge rises");
    assert!(after.active == active, "it is active when the step makes it so");
    if active {
        assert!(
            (after.bit != before.vcu.bit) == (answer == before.vcu.bit),
            "answered: turned; unanswered: held"
        );
        assert!(
            before.vcu.active || before.vcu.bit || !answer || !after.bit,
            "from rest, a 1 is no answer to 0"
        );
    } else {
        assert!(after == Handshake::IDLE, "at rest");
    }
}

/// **A partner that answers in time never sees the fault.** Whatever the jitter of the VCU's cycle, an AI Computer whose
/// bit is the VCU's once an edge is `response_ms` old, and that takes at most 50 ms for it, never has AI_COMMS_LOST raised;
/// from the first active step on, at which it may still send anything.
///
/// Requirements: HS-13, HS-14, HS-16, D-26.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn a_partner_in_time_is_never_lost() {
    let response_ms: u64 = kani::any::<u8>().into();
    kani::assume(response_ms <= 50);
    let before = Edge::any();
    kani::assume(!before.is_lost());
    // No edge can have gone unanswered for longer than the response takes, up to the cycle that saw it last.
    let (answer, dt_ms): (bool, u32) = (kani::any(), kani::any());
    let age_ms = before.since_ms + u64::from(dt_ms);
    kani::assume(!before.vcu.active || age_ms < response_ms || answer == before.vcu.bit);
    let after = before.step(true, answer, dt_ms);
    kani::cover!(response_ms == 50 && age_ms == 50 && before.vcu.active, "just in time");
    kani::cover!(response_ms < 50 && age_ms == response_ms && before.vcu.active, "sooner, and just in time");
    kani::cover!(before.vcu.active && answer != before.vcu.bit, "not answered yet");
    kani::cover!(!before.vcu.active, "the first active step");
    assert!(!after.is_lost(), "no fault");
}

/// **A partner that does not answer is always found out**: 50 ms after the edge at the latest, whatever the cycle.
///
/// Requirements: HS-9, HS-16.
#[cfg_attr(kani, kani::proof, kani::unwind(5))]
pub fn a_silent_partner_is_always_found_out() {
    let mut edge = Edge::any();
    kani::assume(edge.vcu.active);
    let silent = !edge.vcu.bit;
    let mut passed_ms = 0;
    for _ in 0..3 {
        let dt_ms: u16 = kani::any();
        edge = edge.step(true, silent, dt_ms.into());
        passed_ms += u32::from(dt_ms);
        assert!(edge.is_lost() || passed_ms < 50, "50 ms have passed");
    }
    kani::cover!(passed_ms == 50 && edge.is_lost(), "found out at 50 ms");
    kani::cover!(!edge.is_lost(), "not yet");
}

theorems![
    lost_if_and_only_if_unanswered_for_50_ms,
    the_bit_turns_when_it_is_answered,
    a_partner_in_time_is_never_lost,
    a_silent_partner_is_always_found_out,
];
