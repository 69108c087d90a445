//! What the VCU of 2026 sends for the data logger alone, where the database differs from version 4.0.

use super::V2026;
use crate::messages::Vcu2LogDynamics1;
use crate::messages::layout::layouts;

layouts! { V2026:
    Vcu2LogDynamics1 = "VCU2LOG_Dynamics1", 8 bytes, every 100 ms, section "2.2" {
        speed_actual = "Speed_actual" 0|8;
        speed_target = "Speed_target" 8|8;
        steer_actual = "Steer_actual" 16|8;
        steer_target = "Steer_target" 24|8;
        brake_actual = "Brake_actual_pct" 32|8;
        brake_target = "Brake_target_pct" 40|8;
        drive_trq_actual = "Drive_trq_actual_pct" 48|8;
        drive_trq_target = "Drive_trq_target_pct" 56|8;
    }
}
