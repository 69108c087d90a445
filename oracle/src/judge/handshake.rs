//! Watching the handshake of section 2.4 from the bus.

use adsdv_spec::Truth;

/// What the bus shows of the handshake.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watch {
    /// The VCU's bit.
    vcu: Option<bool>,
    /// When it changed to that; `None` if that was before the first frame seen.
    edge_at: Option<i64>,
    /// The AI Computer's bit, while its frames are fresh.
    ai: Option<bool>,
    /// When the AI Computer was last seen to send 0, and 1.
    ai_seen: [Option<i64>; 2],
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
    /// Since when.
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

    /// The AI Computer's bit was seen. Tells the response time if this answers an edge.
    pub(super) fn ai(&mut self, now: i64, bit: bool) -> Option<i64> {
        self.ai = Some(bit);
        self.ai_seen[usize::from(bit)] = Some(now);
        if self.answered || self.vcu != Some(bit) {
            return None;
        }
        self.answered = true;
        let response = now - self.edge_at?;
        self.last_response = response;
        (!self.blind).then_some(response)
    }

    /// Whether a suspect edge was answered after all, give or take the window.
    pub(super) fn clears(&self, suspect: Suspect, window: i64) -> bool {
        self.ai_seen[usize::from(suspect.bit)].is_none_or(|seen| seen >= suspect.since - window)
    }

    /// The AI Computer's frames stopped, or cannot be read.
    pub(super) fn ai_gone(&mut self) {
        self.ai = None;
        self.blind = true;
    }

    /// The VCU's frames stopped: nothing is known of its edge.
    pub(super) fn vcu_gone(&mut self) {
        self.vcu = None;
        self.edge_at = None;
        self.answered = false;
        self.blind = true;
    }

    /// Whether the edge was answered.
    pub(super) fn is_answered(&self) -> bool {
        self.answered
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
            None if self.edge_at.is_some() && quick => Truth::False,
            Some(elapsed) if elapsed + window < limit && quick => Truth::False,
            Some(elapsed) if elapsed >= limit + window && !self.blind => Truth::True,
            _ => Truth::Unknown,
        }
    }

    /// Marks the AI Computer's fault at this edge as reported; false if it was already.
    pub(super) fn report_ai(&mut self) -> bool {
        !std::mem::replace(&mut self.reported_ai, true)
    }

    /// Marks the VCU's fault at this edge as reported; false if it was already.
    pub(super) fn report_vcu(&mut self) -> bool {
        !std::mem::replace(&mut self.reported_vcu, true)
    }
}
