//! What the VCU remembers between two steps, as a struct of C.

use adsdv_spec::{Control, Handshake};

use crate::border::{Packed, Plain, answer, out};
use crate::error::{adsdv_error, adsdv_status};
use crate::plain;

/// What the VCU remembers between two steps. Flags are 0 or 1. It can be copied, compared and kept like any struct.
// Bytes first, without a gap: see limits.rs.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct adsdv_control {
    /// The state of Figure 2: an adsdv_as_state.
    pub state: u8,
    /// AS_READY only: the "Go" switch was seen off, so that a rising edge is accepted.
    pub go_seen_low: u8,
    /// AS_DRIVING only, where changes count (fault-trigger=edge): MISSION_STATUS was RUNNING.
    pub was_running: u8,
    /// AS_DRIVING only, where changes count (fault-trigger=edge): DIRECTION_REQUEST was FORWARD.
    pub was_forward: u8,
    /// The handshake was performed at the last step.
    pub handshake_active: u8,
    /// The HANDSHAKE bit that the VCU sends.
    pub handshake_bit: u8,
    /// The vehicle must be power-cycled before it can drive again.
    pub power_cycle_needed: u8,
    /// The fault that shut the vehicle down first: an adsdv_shutdown_cause.
    pub shutdown_cause: u8,
    /// How long the state has lasted, in ms, as far as that matters.
    pub in_state_ms: u16,
    /// For how long the HANDSHAKE bit has been unanswered, in ms; it stops counting at the limit.
    pub handshake_unanswered_ms: u16,
}

// SAFETY: `repr(C)`, integers only.
unsafe impl Plain for adsdv_control {}
// SAFETY: `repr(C)`; 8 numbers of a byte, then 2 of two, and nothing else.
unsafe impl Packed<8, 2> for adsdv_control {}

plain::conversions!("control" adsdv_control[8, 2]: Control {
    state,
    in_state_ms,
    go_seen_low,
    was_running,
    was_forward,
    handshake: Handshake { active = handshake_active, bit = handshake_bit, unanswered_ms = handshake_unanswered_ms },
    power_cycle_needed,
    shutdown_cause,
});

/// The VCU after a power cycle: AS_OFF, nothing remembered.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_control_init(
    control: *mut adsdv_control,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the control state.
        unsafe { out(control, "control")? }.set(adsdv_control::from(&Control::INITIAL));
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
