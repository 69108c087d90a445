//! Which lanes come to the same control state.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Fault, Faults};

use crate::guarded::Guarded;
use crate::network::{Gate, Wired};
use crate::planes::Planes;

/// What the control state after a step depends on: steps out of one control state with the same key come to the same one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key {
    to: AsState,
    /// The fault for which `EMERGENCY_BRAKE` is entered, where nothing was the cause of a shutdown before; otherwise none.
    cause: ShutdownCause,
    /// Which of the handshakes.
    handshake: u8,
    /// The flags of the memory, a bit each.
    kept: u8,
}

impl Key {
    /// The state that is entered, or stays.
    pub const fn to(self) -> AsState {
        self.to
    }
}

/// How many flags of the memory there are.
const FLAGS: usize = 3;

impl Wired<'_> {
    /// Splits the lanes into groups that come to the same control state, one after the other. A lane is in one group; a key comes
    /// twice where two rows lead to the same state.
    #[inline]
    pub fn groups(&self, seen: &Planes, mut group: impl FnMut(Key, u64)) {
        let guarded = self.guarded(seen);
        let mut rest = seen.lanes();
        let mut gates = self.gates;
        while let (Some(first), true) = (gates.first(), rest != 0) {
            let same_row = |gate: &Gate| gate.taken.row == first.taken.row;
            let (row, others) = gates.split_at(gates.iter().take_while(|gate| same_row(gate)).count());
            gates = others;
            let mut reasons = Reasons::NONE;
            let mut here = 0;
            for gate in row {
                let holds = rest & self.hold(&guarded, gate.on, gate.off);
                reasons.add(gate.fault, holds);
                here |= holds;
            }
            rest &= !here;
            if here != 0 {
                self.led(seen, &guarded, first.to, here, Some(&reasons), &mut group);
            }
        }
        if rest != 0 {
            self.led(seen, &guarded, self.control.state, rest, None, &mut group);
        }
    }

    /// Splits lanes that lead to a state by the cause.
    fn led(
        &self,
        seen: &Planes,
        guarded: &Guarded,
        to: AsState,
        lanes: u64,
        reasons: Option<&Reasons>,
        group: &mut impl FnMut(Key, u64),
    ) {
        let is_open = self.control.shutdown_cause == ShutdownCause::NoShutdown;
        let entered = to == AsState::EmergencyBrake && self.control.state != to;
        let mut rest = lanes;
        if let (Some(reasons), true) = (reasons, is_open && entered) {
            for &fault in Fault::ALL {
                let these = rest & reasons.of(fault, seen);
                rest &= !these;
                if these != 0 {
                    self.heard_and_kept(guarded, Key::of(to, fault.cause()), these, group);
                }
                if rest == 0 {
                    return;
                }
            }
        }
        self.heard_and_kept(guarded, Key::of(to, ShutdownCause::NoShutdown), rest, group);
    }

    /// Splits them by the handshake and by the flags of the memory.
    #[inline]
    fn heard_and_kept(&self, guarded: &Guarded, key: Key, lanes: u64, group: &mut impl FnMut(Key, u64)) {
        let kept = self.machine.kept(key.to);
        let flags: [u64; FLAGS] = [kept.go_seen_low, kept.was_running, kept.was_forward]
            .map(|literals| literals.map_or(0, |literals| self.hold(guarded, literals.on, literals.off)));
        for (handshake, answered) in guarded.heard.iter().enumerate() {
            let mut rest = lanes & answered;
            while rest != 0 {
                // The first lane that is left, and those that keep what it keeps.
                let first = rest.trailing_zeros();
                let mut these = rest;
                let mut bits = 0;
                for (place, flag) in flags.iter().enumerate() {
                    let on = flag >> first & 1;
                    these &= if on == 1 { *flag } else { !flag };
                    bits |= (on as u8) << place;
                }
                group(Key { handshake: handshake as u8, kept: bits, ..key }, these);
                rest &= !these;
            }
        }
    }
}

impl Key {
    const fn of(to: AsState, cause: ShutdownCause) -> Self {
        Self { to, cause, handshake: 0, kept: 0 }
    }
}

/// Why a row is taken: the lanes of the terms of it that hold.
struct Reasons {
    /// Of those that are reported as a fault of their own, by its number.
    own: [u64; u16::BITS as usize],
    /// Of those that the faults of the inputs explain.
    of_inputs: u64,
}

impl Reasons {
    const NONE: Self = Self { own: [0; u16::BITS as usize], of_inputs: 0 };

    fn add(&mut self, fault: Option<Fault>, holds: u64) {
        match fault {
            Some(fault) => self.own[fault as usize] |= holds,
            None => self.of_inputs |= holds,
        }
    }

    /// The lanes for which this fault is a reason.
    fn of(&self, fault: Fault, seen: &Planes) -> u64 {
        let of_inputs = if Faults::OPENING.has(fault) { self.of_inputs & seen.fault(fault) } else { 0 };
        self.own[fault as usize] | of_inputs
    }
}
