//! What a step shows to the outside: the decision, the faults, what reaches the actuators, and every VCU frame.

use crate::assi::Assi;
use crate::atoms::Atoms;
use crate::bus::Bus;
use crate::derives::data;
use crate::faults::{Fault, Faults};
use crate::inputs::Inputs;
use crate::machine::{Machine, Taken};
use crate::messages::{
    AnyMessage, AsState, AxleTorqueRequest, BrakePressure, ConesCountAll, DirectionRequest, EbsStage,
    EbsState, Frame, LogBrake, LogDriveTorque, LogSteerAngle, MotorSpeedMax, OpState, ServiceBrake,
    ShutdownCause, SmAs, SmSys, StatusBrk, SteerAngle, SysActionState, TsState, Vcu2AiBrake, Vcu2AiDriveF,
    Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds, Vcu2LogDynamics1,
    Vcu2LogStatus, VcuStatus,
};
use crate::silence::AiSilence;
use crate::table::{Row, Term};

data!(
    /// The outcome of one step.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub struct Outputs {
        /// The state before the step.
        pub from: AsState,
        /// The state after the step.
        pub state: AsState,
        /// The row of Figure 2 that was taken and the term that decided; `None` if the state stays.
        pub taken: Option<Taken>,
        /// The conditions as the guards saw them.
        pub atoms: Atoms,
        /// The fault flags of 520h.
        pub faults: Faults,
        /// `SHUTDOWN_CAUSE` of 520h.
        pub shutdown_cause: ShutdownCause,
        /// The HANDSHAKE bit of 520h.
        pub handshake: bool,
        /// `GO_SIGNAL` of 520h.
        pub go_signal: bool,
        /// The HANDSHAKE bit has been unanswered for too long.
        pub handshake_lost: bool,
        /// The silence, in milliseconds, from which a message of the AI Computer counts as missed at this step; `None` while
        /// nobody watches.
        pub missed_ms: Option<u16>,
    }
);

data!(
    /// What reaches the actuators (sections 3.2, 3.3).
    ///
    /// Drive and steering requests do so in `AS_DRIVING` only. Brake requests do in every state but `AS_OFF`, where the
    /// brakes are the driver's; in `EMERGENCY_BRAKE` the Emergency Braking System brakes fully whatever is asked.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct Actuation {
        /// The drive torque of the front axle.
        pub front_axle_trq: AxleTorqueRequest,
        /// The speed limit of the front motor.
        pub front_motor_speed_max: MotorSpeedMax,
        /// The drive torque of the rear axle.
        pub rear_axle_trq: AxleTorqueRequest,
        /// The speed limit of the rear motor.
        pub rear_motor_speed_max: MotorSpeedMax,
        /// The direction of driving.
        pub direction: DirectionRequest,
        /// The steer angle to go to; `None` if the steering is not active.
        pub steer: Option<SteerAngle>,
        /// The hydraulic pressure of the front brakes.
        pub hyd_press_f: BrakePressure,
        /// The hydraulic pressure of the rear brakes.
        pub hyd_press_r: BrakePressure,
        /// The Emergency Braking System is triggered.
        pub ebs_triggered: bool,
    }
);

impl Actuation {
    /// The requirements of section 3 behind what reaches the actuators in a state, and the decisions where it has none, as
    /// `REQUIREMENTS.md` has them.
    pub const fn requirements(state: AsState) -> &'static [&'static str] {
        match state {
            AsState::Off => &["D-21", "D-42"],
            AsState::Ready => &["DRV-2", "DRV-3", "D-21", "D-41"],
            AsState::Driving => &["MSG-18", "MSG-25", "D-21", "D-41"],
            AsState::Finished => &["FIN-5", "FIN-6", "D-21", "D-41"],
            AsState::EmergencyBrake => &["D-21", "D-43"],
        }
    }
}

data!(
    /// Every message that the VCU sends after a step.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct VcuMessages {
        /// 520h.
        pub status: Vcu2AiStatus,
        /// 521h.
        pub drive_f: Vcu2AiDriveF,
        /// 522h.
        pub drive_r: Vcu2AiDriveR,
        /// 523h.
        pub steer: Vcu2AiSteer,
        /// 524h.
        pub brake: Vcu2AiBrake,
        /// 525h.
        pub wheel_speeds: Vcu2AiWheelSpeeds,
        /// 526h.
        pub wheel_counts: Vcu2AiWheelCounts,
        /// 500h.
        pub log_dynamics: Vcu2LogDynamics1,
        /// 120h, which version 3.0 does not have.
        pub vcu_status: VcuStatus,
        /// 502h, which is sent less often: see [`MessageDef::cycle_ms`](crate::messages::MessageDef::cycle_ms).
        pub log_status: Vcu2LogStatus,
    }
);

impl Outputs {
    /// The row of Figure 2 that was taken.
    pub fn row<'a>(&self, machine: &'a Machine) -> Option<&'a Row> {
        self.taken?.row(&machine.edition().rules.table)
    }

    /// The alternative of that row's guard that decided.
    pub fn term<'a>(&self, machine: &'a Machine) -> Option<&'a Term> {
        self.taken?.term(&machine.edition().rules.table)
    }

    /// The status light.
    pub const fn assi(&self) -> Assi {
        Assi::of(self.state)
    }

    /// What reaches the actuators of what the AI Computer requests.
    #[inline]
    pub fn actuation(&self, inputs: &Inputs) -> Actuation {
        let ai = &inputs.ai;
        let brakes = Actuation {
            hyd_press_f: ai.brake.hyd_press_f_req,
            hyd_press_r: ai.brake.hyd_press_r_req,
            ..Actuation::default()
        };
        match self.state {
            AsState::Off => Actuation::default(),         //= D-42
            AsState::Ready | AsState::Finished => brakes, //= DRV-2, DRV-3, FIN-5, FIN-6, D-21, D-41
            AsState::Driving => Actuation {
                //= MSG-18, DRV-1, D-41
                front_axle_trq: ai.drive_f.front_axle_trq_request,
                front_motor_speed_max: ai.drive_f.front_motor_speed_max,
                rear_axle_trq: ai.drive_r.rear_axle_trq_request,
                rear_motor_speed_max: ai.drive_r.rear_motor_speed_max,
                direction: ai.status.direction_request,
                steer: Some(ai.steer.steer_request),
                ..brakes
            },
            AsState::EmergencyBrake => Actuation {
                //= D-43
                hyd_press_f: BrakePressure::MAX,
                hyd_press_r: BrakePressure::MAX,
                ebs_triggered: true,
                ..Actuation::default()
            },
        }
    }

    /// Every message that the VCU sends after this step.
    ///
    /// ```
    /// use adsdv_spec::{Control, Inputs, Machine};
    /// let (vcu, inputs) = (Machine::REFERENCE, Inputs::default());
    /// let (_, outputs) = vcu.step(&Control::INITIAL, &inputs, 10);
    /// let first = outputs.messages(&inputs).frames(&vcu.edition().bus).next();
    /// assert_eq!(first.unwrap().to_string(), "520#0000010000000000"); // AS_OFF, everything off
    /// ```
    pub fn messages(&self, inputs: &Inputs) -> VcuMessages {
        let (vehicle, ai) = (&inputs.vehicle, &inputs.ai);
        VcuMessages {
            status: self.status(inputs),
            drive_f: Vcu2AiDriveF {
                front_axle_trq: vehicle.front_axle_trq,
                front_axle_trq_request: ai.drive_f.front_axle_trq_request, //= MSG-67
                front_axle_trq_max: vehicle.front_axle_trq_max,
            },
            drive_r: Vcu2AiDriveR {
                rear_axle_trq: vehicle.rear_axle_trq,
                rear_axle_trq_request: ai.drive_r.rear_axle_trq_request, //= MSG-71
                rear_axle_trq_max: vehicle.rear_axle_trq_max,
            },
            steer: Vcu2AiSteer {
                steer_angle: vehicle.steer_angle,
                steer_angle_max: vehicle.steer_angle_max,
                steer_angle_request: ai.steer.steer_request, //= MSG-76
            },
            brake: Vcu2AiBrake {
                //= MSG-79
                hyd_press_f: vehicle.hyd_press_f,
                hyd_press_f_req: ai.brake.hyd_press_f_req,
                hyd_press_r: vehicle.hyd_press_r,
                hyd_press_r_req: ai.brake.hyd_press_r_req,
                status_brk: StatusBrk::Ready,       //= MSG-86, D-60
                status_ebs: self.state_ebs(inputs), //= MSG-87, D-61
            },
            vcu_status: self.vcu_status(inputs),
            wheel_speeds: vehicle.wheel_speeds,
            wheel_counts: vehicle.wheel_counts,
            log_dynamics: log_dynamics(inputs),
            log_status: self.log_status(inputs),
        }
    }

    /// 520h alone, the first of the [`messages`](Self::messages).
    #[inline]
    pub fn status(&self, inputs: &Inputs) -> Vcu2AiStatus {
        let mut status = Vcu2AiStatus {
            handshake: self.handshake,
            as_switch_status: inputs.asms, //= MSG-44
            ts_switch_status: inputs.tsms, //= MSG-45
            go_signal: self.go_signal,
            steering_status: self.steering_active(), //= D-37
            as_state: self.state,
            ami_state: inputs.ami,                 //= RDY-6
            fault_status: !self.faults.is_empty(), //= MSG-50, D-40
            warning_status: inputs.reports.batt_temp_high || inputs.reports.batt_soc_low, //= MSG-51, D-39
            warn_batt_temp_high: inputs.reports.batt_temp_high, //= MSG-52
            warn_batt_soc_low: inputs.reports.batt_soc_low, //= MSG-53
            shutdown_cause: self.shutdown_cause,
            //= MSG-106, D-71
            op_state: match (inputs.reports.charging, inputs.tsms) {
                (true, _) => OpState::Charge,
                (false, true) => OpState::Auto,
                (false, false) => OpState::Init,
            },
            ts_state: if inputs.tsms { TsState::Running } else { TsState::Init }, //= MSG-107, D-72
            //= MSG-108, D-73
            ebs_state: match self.state_ebs(inputs) {
                EbsState::Unavailable => EbsStage::Init,
                EbsState::Armed => EbsStage::Armed,
                EbsState::Triggered => EbsStage::Triggered,
            },
            // SHUTDOWN_REQUEST stays 0: the document names no condition under which the VCU asks the AI Computer to
            // shut down. The flags of the faults follow below.
            //= D-38
            ..Vcu2AiStatus::default()
        };
        self.faults.show(&mut status);
        status
    }

    //= MSG-88
    fn vcu_status(&self, inputs: &Inputs) -> VcuStatus {
        //= MSG-92, D-56
        let missed = |silence_ms| self.missed_ms.is_some_and(|limit_ms| silence_ms >= limit_ms);
        let AiSilence {
            status_silence_ms,
            drive_f_silence_ms,
            drive_r_silence_ms,
            steer_silence_ms,
            brake_silence_ms,
        } = inputs.ai_silence;
        VcuStatus {
            //= MSG-89, D-58
            sm_sys: if inputs.tsms { SmSys::DriveAutonomous } else { SmSys::Aux },
            //= MSG-90, D-59
            sm_as: match self.state {
                AsState::Off => SmAs::Off,
                AsState::Ready => SmAs::Ready,
                AsState::Driving => SmAs::Driving,
                AsState::EmergencyBrake => SmAs::EmergencyBrake,
                AsState::Finished => SmAs::Finished,
            },
            status_timeout: missed(status_silence_ms),
            drive_f_timeout: missed(drive_f_silence_ms),
            drive_r_timeout: missed(drive_r_silence_ms),
            handshake_timeout: self.handshake_lost, //= MSG-93
            steer_timeout: missed(steer_silence_ms),
            brake_timeout: missed(brake_silence_ms),
            //= MSG-91, D-58
            sys_action_state: match (inputs.reports.charging, inputs.tsms) {
                (true, _) => SysActionState::Charge,
                (false, true) => SysActionState::DriveAuto,
                (false, false) => SysActionState::Initialise,
            },
            //= MSG-94, D-57
            warn_brake_plausibility: self.faults.has(Fault::BrakePlausibilityFault),
            warn_kl15_under_v: false,
            warn_ai_estop_req: self.faults.has(Fault::AiComputerRequest),
            warn_ai_comms_lost: self.faults.has(Fault::AiCommsFault),
            warn_auto_braking: self.faults.has(Fault::AutonomousBrakingFault),
            warn_mission_status: self.faults.has(Fault::MissionStatusFault),
        }
    }

    fn log_status(&self, inputs: &Inputs) -> Vcu2LogStatus {
        let pressed = inputs.vehicle.hyd_press_f.raw() > 0 || inputs.vehicle.hyd_press_r.raw() > 0;
        let ai = &inputs.ai.status;
        Vcu2LogStatus {
            state_assi: self.state, //= D-29
            state_ebs: self.state_ebs(inputs),
            state_ami: inputs.ami,                  //= D-29
            state_steering: self.steering_active(), //= D-29
            state_service_brake: match (pressed, inputs.tsms) {
                //= D-46
                (true, _) => ServiceBrake::Engaged,
                (false, true) => ServiceBrake::Available,
                (false, false) => ServiceBrake::Disengaged,
            },
            //= MSG-40
            lap_counter: ai.lap_counter,
            cones_count_actual: ai.cones_count_actual,
            cones_count_all: ConesCountAll::clamped(i32::from(ai.cones_count_all)),
        }
    }

    const fn state_ebs(&self, inputs: &Inputs) -> EbsState {
        match self.state {
            //= D-28
            AsState::EmergencyBrake => EbsState::Triggered,
            _ => inputs.ebs,
        }
    }

    const fn steering_active(&self) -> bool {
        matches!(self.state, AsState::Driving)
    }
}

/// 500h: what is measured and requested, in the coarser units of that message.
fn log_dynamics(inputs: &Inputs) -> Vcu2LogDynamics1 {
    let (vehicle, ai) = (&inputs.vehicle, &inputs.ai);
    let brake = |front: BrakePressure, rear: BrakePressure| {
        // The mean of two pressures in halves of a percent.
        //= D-47
        LogBrake::clamped((front.raw() + rear.raw()) / 4)
    };
    let torque = |front: i32, rear: i32| {
        //= D-50
        // Divided once, by so many steps of both axles as make one percent.
        LogDriveTorque::clamped((front + rear) / (2 * AxleTorqueRequest::MAX.raw() / 100))
    };
    // From tenths of a degree to halves.
    //= D-48
    let steer = |angle: SteerAngle| LogSteerAngle::clamped(angle.raw() / 5);
    Vcu2LogDynamics1 {
        speed_actual: vehicle.speed,
        speed_target: ai.status.veh_speed_demand, //= D-49
        steer_actual: steer(vehicle.steer_angle),
        steer_target: steer(ai.steer.steer_request),
        brake_actual: brake(vehicle.hyd_press_f, vehicle.hyd_press_r),
        brake_target: brake(ai.brake.hyd_press_f_req, ai.brake.hyd_press_r_req),
        drive_trq_actual: torque(vehicle.front_axle_trq.raw(), vehicle.rear_axle_trq.raw()),
        drive_trq_target: torque(
            ai.drive_f.front_axle_trq_request.raw(),
            ai.drive_r.rear_axle_trq_request.raw(),
        ),
    }
}

impl VcuMessages {
    /// The messages, in the order in which they are sent: 520h first, 502h last.
    pub fn all(&self) -> [AnyMessage; 10] {
        [
            self.status.into(),
            self.drive_f.into(),
            self.drive_r.into(),
            self.steer.into(),
            self.brake.into(),
            self.wheel_speeds.into(),
            self.wheel_counts.into(),
            self.log_dynamics.into(),
            self.vcu_status.into(),
            self.log_status.into(),
        ]
    }

    /// The frames of an edition, in the order in which they are sent.
    pub fn frames(&self, bus: &Bus) -> impl Iterator<Item = Frame> + use<> {
        let bus = *bus;
        self.all().into_iter().filter_map(move |message| bus.encode(message))
    }
}
