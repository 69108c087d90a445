//! What a recorder on the bus sees of a run.
//!
//! In each cycle the AI Computer's frames come first, half a cycle before the step that sees them; the VCU's come right
//! after the step. A slow message, such as 502h, comes in some cycles only; 502h also out of turn when the EBS changes: a path may change it faster than
//! 502h comes, and no other message shows it.

use adsdv_spec::messages::{EbsState, Frame, Vcu2LogStatus};

use super::{MS, Run};

/// The time from one frame to the next, in nanoseconds: about what one takes on a bus of 500 kbit/s.
const FRAME_NS: i64 = MS / 4;

impl Run {
    /// The frames on the bus with their times, in nanoseconds since the log begins, in the order of time.
    pub fn frames(&self) -> impl Iterator<Item = (i64, Frame)> + '_ {
        let bus = self.machine.edition().bus;
        let cycle_ms = self.machine.edition().rules.timing.cycle_ms;
        // How often a slow message comes; `None` for one that comes in each cycle.
        let slow_ns = move |frame: &Frame| {
            let def = bus.message(frame.id).filter(|def| def.cycle_ms > cycle_ms)?;
            Some(i64::from(def.cycle_ms) * MS)
        };
        let ebs_before =
            std::iter::once(EbsState::default()).chain(self.cycles.iter().map(|cycle| cycle.inputs.ebs));
        self.cycles.iter().zip(ebs_before).flat_map(move |(cycle, ebs_before)| {
            let begin_ns = cycle.t_ns - self.cycle_ns() / 2;
            let news = cycle.inputs.ebs != ebs_before;
            let sent = move |frame: &Frame| {
                slow_ns(frame).is_none_or(|slow_ns| begin_ns % slow_ns == 0)
                    || news && frame.id == Vcu2LogStatus::ID
            };
            let vcu = cycle.outputs.messages(&cycle.inputs).frames(&bus);
            at(begin_ns, cycle.inputs.ai.frames(&bus)).chain(at(cycle.t_ns, vcu.filter(sent)))
        })
    }
}

/// Frames that are sent one after the other from a time on.
fn at(begin_ns: i64, frames: impl IntoIterator<Item = Frame>) -> impl Iterator<Item = (i64, Frame)> {
    (0..).map(move |place| begin_ns + place * FRAME_NS).zip(frames)
}
