//! What the VCU tells the AI Computer (section 2.2).

use super::message::messages;
use super::{
    AmiState, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, ShutdownCause, SteerAngle,
    SteerAngleMax, WheelSpeed,
};

messages! {
    /// VCU status.
    Vcu2AiStatus = "VCU2AI_Status" 0x520, Vcu, 8 bytes, section "2.2" { //= MSG-41 to MSG-64, HS-3
        /// Handshake.
        ///
        /// The bit that the AI Computer answers (section 2.4).
        handshake: bool = "HANDSHAKE" 0|1;
        /// Shutdown request to AI.
        shutdown_request: bool = "SHUTDOWN_REQUEST" 8|1 ["NO SHUTDOWN", "SHUTDOWN REQUESTED"];
        /// Autonomous System switch status.
        ///
        /// The Autonomous System Master Switch (ASMS).
        as_switch_status: bool = "AS_SWITCH_STATUS" 9|1 ["OFF", "ON"];
        /// Tractive System switch status.
        ///
        /// The Tractive System Master Switch (TSMS).
        ts_switch_status: bool = "TS_SWITCH_STATUS" 10|1 ["OFF", "ON"];
        /// Autonomous System "Go" signal.
        ///
        /// Section 3.2 calls it `RES_GO_SIGNAL`. The database's range has no 1, its value names do.
        go_signal: bool = "GO_SIGNAL" 11|1 ["NO GO", "GO"];
        /// State of the steering system.
        ///
        /// Two bits, of which the document names only the values 0 and 1.
        steering_status: bool = "STEERING_STATUS" 12|2 ["OFF", "ACTIVE"];
        /// State of the Autonomous System.
        as_state: AsState = "AS_STATE" 16|4;
        /// State of the Mission Indicator.
        ami_state: AmiState = "AMI_STATE" 20|4;
        /// System fault status.
        fault_status: bool = "FAULT_STATUS" 24|1 ["NO FAULT", "FAULT DETECTED"];
        /// System warning status.
        warning_status: bool = "WARNING_STATUS" 25|1 ["NO WARNING", "WARNING ACTIVE"];
        /// High traction battery temperature warning.
        warn_batt_temp_high: bool = "WARN_BATT_TEMP_HIGH" 32|1 ["FALSE", "TRUE"];
        /// Low traction battery SOC warning.
        warn_batt_soc_low: bool = "WARN_BATT_SOC_LOW" 33|1 ["FALSE", "TRUE"];
        /// AI system E-stop request.
        ai_estop_request: bool = "AI_ESTOP_REQUEST" 40|1 ["FALSE", "TRUE"];
        /// HVIL open-circuit fault.
        hvil_open_fault: bool = "HVIL_OPEN_FAULT" 41|1 ["FALSE", "TRUE"];
        /// HVIL short-circuit fault.
        hvil_short_fault: bool = "HVIL_SHORT_FAULT" 42|1 ["FALSE", "TRUE"];
        /// EBS fault.
        ebs_fault: bool = "EBS_FAULT" 43|1 ["FALSE", "TRUE"];
        /// Offboard charger fault.
        offboard_charger_fault: bool = "OFFBOARD_CHARGER_FAULT" 44|1 ["FALSE", "TRUE"];
        /// AI CAN communications fault.
        ///
        /// A handshake was not answered in time (section 2.4).
        ai_comms_lost: bool = "AI_COMMS_LOST" 45|1 ["FALSE", "TRUE"];
        /// Braking in Autonomous Driving mode fault.
        ///
        /// NEUTRAL was requested while the vehicle was moving (section 4).
        autonomous_braking_fault: bool = "AUTONOMOUS_BRAKING_FAULT" 46|1 ["FALSE", "TRUE"];
        /// Autonomous mission status fault.
        ///
        /// The mission was FINISHED while the vehicle was moving (section 4).
        mission_status_fault: bool = "MISSION_STATUS_FAULT" 47|1 ["FALSE", "TRUE"];
        /// Battery charging procedure fault.
        ///
        /// A master switch was on while the battery was being charged.
        charge_procedure_fault: bool = "CHARGE_PROCEDURE_FAULT" 48|1 ["FALSE", "TRUE"];
        /// BMS fault.
        bms_fault: bool = "BMS_FAULT" 49|1 ["FALSE", "TRUE"];
        /// Fault causing a system shutdown.
        shutdown_cause: ShutdownCause = "SHUTDOWN_CAUSE" 56|8;
    }

    /// Front drive motor feedback.
    Vcu2AiDriveF = "VCU2AI_Drive_F" 0x521, Vcu, 8 bytes, section "2.2" { //= MSG-65 to MSG-68
        /// Current front axle torque.
        front_axle_trq: AxleTorque = "FRONT_AXLE_TRQ_Nm" 0|16;
        /// Requested front axle torque.
        ///
        /// As received in `AI2VCU_Drive_F`.
        front_axle_trq_request: AxleTorqueRequest = "FRONT_AXLE_TRQ_REQUEST_Nm" 16|16;
        /// Maximum front axle drive torque.
        front_axle_trq_max: AxleTorqueRequest = "FRONT_AXLE_TRQ_MAX_Nm" 32|16;
    }

    /// Rear drive motor feedback.
    Vcu2AiDriveR = "VCU2AI_Drive_R" 0x522, Vcu, 8 bytes, section "2.2" { //= MSG-69 to MSG-72
        /// Current rear axle torque.
        rear_axle_trq: AxleTorque = "REAR_AXLE_TRQ_Nm" 0|16;
        /// Requested rear axle torque.
        ///
        /// As received in `AI2VCU_Drive_R`. Unsigned, as the text says; the database says signed. No
        /// value in range differs.
        rear_axle_trq_request: AxleTorqueRequest = "REAR_AXLE_TRQ_REQUEST_Nm" 16|16;
        /// Maximum rear axle drive torque.
        rear_axle_trq_max: AxleTorqueRequest = "REAR_AXLE_TRQ_MAX_Nm" 32|16;
    }

    /// Feedback from steering system.
    Vcu2AiSteer = "VCU2AI_Steer" 0x523, Vcu, 8 bytes, section "2.2" { //= MSG-73 to MSG-76
        /// Current steering angle.
        steer_angle: SteerAngle = "STEER_ANGLE_deg" 0|16;
        /// Maximum allowable steering angle.
        ///
        /// The same limit to the left and to the right.
        steer_angle_max: SteerAngleMax = "STEER_ANGLE_MAX_deg" 16|16;
        /// Requested steering angle.
        ///
        /// As received in `AI2VCU_Steer`.
        steer_angle_request: SteerAngle = "STEER_ANGLE_REQUEST_deg" 32|16;
    }

    /// Braking system feedback.
    Vcu2AiBrake = "VCU2AI_Brake" 0x524, Vcu, 8 bytes, section "2.2" { //= MSG-77 to MSG-79
        /// Front axle brake pressure.
        hyd_press_f: BrakePressure = "HYD_PRESS_F_pct" 0|8;
        /// Requested front axle brake pressure.
        ///
        /// As received in `AI2VCU_Brake`.
        hyd_press_f_req: BrakePressure = "HYD_PRESS_F_REQ_pct" 8|8;
        /// Rear axle brake pressure.
        hyd_press_r: BrakePressure = "HYD_PRESS_R_pct" 16|8;
        /// Requested rear axle brake pressure.
        ///
        /// As received in `AI2VCU_Brake`.
        hyd_press_r_req: BrakePressure = "HYD_PRESS_R_REQ_pct" 24|8;
    }

    /// Measured wheel speeds.
    Vcu2AiWheelSpeeds = "VCU2AI_Wheel_speeds" 0x525, Vcu, 8 bytes, section "2.2" { //= MSG-80, MSG-81
        /// Front left wheel speed.
        fl_wheel_speed: WheelSpeed = "FL_WHEEL_SPEED_rpm" 0|16;
        /// Front right wheel speed.
        fr_wheel_speed: WheelSpeed = "FR_WHEEL_SPEED_rpm" 16|16;
        /// Rear left wheel speed.
        rl_wheel_speed: WheelSpeed = "RL_WHEEL_SPEED_rpm" 32|16;
        /// Rear right wheel speed.
        rr_wheel_speed: WheelSpeed = "RR_WHEEL_SPEED_rpm" 48|16;
    }

    /// Measured wheel odometry counts.
    Vcu2AiWheelCounts = "VCU2AI_Wheel_counts" 0x526, Vcu, 8 bytes, section "2.2" { //= MSG-82, MSG-83
        /// Front left wheel speed pulse count.
        fl_pulse_count: u16 = "FL_PULSE_COUNT" 0|16;
        /// Front right wheel speed pulse count.
        fr_pulse_count: u16 = "FR_PULSE_COUNT" 16|16;
        /// Rear left wheel speed pulse count.
        rl_pulse_count: u16 = "RL_PULSE_COUNT" 32|16;
        /// Rear right wheel speed pulse count.
        rr_pulse_count: u16 = "RR_PULSE_COUNT" 48|16;
    }
}
