//! What the VCU of 2026 sends otherwise than that of version 4.0: no 120h, and three more states in 520h.
//!
//! The bound of the loops is that of a step; the table of messages has 15.

use adsdv_spec::editions::V2026;
use adsdv_spec::messages::{AsState, EbsStage, EbsState, OpState, TsState};

use crate::prelude::*;

/// **In 2026 each message but 120h goes out in its frame.** The nine frames that the VCU sends have the identifiers and the
/// lengths of 520h to 526h, 500h and 502h, in this order.
///
/// Requirements: MSG-29, MSG-34, MSG-41, MSG-65, MSG-69, MSG-73, MSG-77, MSG-82, MSG-101, MSG-113, MSG-116.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn each_message_of_2026_goes_out_in_its_frame() {
    const SENT: [(u16, u8); 9] = [
        (0x520, 8),
        (0x521, 6),
        (0x522, 6),
        (0x523, 6),
        (0x524, 5),
        (0x525, 8),
        (0x526, 8),
        (0x500, 8),
        (0x502, 5),
    ];
    let step = any_end();
    let messages = subject().messages(&step.outputs, &step.inputs).all();
    let mut sent = 0;
    for message in messages {
        let Some(frame) = V2026::write(&message) else { continue };
        let frame = subject().sent(frame);
        kani::cover!(frame.id == 0x520 && frame.data[0] > 0x0F, "a mode in the first byte of 520h");
        assert!(sent < SENT.len(), "nine at most");
        let (id, len) = SENT[sent];
        assert!(frame.id == id, "the identifier");
        assert!(frame.len == len, "the length");
        sent += 1;
    }
    assert!(sent == SENT.len(), "nine at least");
}

/// **520h shows the operation, the tractive system and the EBS.** OP_STATE is charging, else driving while TSMS is on, else
/// initialising; TS_STATE is running while TSMS is on. EBS_STATE is armed and triggered with State_EBS of 502h, which is
/// TRIGGERED in EMERGENCY_BRAKE and else what the EBS reports; and initialising while it is UNAVAILABLE.
///
/// Requirements: MSG-106 to MSG-108, D-71 to D-73.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn status_520h_shows_operation_tractive_system_and_ebs() {
    let step = any_end();
    let status = subject().messages(&step.outputs, &step.inputs).status;
    let (charging, tsms) = (step.inputs.reports.charging, step.inputs.tsms);
    kani::cover!(charging && tsms, "charging with TSMS on");
    let op_state = if charging {
        OpState::Charge
    } else if tsms {
        OpState::Auto
    } else {
        OpState::Init
    };
    assert!(status.op_state == op_state, "OP_STATE");
    assert!(status.ts_state == if tsms { TsState::Running } else { TsState::Init }, "TS_STATE");
    let braking = step.after.state == AsState::EmergencyBrake;
    let unavailable = braking && (step.inputs.ebs == EbsState::Unavailable);
    kani::cover!(unavailable, "it reports itself UNAVAILABLE in EMERGENCY_BRAKE");
    let ebs_state = if braking {
        EbsStage::Triggered
    } else {
        match step.inputs.ebs {
            EbsState::Unavailable => EbsStage::Init,
            EbsState::Armed => EbsStage::Armed,
            EbsState::Triggered => EbsStage::Triggered,
        }
    };
    assert!(status.ebs_state == ebs_state, "EBS_STATE");
}

theorems![each_message_of_2026_goes_out_in_its_frame, status_520h_shows_operation_tractive_system_and_ebs];
