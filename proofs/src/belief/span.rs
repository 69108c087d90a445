//! Times between two bounds.

use adsdv_spec::belief::Span;
use adsdv_spec::{Handshake, Truth};

use super::around;
use crate::prelude::*;

/// A timer after so much time, as the handshake counts it.
fn counted_up(timer_ms: u16, dt_ms: u16, limit_ms: u16) -> u16 {
    let waits = Handshake { active: true, bit: false, unanswered_ms: timer_ms };
    waits.step(true, true, dt_ms.into(), limit_ms).unanswered_ms
}

/// **A timer between two bounds stays between them as they count up**, for every time between two other bounds and every
/// limit. What is known exactly is known exactly afterwards; and who knows less before knows no more afterwards.
///
/// Requirements: DRV-4, ETO-1, HS-9.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn a_timer_stays_between_its_bounds() {
    let (timer_ms, dt_ms, limit_ms): (u16, u16, u16) = (kani::any(), kani::any(), kani::any());
    let (timer, dt) = (around::span(timer_ms), around::span(dt_ms));
    let after_ms = counted_up(timer_ms, dt_ms, limit_ms);
    let after = subject().counted_up(timer, dt, limit_ms);
    kani::cover!(after.reaches(limit_ms) == Truth::Unknown, "some have reached the limit, and some have not");
    kani::cover!(timer == Span::exact(timer_ms) && dt == Span::exact(dt_ms) && dt_ms > 0, "all is known");
    assert!(after.allows(after_ms), "the timer is between the bounds");
    let exact = timer == Span::exact(timer_ms) && dt == Span::exact(dt_ms);
    assert!(!exact || after == Span::exact(after_ms), "what is known exactly stays so");
    let wider = subject().counted_up(around::wider(timer), around::wider(dt), limit_ms);
    assert!(wider.covers(after), "who knows less knows no more afterwards");
}

/// **What is left of a span when a limit is reached, or is not, is exactly those of its times**; and whether it is reached is
/// called unknown exactly where both may be.
///
/// Requirements: DRV-4, ETO-1, HS-9.
#[cfg_attr(kani, kani::proof, kani::unwind(3))]
pub fn a_span_is_cut_at_a_limit() {
    let (one_ms, other_ms, limit_ms): (u16, u16, u16) = (kani::any(), kani::any(), kani::any());
    let span = around::span(one_ms);
    let reached: bool = kani::any();
    let left = subject().span_given(span, limit_ms, reached);
    kani::cover!(left.is_none(), "nothing is left");
    kani::cover!(left.is_some_and(|left| left != span && left.allows(one_ms)), "some is left");
    for ms in [one_ms, other_ms] {
        let fits = span.allows(ms) && (ms >= limit_ms) == reached;
        let is_left = match left {
            Some(left) => left.allows(ms),
            None => false,
        };
        assert!(is_left == fits, "what is left is what fits");
    }
    if let Some(left) = left {
        assert!(left.allows(left.least_ms()) && left.allows(left.most_ms()), "what is left is something");
    }
    let called = subject().span_reaches(span, limit_ms);
    kani::cover!(called == Truth::Unknown, "it may have reached it");
    assert!(called.allows(one_ms >= limit_ms), "what is said of the limit is so");
    let both = span.least_ms() < limit_ms && limit_ms <= span.most_ms();
    assert!((called == Truth::Unknown) == both, "unknown is said where both may be");
}

/// **A span or another allows what either does and is bounded by their bounds; a span and another allow exactly what both do**;
/// and one covers another exactly where it allows all that it does.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(3))]
pub fn spans_are_joined() {
    let (ms, other_ms): (u16, u16) = (kani::any(), kani::any());
    let one = around::span(ms);
    let other = if kani::any() { around::span(ms) } else { around::span(other_ms) };
    let (either, both) = subject().join_spans(one, other);
    let (other_way, _) = subject().join_spans(other, one);
    kani::cover!(both.is_none(), "they exclude each other");
    kani::cover!(one.covers(other) && one != other, "one covers the other");
    assert!(either.allows(ms), "what one allows");
    assert!(either == other_way, "whichever comes first");
    assert!(either.covers(one) && either.covers(other), "what either allows");
    for bound_ms in [either.least_ms(), either.most_ms()] {
        assert!(one.allows(bound_ms) || other.allows(bound_ms), "no further than they go");
    }
    for ms in [ms, other_ms] {
        let in_both = match both {
            Some(both) => both.allows(ms),
            None => false,
        };
        assert!(in_both == (one.allows(ms) && other.allows(ms)), "both is what both allow");
    }
    let bounds_too = one.allows(other.least_ms()) && one.allows(other.most_ms());
    assert!(one.covers(other) == bounds_too, "covered is what has its bounds within");
    assert!(!one.covers(other) || !other.allows(other_ms) || one.allows(other_ms), "and all between them");
}

theorems![a_timer_stays_between_its_bounds, a_span_is_cut_at_a_limit, spans_are_joined];
