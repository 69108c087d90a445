//! The receiver of the remote control, on the bus of an edition that has it there.

use adsdv_oracle::remote::{Remote, Switches};
use adsdv_spec::messages::Frame;
use adsdv_spec::{Bus, Inputs};

use super::slow::Slow;

/// How well the transmitter is received, in percent.
const RADIO_PCT: u8 = 100;

/// The frame of the remote control, if there is one and it is due: "Go" and the E-stop as the operator has set them.
///
/// Which level of `ESTOP_STATUS` means that the button is pressed, no document says. Here it is 1. The quality of the radio link is
/// full, or nothing once the transmitter is lost; the third switch, which nobody uses, stays off.
pub(super) fn due(bus: &Bus, inputs: &Inputs, slow: &mut Slow, dt_ms: u32) -> Option<Frame> {
    let remote = Remote::of(bus)?;
    let message = remote.message();
    let cycle_ms = message.cycle_ms?;
    let switches = Switches { go: inputs.go, estop: inputs.sdc.remote_estop };
    let radio_pct = if inputs.sdc.res_link_lost { 0 } else { RADIO_PCT };
    slow.is_due(message.id, cycle_ms.into(), dt_ms).then(|| remote.frame(switches, radio_pct)).flatten()
}
