//! What the VCU sends, and what reaches the actuators (sections 2.2, 3.2 and 3.3, and the decisions on both).
//!
//! How a message becomes bytes is the matter of [`codec`](crate::codec); what the faults, the handshake and "Go" come to
//! is said by [`words`], and here it is what 520h says.
//!
//! The bound of the loops is that of a step, which goes along the arrows and the faults; the messages add none to it.

use adsdv_spec::messages::{AsState, DirectionRequest, EbsState, Frame, ServiceBrake, SteerAngle};
use adsdv_spec::{Actuation, Assi, Readings, VcuMessages};

use crate::prelude::*;
use crate::words;

/// What the VCU sends after a step.
fn messages(step: &Step) -> VcuMessages {
    subject().messages(&step.outputs, &step.inputs)
}

/// What reaches the actuators after a step.
fn actuation(step: &Step) -> Actuation {
    subject().actuation(&step.outputs, &step.inputs)
}

/// The frame carries this message, with this identifier and this length.
fn carries<M: Coded>(frame: Frame, id: u16, len: u8, message: &M) {
    let frame = subject().sent(frame);
    assert!(frame.id == id, "the identifier");
    assert!(frame.len == len, "the length");
    // As words: arrays are compared byte by byte.
    let content = u64::from_le_bytes(message.encode().data);
    assert!(u64::from_le_bytes(frame.data) == content, "the content");
}

/// **Each message goes out in its frame.** The nine frames that the VCU sends have the identifiers and lengths of 520h to
/// 526h, 500h and 502h, each that of its message. That a message is written as it should be is for `codec`.
///
/// Requirements: MSG-29, MSG-34, MSG-41, MSG-65, MSG-69, MSG-73, MSG-77, MSG-80, MSG-82.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn each_message_goes_out_in_its_frame() {
    let step = any_end();
    let messages = messages(&step);
    let all = messages.all();
    let frames = all.map(|message| Layouts::write(&message).unwrap_or_default());
    let [status, drive_f, drive_r, steer, brake, speeds, counts, dynamics, _, log] = frames;
    assert!(Layouts::write(&all[8]).is_none(), "version 3.0 has no 120h");
    kani::cover!(counts.data[7] != 0, "something is in the last byte");
    carries(status, 0x520, 8, &messages.status);
    carries(drive_f, 0x521, 8, &messages.drive_f);
    carries(drive_r, 0x522, 8, &messages.drive_r);
    carries(steer, 0x523, 8, &messages.steer);
    carries(brake, 0x524, 8, &messages.brake);
    carries(speeds, 0x525, 8, &messages.wheel_speeds);
    carries(counts, 0x526, 8, &messages.wheel_counts);
    carries(dynamics, 0x500, 8, &messages.log_dynamics);
    carries(log, 0x502, 5, &messages.log_status);
}

/// **520h shows the switches, the states and the warnings.** `AS_SWITCH_STATUS` and `TS_SWITCH_STATUS` are ASMS and TSMS,
/// `AS_STATE` is the state that the step has led to, `AMI_STATE` the mission selected. `STEERING_STATUS` is active in
/// AS_DRIVING only, `WARNING_STATUS` is on with either warning, and `SHUTDOWN_REQUEST` is never on.
///
/// Requirements: MSG-42 to MSG-45, MSG-47 to MSG-49, MSG-51 to MSG-53, RDY-6, D-37 to D-39.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn status_520h_shows_the_switches_and_the_states() {
    let step = any_step();
    let Step { inputs, after, .. } = &step;
    let status = messages(&step).status;
    kani::cover!(status.as_state != step.before.state, "the state has changed");
    assert!(status.handshake == after.handshake.bit, "HANDSHAKE");
    assert!(!status.shutdown_request, "SHUTDOWN_REQUEST");
    assert!(status.as_switch_status == inputs.asms, "AS_SWITCH_STATUS");
    assert!(status.ts_switch_status == inputs.tsms, "TS_SWITCH_STATUS");
    assert!(status.steering_status == (after.state == AsState::Driving), "STEERING_STATUS");
    assert!(status.as_state == after.state, "AS_STATE");
    assert!(status.ami_state == inputs.ami, "AMI_STATE");
    let (hot, low) = (inputs.reports.batt_temp_high, inputs.reports.batt_soc_low);
    kani::cover!(hot != low, "one warning");
    assert!(status.warning_status == (hot || low), "WARNING_STATUS");
    assert!(status.warn_batt_temp_high == hot, "WARN_BATT_TEMP_HIGH");
    assert!(status.warn_batt_soc_low == low, "WARN_BATT_SOC_LOW");
}

/// Claims it of steps from a state; whether a fault is shown.
fn status_520h_shows_the_faults(state: AsState) -> bool {
    let step = any_step_from(state);
    let status = messages(&step).status;
    let said = words::step(&step.before, &step.inputs, step.dt_ms, Readings::DEFAULT);
    let flags = said.flags;
    assert!(status.ai_estop_request == flags.ai_estop_request, "AI_ESTOP_REQUEST");
    assert!(status.hvil_open_fault == flags.hvil_open_fault, "HVIL_OPEN_FAULT");
    assert!(status.hvil_short_fault == flags.hvil_short_fault, "HVIL_SHORT_FAULT");
    assert!(status.ebs_fault == flags.ebs_fault, "EBS_FAULT");
    assert!(status.offboard_charger_fault == flags.offboard_charger_fault, "OFFBOARD_CHARGER_FAULT");
    assert!(status.ai_comms_lost == flags.ai_comms_lost, "AI_COMMS_LOST");
    assert!(status.autonomous_braking_fault == flags.autonomous_braking_fault, "AUTONOMOUS_BRAKING_FAULT");
    assert!(status.mission_status_fault == flags.mission_status_fault, "MISSION_STATUS_FAULT");
    assert!(status.charge_procedure_fault == flags.charge_procedure_fault, "CHARGE_PROCEDURE_FAULT");
    assert!(status.bms_fault == flags.bms_fault, "BMS_FAULT");
    assert!(
        status.brake_plausibility_fault == flags.brake_plausibility_fault,
        "BRAKE_PLAUSIBILITY_FAULT, of a later version"
    );
    let any = status.ai_estop_request
        || status.hvil_open_fault
        || status.hvil_short_fault
        || status.ebs_fault
        || status.offboard_charger_fault
        || status.ai_comms_lost
        || status.autonomous_braking_fault
        || status.mission_status_fault
        || status.charge_procedure_fault
        || status.bms_fault
        || status.brake_plausibility_fault;
    kani::cover!(any, "a fault");
    assert!(status.fault_status == any, "FAULT_STATUS");
    assert!(status.shutdown_cause == said.shutdown_cause, "SHUTDOWN_CAUSE");
    any
}

/// The same of a state that is none of the faults' doing.
fn status_520h_shows_the_faults_or_none(state: AsState) {
    let any = status_520h_shows_the_faults(state);
    kani::cover!(!any, "no fault");
}

harnesses! {
    /// **520h shows the faults.** Each flag is the fault as the document's words have it, live or kept with its cause;
    /// `FAULT_STATUS` is on with any of them; and `SHUTDOWN_CAUSE` is the first cause.
    ///
    /// Requirements: MSG-50, MSG-54 to MSG-64, HS-9, D-12 to D-18, D-27, D-40.
    unwind 13;
    status_520h_shows_the_faults_of_off = status_520h_shows_the_faults_or_none(AsState::Off);
    status_520h_shows_the_faults_of_ready = status_520h_shows_the_faults_or_none(AsState::Ready);
    status_520h_shows_the_faults_of_driving = status_520h_shows_the_faults_or_none(AsState::Driving);
    status_520h_shows_the_faults_of_finished = status_520h_shows_the_faults_or_none(AsState::Finished);
    status_520h_shows_the_faults_of_emergency_brake = status_520h_shows_the_faults(AsState::EmergencyBrake);
}

/// **GO_SIGNAL is on while the vehicle may drive.** In AS_DRIVING while "Go" is on, from the step that detects its rising
/// edge; never otherwise.
///
/// Requirements: MSG-46, DRV-14, D-7.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn go_signal_is_on_while_the_vehicle_may_drive() {
    let step = any_step();
    let go = step.inputs.go && step.after.state == AsState::Driving;
    kani::cover!(step.leads(AsState::Ready, AsState::Driving), "the edge is detected");
    kani::cover!(step.inputs.go && !go, "\"Go\" is on, and the vehicle does not drive");
    assert!(messages(&step).status.go_signal == go, "GO_SIGNAL");
    assert!(
        go || !step.leads(AsState::Ready, AsState::Driving),
        "it is on at the step that detects the edge"
    );
}

/// **521h, 522h and 523h say what is, what is asked for and what is allowed.** Torques and steer angle as they are
/// measured, the requests of the AI Computer as they came, whatever the state, and the limits.
///
/// Requirements: MSG-65 to MSG-76.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn feedback_of_drive_and_steering() {
    let step = any_end();
    let (ai, vehicle) = (&step.inputs.ai, &step.inputs.vehicle);
    let VcuMessages { drive_f, drive_r, steer, .. } = messages(&step);
    kani::cover!(drive_f.front_axle_trq_request.raw() == 1950, "a request for all there is");
    kani::cover!(drive_r.rear_axle_trq.raw() < 0, "the motor brakes");
    assert!(drive_f.front_axle_trq == vehicle.front_axle_trq, "FRONT_AXLE_TRQ_Nm");
    assert!(drive_f.front_axle_trq_request == ai.drive_f.front_axle_trq_request, "FRONT_AXLE_TRQ_REQUEST_Nm");
    assert!(drive_f.front_axle_trq_max == vehicle.front_axle_trq_max, "FRONT_AXLE_TRQ_MAX_Nm");
    assert!(drive_r.rear_axle_trq == vehicle.rear_axle_trq, "REAR_AXLE_TRQ_Nm");
    assert!(drive_r.rear_axle_trq_request == ai.drive_r.rear_axle_trq_request, "REAR_AXLE_TRQ_REQUEST_Nm");
    assert!(drive_r.rear_axle_trq_max == vehicle.rear_axle_trq_max, "REAR_AXLE_TRQ_MAX_Nm");
    assert!(steer.steer_angle == vehicle.steer_angle, "STEER_ANGLE_deg");
    assert!(steer.steer_angle_max == vehicle.steer_angle_max, "STEER_ANGLE_MAX_deg");
    assert!(steer.steer_angle_request == ai.steer.steer_request, "STEER_ANGLE_REQUEST_deg");
}

/// **524h, 525h and 526h say what is, and what is asked for.** Pressures, wheel speeds and pulse counts as they are
/// measured, wheel by wheel, and the requests of the AI Computer as they came, whatever the state.
///
/// Requirements: MSG-77 to MSG-83.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn feedback_of_brakes_and_wheels() {
    let step = any_end();
    let (ai, vehicle) = (&step.inputs.ai, &step.inputs.vehicle);
    let VcuMessages { brake, wheel_speeds, wheel_counts, .. } = messages(&step);
    kani::cover!(brake.hyd_press_f_req != brake.hyd_press_r_req, "not the same at both axles");
    assert!(brake.hyd_press_f == vehicle.hyd_press_f, "HYD_PRESS_F_pct");
    assert!(brake.hyd_press_f_req == ai.brake.hyd_press_f_req, "HYD_PRESS_F_REQ_pct");
    assert!(brake.hyd_press_r == vehicle.hyd_press_r, "HYD_PRESS_R_pct");
    assert!(brake.hyd_press_r_req == ai.brake.hyd_press_r_req, "HYD_PRESS_R_REQ_pct");
    let speeds = &vehicle.wheel_speeds;
    assert!(wheel_speeds.fl_wheel_speed == speeds.fl_wheel_speed, "FL_WHEEL_SPEED_rpm");
    assert!(wheel_speeds.fr_wheel_speed == speeds.fr_wheel_speed, "FR_WHEEL_SPEED_rpm");
    assert!(wheel_speeds.rl_wheel_speed == speeds.rl_wheel_speed, "RL_WHEEL_SPEED_rpm");
    assert!(wheel_speeds.rr_wheel_speed == speeds.rr_wheel_speed, "RR_WHEEL_SPEED_rpm");
    let counts = &vehicle.wheel_counts;
    assert!(wheel_counts.fl_pulse_count == counts.fl_pulse_count, "FL_PULSE_COUNT");
    assert!(wheel_counts.fr_pulse_count == counts.fr_pulse_count, "FR_PULSE_COUNT");
    assert!(wheel_counts.rl_pulse_count == counts.rl_pulse_count, "RL_PULSE_COUNT");
    assert!(wheel_counts.rr_pulse_count == counts.rr_pulse_count, "RR_PULSE_COUNT");
}

/// **500h says the same as the others, in coarser steps.** The speed as it is measured, the one that the AI Computer
/// demands; the steer angles in halves of a degree, rounded towards zero; braking as the mean of both axles, rounded down
/// to a percent; torque as the sum of both axles in percent of twice 195 Nm, to less than one.
///
/// Requirements: MSG-29 to MSG-33, D-47 to D-50.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn log_500h_has_the_same_in_coarser_steps() {
    let step = any_end();
    let (ai, vehicle) = (&step.inputs.ai, &step.inputs.vehicle);
    let log = messages(&step).log_dynamics;
    assert!(log.speed_actual.raw() == vehicle.speed.raw(), "Speed_actual_kmh");
    assert!(log.speed_target.raw() == ai.status.veh_speed_demand.raw(), "Speed_target_kmh");

    // Five tenths of a degree are one half.
    let rounded = |half: i32, angle: SteerAngle| {
        let rest = angle.raw() - 5 * half;
        -5 < rest && rest < 5 && (rest == 0 || (rest > 0) == (angle.raw() > 0))
    };
    kani::cover!(vehicle.steer_angle.raw() == -4, "less than half a degree to the right");
    assert!(rounded(log.steer_actual.raw(), vehicle.steer_angle), "Steer_actual_deg");
    assert!(rounded(log.steer_target.raw(), ai.steer.steer_request), "Steer_target_deg");

    // Four halves of a percent, at both axles together, are one percent of both.
    let mean = |percent: i32, front: i32, rear: i32| {
        let rest = front + rear - 4 * percent;
        (0..4).contains(&rest)
    };
    let (front, rear) = (vehicle.hyd_press_f.raw(), vehicle.hyd_press_r.raw());
    kani::cover!(front + rear == 399, "just not the full brake");
    assert!(mean(log.brake_actual.raw(), front, rear), "Brake_actual_pct");
    let (front, rear) = (ai.brake.hyd_press_f_req.raw(), ai.brake.hyd_press_r_req.raw());
    assert!(mean(log.brake_target.raw(), front, rear), "Brake_target_pct");

    // One percent of twice 195 Nm is 39 tenths of a Nm.
    let sum = |percent: i32, front: i32, rear: i32| {
        let rest = front + rear - 39 * percent;
        -39 < rest && rest < 39
    };
    let (front, rear) = (vehicle.front_axle_trq.raw(), vehicle.rear_axle_trq.raw());
    kani::cover!(front + rear < 0, "the motors brake");
    assert!(sum(log.drive_trq_actual.raw(), front, rear), "Drive_trq_actual_pct");
    let (front, rear) = (ai.drive_f.front_axle_trq_request.raw(), ai.drive_r.rear_axle_trq_request.raw());
    assert!(sum(log.drive_trq_target.raw(), front, rear), "Drive_trq_target_pct");
}

/// **502h shows the states again, and what the AI Computer counts.** `State_ASSI`, `State_AMI` and `State_steering` are
/// what 520h says. `State_EBS` is what the EBS reports, and TRIGGERED in EMERGENCY_BRAKE. `State_service_brake` is ENGAGED
/// while there is pressure at an axle, else AVAILABLE while TSMS is on, else DISENGAGED.
///
/// Requirements: MSG-34 to MSG-40, D-28, D-29, D-46.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn log_502h_shows_the_states_again() {
    let step = any_end();
    let Step { inputs, after, .. } = &step;
    let VcuMessages { status, log_status: log, .. } = messages(&step);
    assert!(log.state_assi == after.state && log.state_assi == status.as_state, "State_ASSI");
    assert!(log.state_ami == inputs.ami && log.state_ami == status.ami_state, "State_AMI");
    assert!(log.state_steering == status.steering_status, "State_steering");

    let braking = after.state == AsState::EmergencyBrake;
    kani::cover!(braking && inputs.ebs == EbsState::Armed, "the EBS reports itself armed all the same");
    assert!(log.state_ebs == if braking { EbsState::Triggered } else { inputs.ebs }, "State_EBS");

    let pressed = inputs.vehicle.hyd_press_f.raw() > 0 || inputs.vehicle.hyd_press_r.raw() > 0;
    kani::cover!(!pressed && inputs.tsms, "the brake is available");
    let service_brake = if pressed {
        ServiceBrake::Engaged
    } else if inputs.tsms {
        ServiceBrake::Available
    } else {
        ServiceBrake::Disengaged
    };
    assert!(log.state_service_brake == service_brake, "State_service_brake");

    let ai = &inputs.ai.status;
    assert!(log.lap_counter == ai.lap_counter, "Lap_counter");
    assert!(log.cones_count_actual == ai.cones_count_actual, "Cones_count_actual");
    assert!(log.cones_count_all.raw() == i32::from(ai.cones_count_all), "Cones_count_all");
}

/// **Drive and steering obey in AS_DRIVING, and in no other state.** There each request reaches its actuator as it came: a
/// torque together with the motor speed that decides whether it drives or brakes, and a steer angle with its sign, which is
/// positive to the left on both ends. In every other state, AS_READY and AS_FINISHED among them, no torque, no
/// direction and no steer angle gets there.
///
/// Requirements: MSG-18, MSG-25, DRV-2, DRV-3, FIN-5, FIN-6, D-21.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn drive_and_steering_obey_in_as_driving_only() {
    let step = any_end();
    let ai = &step.inputs.ai;
    let reached = actuation(&step);
    let asked = ai.drive_f.front_axle_trq_request.raw() > 0 && ai.steer.steer_request.raw() > 0;
    if step.after.state == AsState::Driving {
        kani::cover!(asked, "the vehicle drives to the left");
        assert!(reached.front_axle_trq == ai.drive_f.front_axle_trq_request, "the torque of the front axle");
        assert!(reached.front_motor_speed_max == ai.drive_f.front_motor_speed_max, "the front motor's speed");
        assert!(reached.rear_axle_trq == ai.drive_r.rear_axle_trq_request, "the torque of the rear axle");
        assert!(reached.rear_motor_speed_max == ai.drive_r.rear_motor_speed_max, "the rear motor's speed");
        assert!(reached.direction == ai.status.direction_request, "the direction");
        assert!(reached.steer == Some(ai.steer.steer_request), "the steer angle");
    } else {
        kani::cover!(asked && step.after.state == AsState::Ready, "a request in AS_READY");
        kani::cover!(asked && step.after.state == AsState::Finished, "a request in AS_FINISHED");
        assert!(reached.front_axle_trq.raw() == 0, "no torque at the front axle");
        assert!(reached.front_motor_speed_max.raw() == 0, "no speed of the front motor");
        assert!(reached.rear_axle_trq.raw() == 0, "no torque at the rear axle");
        assert!(reached.rear_motor_speed_max.raw() == 0, "no speed of the rear motor");
        assert!(reached.direction == DirectionRequest::Neutral, "no direction");
        assert!(reached.steer.is_none(), "no steer angle");
    }
}

/// **The powertrain is ready when AS_READY ends.** The very step that leads from there to AS_DRIVING lets commands through:
/// steering is active, and the motors have the speeds that the AI Computer asks for.
///
/// Requirements: DRV-1.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn the_powertrain_is_ready_when_as_ready_ends() {
    let step = any_step_from(AsState::Ready);
    let ai = &step.inputs.ai;
    let reached = actuation(&step);
    if step.after.state == AsState::Driving {
        kani::cover!(ai.drive_f.front_motor_speed_max.raw() > 0, "the motor may turn");
        assert!(reached.steer == Some(ai.steer.steer_request), "steering is active");
        assert!(reached.front_motor_speed_max == ai.drive_f.front_motor_speed_max, "the front motor's speed");
        assert!(reached.rear_motor_speed_max == ai.drive_r.rear_motor_speed_max, "the rear motor's speed");
    }
}

/// **Commands end with AS_DRIVING.** The very step that leads from there to AS_FINISHED, or to EMERGENCY_BRAKE, lets no
/// command for the drive motors and the steering motor through any more, whatever is still asked for.
///
/// Requirements: FIN-5, FIN-6, D-21.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn commands_end_with_as_driving() {
    let step = any_step_from(AsState::Driving);
    let asked = step.inputs.ai.drive_r.rear_axle_trq_request.raw() > 0;
    let reached = actuation(&step);
    if step.after.state != AsState::Driving {
        kani::cover!(asked && step.after.state == AsState::Finished, "torque is still asked for");
        assert!(reached.front_axle_trq.raw() == 0 && reached.rear_axle_trq.raw() == 0, "no torque any more");
        assert!(reached.steer.is_none(), "no steering any more");
    }
}

/// **The brakes.** In AS_OFF they are the driver's: no request of the AI Computer gets there. In AS_READY, AS_DRIVING and
/// AS_FINISHED they obey it. In EMERGENCY_BRAKE, and only there, the EBS is triggered, and brakes fully whatever is asked.
///
/// Requirements: D-41 to D-43.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn the_brakes_obey_in_every_state_but_as_off() {
    let step = any_end();
    let brake = &step.inputs.ai.brake;
    let reached = actuation(&step);
    let asked = (brake.hyd_press_f_req.raw(), brake.hyd_press_r_req.raw());
    let full = (200, 200);
    kani::cover!(step.after.state == AsState::Off && asked.0 > 0, "braking is asked for in AS_OFF");
    kani::cover!(
        step.after.state == AsState::EmergencyBrake && asked.0 < 200,
        "less than everything is asked for"
    );
    let pressure = match step.after.state {
        AsState::Off => (0, 0),
        AsState::Ready | AsState::Driving | AsState::Finished => asked,
        AsState::EmergencyBrake => full,
    };
    assert!(reached.hyd_press_f.raw() == pressure.0, "the pressure at the front axle");
    assert!(reached.hyd_press_r.raw() == pressure.1, "the pressure at the rear axle");
    assert!(reached.ebs_triggered == (step.after.state == AsState::EmergencyBrake), "the EBS");
}

/// **The ASSI shows the state.** Off in AS_OFF, yellow in AS_READY and flashing in AS_DRIVING, blue in AS_FINISHED and
/// flashing in EMERGENCY_BRAKE: that of the state that the step has led to.
///
/// Requirements: SM-4 to SM-8.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn the_assi_shows_the_state() {
    let step = any_step();
    kani::cover!(step.before.state != step.after.state, "the light changes");
    let light = match step.after.state {
        AsState::Off => Assi::Off,
        AsState::Ready => Assi::YellowContinuous,
        AsState::Driving => Assi::YellowFlashing,
        AsState::EmergencyBrake => Assi::BlueFlashing,
        AsState::Finished => Assi::BlueContinuous,
    };
    assert!(step.outputs.assi() == light, "the light of the state");
}

theorems![
    each_message_goes_out_in_its_frame,
    status_520h_shows_the_switches_and_the_states,
    status_520h_shows_the_faults_of_off,
    status_520h_shows_the_faults_of_ready,
    status_520h_shows_the_faults_of_driving,
    status_520h_shows_the_faults_of_finished,
    status_520h_shows_the_faults_of_emergency_brake,
    go_signal_is_on_while_the_vehicle_may_drive,
    feedback_of_drive_and_steering,
    feedback_of_brakes_and_wheels,
    log_500h_has_the_same_in_coarser_steps,
    log_502h_shows_the_states_again,
    drive_and_steering_obey_in_as_driving_only,
    the_powertrain_is_ready_when_as_ready_ends,
    commands_end_with_as_driving,
    the_brakes_obey_in_every_state_but_as_off,
    the_assi_shows_the_state,
];
