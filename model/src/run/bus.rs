//! What a recorder on the bus sees of a run.
//!
//! In each cycle the AI Computer's frames come first, half a cycle before the step that sees them; the VCU's come right
//! after the step. 502h comes in some cycles only, and out of turn when the EBS changes: a path may change it faster than
//! 502h comes, and no other message shows it.

use adsdv_spec::AiMessages;
use adsdv_spec::messages::{EbsState, Frame, Message, Vcu2LogStatus};

use super::{CYCLE_NS, MS, Run};

/// The time from one frame to the next, in nanoseconds: about what one takes on a bus of 500 kbit/s.
const FRAME_NS: i64 = MS / 4;

impl Run {
    /// The frames on the bus with their times, in nanoseconds since the log begins, in the order of time.
    pub fn frames(&self) -> impl Iterator<Item = (i64, Frame)> + '_ {
        let log_status_ns = i64::from(self.machine.edition().rules.timing.log_status_cycle_ms) * MS;
        let ebs_before =
            std::iter::once(EbsState::default()).chain(self.cycles.iter().map(|cycle| cycle.inputs.ebs));
        self.cycles.iter().zip(ebs_before).flat_map(move |(cycle, ebs_before)| {
            let begin_ns = cycle.t_ns - CYCLE_NS / 2;
            let log_status = begin_ns.checked_rem(log_status_ns) == Some(0) || cycle.inputs.ebs != ebs_before;
            let sent = move |frame: &Frame| log_status || frame.id != Vcu2LogStatus::ID;
            let vcu = cycle.outputs.messages(&cycle.inputs).frames();
            at(begin_ns, ai_frames(&cycle.inputs.ai)).chain(at(cycle.t_ns, vcu.into_iter().filter(sent)))
        })
    }
}

fn ai_frames(ai: &AiMessages) -> [Frame; 5] {
    let AiMessages { status, drive_f, drive_r, steer, brake } = ai;
    [status.encode(), drive_f.encode(), drive_r.encode(), steer.encode(), brake.encode()]
}

/// Frames that are sent one after the other from a time on.
fn at(begin_ns: i64, frames: impl IntoIterator<Item = Frame>) -> impl Iterator<Item = (i64, Frame)> {
    (0..).map(move |place| begin_ns + place * FRAME_NS).zip(frames)
}
