//! What both sides send for the data logger alone (sections 2.1 and 2.2): nobody acts on it.

use super::message::messages;
use super::{
    Acceleration, AmiState, AsState, ConesCountAll, EbsState, LapCounter, LogBrake, LogDriveTorque,
    LogSteerAngle, ServiceBrake, SpeedKmh, YawRate,
};

messages! {
    /// Vehicle dynamics as the VCU knows them, for the data logger.
    Vcu2LogDynamics1 = "VCU2LOG_Dynamics1" 0x500, Vcu, 8 bytes, section "2.2" { //= MSG-29 to MSG-33
        /// Actual vehicle speed.
        speed_actual: SpeedKmh = "Speed_actual_kmh" 0|8;
        /// Target vehicle speed.
        speed_target: SpeedKmh = "Speed_target_kmh" 8|8;
        /// Actual steer angle (bicycle model).
        steer_actual: LogSteerAngle = "Steer_actual_deg" 16|8;
        /// Requested steer angle (bicycle model).
        steer_target: LogSteerAngle = "Steer_target_deg" 24|8;
        /// Actual mechanical braking percentage.
        brake_actual: LogBrake = "Brake_actual_pct" 32|8;
        /// Requested mechanical braking percentage.
        brake_target: LogBrake = "Brake_target_pct" 40|8;
        /// Sum of actual front and rear axle torque.
        ///
        /// Signed, as the text says; the database says unsigned. No value from 0 to 100 % differs.
        drive_trq_actual: LogDriveTorque = "Drive_trq_actual_pct" 48|8;
        /// Sum of requested front and rear axle torque.
        ///
        /// Signed, as the text says; the database says unsigned. No value from 0 to 100 % differs.
        drive_trq_target: LogDriveTorque = "Drive_trq_target_pct" 56|8;
    }

    /// Vehicle dynamics as the AI Computer measures them, for the data logger.
    Ai2LogDynamics2 = "AI2LOG_Dynamics2" 0x501, Ai, 6 bytes, section "2.1" { //= MSG-1 to MSG-4
        /// Longitudinal vehicle acceleration.
        ///
        /// The text spells it `Accel_longitudinal_ms2`.
        accel_longitudinal: Acceleration = "Accel_longitudinal_mps2" 0|16;
        /// Lateral vehicle acceleration.
        ///
        /// The text spells it `Accel_lateral_ms2`.
        accel_lateral: Acceleration = "Accel_lateral_mps2" 16|16;
        /// Yaw rate.
        yaw_rate: YawRate = "Yaw_rate_degps" 32|16;
    }

    /// Vehicle status, for the data logger.
    Vcu2LogStatus = "VCU2LOG_Status" 0x502, Vcu, 5 bytes, section "2.2" { //= MSG-34 to MSG-40
        /// Autonomous System Status Indicator (ASSI) state.
        ///
        /// The value names are the text's; the database leaves out `AS_`, and ends in `FINISH`.
        state_assi: AsState = "State_ASSI" 0|3;
        /// Emergency Braking System (EBS) state.
        state_ebs: EbsState = "State_EBS" 3|2;
        /// Autonomous Mission Indicator (AMI) state.
        ///
        /// The text calls it `AMI_STATE` here too. The value names are the text's; the database's list
        /// is that of an earlier version.
        state_ami: AmiState = "State_AMI" 5|3;
        /// Steering system status.
        state_steering: bool = "State_steering" 8|1 ["OFF", "ON"];
        /// Service brake (mechanical friction brakes) status.
        state_service_brake: ServiceBrake = "State_service_brake" 9|2;
        /// Lap counter, from `AI2VCU_Status`.
        lap_counter: LapCounter = "Lap_counter" 11|4;
        /// Number of cones detected, from `AI2VCU_Status`.
        cones_count_actual: u8 = "Cones_count_actual" 15|8;
        /// Total number of cones detected, from `AI2VCU_Status`.
        ///
        /// One bit more than where it comes from.
        cones_count_all: ConesCountAll = "Cones_count_all" 23|17;
    }
}
