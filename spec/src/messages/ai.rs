//! What the AI Computer tells the VCU (section 2.1).

use super::message::messages;
use super::{
    AxleTorqueRequest, BrakePressure, DirectionRequest, LapCounter, MissionStatus, MotorSpeedMax, SpeedKmh,
    SteerAngle,
};

messages! {
    /// AI Computer status.
    Ai2VcuStatus = "AI2VCU_Status" 0x510, Ai, 8 bytes, section "2.1" {
        //= MSG-5 to MSG-8, MSG-10 to MSG-15, HS-2
        /// Handshake.
        ///
        /// The answer to the VCU's bit (section 2.4).
        handshake: bool = "HANDSHAKE" 0|1;
        /// Shutdown request to VCU.
        ///
        /// The AI Computer asks for an emergency stop.
        estop_request: bool = "ESTOP_REQUEST" 8|1 ["NO SHUTDOWN", "SHUTDOWN REQUESTED"];
        /// Autonomous mission status.
        mission_status: MissionStatus = "MISSION_STATUS" 12|2;
        /// Requested vehicle direction.
        direction_request: DirectionRequest = "DIRECTION_REQUEST" 14|2;
        /// Lap counter.
        ///
        /// Of the Track drive mission; for the data logger.
        lap_counter: LapCounter = "LAP_COUNTER" 16|4;
        /// Number of cones detected.
        ///
        /// Now, for the data logger.
        cones_count_actual: u8 = "CONES_COUNT_ACTUAL" 24|8;
        /// Total number of cones detected.
        ///
        /// A running counter, for the data logger.
        cones_count_all: u16 = "CONES_COUNT_ALL" 32|16;
        /// Actual vehicle speed.
        ///
        /// For the data logger.
        veh_speed_actual: SpeedKmh = "VEH_SPEED_ACTUAL_kmh" 48|8;
        /// Demanded vehicle speed.
        ///
        /// For the data logger.
        veh_speed_demand: SpeedKmh = "VEH_SPEED_DEMAND_kmh" 56|8;
    }

    /// Front drive motor commands.
    Ai2VcuDriveF = "AI2VCU_Drive_F" 0x511, Ai, 8 bytes, section "2.1" { //= MSG-16, MSG-17, MSG-19
        /// Requested front axle torque.
        ///
        /// Its size only: whether it drives or brakes depends on the motor speed limit.
        front_axle_trq_request: AxleTorqueRequest = "FRONT_AXLE_TRQ_REQUEST_Nm" 0|16;
        /// Front motor speed limit.
        front_motor_speed_max: MotorSpeedMax = "FRONT_MOTOR_SPEED_MAX_rpm" 16|16;
    }

    /// Rear drive motor commands.
    Ai2VcuDriveR = "AI2VCU_Drive_R" 0x512, Ai, 8 bytes, section "2.1" { //= MSG-20 to MSG-22
        /// Requested rear axle torque.
        ///
        /// Its size only: whether it drives or brakes depends on the motor speed limit.
        rear_axle_trq_request: AxleTorqueRequest = "REAR_AXLE_TRQ_REQUEST_Nm" 0|16;
        /// Rear motor speed limit.
        rear_motor_speed_max: MotorSpeedMax = "REAR_MOTOR_SPEED_MAX_rpm" 16|16;
    }

    /// Steering commands.
    Ai2VcuSteer = "AI2VCU_Steer" 0x513, Ai, 8 bytes, section "2.1" { //= MSG-23, MSG-24
        /// Requested steer angle.
        steer_request: SteerAngle = "STEER_REQUEST_deg" 0|16;
    }

    /// Friction braking commands.
    Ai2VcuBrake = "AI2VCU_Brake" 0x514, Ai, 8 bytes, section "2.1" { //= MSG-26 to MSG-28
        /// Requested front axle hydraulic brake pressure.
        hyd_press_f_req: BrakePressure = "HYD_PRESS_F_REQ_pct" 0|8;
        /// Requested rear axle hydraulic brake pressure.
        hyd_press_r_req: BrakePressure = "HYD_PRESS_R_REQ_pct" 8|8;
    }
}
