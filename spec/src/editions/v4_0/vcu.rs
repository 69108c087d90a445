//! What the VCU tells the AI Computer in version 4.0 (section 2.2), as its database lays it out.

use super::V4_0;
use super::values::{CAUSES, MISSIONS};
use crate::messages::layout::layouts;
use crate::messages::{
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelSpeeds, VcuStatus,
};

layouts! { V4_0:
    VcuStatus = "VCU_STATUS", 8 bytes, every 10 ms, section "2.2" {
        sm_sys = "SM_SYS" 0|4;
        sm_as = "SM_AS" 12|4;
        status_timeout = "R1_AI2VCU_STATUS_TIMEOUT_ERROR" 32|1 ["FALSE", "TRUE"];
        drive_f_timeout = "R1_AI2VCU_DRIVE_F_TIMEOUT_ERROR" 38|1 ["FALSE", "TRUE"];
        drive_r_timeout = "R1_AI2VCU_DRIVE_R_TIMEOUT_ERROR" 39|1 ["FALSE", "TRUE"];
        // The text spells it `R1_AI2VCU_STATUS_HANDSHAKE_ERROR`.
        handshake_timeout = "R1_AI2VCU_STATUS_HANDSHAKE_TIMEOUT_ERROR" 45|1 ["FALSE", "TRUE"];
        steer_timeout = "R1_AI2VCU_STEER_TIMEOUT_ERROR" 46|1 ["FALSE", "TRUE"];
        brake_timeout = "R1_AI2VCU_BRAKE_TIMEOUT_ERROR" 47|1 ["FALSE", "TRUE"];
        // The database's range ends before the last of its value names.
        sys_action_state = "SYS_ACTION_STATE" 48|4;
        warn_brake_plausibility = "WARN_BRAKE_PLAUSIBILITY" 58|1 ["FALSE", "TRUE"];
        warn_kl15_under_v = "WARN_KL15_UNDER_V" 59|1 ["FALSE", "TRUE"];
        warn_ai_estop_req = "WARN_AI_ESTOP_REQ" 60|1 ["FALSE", "TRUE"];
        warn_ai_comms_lost = "WARN_AI_COMMS_LOST" 61|1 ["FALSE", "TRUE"];
        warn_auto_braking = "WARN_AUTO_BRAKING" 62|1 ["FALSE", "TRUE"];
        warn_mission_status = "WARN_MISSION_STATUS" 63|1 ["FALSE", "TRUE"];
    }

    Vcu2AiStatus = "VCU2AI_Status", 8 bytes, every 10 ms, section "2.2" {
        handshake = "HANDSHAKE" 0|1;
        shutdown_request = "SHUTDOWN_REQUEST" 8|1 ["NO SHUTDOWN", "SHUTDOWN REQUESTED"];
        as_switch_status = "AS_SWITCH_STATUS" 9|1 ["OFF", "ON"];
        ts_switch_status = "TS_SWITCH_STATUS" 10|1 ["OFF", "ON"];
        // The database's range has no 1, its value names do.
        go_signal = "GO_SIGNAL" 11|1 ["NO GO", "GO"];
        steering_status = "STEERING_STATUS" 12|2 ["OFF", "ACTIVE"];
        as_state = "AS_STATE" 16|4;
        ami_state = "AMI_STATE" 20|4 of MISSIONS;
        fault_status = "FAULT_STATUS" 24|1 ["NO FAULT", "FAULT DETECTED"];
        warning_status = "WARNING_STATUS" 25|1 ["NO WARNING", "WARNING ACTIVE"];
        warn_batt_temp_high = "WARN_BATT_TEMP_HIGH" 32|1 ["FALSE", "TRUE"];
        warn_batt_soc_low = "WARN_BATT_SOC_LOW" 33|1 ["FALSE", "TRUE"];
        // Where a unit would stand, the database marks the faults; they have none.
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
        brake_plausibility_fault = "BRAKE_PLAUSIBILITY_FAULT" 50|1 ["FALSE", "TRUE"];
        shutdown_cause = "SHUTDOWN_CAUSE" 56|8 of CAUSES;
    }

    Vcu2AiDriveF = "VCU2AI_Drive_F", 6 bytes, every 10 ms, section "2.2" {
        front_axle_trq = "FRONT_AXLE_TRQ" 0|16;
        front_axle_trq_request = "FRONT_AXLE_TRQ_REQUEST" 16|16;
        front_axle_trq_max = "FRONT_AXLE_TRQ_MAX" 32|16;
    }

    Vcu2AiDriveR = "VCU2AI_Drive_R", 6 bytes, every 10 ms, section "2.2" {
        rear_axle_trq = "REAR_AXLE_TRQ" 0|16;
        rear_axle_trq_request = "REAR_AXLE_TRQ_REQUEST" 16|16;
        rear_axle_trq_max = "REAR_AXLE_TRQ_MAX" 32|16;
    }

    Vcu2AiSteer = "VCU2AI_Steer", 6 bytes, every 10 ms, section "2.2" {
        steer_angle = "ANGLE" 0|16 in -210 to 210;
        steer_angle_max = "ANGLE_MAX" 16|16 in 0 to 210;
        steer_angle_request = "ANGLE_REQUEST" 32|16 in -210 to 210;
    }

    Vcu2AiBrake = "VCU2AI_Brake", 5 bytes, every 10 ms, section "2.2" {
        hyd_press_f = "HYD_PRESS_F_pct" 0|8;
        hyd_press_f_req = "HYD_PRESS_F_REQ_pct" 8|8;
        hyd_press_r = "HYD_PRESS_R_pct" 16|8;
        hyd_press_r_req = "HYD_PRESS_R_REQ_pct" 24|8;
        status_brk = "STATUS_BRK" 32|4;
        status_ebs = "STATUS_EBS" 36|4;
    }

    Vcu2AiWheelSpeeds = "VCU2AI_Speeds", 8 bytes, every 10 ms, section "2.2" {
        fl_wheel_speed = "FL_WHEEL_SPEED" 0|16;
        fr_wheel_speed = "FR_WHEEL_SPEED" 16|16;
        rl_wheel_speed = "RL_WHEEL_SPEED" 32|16;
        rr_wheel_speed = "RR_WHEEL_SPEED" 48|16;
    }
}
