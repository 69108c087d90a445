//! Watching the handshake of section 2.4 from the bus.

use adsdv_spec::Truth;

/// So many frames in a row with the same bit are no accident of a recorder that loses frames.
const STUCK: u32 = 20;

/// What the bus shows of the handshake.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watch {
    /// The VCU's bit.
    vcu: Option<bool>,
    /// When it changed to that; `None` if that was before the first frame seen.
    edge_at: Option<i64>,
    /// The AI Computer's bit, while its frames are fresh.
    ai: Option<bool>,
    /// How many frames in a row the AI Computer has sent that bit.
    ai_run: u32,
    /// Whether the last edge was answered.
    answered: bool,
    /// How long the answer before took.
    last_response: i64,
    /// Whether frames that could have answered this edge may be missing from the log.
    blind: bool,
    reported_ai: bool,
    reported_vcu: bool,
}

/// An edge of the VCU's bit that came, as far as is seen yet, without an answer to the one before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Suspect {
    /// The bit that should have been answered.
    pub(super) bit: bool,
    /// When it came.
    pub(super) since: i64,
}

impl Watch {
    /// The VCU's bit was seen.
    pub(super) fn vcu(&mut self, now: i64, bit: bool) -> Option<Suspect> {
        let before = self.vcu.replace(bit);
        if before == Some(bit) {
            return None;
        }
        let unanswered = !self.answered && !self.blind && self.ai.is_some();
        let suspect = match (before, self.edge_at) {
            (Some(bit), Some(since)) if unanswered => Some(Suspect { bit, since }),
            _ => None,
        };
        self.edge_at = before.map(|_| now);
        self.answered = false;
        self.blind = self.ai.is_none();
        self.reported_ai = false;
        self.reported_vcu = false;
        suspect
    }

    /// The AI Computer's bit was seen. Tells whether this changes what is known: it answers the edge, or shows that
    /// one is missing from the log.
    pub(super) fn ai(&mut self, now: i64, bit: bool) -> bool {
        self.ai_run = if self.ai == Some(bit) { self.ai_run.saturating_add(1) } else { 1 };
        self.ai = Some(bit);
        if self.answered && self.vcu != Some(bit) {
            // The AI Computer goes on to the next bit: an edge of the VCU is missing from the log.
            self.restart();
            return true;
        }
        if self.answered || self.vcu != Some(bit) {
            return false;
        }
        self.answered = true;
        if let Some(edge) = self.edge_at {
            self.last_response = now - edge;
        }
        true
    }

    /// Whether a suspect edge may have been answered after all: single answers may be missing from the log, so
    /// only a bit that has been stuck for many frames proves that there was none.
    pub(super) fn clears(&self, suspect: Suspect) -> bool {
        self.ai != Some(!suspect.bit) || self.ai_run < STUCK
    }

    /// The handshake may have begun anew, because the tractive system was switched on or off.
    pub(super) fn restart(&mut self) {
        self.edge_at = None;
        self.answered = false;
        self.blind = true;
    }

    /// The AI Computer's frames stopped, or cannot be read.
    pub(super) fn ai_gone(&mut self) {
        self.ai = None;
        self.ai_run = 0;
        self.blind = true;
    }

    /// The VCU's frames stopped: nothing is known of its edge.
    pub(super) fn vcu_gone(&mut self) {
        self.vcu = None;
        self.restart();
    }

    /// Whether the edge was answered.
    pub(super) fn is_answered(&self) -> bool {
        self.answered
    }

    /// How long the answer to this edge took, if it is certain that no earlier one is missing from the log.
    pub(super) fn response(&self) -> Option<i64> {
        (self.answered && !self.blind && self.edge_at.is_some()).then_some(self.last_response)
    }

    /// When the VCU's bit changed last.
    pub(super) fn edge_at(&self) -> Option<i64> {
        self.edge_at
    }

    /// For how long the edge has been unanswered, as far as the log shows.
    pub(super) fn unanswered(&self, now: i64) -> Option<i64> {
        if self.answered { None } else { self.edge_at.map(|edge| now - edge) }
    }

    /// Whether the AI Computer can be seen not to answer: its frames come, with the other bit.
    pub(super) fn ai_is_wrong(&self) -> bool {
        !self.blind && !self.answered && self.ai.is_some() && self.ai != self.vcu
    }

    /// Whether the communication is lost: unanswered for `limit`, give or take `window`.
    pub(super) fn lost(&self, now: i64, limit: i64, window: i64) -> Truth {
        let quick = self.last_response + window < limit;
        match self.unanswered(now) {
            // While the AI Computer is not heard, two edges may be missing from the log: the bit looks the same.
            None if self.edge_at.is_some() && quick && !self.blind => Truth::False,
            Some(elapsed) if elapsed + window < limit && quick => Truth::False,
            Some(elapsed) if elapsed >= limit + window && !self.blind => Truth::True,
            _ => Truth::Unknown,
        }
    }

    /// Marks the AI Computer's fault at this edge as reported; false if it was already.
    pub(super) fn report_ai(&mut self) -> bool {
        !std::mem::replace(&mut self.reported_ai, true)
    }

    /// Whether the AI Computer's fault at this edge was reported.
    pub(super) fn is_reported(&self) -> bool {
        self.reported_ai
    }

    /// Marks the VCU's fault at this edge as reported; false if it was already.
    pub(super) fn report_vcu(&mut self) -> bool {
        !std::mem::replace(&mut self.reported_vcu, true)
    }
}
