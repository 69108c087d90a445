//! Who recorded a log, by the direction of its frames.

use adsdv_spec::messages::{Ai2VcuStatus, Vcu2AiStatus};

use crate::candump::Direction;

/// In which direction each side's status message went, as far as the log says.
#[derive(Debug, Default)]
pub(super) struct Directions {
    ai: [u64; 2],
    vcu: [u64; 2],
}

impl Directions {
    pub(super) fn count(&mut self, id: u16, direction: Option<Direction>) {
        let counts = match id {
            Ai2VcuStatus::ID => &mut self.ai,
            Vcu2AiStatus::ID => &mut self.vcu,
            _ => return,
        };
        match direction {
            Some(Direction::Rx) => counts[0] += 1,
            Some(Direction::Tx) => counts[1] += 1,
            None => {}
        }
    }

    /// Whether the AI Computer itself recorded: its own messages are all sent, and the VCU's are received but for
    /// single ones.
    pub(super) fn recorded_by_ai(&self) -> bool {
        let ([ai_rx, ai_tx], [vcu_rx, vcu_tx]) = (self.ai, self.vcu);
        ai_tx > 0 && ai_rx == 0 && vcu_rx > 4 && vcu_rx > 4 * vcu_tx
    }
}
