//! What the AI Computer tells the VCU in version 3.0 (section 2.1), as its database lays it out.

use super::V3_0;
use crate::messages::layout::layouts;
use crate::messages::{Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer};

layouts! { V3_0:
    Ai2VcuStatus = "AI2VCU_Status", 8 bytes, every 10 ms, section "2.1" {
        handshake = "HANDSHAKE" 0|1;
        estop_request = "ESTOP_REQUEST" 8|1 ["NO SHUTDOWN", "SHUTDOWN REQUESTED"];
        mission_status = "MISSION_STATUS" 12|2;
        direction_request = "DIRECTION_REQUEST" 14|2;
        lap_counter = "LAP_COUNTER" 16|4;
        cones_count_actual = "CONES_COUNT_ACTUAL" 24|8;
        cones_count_all = "CONES_COUNT_ALL" 32|16;
        veh_speed_actual = "VEH_SPEED_ACTUAL_kmh" 48|8;
        veh_speed_demand = "VEH_SPEED_DEMAND_kmh" 56|8;
    }

    Ai2VcuDriveF = "AI2VCU_Drive_F", 8 bytes, every 10 ms, section "2.1" {
        front_axle_trq_request = "FRONT_AXLE_TRQ_REQUEST_Nm" 0|16;
        front_motor_speed_max = "FRONT_MOTOR_SPEED_MAX_rpm" 16|16;
    }

    Ai2VcuDriveR = "AI2VCU_Drive_R", 8 bytes, every 10 ms, section "2.1" {
        rear_axle_trq_request = "REAR_AXLE_TRQ_REQUEST_Nm" 0|16;
        rear_motor_speed_max = "REAR_MOTOR_SPEED_MAX_rpm" 16|16;
    }

    Ai2VcuSteer = "AI2VCU_Steer", 8 bytes, every 10 ms, section "2.1" {
        steer_request = "STEER_REQUEST_deg" 0|16 in -240 to 240;
    }

    Ai2VcuBrake = "AI2VCU_Brake", 8 bytes, every 10 ms, section "2.1" {
        hyd_press_f_req = "HYD_PRESS_F_REQ_pct" 0|8;
        hyd_press_r_req = "HYD_PRESS_R_REQ_pct" 8|8;
    }
}
