//! What the theorems of `outputs.rs` catch: each signal that the VCU sends with another value, and requests that leak to the
//! actuators or do not get there.

use adsdv_proofs::subject::Subject;
use adsdv_spec::editions::{V3_0, V4_0};
use adsdv_spec::messages::{
    BrakePressure, ConesCountAll, DirectionRequest, EbsState, Frame, Layout, LogBrake, LogDriveTorque,
    LogSteerAngle, Message, MessageDef, MotorSpeedMax, ShutdownCause, SignalDef, SmAs, StatusBrk, SteerAngle,
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, VcuStatus,
};
use adsdv_spec::{Actuation, AsState, Control, Inputs, Machine, Outputs, VcuMessages};

use crate::Mutant;
use crate::otherwise::{Sending, Sent};

pub(crate) fn mutants() -> Vec<Mutant> {
    let mut mutants = of_each_signal();
    mutants.extend(of_messages());
    mutants.extend(of_frames());
    mutants.extend(of_the_actuators());
    mutants.extend(of_the_assi());
    mutants.extend(of_4_0());
    mutants
}

/// The theorem that speaks of a signal of the VCU.
fn theorem(id: u16, signal: &str) -> &'static str {
    match (id, signal) {
        (0x520, "FAULT_STATUS" | "SHUTDOWN_CAUSE" | "AI_ESTOP_REQUEST" | "AI_COMMS_LOST") => {
            "status_520h_shows_the_faults_of_driving"
        }
        (0x520, fault) if fault.ends_with("_FAULT") => "status_520h_shows_the_faults_of_driving",
        (0x520, "GO_SIGNAL") => "go_signal_is_on_while_the_vehicle_may_drive",
        (0x520, _) => "status_520h_shows_the_switches_and_the_states",
        (0x521..=0x523, _) => "feedback_of_drive_and_steering",
        (0x524..=0x526, _) => "feedback_of_brakes_and_wheels",
        (0x500, _) => "log_500h_has_the_same_in_coarser_steps",
        (0x502, _) => "log_502h_shows_the_states_again",
        _ => panic!("{signal} is not the VCU's"),
    }
}

/// The message with the value of a signal that comes next.
fn next<M: Message>(message: M, signal: &SignalDef) -> M
where
    V3_0: Layout<M>,
{
    let data = V3_0::encode(&message).data;
    let raw = signal.raw(&data).map_or(signal.min, |raw| raw + 1);
    let raw = if signal.allows(raw) { raw } else { signal.min };
    V3_0::decode(&signal.put(data, raw)).unwrap_or(message)
}

/// Each signal that the VCU sends, with another value.
fn of_each_signal() -> Vec<Mutant> {
    fn of<M: Message + 'static>(part: fn(&mut VcuMessages) -> &mut M) -> Vec<Mutant>
    where
        V3_0: Layout<M>,
    {
        let MessageDef { id, signals, .. } = *<V3_0 as Layout<M>>::DEF;
        let of_signal = |signal: &'static SignalDef| {
            let what = format!("{id:03X}h, {}: another value", signal.name);
            let change = move |messages: &mut VcuMessages, _: &Outputs, _: &Inputs| {
                let message = part(messages);
                *message = next(*message, signal);
            };
            Mutant::new(theorem(id, signal.name), &what, Sending(change))
        };
        signals.iter().map(of_signal).collect()
    }
    [
        of::<Vcu2AiStatus>(|messages| &mut messages.status),
        of::<Vcu2AiDriveF>(|messages| &mut messages.drive_f),
        of::<Vcu2AiDriveR>(|messages| &mut messages.drive_r),
        of::<Vcu2AiSteer>(|messages| &mut messages.steer),
        of::<Vcu2AiBrake>(|messages| &mut messages.brake),
        of::<Vcu2AiWheelSpeeds>(|messages| &mut messages.wheel_speeds),
        of::<Vcu2AiWheelCounts>(|messages| &mut messages.wheel_counts),
        of::<Vcu2LogDynamics1>(|messages| &mut messages.log_dynamics),
        of::<Vcu2LogStatus>(|messages| &mut messages.log_status),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Rules that are nearly those of the document.
fn of_messages() -> Vec<Mutant> {
    let of = |theorem, what, change: fn(&mut VcuMessages, &Outputs, &Inputs)| {
        Mutant::new(theorem, what, Sending(change))
    };
    let states = "status_520h_shows_the_switches_and_the_states";
    let log = "log_502h_shows_the_states_again";
    vec![
        of(states, "the state before the step", |messages, outputs, _| {
            messages.status.as_state = outputs.from;
        }),
        of(states, "a shutdown request in EMERGENCY_BRAKE", |messages, outputs, _| {
            messages.status.shutdown_request = outputs.state == AsState::EmergencyBrake;
        }),
        of(states, "steering is active in AS_READY", |messages, outputs, _| {
            messages.status.steering_status |= outputs.state == AsState::Ready;
        }),
        of(states, "one warning is not enough", |messages, _, _| {
            messages.status.warning_status =
                messages.status.warn_batt_temp_high && messages.status.warn_batt_soc_low;
        }),
        of(
            "status_520h_shows_the_faults_of_off",
            "a fault once the vehicle has stopped for it",
            |messages, _, _| {
                messages.status.fault_status = messages.status.shutdown_cause.raw() != 0;
            },
        ),
        of("status_520h_shows_the_faults_of_ready", "no cause", |messages, _, _| {
            messages.status.shutdown_cause = ShutdownCause::NoShutdown;
        }),
        of("status_520h_shows_the_faults_of_finished", "no cause", |messages, _, _| {
            messages.status.shutdown_cause = ShutdownCause::NoShutdown;
        }),
        of("status_520h_shows_the_faults_of_emergency_brake", "no cause", |messages, _, _| {
            messages.status.shutdown_cause = ShutdownCause::NoShutdown;
        }),
        of("go_signal_is_on_while_the_vehicle_may_drive", "the raw switch", |messages, _, inputs| {
            messages.status.go_signal = inputs.go;
        }),
        of("go_signal_is_on_while_the_vehicle_may_drive", "a step late", |messages, outputs, _| {
            messages.status.go_signal &= outputs.from == AsState::Driving;
        }),
        of(
            "feedback_of_drive_and_steering",
            "requests only where they are obeyed",
            |messages, outputs, _| {
                if outputs.state != AsState::Driving {
                    messages.steer.steer_angle_request = SteerAngle::default();
                }
            },
        ),
        of("feedback_of_brakes_and_wheels", "the left is the right", |messages, _, _| {
            let speeds = &mut messages.wheel_speeds;
            std::mem::swap(&mut speeds.fl_wheel_speed, &mut speeds.fr_wheel_speed);
        }),
        of("log_500h_has_the_same_in_coarser_steps", "angles are rounded down", |messages, _, inputs| {
            let half = inputs.vehicle.steer_angle.raw().div_euclid(5);
            messages.log_dynamics.steer_actual = LogSteerAngle::clamped(half);
        }),
        of("log_500h_has_the_same_in_coarser_steps", "braking is rounded up", |messages, _, inputs| {
            let sum = inputs.vehicle.hyd_press_f.raw() + inputs.vehicle.hyd_press_r.raw();
            messages.log_dynamics.brake_actual = LogBrake::clamped((sum + 3) / 4);
        }),
        of("log_500h_has_the_same_in_coarser_steps", "torque in percent of 195 Nm", |messages, _, inputs| {
            let sum = inputs.vehicle.front_axle_trq.raw() + inputs.vehicle.rear_axle_trq.raw();
            messages.log_dynamics.drive_trq_actual = LogDriveTorque::clamped(sum * 10 / 195);
        }),
        of(log, "the EBS as it reports itself", |messages, _, inputs| {
            messages.log_status.state_ebs = inputs.ebs;
        }),
        of(log, "TRIGGERED after EMERGENCY_BRAKE", |messages, outputs, _| {
            if outputs.from == AsState::EmergencyBrake {
                messages.log_status.state_ebs = EbsState::Triggered;
            }
        }),
        of(log, "the count of cones ends at 255", |messages, _, inputs| {
            let count = i32::from(inputs.ai.status.cones_count_all).min(255);
            messages.log_status.cones_count_all = ConesCountAll::clamped(count);
        }),
    ]
}

fn of_frames() -> Vec<Mutant> {
    let theorem = "each_message_goes_out_in_its_frame";
    let of = |what, change: fn(Frame) -> Frame| Mutant::new(theorem, what, Sent::new(change));
    vec![
        of("521h is sent as 522h", |frame| match frame.id {
            0x521 => Frame { id: 0x522, ..frame },
            _ => frame,
        }),
        of("502h has eight bytes", |frame| Frame { len: 8, ..frame }),
        of("the last byte is lost", |frame| {
            let [head @ .., _] = frame.data;
            let mut data = [0; 8];
            data[..7].copy_from_slice(&head);
            Frame { data, ..frame }
        }),
    ]
}

/// What reaches the actuators.
#[derive(Clone)]
struct Actuating(fn(&Outputs, &Inputs) -> Actuation);

impl Subject for Actuating {
    fn actuation(&self, outputs: &Outputs, inputs: &Inputs) -> Actuation {
        (self.0)(outputs, inputs)
    }
}

/// As if the step had led to this state.
fn as_in(state: AsState, outputs: &Outputs, inputs: &Inputs) -> Actuation {
    Outputs { state, ..*outputs }.actuation(inputs)
}

fn of_the_actuators() -> Vec<Mutant> {
    let of = |theorem, what, change| Mutant::new(theorem, what, Actuating(change));
    let commands = "drive_and_steering_obey_in_as_driving_only";
    let brakes = "the_brakes_obey_in_every_state_but_as_off";
    vec![
        of(commands, "torque in AS_READY", |outputs, inputs| {
            let torque = inputs.ai.drive_f.front_axle_trq_request;
            match outputs.state {
                AsState::Ready => Actuation { front_axle_trq: torque, ..outputs.actuation(inputs) },
                _ => outputs.actuation(inputs),
            }
        }),
        of(commands, "steering in AS_FINISHED", |outputs, inputs| match outputs.state {
            AsState::Finished => {
                Actuation { steer: Some(inputs.ai.steer.steer_request), ..outputs.actuation(inputs) }
            }
            _ => outputs.actuation(inputs),
        }),
        of(commands, "positive is to the right", |outputs, inputs| {
            let mut turned = outputs.actuation(inputs);
            turned.steer = turned.steer.map(|angle| SteerAngle::clamped(-angle.raw()));
            turned
        }),
        of(commands, "the speed limit stays behind", |outputs, inputs| Actuation {
            rear_motor_speed_max: MotorSpeedMax::MAX,
            ..outputs.actuation(inputs)
        }),
        of(commands, "always forward", |outputs, inputs| Actuation {
            direction: DirectionRequest::Forward,
            ..outputs.actuation(inputs)
        }),
        of("the_powertrain_is_ready_when_as_ready_ends", "ready a step late", |outputs, inputs| {
            let late = outputs.from == AsState::Ready && outputs.state == AsState::Driving;
            as_in(if late { AsState::Ready } else { outputs.state }, outputs, inputs)
        }),
        of("commands_end_with_as_driving", "a step late", |outputs, inputs| {
            as_in(outputs.from, outputs, inputs)
        }),
        of(brakes, "the AI Computer brakes in AS_OFF", |outputs, inputs| match outputs.state {
            AsState::Off => as_in(AsState::Ready, outputs, inputs),
            _ => outputs.actuation(inputs),
        }),
        of(brakes, "the AI Computer brakes in AS_DRIVING only", |outputs, inputs| match outputs.state {
            AsState::Ready | AsState::Finished => as_in(AsState::Off, outputs, inputs),
            _ => outputs.actuation(inputs),
        }),
        of(brakes, "half an emergency", |outputs, inputs| {
            let half = BrakePressure::clamped(100);
            match outputs.state {
                AsState::EmergencyBrake => Actuation { hyd_press_r: half, ..outputs.actuation(inputs) },
                _ => outputs.actuation(inputs),
            }
        }),
        of(brakes, "the EBS stays out", |outputs, inputs| Actuation {
            ebs_triggered: false,
            ..outputs.actuation(inputs)
        }),
    ]
}

/// A step that shows the state before it.
#[derive(Clone)]
struct ShowsTheStateBefore;

impl Subject for ShowsTheStateBefore {
    fn step(&self, before: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        let (after, outputs) = Machine::REFERENCE.step(before, inputs, dt_ms);
        (after, Outputs { state: before.state, ..outputs })
    }
}

fn of_the_assi() -> Vec<Mutant> {
    vec![Mutant::new("the_assi_shows_the_state", "the state before the step", ShowsTheStateBefore)]
}

/// What the theorems of `outputs_of_4_0.rs` catch.
fn of_4_0() -> Vec<Mutant> {
    let of = |theorem, what, change: fn(&mut VcuMessages, &Outputs, &Inputs)| {
        Mutant::new(theorem, what, Sending(change))
    };
    let (timeouts, warnings) = ("status_120h_shows_the_timeouts", "status_120h_warns_of_what_520h_shows");
    let modes = "status_120h_shows_the_modes";
    let mut mutants: Vec<Mutant> = <V4_0 as Layout<VcuStatus>>::DEF
        .signals
        .iter()
        .map(|signal| {
            let theorem = match signal.name {
                name if name.starts_with("R1_") => timeouts,
                name if name.starts_with("WARN_") => warnings,
                _ => modes,
            };
            let change = move |messages: &mut VcuMessages, _: &Outputs, _: &Inputs| {
                let data = V4_0::encode(&messages.vcu_status).data;
                let raw = signal.raw(&data).map(|raw| raw + 1).filter(|&raw| signal.allows(raw));
                let other = signal.put(data, raw.unwrap_or(signal.min));
                messages.vcu_status = V4_0::decode(&other).unwrap_or(messages.vcu_status);
            };
            Mutant::new(theorem, &format!("120h, {}: another value", signal.name), Sending(change))
        })
        .collect();
    mutants.extend([
        of(timeouts, "shown with TSMS off", |messages, _, inputs| {
            messages.vcu_status.steer_timeout = inputs.ai_silence.steer_silence_ms >= 100;
        }),
        of(warnings, "WARN_AI_COMMS_LOST with a timeout", |messages, _, _| {
            messages.vcu_status.warn_ai_comms_lost |= messages.vcu_status.steer_timeout;
        }),
        of(modes, "AS_R2D with \"Go\" in AS_READY", |messages, outputs, inputs| {
            if outputs.state == AsState::Ready && inputs.go {
                messages.vcu_status.sm_as = SmAs::R2d;
            }
        }),
        of("states_of_524h", "a fault of the EBS is one of the brakes", |messages, _, inputs| {
            if inputs.reports.ebs_fault {
                messages.brake.status_brk = StatusBrk::Fault;
            }
        }),
        of("states_of_524h", "the EBS as it reports itself", |messages, _, inputs| {
            messages.brake.status_ebs = inputs.ebs;
        }),
        Mutant::new(
            "each_message_of_4_0_goes_out_in_its_frame",
            "120h goes out as 121h",
            SentAs(0x120, 0x121),
        ),
    ]);
    mutants
}

/// A message with another identifier.
#[derive(Clone)]
struct SentAs(u16, u16);

impl Subject for SentAs {
    fn sent(&self, frame: Frame) -> Frame {
        if frame.id == self.0 { Frame { id: self.1, ..frame } } else { frame }
    }
}
