//! The handshake of section 2.4 and Figure 1, as the VCU sees it.
//!
//! The VCU sends a bit, waits until the AI Computer sends the same bit back, and then changes its own. An edge
//! that stays unanswered for too long is the fault `AI_COMMS_LOST`; it lasts until the edge is answered.

use crate::derives::data;

data!(
    /// The VCU's side of the handshake.
    ///
    /// ```
    /// use adsdv_spec::{Handshake, Edition};
    /// let limit = Edition::V3_0.rules.timing.handshake_ms;
    /// let mut vcu = Handshake::default().step(true, false, 10, limit); // the AI's 0 matches: the VCU now asks for 1
    /// assert!(vcu.bit);
    /// for _ in 0..4 { vcu = vcu.step(true, false, 10, limit); }        // 40 ms without an answer
    /// assert!(!vcu.is_lost(limit));
    /// vcu = vcu.step(true, false, 10, limit);                          // 50 ms
    /// assert!(vcu.is_lost(limit));
    /// assert!(!vcu.step(true, true, 10, limit).is_lost(limit));        // answered at last
    /// ```
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub struct Handshake {
        /// Whether the handshake was performed at the last step.
        pub active: bool,
        /// The HANDSHAKE bit that the VCU sends.
        pub bit: bool,
        /// For how long that bit has been unanswered, in milliseconds; it stops counting at the limit.
        pub unanswered_ms: u16,
    }
);

impl Handshake {
    /// The VCU's side at rest: it sends 0 and waits for nothing.
    pub const IDLE: Self = Self { active: false, bit: false, unanswered_ms: 0 };

    /// The handshake `dt_ms` later, when the AI Computer's bit is `answer`. One that is not `active` rests.
    ///
    /// The first active step begins the handshake: what went before it does not count as time without an answer.
    #[must_use]
    pub const fn step(self, active: bool, answer: bool, dt_ms: u32, limit_ms: u16) -> Self {
        if !active {
            //= D-8
            Self::IDLE
        } else if answer == self.bit {
            //= HS-4, HS-6 to HS-8, HS-12, HS-14, D-26
            Self { active, bit: !self.bit, unanswered_ms: 0 }
        } else if self.active {
            //= HS-15, HS-16
            Self { unanswered_ms: count_up(self.unanswered_ms, dt_ms, limit_ms), ..self }
        } else {
            //= D-44
            Self { active, ..Self::IDLE }
        }
    }

    /// Whether the edge has been unanswered for the limit: the fault `AI_COMMS_LOST`.
    pub const fn is_lost(self, limit_ms: u16) -> bool {
        //= HS-9, HS-13, HS-16
        self.active && self.unanswered_ms >= limit_ms
    }
}

/// A timer that counts up and stays at its limit.
///
/// In 16 bits, in which a timer is kept: for a proof that is much less than the same in 32 bits.
pub(crate) const fn count_up(timer_ms: u16, dt_ms: u32, limit_ms: u16) -> u16 {
    let dt_ms = if dt_ms > u16::MAX as u32 { u16::MAX } else { dt_ms as u16 };
    let sum_ms = timer_ms.saturating_add(dt_ms);
    if sum_ms > limit_ms { limit_ms } else { sum_ms }
}
