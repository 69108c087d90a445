//! A time between two bounds.

use core::fmt;
use core::ops::RangeInclusive;

use crate::handshake::count_up;
use crate::truth::Truth;

/// A time that lies between two bounds, both included, in milliseconds: in 16 bits, as the VCU's timers are.
///
/// ```
/// use adsdv_spec::{Truth, belief::Span};
/// let waited = Span::between(30, 45).counted_up(Span::between(8, 12), 50);
/// assert_eq!(waited, Span::between(38, 50)); // it stops at its limit
/// assert_eq!(waited.reaches(50), Truth::Unknown);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    least_ms: u16,
    most_ms: u16,
}

impl Span {
    /// This time and no other.
    pub const fn exact(ms: u16) -> Self {
        Self { least_ms: ms, most_ms: ms }
    }

    /// Any time from the one to the other, whichever is less.
    pub const fn between(one_ms: u16, other_ms: u16) -> Self {
        if one_ms <= other_ms {
            Self { least_ms: one_ms, most_ms: other_ms }
        } else {
            Self { least_ms: other_ms, most_ms: one_ms }
        }
    }

    /// A time that passes; what is beyond 16 bits is as good as their largest number. `None` for a range that is empty.
    pub const fn of(range: &RangeInclusive<u32>) -> Option<Self> {
        const fn clamped(ms: u32) -> u16 {
            if ms > u16::MAX as u32 { u16::MAX } else { ms as u16 }
        }
        let (least, most) = (*range.start(), *range.end());
        if least <= most { Some(Self { least_ms: clamped(least), most_ms: clamped(most) }) } else { None }
    }

    /// The least it can be.
    pub const fn least_ms(self) -> u16 {
        self.least_ms
    }

    /// The most it can be.
    pub const fn most_ms(self) -> u16 {
        self.most_ms
    }

    /// Whether it may be this.
    pub const fn allows(self, ms: u16) -> bool {
        self.least_ms <= ms && ms <= self.most_ms
    }

    /// Whether this allows all that the other does.
    pub const fn covers(self, other: Self) -> bool {
        self.least_ms <= other.least_ms && other.most_ms <= self.most_ms
    }

    /// What is known when either may be what was so.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self {
            least_ms: if self.least_ms < other.least_ms { self.least_ms } else { other.least_ms },
            most_ms: if self.most_ms > other.most_ms { self.most_ms } else { other.most_ms },
        }
    }

    /// What is left when both are so; `None` if they exclude each other.
    pub const fn and(self, other: Self) -> Option<Self> {
        let least_ms = if self.least_ms > other.least_ms { self.least_ms } else { other.least_ms };
        let most_ms = if self.most_ms < other.most_ms { self.most_ms } else { other.most_ms };
        if least_ms <= most_ms { Some(Self { least_ms, most_ms }) } else { None }
    }

    /// A timer after so much time, which stays at its limit: the twin of what a VCU's timer does.
    #[must_use]
    pub const fn counted_up(self, dt_ms: Self, limit_ms: u16) -> Self {
        Self {
            least_ms: count_up(self.least_ms, dt_ms.least_ms as u32, limit_ms),
            most_ms: count_up(self.most_ms, dt_ms.most_ms as u32, limit_ms),
        }
    }

    /// Whether it has reached a limit.
    pub const fn reaches(self, limit_ms: u16) -> Truth {
        if self.least_ms >= limit_ms {
            Truth::True
        } else if self.most_ms < limit_ms {
            Truth::False
        } else {
            Truth::Unknown
        }
    }

    /// What is left of it when it has reached a limit, or has not; `None` if nothing is.
    pub const fn given(self, limit_ms: u16, reached: bool) -> Option<Self> {
        if reached {
            self.and(Self { least_ms: limit_ms, most_ms: u16::MAX })
        } else {
            match limit_ms.checked_sub(1) {
                Some(below_ms) => self.and(Self { least_ms: 0, most_ms: below_ms }),
                None => None,
            }
        }
    }
}

/// As `40 ms`, or `40 to 50 ms`.
impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.least_ms == self.most_ms {
            write!(f, "{} ms", self.least_ms)
        } else {
            write!(f, "{} to {} ms", self.least_ms, self.most_ms)
        }
    }
}
