//! What the VCU sends for the data logger alone in version 4.0 (section 2.2), as its database lays it out.
//!
//! What the AI Computer sends for it, `AI2LOG_Dynamics2`, is as in version 3.0. The database names another sender of that
//! message, the unit that measures it; the text says the AI Computer.

use super::V4_0;
use super::values::MISSIONS;
use crate::messages::layout::layouts;
use crate::messages::{Vcu2LogDynamics1, Vcu2LogStatus};

layouts! { V4_0:
    Vcu2LogDynamics1 = "VCU2LOG_Dynamics1", 8 bytes, every 10 ms, section "2.2" {
        // The text ends the names of these four in `_kmh` and `_deg`.
        speed_actual = "Speed_actual" 0|8;
        speed_target = "Speed_target" 8|8;
        steer_actual = "Steer_actual" 16|8;
        steer_target = "Steer_target" 24|8;
        brake_actual = "Brake_actual_pct" 32|8;
        brake_target = "Brake_target_pct" 40|8;
        // These two signed, as the text says; the database says unsigned. No value from 0 to 100 % differs.
        drive_trq_actual = "Drive_trq_actual_pct" 48|8;
        drive_trq_target = "Drive_trq_target_pct" 56|8;
    }

    Vcu2LogStatus = "VCU2LOG_Status", 5 bytes, every 100 ms, section "2.2" {
        // The value names are the text's; the database leaves out `AS_`, and ends in `FINISH`.
        state_assi = "State_ASSI" 0|3;
        state_ebs = "State_EBS" 3|2;
        state_ami = "AMI_STATE" 5|3 of MISSIONS;
        state_steering = "State_steering" 8|1 ["OFF", "ON"];
        state_service_brake = "State_service_brake" 9|2;
        lap_counter = "Lap_counter" 11|4;
        cones_count_actual = "Cones_count_actual" 15|8;
        cones_count_all = "Cones_count_all" 23|17;
    }
}
