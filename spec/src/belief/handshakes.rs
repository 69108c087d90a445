//! What the handshake may be.

use crate::belief::Span;
use crate::handshake::Handshake;
use crate::truth::Truth;

/// What the VCU's side of the handshake may be: at rest, or with either bit, unanswered for a time between two bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Handshakes {
    /// Whether it may be at rest.
    pub idle: bool,
    /// Whether it may send 0, and for how long that may have been unanswered.
    pub low: Option<Span>,
    /// Whether it may send 1, and for how long that may have been unanswered.
    pub high: Option<Span>,
}

impl Handshakes {
    /// None at all: what no VCU can be in.
    pub const NONE: Self = Self { idle: false, low: None, high: None };

    /// This one and no other. One that rests has the rest's other values, as every step leaves it.
    pub const fn exact(handshake: Handshake) -> Self {
        let Handshake { active, bit, unanswered_ms } = handshake;
        if active {
            Self::NONE.or_waits(bit, Span::exact(unanswered_ms))
        } else {
            Self { idle: true, ..Self::NONE }
        }
    }

    /// Any there can be, with timers up to this limit.
    pub const fn any(limit_ms: u16) -> Self {
        let waits = Some(Span::between(0, limit_ms));
        Self { idle: true, low: waits, high: waits }
    }

    /// Whether it may be this one.
    pub const fn allows(&self, handshake: Handshake) -> bool {
        let Handshake { active, bit, unanswered_ms } = handshake;
        if !active {
            return self.idle && !bit && unanswered_ms == 0;
        }
        match self.waits(bit) {
            Some(span) => span.allows(unanswered_ms),
            None => false,
        }
    }

    /// Whether this allows all that the other does.
    pub const fn covers(&self, other: &Self) -> bool {
        (self.idle || !other.idle) && covers(self.low, other.low) && covers(self.high, other.high)
    }

    /// Whether it may be none.
    pub const fn is_empty(&self) -> bool {
        !self.idle && self.low.is_none() && self.high.is_none()
    }

    /// For how long the bit may have been unanswered, if it may be sent at all by a handshake that is performed.
    pub const fn waits(&self, bit: bool) -> Option<Span> {
        if bit { self.high } else { self.low }
    }

    /// What is known when either may be what was so.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self {
            idle: self.idle || other.idle,
            low: either(self.low, other.low),
            high: either(self.high, other.high),
        }
    }

    const fn or_waits(self, bit: bool, span: Span) -> Self {
        if bit {
            Self { high: either(self.high, Some(span)), ..self }
        } else {
            Self { low: either(self.low, Some(span)), ..self }
        }
    }

    /// The handshake after so much time: the twin of [`Handshake::step`]. Whether it is performed, and what the AI Computer's
    /// bit is, may be unknown.
    #[must_use]
    pub const fn step(&self, active: Truth, answer: Truth, dt_ms: Span, limit_ms: u16) -> Self {
        let mut after = Self { idle: active.allows(false), ..Self::NONE };
        if !active.allows(true) {
            return after;
        }
        if self.idle {
            if answer.allows(false) {
                after = after.or_waits(true, Span::exact(0));
            }
            if answer.allows(true) {
                after = after.or_waits(false, Span::exact(0));
            }
        }
        if let Some(low) = self.low {
            if answer.allows(false) {
                after = after.or_waits(true, Span::exact(0));
            }
            if answer.allows(true) {
                after = after.or_waits(false, low.counted_up(dt_ms, limit_ms));
            }
        }
        if let Some(high) = self.high {
            if answer.allows(true) {
                after = after.or_waits(false, Span::exact(0));
            }
            if answer.allows(false) {
                after = after.or_waits(true, high.counted_up(dt_ms, limit_ms));
            }
        }
        after
    }

    /// What is left of it when the edge has been unanswered for the limit, or has not.
    #[must_use]
    pub const fn given_lost(&self, limit_ms: u16, lost: bool) -> Self {
        Self {
            idle: self.idle && !lost,
            low: given(self.low, limit_ms, lost),
            high: given(self.high, limit_ms, lost),
        }
    }

    /// What is left of it when this is the bit that the VCU sends: one that rests sends 0.
    #[must_use]
    pub const fn given_bit(&self, bit: bool) -> Self {
        if bit { Self { high: self.high, ..Self::NONE } } else { Self { high: None, ..*self } }
    }

    /// Whether communication is lost.
    pub const fn is_lost(&self, limit_ms: u16) -> Truth {
        match (self.given_lost(limit_ms, true).is_empty(), self.given_lost(limit_ms, false).is_empty()) {
            (true, _) => Truth::False,
            (false, true) => Truth::True,
            (false, false) => Truth::Unknown,
        }
    }
}

const fn covers(one: Option<Span>, other: Option<Span>) -> bool {
    match (one, other) {
        (_, None) => true,
        (None, Some(_)) => false,
        (Some(one), Some(other)) => one.covers(other),
    }
}

const fn either(one: Option<Span>, other: Option<Span>) -> Option<Span> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.or(other)),
        (Some(span), None) | (None, Some(span)) => Some(span),
        (None, None) => None,
    }
}

const fn given(span: Option<Span>, limit_ms: u16, reached: bool) -> Option<Span> {
    match span {
        Some(span) => span.given(limit_ms, reached),
        None => None,
    }
}
