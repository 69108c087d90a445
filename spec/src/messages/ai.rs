//! What the AI Computer tells the VCU (section 2.1).

use super::content::contents;
use super::{
    AxleTorqueRequest, BrakePressure, DirectionRequest, LapCounter, MissionStatus, MotorSpeedMax, SpeedKmh,
    SteerAngle,
};

contents! {
    /// AI Computer status.
    Ai2VcuStatus 0x510 from Ai, cites ["MSG-5"] {
        /// Handshake.
        ///
        /// The answer to the VCU's bit (section 2.4).
        handshake: bool, cites ["MSG-6", "HS-2"];
        /// Shutdown request to VCU.
        ///
        /// The AI Computer asks for an emergency stop.
        estop_request: bool, cites ["MSG-7"];
        /// Autonomous mission status.
        mission_status: MissionStatus, cites ["MSG-8"];
        /// Requested vehicle direction.
        direction_request: DirectionRequest, cites ["MSG-10", "D-32"];
        /// Lap counter.
        ///
        /// Of the Track drive mission; for the data logger.
        lap_counter: LapCounter, cites ["MSG-11"];
        /// Number of cones detected.
        ///
        /// Now, for the data logger.
        cones_count_actual: u8, cites ["MSG-12"];
        /// Total number of cones detected.
        ///
        /// A running counter, for the data logger.
        cones_count_all: u16, cites ["MSG-13"];
        /// Actual vehicle speed.
        ///
        /// For the data logger.
        veh_speed_actual: SpeedKmh, cites ["MSG-14"];
        /// Demanded vehicle speed.
        ///
        /// For the data logger.
        veh_speed_demand: SpeedKmh, cites ["MSG-15"];
    }

    /// Front drive motor commands.
    Ai2VcuDriveF 0x511 from Ai, cites ["MSG-16"] {
        /// Requested front axle torque.
        ///
        /// Its size only: whether it drives or brakes depends on the motor speed limit.
        front_axle_trq_request: AxleTorqueRequest, cites ["MSG-17"];
        /// Front motor speed limit.
        front_motor_speed_max: MotorSpeedMax, cites ["MSG-19"];
    }

    /// Rear drive motor commands.
    Ai2VcuDriveR 0x512 from Ai, cites ["MSG-20"] {
        /// Requested rear axle torque.
        ///
        /// Its size only: whether it drives or brakes depends on the motor speed limit.
        rear_axle_trq_request: AxleTorqueRequest, cites ["MSG-21"];
        /// Rear motor speed limit.
        rear_motor_speed_max: MotorSpeedMax, cites ["MSG-22"];
    }

    /// Steering commands.
    Ai2VcuSteer 0x513 from Ai, cites ["MSG-23"] {
        /// Requested steer angle.
        //= MSG-25
        steer_request: SteerAngle, cites ["MSG-24", "MSG-99", "MSG-105"];
    }

    /// Friction braking commands.
    Ai2VcuBrake 0x514 from Ai, cites ["MSG-26"] {
        /// Requested front axle hydraulic brake pressure.
        hyd_press_f_req: BrakePressure, cites ["MSG-27"];
        /// Requested rear axle hydraulic brake pressure.
        hyd_press_r_req: BrakePressure, cites ["MSG-28"];
    }
}
