//! How long the AI Computer's messages have not come.
//!
//! Version 4.0 watches five messages, each for ten in a row that are missed. How long one has been missing follows from what
//! has come alone, whatever the VCU does meanwhile, and so it is an input like the messages themselves: a step asks only
//! whether the longest silence has reached the limit, and the VCU's memory has no counter for it.

use crate::atoms::{Atom, Atoms};
use crate::derives::data;
use crate::limits::Thresholds;
use crate::messages::{Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer};

data!(
    /// For how long there has been no valid message of each kind from the AI Computer, in milliseconds; before the first one,
    /// since the VCU started. The default is that all have just come.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct AiSilence {
        /// 510h.
        pub status_silence_ms: u16,
        /// 511h.
        pub drive_f_silence_ms: u16,
        /// 512h.
        pub drive_r_silence_ms: u16,
        /// 513h.
        pub steer_silence_ms: u16,
        /// 514h.
        pub brake_silence_ms: u16,
    }
);

impl AiSilence {
    /// The atom that the silence decides.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::AiMessagesMissed]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self, thresholds: &Thresholds) -> Atoms {
        //= HS-18, D-52
        let missed = match thresholds.missed_ms {
            Some(limit_ms) => self.longest_ms() >= limit_ms,
            None => false,
        };
        Atoms::when(Atom::AiMessagesMissed, missed)
    }

    /// All of them after a time in which none has come.
    ///
    /// ```
    /// use adsdv_spec::{AiSilence, Atom, Edition};
    ///
    /// let mut silence = AiSilence::default().after(90);
    /// silence.end(0x510); // a valid 510h
    /// let silence = silence.after(10);
    /// assert_eq!((silence.status_silence_ms, silence.brake_silence_ms), (10, 100));
    /// assert!(silence.atoms(&Edition::V4_0.rules.thresholds).has(Atom::AiMessagesMissed));
    /// assert!(silence.atoms(&Edition::V3_0.rules.thresholds).is_empty()); // 3.0 has no such rule
    /// ```
    #[must_use]
    pub const fn after(self, dt_ms: u32) -> Self {
        Self {
            status_silence_ms: later(self.status_silence_ms, dt_ms),
            drive_f_silence_ms: later(self.drive_f_silence_ms, dt_ms),
            drive_r_silence_ms: later(self.drive_r_silence_ms, dt_ms),
            steer_silence_ms: later(self.steer_silence_ms, dt_ms),
            brake_silence_ms: later(self.brake_silence_ms, dt_ms),
        }
    }

    /// A valid message with this identifier has come. Other identifiers are not watched.
    pub const fn end(&mut self, id: u16) {
        match id {
            Ai2VcuStatus::ID => self.status_silence_ms = 0,
            Ai2VcuDriveF::ID => self.drive_f_silence_ms = 0,
            Ai2VcuDriveR::ID => self.drive_r_silence_ms = 0,
            Ai2VcuSteer::ID => self.steer_silence_ms = 0,
            Ai2VcuBrake::ID => self.brake_silence_ms = 0,
            _ => {}
        }
    }

    /// All messages missing for the same time.
    pub const fn of(silence_ms: u16) -> Self {
        Self {
            status_silence_ms: silence_ms,
            drive_f_silence_ms: silence_ms,
            drive_r_silence_ms: silence_ms,
            steer_silence_ms: silence_ms,
            brake_silence_ms: silence_ms,
        }
    }

    /// The longest of them.
    pub const fn longest_ms(&self) -> u16 {
        longer(
            longer(
                longer(self.status_silence_ms, self.drive_f_silence_ms),
                longer(self.drive_r_silence_ms, self.steer_silence_ms),
            ),
            self.brake_silence_ms,
        )
    }
}

const fn longer(a: u16, b: u16) -> u16 {
    if a > b { a } else { b }
}

/// A silence that goes on; it stays at the longest that can be counted.
const fn later(silence_ms: u16, dt_ms: u32) -> u16 {
    crate::handshake::count_up(silence_ms, dt_ms, u16::MAX)
}
