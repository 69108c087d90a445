//! What the VCU tells the AI Computer in version 3.0 (section 2.2), as its database lays it out.

use super::V3_0;
use crate::messages::layout::layouts;
use crate::messages::{
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
};

layouts! { V3_0:
    Vcu2AiStatus = "VCU2AI_Status", 8 bytes, every 10 ms, section "2.2" {
        handshake = "HANDSHAKE" 0|1;
        shutdown_request = "SHUTDOWN_REQUEST" 8|1 ["NO SHUTDOWN", "SHUTDOWN REQUESTED"];
        as_switch_status = "AS_SWITCH_STATUS" 9|1 ["OFF", "ON"];
        ts_switch_status = "TS_SWITCH_STATUS" 10|1 ["OFF", "ON"];
        // The database's range has no 1, its value names do.
        go_signal = "GO_SIGNAL" 11|1 ["NO GO", "GO"];
        steering_status = "STEERING_STATUS" 12|2 ["OFF", "ACTIVE"];
        as_state = "AS_STATE" 16|4;
        ami_state = "AMI_STATE" 20|4;
        fault_status = "FAULT_STATUS" 24|1 ["NO FAULT", "FAULT DETECTED"];
        warning_status = "WARNING_STATUS" 25|1 ["NO WARNING", "WARNING ACTIVE"];
        warn_batt_temp_high = "WARN_BATT_TEMP_HIGH" 32|1 ["FALSE", "TRUE"];
        warn_batt_soc_low = "WARN_BATT_SOC_LOW" 33|1 ["FALSE", "TRUE"];
        ai_estop_request = "AI_ESTOP_REQUEST" 40|1 ["FALSE", "TRUE"];
        hvil_open_fault = "HVIL_OPEN_FAULT" 41|1 ["FALSE", "TRUE"];
        hvil_short_fault = "HVIL_SHORT_FAULT" 42|1 ["FALSE", "TRUE"];
        ebs_fault = "EBS_FAULT" 43|1 ["FALSE", "TRUE"];
        offboard_charger_fault = "OFFBOARD_CHARGER_FAULT" 44|1 ["FALSE", "TRUE"];
        ai_comms_lost = "AI_COMMS_LOST" 45|1 ["FALSE", "TRUE"];
        autonomous_braking_fault = "AUTONOMOUS_BRAKING_FAULT" 46|1 ["FALSE", "TRUE"];
        mission_status_fault = "MISSION_STATUS_FAULT" 47|1 ["FALSE", "TRUE"];
        charge_procedure_fault = "CHARGE_PROCEDURE_FAULT" 48|1 ["FALSE", "TRUE"];
        bms_fault = "BMS_FAULT" 49|1 ["FALSE", "TRUE"];
        shutdown_cause = "SHUTDOWN_CAUSE" 56|8 in 0 to 10;
    }

    Vcu2AiDriveF = "VCU2AI_Drive_F", 8 bytes, every 10 ms, section "2.2" {
        front_axle_trq = "FRONT_AXLE_TRQ_Nm" 0|16;
        front_axle_trq_request = "FRONT_AXLE_TRQ_REQUEST_Nm" 16|16;
        front_axle_trq_max = "FRONT_AXLE_TRQ_MAX_Nm" 32|16;
    }

    Vcu2AiDriveR = "VCU2AI_Drive_R", 8 bytes, every 10 ms, section "2.2" {
        rear_axle_trq = "REAR_AXLE_TRQ_Nm" 0|16;
        // Unsigned, as the text says; the database says signed. No value in range differs.
        rear_axle_trq_request = "REAR_AXLE_TRQ_REQUEST_Nm" 16|16;
        rear_axle_trq_max = "REAR_AXLE_TRQ_MAX_Nm" 32|16;
    }

    Vcu2AiSteer = "VCU2AI_Steer", 8 bytes, every 10 ms, section "2.2" {
        steer_angle = "STEER_ANGLE_deg" 0|16 in -240 to 240;
        steer_angle_max = "STEER_ANGLE_MAX_deg" 16|16 in 0 to 240;
        steer_angle_request = "STEER_ANGLE_REQUEST_deg" 32|16 in -240 to 240;
    }

    Vcu2AiBrake = "VCU2AI_Brake", 8 bytes, every 10 ms, section "2.2" {
        hyd_press_f = "HYD_PRESS_F_pct" 0|8;
        hyd_press_f_req = "HYD_PRESS_F_REQ_pct" 8|8;
        hyd_press_r = "HYD_PRESS_R_pct" 16|8;
        hyd_press_r_req = "HYD_PRESS_R_REQ_pct" 24|8;
    }

    Vcu2AiWheelSpeeds = "VCU2AI_Wheel_speeds", 8 bytes, every 10 ms, section "2.2" {
        fl_wheel_speed = "FL_WHEEL_SPEED_rpm" 0|16;
        fr_wheel_speed = "FR_WHEEL_SPEED_rpm" 16|16;
        rl_wheel_speed = "RL_WHEEL_SPEED_rpm" 32|16;
        rr_wheel_speed = "RR_WHEEL_SPEED_rpm" 48|16;
    }

    Vcu2AiWheelCounts = "VCU2AI_Wheel_counts", 8 bytes, every 10 ms, section "2.2" {
        fl_pulse_count = "FL_PULSE_COUNT" 0|16;
        fr_pulse_count = "FR_PULSE_COUNT" 16|16;
        rl_pulse_count = "RL_PULSE_COUNT" 32|16;
        rr_pulse_count = "RR_PULSE_COUNT" 48|16;
    }
}
