//! How long EMERGENCY_BRAKE lasts, and what it leaves behind.

use adsdv_spec::messages::AsState::{EmergencyBrake, Off};
use adsdv_spec::messages::ShutdownCause;

use super::{must_lead, only_if};
use crate::prelude::*;

/// **EMERGENCY_BRAKE lasts at least 15 seconds**, whatever the cycle: the time begins anew when it is entered, and it is left
/// only when 15000 ms are full.
///
/// Requirements: ETO-1, SM-17.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn brake_time() {
    let step = any_step();
    let (was, is) = (step.before.state == EmergencyBrake, step.after.state == EmergencyBrake);
    kani::cover!(was && !is && step.lasted_ms() == 15000, "the 15 seconds are just full");
    kani::cover!(was && !step.inputs.asms && step.lasted_ms() == 14999, "a millisecond is missing");
    kani::cover!(!was && is && step.dt_ms > 0, "it is entered");
    assert!(!was || is || step.lasted_ms() >= 15000, "it has lasted for its time");
    assert!(was || !is || step.after.in_state_ms == 0, "the time begins anew");
}

/// **EMERGENCY_BRAKE is left only with ASMS off.**
///
/// Requirements: ETO-2, SM-17.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn brake_asms() {
    let step = any_step_from(EmergencyBrake);
    kani::cover!(step.inputs.asms && step.lasted_ms() >= 15000, "ASMS is still on after 15 seconds");
    only_if(&step, Off, !step.inputs.asms);
}

/// **EMERGENCY_BRAKE is left when it may be**: for AS_OFF, once it has lasted 15 seconds and ASMS is off, whenever that was
/// switched.
///
/// Requirements: ETO-2, SM-17, D-23.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn brake_due() {
    let step = any_step_from(EmergencyBrake);
    let due = step.lasted_ms() >= 15000 && !step.inputs.asms;
    kani::cover!(due && step.lasted_ms() == 15000, "the 15 seconds are just full");
    kani::cover!(due && step.words().section_3_5_sdc_open(), "the shutdown circuit is still open");
    must_lead(&step, due, Off);
}

/// **After an emergency the vehicle stays where it cannot drive.** A VCU that has been shut down stays in EMERGENCY_BRAKE
/// and AS_OFF, whatever it sees, until its power is cycled.
///
/// Requirements: ETO-3, D-11.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn power_cycle() {
    let step = any_step();
    let shut_down = step.before.shutdown_cause != ShutdownCause::NoShutdown;
    let all_for_ready = super::off::all_for_ready(&step.inputs);
    kani::cover!(shut_down && step.before.state == Off && all_for_ready, "AS_READY would be due");
    kani::cover!(shut_down && step.leads(EmergencyBrake, Off), "EMERGENCY_BRAKE is left");
    let stays = step.after.state == Off || step.after.state == EmergencyBrake;
    assert!(!shut_down || stays, "AS_READY and all that follows need a power cycle");
}

/// **SHUTDOWN_CAUSE is the first cause, for good.** It is set by the step that enters EMERGENCY_BRAKE, and by no other; it
/// then never changes, and 520h shows it.
///
/// Requirements: D-15.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn shutdown_cause() {
    let step = any_step();
    let (before, after) = (step.before.shutdown_cause, step.after.shutdown_cause);
    let was_shut_down = before != ShutdownCause::NoShutdown;
    kani::cover!(!was_shut_down && after == ShutdownCause::BmsFault, "the last cause is set");
    kani::cover!(
        was_shut_down && step.leads(EmergencyBrake, Off),
        "EMERGENCY_BRAKE is left, the cause stays"
    );
    if was_shut_down {
        assert!(after == before, "the first cause stays");
    } else {
        let enters = step.after.state == EmergencyBrake;
        assert!(
            (after != ShutdownCause::NoShutdown) == enters,
            "an emergency has a cause, and only an emergency"
        );
    }
    assert!(step.outputs.shutdown_cause == after, "it is shown");
}

theorems![brake_time, brake_asms, brake_due, power_cycle, shutdown_cause];
