//! What both sides send for the data logger alone in version 3.0 (sections 2.1 and 2.2), as its database lays it out.

use super::V3_0;
use crate::messages::layout::layouts;
use crate::messages::{Ai2LogDynamics2, Vcu2LogDynamics1, Vcu2LogStatus};

layouts! { V3_0:
    Vcu2LogDynamics1 = "VCU2LOG_Dynamics1", 8 bytes, every 10 ms, section "2.2" {
        speed_actual = "Speed_actual_kmh" 0|8;
        speed_target = "Speed_target_kmh" 8|8;
        steer_actual = "Steer_actual_deg" 16|8;
        steer_target = "Steer_target_deg" 24|8;
        brake_actual = "Brake_actual_pct" 32|8;
        brake_target = "Brake_target_pct" 40|8;
        // These two signed, as the text says; the database says unsigned. No value from 0 to 100 % differs.
        drive_trq_actual = "Drive_trq_actual_pct" 48|8;
        drive_trq_target = "Drive_trq_target_pct" 56|8;
    }

    Ai2LogDynamics2 = "AI2LOG_Dynamics2", 6 bytes, every 10 ms, section "2.1" {
        // The text spells these two `Accel_longitudinal_ms2` and `Accel_lateral_ms2`.
        accel_longitudinal = "Accel_longitudinal_mps2" 0|16;
        accel_lateral = "Accel_lateral_mps2" 16|16;
        yaw_rate = "Yaw_rate_degps" 32|16;
    }

    Vcu2LogStatus = "VCU2LOG_Status", 5 bytes, every 100 ms, section "2.2" {
        // The value names are the text's; the database leaves out `AS_`, and ends in `FINISH`.
        state_assi = "State_ASSI" 0|3;
        state_ebs = "State_EBS" 3|2;
        // The text calls it `AMI_STATE` here too. The value names are the text's; the database's list is that of an earlier
        // version.
        state_ami = "State_AMI" 5|3;
        state_steering = "State_steering" 8|1 ["OFF", "ON"];
        state_service_brake = "State_service_brake" 9|2;
        lap_counter = "Lap_counter" 11|4;
        cones_count_actual = "Cones_count_actual" 15|8;
        cones_count_all = "Cones_count_all" 23|17;
    }
}
