//! Which arrow is taken first.

use crate::guarded::Guarded;
use crate::network::{Gate, Wired};

impl Wired<'_> {
    /// For each arrow out of the state, in the order of evaluation, the lanes in which it is taken: its guard is the
    /// first that holds. In lanes that are in none of these the state stays.
    pub fn arrows(&self, guarded: &Guarded) -> impl Iterator<Item = (&Gate, u64)> {
        self.gates.iter().scan(u64::MAX, |rest, gate| {
            let taken = *rest & self.hold(guarded, gate.on, gate.off);
            *rest &= !taken;
            Some((gate, taken))
        })
    }
}
