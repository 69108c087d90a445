//! What the VCU tells the AI Computer (section 2.2).

use super::content::contents;
use super::{
    AmiState, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, EbsStage, EbsState, OpState,
    ShutdownCause, SmAs, SmSys, StatusBrk, SteerAngle, SteerAngleMax, SysActionState, TsState, WheelSpeed,
};

contents! {
    /// State of the vehicle, and what the VCU misses from the AI Computer.
    VcuStatus 0x120 from Vcu, cites ["MSG-88"] {
        /// State of the vehicle.
        sm_sys: SmSys, cites ["MSG-89"];
        /// State of the Autonomous System, as the vehicle keeps it.
        sm_as: SmAs, cites ["MSG-90"];
        /// Missed messages: `AI2VCU_Status`.
        status_timeout: bool, cites ["MSG-92"];
        /// Missed messages: `AI2VCU_Drive_F`.
        drive_f_timeout: bool, cites ["MSG-92"];
        /// Missed messages: `AI2VCU_Drive_R`.
        drive_r_timeout: bool, cites ["MSG-92"];
        /// Handshake unanswered.
        handshake_timeout: bool, cites ["MSG-93"];
        /// Missed messages: `AI2VCU_Steer`.
        steer_timeout: bool, cites ["MSG-92"];
        /// Missed messages: `AI2VCU_Brake`.
        brake_timeout: bool, cites ["MSG-92"];
        /// What the vehicle is doing.
        sys_action_state: SysActionState, cites ["MSG-91"];
        /// Brake plausibility warning.
        warn_brake_plausibility: bool, cites ["MSG-94"];
        /// Low 12 V supply warning.
        ///
        /// The document gives no threshold.
        warn_kl15_under_v: bool, cites ["MSG-94"];
        /// AI system E-stop request warning.
        warn_ai_estop_req: bool, cites ["MSG-94"];
        /// AI CAN communications warning.
        warn_ai_comms_lost: bool, cites ["MSG-94"];
        /// Braking in Autonomous Driving mode warning.
        warn_auto_braking: bool, cites ["MSG-94"];
        /// Autonomous mission status warning.
        warn_mission_status: bool, cites ["MSG-94"];
    }

    /// VCU status.
    Vcu2AiStatus 0x520 from Vcu, cites ["MSG-41"] {
        /// Handshake.
        ///
        /// The bit that the AI Computer answers (section 2.4).
        handshake: bool, cites ["MSG-42", "HS-3"];
        /// What the vehicle is operated for.
        ///
        /// Since the database of 2026.
        op_state: OpState, cites ["MSG-106"];
        /// Shutdown request to AI.
        shutdown_request: bool, cites ["MSG-43"];
        /// Autonomous System switch status.
        ///
        /// The Autonomous System Master Switch (ASMS).
        as_switch_status: bool, cites ["MSG-44"];
        /// Tractive System switch status.
        ///
        /// The Tractive System Master Switch (TSMS).
        ts_switch_status: bool, cites ["MSG-45"];
        /// Autonomous System "Go" signal.
        ///
        /// Section 3.2 calls it `RES_GO_SIGNAL`.
        go_signal: bool, cites ["MSG-46"];
        /// State of the steering system.
        ///
        /// Two bits, of which the document names only the values 0 and 1.
        steering_status: bool, cites ["MSG-47"];
        /// State of the Autonomous System.
        as_state: AsState, cites ["MSG-48", "MSG-109"];
        /// State of the Mission Indicator.
        ami_state: AmiState, cites ["MSG-49"];
        /// System fault status.
        fault_status: bool, cites ["MSG-50"];
        /// System warning status.
        warning_status: bool, cites ["MSG-51"];
        /// State of the tractive system.
        ///
        /// Since the database of 2026.
        ts_state: TsState, cites ["MSG-107"];
        /// High traction battery temperature warning.
        warn_batt_temp_high: bool, cites ["MSG-52"];
        /// Low traction battery SOC warning.
        warn_batt_soc_low: bool, cites ["MSG-53"];
        /// Stage of the Emergency Braking System (EBS).
        ///
        /// Since the database of 2026.
        ebs_state: EbsStage, cites ["MSG-108"];
        /// AI system E-stop request.
        ai_estop_request: bool, cites ["MSG-54"];
        /// HVIL open-circuit fault.
        hvil_open_fault: bool, cites ["MSG-55"];
        /// HVIL short-circuit fault.
        hvil_short_fault: bool, cites ["MSG-56"];
        /// EBS fault.
        ebs_fault: bool, cites ["MSG-57"];
        /// Offboard charger fault.
        offboard_charger_fault: bool, cites ["MSG-58"];
        /// AI CAN communications fault.
        ///
        /// A handshake was not answered in time (section 2.4).
        ai_comms_lost: bool, cites ["MSG-59"];
        /// Braking in Autonomous Driving mode fault.
        ///
        /// NEUTRAL was requested while the vehicle was moving (section 4).
        autonomous_braking_fault: bool, cites ["MSG-60"];
        /// Autonomous mission status fault.
        ///
        /// The mission was FINISHED while the vehicle was moving (section 4).
        mission_status_fault: bool, cites ["MSG-61"];
        /// Battery charging procedure fault.
        ///
        /// A master switch was on while the battery was being charged.
        charge_procedure_fault: bool, cites ["MSG-62"];
        /// BMS fault.
        bms_fault: bool, cites ["MSG-63"];
        /// Brake plausibility fault.
        ///
        /// Torque and hydraulic braking were requested at once (section 4 of version 4.0).
        brake_plausibility_fault: bool, cites ["MSG-84"];
        /// Fault causing a system shutdown.
        shutdown_cause: ShutdownCause, cites ["MSG-64", "MSG-85"];
    }

    /// Front drive motor feedback.
    Vcu2AiDriveF 0x521 from Vcu, cites ["MSG-65"] {
        /// Current front axle torque.
        front_axle_trq: AxleTorque, cites ["MSG-66"];
        /// Requested front axle torque.
        ///
        /// As received in `AI2VCU_Drive_F`.
        front_axle_trq_request: AxleTorqueRequest, cites ["MSG-67"];
        /// Maximum front axle drive torque.
        front_axle_trq_max: AxleTorqueRequest, cites ["MSG-68"];
    }

    /// Rear drive motor feedback.
    Vcu2AiDriveR 0x522 from Vcu, cites ["MSG-69"] {
        /// Current rear axle torque.
        rear_axle_trq: AxleTorque, cites ["MSG-70"];
        /// Requested rear axle torque.
        ///
        /// As received in `AI2VCU_Drive_R`.
        rear_axle_trq_request: AxleTorqueRequest, cites ["MSG-71"];
        /// Maximum rear axle drive torque.
        rear_axle_trq_max: AxleTorqueRequest, cites ["MSG-72"];
    }

    /// Feedback from steering system.
    Vcu2AiSteer 0x523 from Vcu, cites ["MSG-73"] {
        /// Current steering angle.
        steer_angle: SteerAngle, cites ["MSG-74", "MSG-100", "MSG-110"];
        /// Maximum allowable steering angle.
        ///
        /// The same limit to the left and to the right.
        steer_angle_max: SteerAngleMax, cites ["MSG-75"];
        /// Requested steering angle.
        ///
        /// As received in `AI2VCU_Steer`.
        steer_angle_request: SteerAngle, cites ["MSG-76"];
    }

    /// Braking system feedback.
    Vcu2AiBrake 0x524 from Vcu, cites ["MSG-77"] {
        /// Front axle brake pressure.
        hyd_press_f: BrakePressure, cites ["MSG-78"];
        /// Requested front axle brake pressure.
        ///
        /// As received in `AI2VCU_Brake`.
        hyd_press_f_req: BrakePressure, cites ["MSG-79"];
        /// Rear axle brake pressure.
        hyd_press_r: BrakePressure, cites ["MSG-78"];
        /// Requested rear axle brake pressure.
        ///
        /// As received in `AI2VCU_Brake`.
        hyd_press_r_req: BrakePressure, cites ["MSG-79"];
        /// Braking controller status.
        ///
        /// Since version 4.0.
        status_brk: StatusBrk, cites ["MSG-86"];
        /// Emergency Braking System (EBS) status.
        ///
        /// Since version 4.0.
        status_ebs: EbsState, cites ["MSG-87"];
    }

    /// Measured wheel speeds.
    Vcu2AiWheelSpeeds 0x525 from Vcu, cites ["MSG-80", "MSG-101"] {
        /// Front left wheel speed.
        fl_wheel_speed: WheelSpeed, cites ["MSG-81"];
        /// Front right wheel speed.
        fr_wheel_speed: WheelSpeed, cites ["MSG-81"];
        /// Rear left wheel speed.
        rl_wheel_speed: WheelSpeed, cites ["MSG-81"];
        /// Rear right wheel speed.
        rr_wheel_speed: WheelSpeed, cites ["MSG-81"];
    }

    /// Measured wheel odometry counts.
    Vcu2AiWheelCounts 0x526 from Vcu, cites ["MSG-82"] {
        /// Front left wheel speed pulse count.
        fl_pulse_count: u16, cites ["MSG-83"];
        /// Front right wheel speed pulse count.
        fr_pulse_count: u16, cites ["MSG-83"];
        /// Rear left wheel speed pulse count.
        rl_pulse_count: u16, cites ["MSG-83"];
        /// Rear right wheel speed pulse count.
        rr_pulse_count: u16, cites ["MSG-83"];
    }
}
