//! What version 4.0 has otherwise: the ten ways out of AS_DRIVING into EMERGENCY_BRAKE, the handshake of 100 ms and the
//! messages that are missed.
//!
//! The machine is that of 4.0 with its default readings. Each of the ten alternatives of Figure 2 has its theorem; that
//! there is no other, and which cause the VCU shows, one theorem says for all ten.
//!
//! The bound of the loops is that of a step: up to 12 arrows lead out of AS_DRIVING, and there are 11 faults.

use adsdv_spec::messages::AsState::{self, Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::messages::{DirectionRequest, EbsState, MissionStatus, ShutdownCause};
use adsdv_spec::{AiSilence, Atom, Atoms, Control, Fault, Handshake, Inputs, Observation};

use super::{fastest_rpm, must_lead, only_if};
use crate::prelude::*;
use crate::words;

/// 2.4: the VCU's bit has been unanswered for 100 ms.
fn handshake_lost(step: &Step) -> bool {
    match step.unanswered_ms() {
        Some(waited_ms) => waited_ms >= 100,
        None => false,
    }
}

/// 2.4: one of the five messages has not come for 100 ms, while TSMS is on and so the handshake is carried out.
fn message_missed(step: &Step) -> bool {
    step.inputs.tsms && words::missed(&step.inputs)
}

/// 2.4 and 4: AI_COMMS_LOST, for either reason.
fn comms_lost(step: &Step) -> bool {
    handshake_lost(step) | message_missed(step)
}

/// A step in which the condition holds leads from AS_DRIVING to EMERGENCY_BRAKE. The fault of this number is shown; it is the
/// cause, unless there is one with a lower number as well.
fn must_brake(step: &Step, condition: bool, fault: Fault) {
    must_lead(step, condition, EmergencyBrake);
    let cause = step.after.shutdown_cause;
    let alone = condition && (cause as u8 == fault as u8);
    kani::cover!(alone, "it is the cause");
    if condition {
        assert!(step.outputs.faults.has(fault), "its flag is shown");
        assert!(
            cause as u8 != 0 && cause as u8 <= fault as u8,
            "it is the cause, or one with a lower number is"
        );
        assert!(step.outputs.shutdown_cause as u8 == cause as u8, "520h tells the cause");
    }
}

/// **4.0, alternative 1: an open shutdown circuit in AS_DRIVING leads to EMERGENCY_BRAKE**: any of the causes of section 3.5.
///
/// Requirements: DTE-1, SM-13, RTE-2 to RTE-8, D-5.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_sdc_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let open = step.words().section_3_5_sdc_open();
    let at_once = open & step.words().section_3_3();
    kani::cover!(at_once, "the vehicle has finished at once");
    must_lead(&step, open, EmergencyBrake);
}

/// **4.0, alternative 2: ASMS off in AS_DRIVING leads to EMERGENCY_BRAKE**, with the cause of an open circuit.
///
/// Requirements: DTE-3, SM-13, D-5, D-13.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_asms_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    must_brake(&step, !step.inputs.asms, Fault::HvilOpenFault);
}

/// **4.0, alternative 3: "Go" off in AS_DRIVING leads to EMERGENCY_BRAKE**, with the cause of an open circuit.
///
/// Requirements: DTE-2, SM-13, D-5, D-13.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_go_off_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    must_brake(&step, !step.inputs.go, Fault::HvilOpenFault);
}

/// **4.0, alternative 4: FINISHED while moving raises MISSION_STATUS_FAULT and leads to EMERGENCY_BRAKE**, whatever
/// MISSION_STATUS was before. Moving is any wheel that turns faster than 10 rpm.
///
/// Requirements: DTE-6, DTE-7, IMP-4, IMP-5, IMP-9, MSG-61, D-65.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_finished_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let finished = step.inputs.ai.status.mission_status == MissionStatus::Finished;
    let fastest_rpm = fastest_rpm(&step.inputs);
    let just = finished && (fastest_rpm == 11);
    kani::cover!(just, "the fastest wheel turns at 11 rpm");
    must_brake(&step, finished && fastest_rpm > 10, Fault::MissionStatusFault);
}

/// **4.0, alternative 5: NEUTRAL while moving raises AUTONOMOUS_BRAKING_FAULT and leads to EMERGENCY_BRAKE**, whatever
/// DIRECTION_REQUEST was before.
///
/// Requirements: DTE-6, DTE-8, IMP-4, IMP-6, IMP-9, MSG-60, D-65.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_neutral_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let neutral = step.inputs.ai.status.direction_request == DirectionRequest::Neutral;
    let fastest_rpm = fastest_rpm(&step.inputs);
    let just = neutral && (fastest_rpm == 11);
    kani::cover!(just, "the fastest wheel turns at 11 rpm");
    must_brake(&step, neutral && fastest_rpm > 10, Fault::AutonomousBrakingFault);
}

/// **4.0, alternative 6: torque and hydraulic braking at once raise BRAKE_PLAUSIBILITY_FAULT and lead to EMERGENCY_BRAKE**:
/// more than zero of either axle and of either brake, in the last messages that have come, whatever the motors do.
///
/// Requirements: DTE-6, DTE-9, IMP-8, IMP-9, MSG-84, MSG-85, D-53, D-64.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_brake_plausibility_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let ai = &step.inputs.ai;
    let (front, rear) = (ai.drive_f.front_axle_trq_request.raw(), ai.drive_r.rear_axle_trq_request.raw());
    let (front_brake, rear_brake) = (ai.brake.hyd_press_f_req.raw(), ai.brake.hyd_press_r_req.raw());
    let both = (front > 0 || rear > 0) && (front_brake > 0 || rear_brake > 0);
    let crossed = both && (front == 0) && (rear_brake == 0);
    kani::cover!(crossed, "torque at the rear, braking in front");
    must_brake(&step, both, Fault::BrakePlausibilityFault);
}

/// **4.0, alternative 7: ESTOP_REQUEST in AS_DRIVING leads to EMERGENCY_BRAKE**, with cause 1, which no other goes before.
///
/// Requirements: DTE-10, MSG-54, D-62.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_estop_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    must_brake(&step, step.inputs.ai.status.estop_request, Fault::AiComputerRequest);
}

/// **4.0, alternative 8: a handshake unanswered for 100 ms in AS_DRIVING leads to EMERGENCY_BRAKE**, counted from the edge of
/// the VCU's bit.
///
/// Requirements: DTE-6, DTE-11, IMP-7, HS-17, HS-19.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_handshake_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let just = matches!(step.unanswered_ms(), Some(100));
    kani::cover!(just, "the 100 ms are just full");
    must_brake(&step, handshake_lost(&step), Fault::AiCommsFault);
}

/// **4.0, alternative 8: a message missed for 100 ms in AS_DRIVING leads to EMERGENCY_BRAKE**, whichever of the five it is,
/// while TSMS is on and so the handshake is carried out.
///
/// Requirements: DTE-6, DTE-11, IMP-7, HS-18, D-51, D-52.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_missed_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let AiSilence { steer_silence_ms, brake_silence_ms, .. } = step.inputs.ai_silence;
    let just = (steer_silence_ms == 100) && (brake_silence_ms < 100);
    kani::cover!(just, "513h has just been missing for 100 ms");
    must_brake(&step, message_missed(&step), Fault::AiCommsFault);
}

/// **4.0, alternative 9: BMS_FAULT in AS_DRIVING leads to EMERGENCY_BRAKE.**
///
/// Requirements: DTE-12, MSG-63, D-54.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_bms_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    must_brake(&step, step.inputs.sdc.bms_fault, Fault::BmsFault);
}

/// **4.0, alternative 10: an EBS that is UNAVAILABLE in AS_DRIVING leads to EMERGENCY_BRAKE**, as EBS_FAULT.
///
/// Requirements: DTE-13, MSG-57, D-55.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_ebs_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    must_brake(&step, step.inputs.ebs == EbsState::Unavailable, Fault::EbsFault);
}

/// **In 4.0 AS_DRIVING ends in EMERGENCY_BRAKE for one of the ten alternatives, and for nothing else**; an EBS that is
/// TRIGGERED is none of them.
///
/// Requirements: SM-13, DTE-1 to DTE-3, DTE-6 to DTE-13, IMP-9, D-24, D-26, D-55.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_founded_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let inputs = &step.inputs;
    let status = &inputs.ai.status;
    let moving = fastest_rpm(inputs) > 10;
    let one_of_ten = step.words().section_3_5_sdc_open()
        || !inputs.asms
        || !inputs.go
        || moving && status.mission_status == MissionStatus::Finished
        || moving && status.direction_request == DirectionRequest::Neutral
        || words::torque_and_brake(inputs)
        || status.estop_request
        || comms_lost(&step)
        || inputs.sdc.bms_fault
        || inputs.ebs == EbsState::Unavailable;
    let goes_on = step.after.state == Driving;
    let triggered = goes_on && (inputs.ebs == EbsState::Triggered);
    kani::cover!(triggered, "the EBS is TRIGGERED, which is no reason");
    let silent = goes_on & inputs.tsms && (inputs.ai_silence.brake_silence_ms == 99);
    kani::cover!(silent, "514h has been missing for 99 ms, which is no reason");
    let unanswered = goes_on & matches!(step.unanswered_ms(), Some(99));
    kani::cover!(unanswered, "unanswered for 99 ms, which is no reason");
    only_if(&step, EmergencyBrake, one_of_ten);
}

/// **In 4.0 the cause of the end of AS_DRIVING is the alternative with the lowest number.** EBS UNAVAILABLE counts as 4,
/// ASMS and "Go" off as 2, brake plausibility as 11.
///
/// Requirements: MSG-64, MSG-85, D-12 to D-16, D-55, D-62.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn driving_cause_in_4_0() {
    let step = any_step_of_4_0_from(Driving);
    let inputs = &step.inputs;
    let (status, sdc, reports) = (&inputs.ai.status, &inputs.sdc, &inputs.reports);
    let moving = fastest_rpm(inputs) > 10;
    let open = reports.hvil_open
        || sdc.remote_estop
        || sdc.res_link_lost
        || sdc.vehicle_estop
        || sdc.crash_sensor
        || sdc.critical_fault
        || sdc.mpp_dongle_removed
        || !inputs.asms
        || !inputs.go;
    let cause = if status.estop_request {
        1
    } else if open {
        2
    } else if reports.hvil_short {
        3
    } else if reports.ebs_fault || inputs.ebs == EbsState::Unavailable {
        4
    } else if reports.offboard_charger_fault {
        5
    } else if comms_lost(&step) {
        6
    } else if moving && status.direction_request == DirectionRequest::Neutral {
        7
    } else if moving && status.mission_status == MissionStatus::Finished {
        8
    } else if reports.charging && (inputs.asms || inputs.tsms) {
        9
    } else if sdc.bms_fault {
        10
    } else if words::torque_and_brake(inputs) {
        11
    } else {
        0
    };
    kani::cover!(cause == 11, "brake plausibility alone");
    kani::cover!(cause == 0, "no reason to brake");
    assert!(step.after.shutdown_cause as u8 == cause, "the lowest number");
    assert!((cause != 0) == (step.after.state == EmergencyBrake), "a cause if and only if it brakes");
}

/// **In 4.0 a vehicle that stands brakes for an open shutdown circuit and a loss of communications, and for nothing else.** In
/// AS_READY and AS_FINISHED no ESTOP_REQUEST matters, no brake plausibility and no EBS that is UNAVAILABLE; a fault of the
/// battery does, by way of the open circuit.
///
/// Requirements: SM-12, SM-15, RTE-1 to RTE-8, FTE-1, IMP-9, HS-10, D-3, D-4, D-54, D-62, D-63.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn standing_brakes_in_4_0() {
    let from: AsState = kani::any_where(|state| matches!(state, Ready | Finished));
    let step = any_step_of_4_0_from(from);
    let open = step.words().section_3_5_sdc_open();
    let lost = comms_lost(&step);
    let by_battery = step.inputs.sdc.bms_fault && !lost;
    kani::cover!(by_battery, "a fault of the battery");
    let asked = step.inputs.ai.status.estop_request && !open && !lost;
    kani::cover!(asked, "ESTOP_REQUEST alone");
    must_lead(&step, open || lost, EmergencyBrake);
    only_if(&step, EmergencyBrake, open || lost);
}

/// **In 4.0 what the VCU remembers of the handshake is what has been**: an answer turns the bit; without one it stays, and the
/// time goes on by the time since the last step, up to 100 ms, from the first active step on. With TSMS off it rests.
///
/// Requirements: HS-1, HS-4, HS-6, HS-7, HS-15, HS-17, HS-19, D-8, D-44.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn handshake_in_4_0() {
    let step = any_step_of_4_0();
    let (before, after) = (step.before.handshake, step.after.handshake);
    let waited_ms = step.unanswered_ms().unwrap_or(0);
    let answered = step.inputs.ai.status.handshake == before.bit;
    let at_once = (after.unanswered_ms == 100) && (before.unanswered_ms == 0);
    kani::cover!(at_once, "lost in one step");
    let expected = if !step.inputs.tsms {
        Handshake { active: false, bit: false, unanswered_ms: 0 }
    } else if answered {
        Handshake { active: true, bit: !before.bit, unanswered_ms: 0 }
    } else {
        Handshake { active: true, bit: before.bit, unanswered_ms: after.unanswered_ms }
    };
    assert!(after == expected, "the bit turns when it is answered, and rests while TSMS is off");
    assert!(u64::from(after.unanswered_ms) == waited_ms.min(100), "the time without an answer");
}

/// **In 4.0 AI_COMMS_LOST is shown if and only if the handshake is unanswered or a message missed for 100 ms**, in every state;
/// or as the cause of the emergency for as long as that stands. It ends with the answer and with the next valid message.
///
/// Requirements: MSG-59, HS-17 to HS-19, D-17, D-18, D-51, D-52.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn comms_lost_in_4_0() {
    let step = any_step_of_4_0();
    let shown = step.outputs.faults.has(Fault::AiCommsFault);
    let lost = comms_lost(&step);
    let cause = step.after.shutdown_cause == ShutdownCause::AiCommsFault;
    let in_off = shown && !cause && (step.after.state == Off);
    kani::cover!(in_off, "shown in AS_OFF, without effect");
    let over = !shown && (step.before.handshake.unanswered_ms == 100);
    kani::cover!(over, "the answer has come");
    let unwatched = !shown & words::missed(&step.inputs);
    kani::cover!(unwatched, "missed, and not watched");
    assert!(shown == (lost || cause), "shown while it is lost, and as a cause");
}

/// Any silences that are as long as these in the one way that matters: whether the longest is at least 100 ms.
fn alike(silence: &AiSilence) -> AiSilence {
    let other = any_silence();
    kani::assume(too_long(&other) == too_long(silence));
    other
}

/// Any silences.
fn any_silence() -> AiSilence {
    let inputs: Inputs = kani::any();
    #[cfg(not(kani))]
    let (_, inputs, _) = crate::steps::in_time(&adsdv_spec::Edition::V4_0, Control::INITIAL, inputs, 0);
    inputs.ai_silence
}

/// Whether the longest is at least 100 ms.
fn too_long(silence: &AiSilence) -> bool {
    words::missed(&Inputs { ai_silence: *silence, ..Inputs::default() })
}

/// **The lemma of silence: silences matter to a step of 4.0 only by whether the longest is at least 100 ms.** Two inputs that
/// differ in nothing but silences, and have the same answer to that, have the same step, whatever was before.
///
/// Requirements: SM-1, HS-18, D-52.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn silence() {
    let one = any_step_of_4_0();
    let silence = one.inputs.ai_silence;
    let inputs = Inputs { ai_silence: alike(&silence), ..one.inputs };
    let other = Step::of_4_0(one.before, inputs, one.dt_ms);
    let differ = silence.steer_silence_ms != inputs.ai_silence.steer_silence_ms;
    let short = differ & !too_long(&silence);
    kani::cover!(short, "short, and different");
    let long = differ & too_long(&silence);
    kani::cover!(long, "long, and different");
    assert!(one.after == other.after, "the same control state");
    assert!(one.outputs == other.outputs, "the same arrow, faults and outputs");
}

/// **No silence matters to a step of 3.0**, which has no rule on missed messages: two inputs that differ in nothing but
/// silences have the same step.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn no_silence_matters_in_3_0() {
    let one = any_step();
    let inputs = Inputs { ai_silence: any_silence(), ..one.inputs };
    let other = Step::of(one.before, inputs, one.dt_ms);
    let differ = too_long(&one.inputs.ai_silence) != too_long(&inputs.ai_silence);
    kani::cover!(differ, "the one is long, the other is not");
    assert!(one.after == other.after, "the same control state");
    assert!(one.outputs == other.outputs, "the same arrow, faults and outputs");
}

/// **What an edition lacks never matters.** In 3.0 a step is the same whatever an observation says of missed messages, of an
/// EBS that is UNAVAILABLE and of brake requests, of which that edition does not speak.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn what_an_edition_lacks_never_matters() {
    const LACKING: Atoms = Atoms::of(&[Atom::AiMessagesMissed, Atom::EbsUnavailable, Atom::BrakeRequestZero]);
    let (before, dt_ms): (Control, u32) = (any_control(), kani::any());
    let seen: Observation = kani::any();
    let other = Observation::new(seen.atoms().union(LACKING), seen.faults());
    let (one, two) = (subject().react(&before, seen, dt_ms), subject().react(&before, other, dt_ms));
    let differ = seen.atoms().bits() != other.atoms().bits();
    kani::cover!(differ, "they differ");
    assert!(one == two, "the same reaction");
}

theorems![
    driving_sdc_in_4_0,
    driving_asms_in_4_0,
    driving_go_off_in_4_0,
    driving_finished_in_4_0,
    driving_neutral_in_4_0,
    driving_brake_plausibility_in_4_0,
    driving_estop_in_4_0,
    driving_handshake_in_4_0,
    driving_missed_in_4_0,
    driving_bms_in_4_0,
    driving_ebs_in_4_0,
    driving_founded_in_4_0,
    driving_cause_in_4_0,
    standing_brakes_in_4_0,
    handshake_in_4_0,
    comms_lost_in_4_0,
    silence,
    no_silence_matters_in_3_0,
    what_an_edition_lacks_never_matters,
];
