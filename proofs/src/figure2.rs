//! Figure 2, in the words of the document: the whole step at once, and each arrow both ways.
//!
//! The guards are those of [`words`]: plain `if`s over raw inputs, which know nothing of the table. An arrow is taken if
//! and only if its guard holds and no guard that comes before it does.

use adsdv_spec::messages::AsState::{self, Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::{Choice, Edition, Readings};

use crate::prelude::*;
use crate::steps::{keeps_invariant_of_4_0, keeps_invariant_of_2026};
use crate::words::{self, Arrow, Verdict};

/// **A step is what the document says.** From every control state, with every input and after every time, the state, what
/// is remembered, the arrow, the fault flags, SHUTDOWN_CAUSE, the HANDSHAKE bit and GO_SIGNAL are those of the words.
///
/// Requirements: SM-1, SM-2, MSG-9, HS-9, HS-10, D-1 to D-18, D-22 to D-27, D-36, D-44, D-45.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn a_step_is_what_the_document_says() {
    let Step { before, inputs, dt_ms, after, outputs } = any_step();
    let said = words::step(&before, &inputs, dt_ms, Readings::DEFAULT);
    kani::cover!(outputs.taken.is_some() && dt_ms > 0, "an arrow is taken");
    kani::cover!(before.handshake.active && after.handshake.unanswered_ms == 50, "the handshake is lost");
    assert!(Verdict::of(after, &outputs) == said, "the step and the words agree");
    assert!(outputs.from == before.state, "the outputs name the state before the step");
}

/// **A step of 4.0 is what the document says.** The same of version 4.0, with its default readings: 100 ms for the
/// handshake, missed messages, and the ten ways out of AS_DRIVING.
///
/// Requirements: SM-1, SM-2, MSG-9, HS-17 to HS-19, DTE-1 to DTE-3, DTE-6 to DTE-13, IMP-5 to IMP-9, MSG-84, MSG-85, D-1, D-3
/// to D-8, D-11 to D-18, D-22 to D-27, D-36, D-44, D-45, D-51 to D-55, D-62 to D-65.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn a_step_of_4_0_is_what_the_document_says() {
    let Step { before, inputs, dt_ms, after, outputs } = any_step_of_4_0();
    let said = words::step_of_4_0(&before, &inputs, dt_ms, Edition::V4_0.readings);
    kani::cover!(outputs.taken.is_some() && dt_ms > 0, "an arrow is taken");
    kani::cover!(before.handshake.active && after.handshake.unanswered_ms == 100, "the handshake is lost");
    assert!(Verdict::of(after, &outputs) == said, "the step and the words agree");
    assert!(outputs.from == before.state, "the outputs name the state before the step");
    assert!(keeps_invariant_of_4_0(&after), "the invariant is kept");
}

/// **The state machine of 2026 is that of 4.0**: the same rules, faults and possible answers, so that what holds of a step of
/// 4.0 with some readings holds of one of 2026 with them. The default readings differ in one: `torque-control=never`.
///
/// Requirements: SM-1, D-67.
#[cfg_attr(kani, kani::proof, kani::unwind(24))]
pub fn the_state_machine_of_2026_is_that_of_4_0() {
    let subject = subject();
    let (old, new) = (subject.machine_of_4_0(), subject.machine_of_2026());
    let (rules, rules_of_2026) = (&old.edition().rules, &new.edition().rules);
    assert!(rules_of_2026.table == rules.table, "Figure 2");
    assert!(rules_of_2026.priorities == rules.priorities, "the order of arrows under readings");
    assert!(rules_of_2026.timing == rules.timing, "the times");
    assert!(rules_of_2026.thresholds == rules.thresholds, "the thresholds");
    assert!(new.edition().faults == old.edition().faults, "the faults");
    assert!(new.edition().choices == old.edition().choices, "the possible answers");
    kani::cover!(new.readings() != old.readings(), "the readings differ");
    assert!(new.readings() == old.readings().with(Choice::TorqueNever), "in one answer");
}

/// **A step of 2026 is what the document says.** That of version 4.0, where torque and hydraulic braking at once are no fault
/// unless somebody chooses so.
///
/// Requirements: SM-1, SM-2, MSG-9, HS-17 to HS-19, DTE-1 to DTE-3, DTE-6 to DTE-13, IMP-5 to IMP-7, IMP-9, D-1, D-3 to D-8,
/// D-11 to D-18, D-22 to D-27, D-36, D-44, D-45, D-51, D-52, D-54, D-55, D-62, D-63, D-65, D-67.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn a_step_of_2026_is_what_the_document_says() {
    let Step { before, inputs, dt_ms, after, outputs } = any_step_of_2026();
    let readings = Edition::V4_0.readings.with(Choice::TorqueNever);
    let said = words::step_of_4_0(&before, &inputs, dt_ms, readings);
    kani::cover!(outputs.taken.is_some() && dt_ms > 0, "an arrow is taken");
    let drives_on = before.state == Driving && after.state == Driving;
    let both = drives_on & words::torque_and_brake(&inputs);
    kani::cover!(both, "torque and brake at once, and it drives on");
    assert!(Verdict::of(after, &outputs) == said, "the step and the words agree");
    assert!(outputs.from == before.state, "the outputs name the state before the step");
    assert!(keeps_invariant_of_2026(&after), "the invariant is kept");
}

/// A step from a state, in the words of the document.
fn any_now(from: AsState, claims: impl FnOnce(&Step, words::StepInWords<'_>)) {
    let step = any_step_from(from);
    claims(&step, words::StepInWords::of(&step.before, &step.inputs, step.dt_ms, Readings::DEFAULT));
}

/// The arrow is taken if `holds`, and only then; and its row is what the step shows to have been taken.
fn taken_if_and_only_if(step: &Step, to: AsState, holds: bool) {
    let taken = step.after.state == to;
    kani::cover!(holds, "the guard holds");
    kani::cover!(!holds, "the guard does not hold");
    assert!(taken == holds, "the arrow is taken if and only if its guard holds");
    let mut shown = false;
    for (place, row) in (0u8..).zip(subject().machine().edition().rules.table.rows()) {
        let arrow = row.from == step.before.state && row.to == to;
        shown |= arrow && step.outputs.taken.is_some_and(|taken| taken.row == place);
    }
    assert!(shown == holds, "its row is the one that is shown");
}

/// **AS_OFF to AS_READY.** With ASMS and TSMS on, a mission selected on the AMI and SELECTED in MISSION_STATUS, and the EBS
/// ARMED, unless a power cycle is needed; then, and only then.
///
/// Requirements: RDY-1 to RDY-5, SM-9, ETO-3, D-1, D-11, D-45.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn off_to_ready() {
    any_now(Off, |step, now| taken_if_and_only_if(step, Ready, now.section_3_1()));
}

/// **AS_READY to EMERGENCY_BRAKE.** With the shutdown circuit open for any of its causes, a lost handshake or an
/// ESTOP_REQUEST; then, and only then, also with ASMS off.
///
/// Requirements: RTE-1 to RTE-8, SM-12, HS-10, D-3, D-9, D-10.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_to_emergency_brake() {
    any_now(Ready, |step, now| {
        kani::cover!(now.section_3_5() && now.section_3_6(), "ASMS is off at once");
        taken_if_and_only_if(step, EmergencyBrake, now.section_3_5());
    });
}

/// **AS_READY to AS_OFF.** With ASMS off, unless there is a reason to brake; then, and only then, also when the vehicle
/// could set off.
///
/// Requirements: RTO-1, SM-10, D-3, D-22.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_to_off() {
    any_now(Ready, |step, now| {
        kani::cover!(now.section_3_6() && now.section_3_2() && !now.section_3_5(), "\"Go\" comes on at once");
        taken_if_and_only_if(step, Off, now.section_3_6() && !now.section_3_5());
    });
}

/// **AS_READY to AS_DRIVING.** After five seconds, without torque and steering requests, with straight wheels and NEUTRAL,
/// at the rising edge of "Go" that was seen off while all this held; unless there is a reason to brake, or ASMS is off.
/// Then, and only then.
///
/// Requirements: DRV-4 to DRV-9, DRV-11, DRV-12, DRV-15, SM-11, D-6, D-22, D-25.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_to_driving() {
    any_now(Ready, |step, now| {
        let guard = now.section_3_2() && !now.section_3_5() && !now.section_3_6();
        kani::cover!(guard && step.inputs.vehicle.steer_angle.raw() == -49, "the wheels are just straight");
        taken_if_and_only_if(step, Driving, guard);
    });
}

/// **AS_DRIVING to EMERGENCY_BRAKE.** With the shutdown circuit open, "Go" or ASMS off, FINISHED or NEUTRAL while a wheel
/// turns faster than 10 rpm, a lost handshake or an ESTOP_REQUEST; then, and only then, also with FINISHED at rest.
///
/// Requirements: DTE-1 to DTE-5, SM-13, HS-10, IMP-1 to IMP-4, D-2, D-5, D-9, D-10, D-24.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_to_emergency_brake() {
    any_now(Driving, |step, now| {
        kani::cover!(now.section_3_7() && now.section_3_3(), "FINISHED at rest, at once");
        kani::cover!(now.neutral_at_speed() && now.finished_at_speed(), "both faults at speed");
        taken_if_and_only_if(step, EmergencyBrake, now.section_3_7());
    });
}

/// **AS_DRIVING to AS_FINISHED.** With FINISHED and all wheels slower than 10 rpm, unless there is a reason to brake; then,
/// and only then.
///
/// Requirements: FIN-4, SM-14, D-5, D-24.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_to_finished() {
    any_now(Driving, |step, now| {
        kani::cover!(!now.at_rest() && !now.moving() && now.finished(), "a wheel turns at exactly 10 rpm");
        taken_if_and_only_if(step, Finished, now.section_3_3() && !now.section_3_7());
    });
}

/// **EMERGENCY_BRAKE to AS_OFF.** After fifteen seconds with ASMS off; then, and only then.
///
/// Requirements: ETO-1, ETO-2, SM-17, D-23.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn emergency_brake_to_off() {
    any_now(EmergencyBrake, |step, now| {
        let full = u64::from(step.before.in_state_ms) + u64::from(step.dt_ms) == 15000;
        kani::cover!(now.section_3_9() && full, "the 15 seconds are just full");
        taken_if_and_only_if(step, Off, now.section_3_9());
    });
}

/// **AS_FINISHED to EMERGENCY_BRAKE.** With the shutdown circuit open, a lost handshake or an ESTOP_REQUEST; then, and only
/// then, also with ASMS off.
///
/// Requirements: FTE-1, SM-15, HS-10, D-4, D-9, D-10.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_to_emergency_brake() {
    any_now(Finished, |step, now| {
        kani::cover!(now.section_3_8() && now.section_3_4(), "ASMS is off at once");
        taken_if_and_only_if(step, EmergencyBrake, now.section_3_8());
    });
}

/// **AS_FINISHED to AS_OFF.** With ASMS off, unless there is a reason to brake; then, and only then.
///
/// Requirements: FTO-1, SM-16, D-4.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_to_off() {
    any_now(Finished, |step, now| taken_if_and_only_if(step, Off, now.section_3_4() && !now.section_3_8()));
}

/// **There is no other arrow.** A state is left only along an arrow of Figure 2, and a step takes at most one.
///
/// Requirements: SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn no_other_arrow() {
    let Step { before, after, outputs, .. } = any_step();
    let stays = before.state == after.state;
    kani::cover!(!stays, "the state is left");
    assert!(stays || Arrow::between(before.state, after.state).is_some(), "Figure 2 has the arrow");
    assert!(outputs.taken.is_none() == stays, "a row is taken where the state changes, and only there");
}

theorems![
    a_step_is_what_the_document_says,
    a_step_of_4_0_is_what_the_document_says,
    a_step_of_2026_is_what_the_document_says,
    off_to_ready,
    ready_to_emergency_brake,
    ready_to_off,
    ready_to_driving,
    driving_to_emergency_brake,
    driving_to_finished,
    emergency_brake_to_off,
    finished_to_emergency_brake,
    finished_to_off,
    no_other_arrow;
    every the_state_machine_of_2026_is_that_of_4_0
];
