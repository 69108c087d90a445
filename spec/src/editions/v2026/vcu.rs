//! What the VCU of 2026 tells the AI Computer, where the database differs from version 4.0.

use super::super::v4_0::{CAUSES, MISSIONS};
use super::V2026;
use super::values::STATES;
use crate::messages::layout::layouts;
use crate::messages::{Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer};

layouts! { V2026:
    Vcu2AiStatus = "VCU2AI_Status", 8 bytes, every 10 ms, section "2.2" {
        handshake = "HANDSHAKE" 0|1;
        op_state = "OP_STATE" 4|4;
        shutdown_request = "SHUTDOWN_REQUEST" 8|1 ["NO SHUTDOWN", "SHUTDOWN REQUESTED"];
        as_switch_status = "AS_SWITCH_STATUS" 9|1 ["OFF", "ON"];
        ts_switch_status = "TS_SWITCH_STATUS" 10|1 ["OFF", "ON"];
        go_signal = "GO_SIGNAL" 11|1 ["NO GO", "GO"];
        steering_status = "STEERING_STATUS" 12|2 ["OFF", "ACTIVE"];
        as_state = "AS_STATE" 16|4 of STATES with 0 as 1;
        ami_state = "AMI_STATE" 20|4 of MISSIONS;
        fault_status = "FAULT_STATUS" 24|1 ["NO FAULT", "FAULT DETECTED"];
        warning_status = "WARNING_STATUS" 25|1 ["NO WARNING", "WARNING ACTIVE"];
        ts_state = "TS_STATE" 28|4;
        warn_batt_temp_high = "WARN_BATT_TEMP_HIGH" 32|1 ["FALSE", "TRUE"];
        warn_batt_soc_low = "WARN_BATT_SOC_LOW" 33|1 ["FALSE", "TRUE"];
        ebs_state = "EBS_STATE" 36|4;
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
        // The database's names end before the last of version 4.0.
        shutdown_cause = "SHUTDOWN_CAUSE" 56|8 of CAUSES;
    }

    Vcu2AiDriveR = "VCU2AI_Drive_R", 6 bytes, every 10 ms, section "2.2" {
        rear_axle_trq = "REAR_AXLE_TRQ_Nm" 0|16;
        rear_axle_trq_request = "REAR_AXLE_TRQ_REQUEST_Nm" 16|16;
        rear_axle_trq_max = "REAR_AXLE_TRQ_MAX_Nm" 32|16;
    }

    Vcu2AiSteer = "VCU2AI_Steer", 6 bytes, every 10 ms, section "2.2" {
        steer_angle = "ANGLE" 0|16 in -300 to 300;
        steer_angle_max = "ANGLE_MAX" 16|16 in 0 to 300;
        steer_angle_request = "ANGLE_REQUEST" 32|16 in -300 to 300;
    }
}
