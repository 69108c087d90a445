//! What both sides send for the data logger alone (sections 2.1 and 2.2): nobody acts on it.

use super::content::contents;
use super::{
    Acceleration, AmiState, AsState, ConesCountAll, EbsState, LapCounter, LogBrake, LogDriveTorque,
    LogSteerAngle, ServiceBrake, SpeedKmh, YawRate,
};

contents! {
    /// Vehicle dynamics as the VCU knows them, for the data logger.
    Vcu2LogDynamics1 0x500 from Vcu {
        /// Actual vehicle speed.
        speed_actual: SpeedKmh;
        /// Target vehicle speed.
        speed_target: SpeedKmh;
        /// Actual steer angle (bicycle model).
        steer_actual: LogSteerAngle;
        /// Requested steer angle (bicycle model).
        steer_target: LogSteerAngle;
        /// Actual mechanical braking percentage.
        brake_actual: LogBrake;
        /// Requested mechanical braking percentage.
        brake_target: LogBrake;
        /// Sum of actual front and rear axle torque.
        drive_trq_actual: LogDriveTorque;
        /// Sum of requested front and rear axle torque.
        drive_trq_target: LogDriveTorque;
    }

    /// Vehicle dynamics as the AI Computer measures them, for the data logger.
    Ai2LogDynamics2 0x501 from Ai {
        /// Longitudinal vehicle acceleration.
        accel_longitudinal: Acceleration;
        /// Lateral vehicle acceleration.
        accel_lateral: Acceleration;
        /// Yaw rate.
        yaw_rate: YawRate;
    }

    /// Vehicle status, for the data logger.
    Vcu2LogStatus 0x502 from Vcu {
        /// Autonomous System Status Indicator (ASSI) state.
        state_assi: AsState;
        /// Emergency Braking System (EBS) state.
        state_ebs: EbsState;
        /// Autonomous Mission Indicator (AMI) state.
        state_ami: AmiState;
        /// Steering system status.
        state_steering: bool;
        /// Service brake (mechanical friction brakes) status.
        state_service_brake: ServiceBrake;
        /// Lap counter, from `AI2VCU_Status`.
        lap_counter: LapCounter;
        /// Number of cones detected, from `AI2VCU_Status`.
        cones_count_actual: u8;
        /// Total number of cones detected, from `AI2VCU_Status`.
        ///
        /// One bit more than where it comes from.
        cones_count_all: ConesCountAll;
    }
}
