//! What both sides send for the data logger alone (sections 2.1 and 2.2): nobody acts on it.

use super::content::contents;
use super::{
    Acceleration, AmiState, AsState, ConesCountAll, EbsState, LapCounter, LogBrake, LogDriveTorque,
    LogSteerAngle, ServiceBrake, SpeedKmh, YawRate,
};

contents! {
    /// Vehicle dynamics as the VCU knows them, for the data logger.
    Vcu2LogDynamics1 0x500 from Vcu, cites ["MSG-29"] {
        /// Actual vehicle speed.
        speed_actual: SpeedKmh, cites ["MSG-30"];
        /// Target vehicle speed.
        speed_target: SpeedKmh, cites ["MSG-30"];
        /// Actual steer angle (bicycle model).
        steer_actual: LogSteerAngle, cites ["MSG-31"];
        /// Requested steer angle (bicycle model).
        steer_target: LogSteerAngle, cites ["MSG-31"];
        /// Actual mechanical braking percentage.
        brake_actual: LogBrake, cites ["MSG-32"];
        /// Requested mechanical braking percentage.
        brake_target: LogBrake, cites ["MSG-32"];
        /// Sum of actual front and rear axle torque.
        drive_trq_actual: LogDriveTorque, cites ["MSG-33"];
        /// Sum of requested front and rear axle torque.
        drive_trq_target: LogDriveTorque, cites ["MSG-33"];
    }

    /// Vehicle dynamics as the AI Computer measures them, for the data logger.
    Ai2LogDynamics2 0x501 from Ai, cites ["MSG-1"] {
        /// Longitudinal vehicle acceleration.
        accel_longitudinal: Acceleration, cites ["MSG-2"];
        /// Lateral vehicle acceleration.
        accel_lateral: Acceleration, cites ["MSG-3"];
        /// Yaw rate.
        yaw_rate: YawRate, cites ["MSG-4"];
    }

    /// Vehicle status, for the data logger.
    Vcu2LogStatus 0x502 from Vcu, cites ["MSG-34"] {
        /// Autonomous System Status Indicator (ASSI) state.
        state_assi: AsState, cites ["MSG-35"];
        /// Emergency Braking System (EBS) state.
        state_ebs: EbsState, cites ["MSG-36"];
        /// Autonomous Mission Indicator (AMI) state.
        state_ami: AmiState, cites ["MSG-37"];
        /// Steering system status.
        state_steering: bool, cites ["MSG-38"];
        /// Service brake (mechanical friction brakes) status.
        state_service_brake: ServiceBrake, cites ["MSG-39"];
        /// Lap counter, from `AI2VCU_Status`.
        lap_counter: LapCounter, cites ["MSG-40"];
        /// Number of cones detected, from `AI2VCU_Status`.
        cones_count_actual: u8, cites ["MSG-40"];
        /// Total number of cones detected, from `AI2VCU_Status`.
        ///
        /// One bit more than where it comes from.
        cones_count_all: ConesCountAll, cites ["MSG-40"];
    }
}
