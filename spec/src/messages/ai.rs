//! What the AI Computer tells the VCU (section 2.1).

use super::content::contents;
use super::{
    AxleTorqueRequest, BrakePressure, DirectionRequest, LapCounter, MissionStatus, MotorSpeedMax, SpeedKmh,
    SteerAngle,
};

contents! {
    /// AI Computer status.
    Ai2VcuStatus 0x510 from Ai {
        /// Handshake.
        ///
        /// The answer to the VCU's bit (section 2.4).
        handshake: bool;
        /// Shutdown request to VCU.
        ///
        /// The AI Computer asks for an emergency stop.
        estop_request: bool;
        /// Autonomous mission status.
        mission_status: MissionStatus;
        /// Requested vehicle direction.
        direction_request: DirectionRequest;
        /// Lap counter.
        ///
        /// Of the Track drive mission; for the data logger.
        lap_counter: LapCounter;
        /// Number of cones detected.
        ///
        /// Now, for the data logger.
        cones_count_actual: u8;
        /// Total number of cones detected.
        ///
        /// A running counter, for the data logger.
        cones_count_all: u16;
        /// Actual vehicle speed.
        ///
        /// For the data logger.
        veh_speed_actual: SpeedKmh;
        /// Demanded vehicle speed.
        ///
        /// For the data logger.
        veh_speed_demand: SpeedKmh;
    }

    /// Front drive motor commands.
    Ai2VcuDriveF 0x511 from Ai {
        /// Requested front axle torque.
        ///
        /// Its size only: whether it drives or brakes depends on the motor speed limit.
        front_axle_trq_request: AxleTorqueRequest;
        /// Front motor speed limit.
        front_motor_speed_max: MotorSpeedMax;
    }

    /// Rear drive motor commands.
    Ai2VcuDriveR 0x512 from Ai {
        /// Requested rear axle torque.
        ///
        /// Its size only: whether it drives or brakes depends on the motor speed limit.
        rear_axle_trq_request: AxleTorqueRequest;
        /// Rear motor speed limit.
        rear_motor_speed_max: MotorSpeedMax;
    }

    /// Steering commands.
    Ai2VcuSteer 0x513 from Ai {
        /// Requested steer angle.
        steer_request: SteerAngle;
    }

    /// Friction braking commands.
    Ai2VcuBrake 0x514 from Ai {
        /// Requested front axle hydraulic brake pressure.
        hyd_press_f_req: BrakePressure;
        /// Requested rear axle hydraulic brake pressure.
        hyd_press_r_req: BrakePressure;
    }
}
