//! What the AI Computer tells the VCU of 2026, where the database differs from version 4.0.

use super::V2026;
use crate::messages::Ai2VcuSteer;
use crate::messages::layout::layouts;

layouts! { V2026:
    Ai2VcuSteer = "AI2VCU_Steer", 2 bytes, every 10 ms, section "2.1" {
        steer_request = "STEER_REQUEST" 0|16 in -300 to 300;
    }
}
