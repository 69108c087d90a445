//! What the handshake may be.

use adsdv_spec::Truth;
use adsdv_spec::belief::{Handshakes, Span};

use super::around;
use crate::prelude::*;

/// **A step of what the handshake may be leads to what it may be then**: for every handshake that is allowed, every bit of the AI
/// Computer and every time that may be, whether it is performed or not, and with any limit. What is known exactly is known
/// exactly afterwards.
///
/// Requirements: HS-1, HS-4, HS-6, HS-7, HS-8, HS-12, HS-15, HS-16, D-8, D-26, D-44.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn a_handshake_steps_within_what_may_be() {
    let before = around::any_handshake();
    let (active, answer, dt_ms, limit_ms): (bool, bool, u16, u16) =
        (kani::any(), kani::any(), kani::any(), kani::any());
    let after = before.step(active, answer, dt_ms.into(), limit_ms);
    let (handshakes, dt) = (around::handshakes(before), around::span(dt_ms));
    let (performed, answered) = (around::truth(active), around::truth(answer));
    let may_be = subject().handshakes_step(&handshakes, performed, answered, dt, limit_ms);
    let exact = handshakes == Handshakes::exact(before)
        && performed != Truth::Unknown
        && answered != Truth::Unknown
        && dt == Span::exact(dt_ms);
    kani::cover!(!exact && after.is_lost(limit_ms) && limit_ms > 0, "it may be lost, and is");
    kani::cover!(exact && after.bit && after.unanswered_ms > 0, "all is known, and it waits");
    assert!(may_be.allows(after), "what it is may be");
    assert!(!exact || may_be == Handshakes::exact(after), "what is known exactly stays so");
}

/// **Who knows less of a handshake knows no more of it after a step.**
///
/// Requirements: HS-15, HS-16.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn knowing_less_allows_no_fewer_handshakes() {
    let handshakes = around::handshakes(around::any_handshake());
    let (active, answer): (Truth, Truth) = (kani::any(), kani::any());
    let (dt, limit_ms): (Span, u16) = (around::span(kani::any()), kani::any());
    let more = subject().handshakes_step(&handshakes, active, answer, dt, limit_ms);
    let less = subject().handshakes_step(
        &around::more_handshakes(handshakes),
        around::less(active),
        around::less(answer),
        around::wider(dt),
        limit_ms,
    );
    kani::cover!(less != more && !more.idle, "less is known, and the handshake is performed");
    assert!(less.covers(&more), "who knows less allows as much");
}

/// **What is left of the handshakes when the edge is lost or not, or when a bit is seen, is exactly those of which it is so**;
/// and whether it is lost is called unknown exactly where both may be.
///
/// Requirements: HS-9, HS-13, HS-16.
#[cfg_attr(kani, kani::proof, kani::unwind(3))]
pub fn handshakes_are_cut_where_one_is_lost_or_seen() {
    let (one, other) = (around::any_handshake(), around::any_handshake());
    let limit_ms: u16 = kani::any();
    let (lost, bit): (bool, bool) = (kani::any(), kani::any());
    let handshakes = around::handshakes(one);
    let given_lost = subject().handshakes_given_lost(&handshakes, limit_ms, lost);
    let given_bit = subject().handshakes_given_bit(&handshakes, bit);
    kani::cover!(given_lost.allows(one) && lost && given_lost != handshakes, "some are lost");
    kani::cover!(given_bit.allows(one) && bit && given_bit != handshakes, "some send 1");
    for handshake in [one, other] {
        let allowed = handshakes.allows(handshake);
        let is_lost = handshake.is_lost(limit_ms);
        assert!(given_lost.allows(handshake) == (allowed && is_lost == lost), "those that are lost, or not");
        assert!(given_bit.allows(handshake) == (allowed && handshake.bit == bit), "those that send the bit");
    }
    let called = subject().handshakes_lost(&handshakes, limit_ms);
    kani::cover!(called == Truth::Unknown, "some are lost and some are not");
    assert!(called.allows(one.is_lost(limit_ms)), "what is said of the edge is so");
    if called == Truth::Unknown {
        assert!(may_be_lost(&handshakes, limit_ms), "one that is lost");
        assert!(may_be_well(&handshakes, limit_ms), "one that is not lost");
    }
}

/// Whether one of them is lost: the one that has waited longest.
fn may_be_lost(handshakes: &Handshakes, limit_ms: u16) -> bool {
    let is_lost = |waits: Option<Span>| waits.is_some_and(|span| span.most_ms() >= limit_ms);
    is_lost(handshakes.low) || is_lost(handshakes.high)
}

/// Whether one of them is not lost: one that rests, or the one that has waited least.
fn may_be_well(handshakes: &Handshakes, limit_ms: u16) -> bool {
    let is_well = |waits: Option<Span>| waits.is_some_and(|span| span.least_ms() < limit_ms);
    handshakes.idle || is_well(handshakes.low) || is_well(handshakes.high)
}

theorems![
    a_handshake_steps_within_what_may_be,
    knowing_less_allows_no_fewer_handshakes,
    handshakes_are_cut_where_one_is_lost_or_seen,
];
