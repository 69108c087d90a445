//! What the VCU tells the AI Computer (section 2.2).

use super::content::contents;
use super::{
    AmiState, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, EbsStage, EbsState, OpState,
    ShutdownCause, SmAs, SmSys, StatusBrk, SteerAngle, SteerAngleMax, SysActionState, TsState, WheelSpeed,
};

contents! {
    /// State of the vehicle, and what the VCU misses from the AI Computer.
    VcuStatus 0x120 from Vcu {
        /// State of the vehicle.
        sm_sys: SmSys;
        /// State of the Autonomous System, as the vehicle keeps it.
        sm_as: SmAs;
        /// Missed messages: `AI2VCU_Status`.
        status_timeout: bool;
        /// Missed messages: `AI2VCU_Drive_F`.
        drive_f_timeout: bool;
        /// Missed messages: `AI2VCU_Drive_R`.
        drive_r_timeout: bool;
        /// Handshake unanswered.
        handshake_timeout: bool;
        /// Missed messages: `AI2VCU_Steer`.
        steer_timeout: bool;
        /// Missed messages: `AI2VCU_Brake`.
        brake_timeout: bool;
        /// What the vehicle is doing.
        sys_action_state: SysActionState;
        /// Brake plausibility warning.
        warn_brake_plausibility: bool;
        /// Low 12 V supply warning.
        ///
        /// The document gives no threshold.
        warn_kl15_under_v: bool;
        /// AI system E-stop request warning.
        warn_ai_estop_req: bool;
        /// AI CAN communications warning.
        warn_ai_comms_lost: bool;
        /// Braking in Autonomous Driving mode warning.
        warn_auto_braking: bool;
        /// Autonomous mission status warning.
        warn_mission_status: bool;
    }

    /// VCU status.
    Vcu2AiStatus 0x520 from Vcu {
        /// Handshake.
        ///
        /// The bit that the AI Computer answers (section 2.4).
        handshake: bool;
        /// What the vehicle is operated for.
        ///
        /// Since the database of 2026.
        op_state: OpState;
        /// Shutdown request to AI.
        shutdown_request: bool;
        /// Autonomous System switch status.
        ///
        /// The Autonomous System Master Switch (ASMS).
        as_switch_status: bool;
        /// Tractive System switch status.
        ///
        /// The Tractive System Master Switch (TSMS).
        ts_switch_status: bool;
        /// Autonomous System "Go" signal.
        ///
        /// Section 3.2 calls it `RES_GO_SIGNAL`.
        go_signal: bool;
        /// State of the steering system.
        ///
        /// Two bits, of which the document names only the values 0 and 1.
        steering_status: bool;
        /// State of the Autonomous System.
        as_state: AsState;
        /// State of the Mission Indicator.
        ami_state: AmiState;
        /// System fault status.
        fault_status: bool;
        /// System warning status.
        warning_status: bool;
        /// State of the tractive system.
        ///
        /// Since the database of 2026.
        ts_state: TsState;
        /// High traction battery temperature warning.
        warn_batt_temp_high: bool;
        /// Low traction battery SOC warning.
        warn_batt_soc_low: bool;
        /// Stage of the Emergency Braking System (EBS).
        ///
        /// Since the database of 2026.
        ebs_state: EbsStage;
        /// AI system E-stop request.
        ai_estop_request: bool;
        /// HVIL open-circuit fault.
        hvil_open_fault: bool;
        /// HVIL short-circuit fault.
        hvil_short_fault: bool;
        /// EBS fault.
        ebs_fault: bool;
        /// Offboard charger fault.
        offboard_charger_fault: bool;
        /// AI CAN communications fault.
        ///
        /// A handshake was not answered in time (section 2.4).
        ai_comms_lost: bool;
        /// Braking in Autonomous Driving mode fault.
        ///
        /// NEUTRAL was requested while the vehicle was moving (section 4).
        autonomous_braking_fault: bool;
        /// Autonomous mission status fault.
        ///
        /// The mission was FINISHED while the vehicle was moving (section 4).
        mission_status_fault: bool;
        /// Battery charging procedure fault.
        ///
        /// A master switch was on while the battery was being charged.
        charge_procedure_fault: bool;
        /// BMS fault.
        bms_fault: bool;
        /// Brake plausibility fault.
        ///
        /// Torque and hydraulic braking were requested at once (section 4 of version 4.0).
        brake_plausibility_fault: bool;
        /// Fault causing a system shutdown.
        shutdown_cause: ShutdownCause;
    }

    /// Front drive motor feedback.
    Vcu2AiDriveF 0x521 from Vcu {
        /// Current front axle torque.
        front_axle_trq: AxleTorque;
        /// Requested front axle torque.
        ///
        /// As received in `AI2VCU_Drive_F`.
        front_axle_trq_request: AxleTorqueRequest;
        /// Maximum front axle drive torque.
        front_axle_trq_max: AxleTorqueRequest;
    }

    /// Rear drive motor feedback.
    Vcu2AiDriveR 0x522 from Vcu {
        /// Current rear axle torque.
        rear_axle_trq: AxleTorque;
        /// Requested rear axle torque.
        ///
        /// As received in `AI2VCU_Drive_R`.
        rear_axle_trq_request: AxleTorqueRequest;
        /// Maximum rear axle drive torque.
        rear_axle_trq_max: AxleTorqueRequest;
    }

    /// Feedback from steering system.
    Vcu2AiSteer 0x523 from Vcu {
        /// Current steering angle.
        steer_angle: SteerAngle;
        /// Maximum allowable steering angle.
        ///
        /// The same limit to the left and to the right.
        steer_angle_max: SteerAngleMax;
        /// Requested steering angle.
        ///
        /// As received in `AI2VCU_Steer`.
        steer_angle_request: SteerAngle;
    }

    /// Braking system feedback.
    Vcu2AiBrake 0x524 from Vcu {
        /// Front axle brake pressure.
        hyd_press_f: BrakePressure;
        /// Requested front axle brake pressure.
        ///
        /// As received in `AI2VCU_Brake`.
        hyd_press_f_req: BrakePressure;
        /// Rear axle brake pressure.
        hyd_press_r: BrakePressure;
        /// Requested rear axle brake pressure.
        ///
        /// As received in `AI2VCU_Brake`.
        hyd_press_r_req: BrakePressure;
        /// Braking controller status.
        ///
        /// Since version 4.0.
        status_brk: StatusBrk;
        /// Emergency Braking System (EBS) status.
        ///
        /// Since version 4.0.
        status_ebs: EbsState;
    }

    /// Measured wheel speeds.
    Vcu2AiWheelSpeeds 0x525 from Vcu {
        /// Front left wheel speed.
        fl_wheel_speed: WheelSpeed;
        /// Front right wheel speed.
        fr_wheel_speed: WheelSpeed;
        /// Rear left wheel speed.
        rl_wheel_speed: WheelSpeed;
        /// Rear right wheel speed.
        rr_wheel_speed: WheelSpeed;
    }

    /// Measured wheel odometry counts.
    Vcu2AiWheelCounts 0x526 from Vcu {
        /// Front left wheel speed pulse count.
        fl_pulse_count: u16;
        /// Front right wheel speed pulse count.
        fr_pulse_count: u16;
        /// Rear left wheel speed pulse count.
        rl_pulse_count: u16;
        /// Rear right wheel speed pulse count.
        rr_pulse_count: u16;
    }
}
