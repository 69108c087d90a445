//! Watching the handshake of section 2.4 from the bus.
//!
//! By hand, and not by what may be of [`Handshakes`](adsdv_spec::belief::Handshakes): within a window each side changes its bit
//! several times, so that nothing is known of the bits throughout; which frame came after which tells all the same.

use adsdv_spec::Truth;

/// So many frames in a row with the same bit are no accident of a recorder that loses frames.
const STUCK: u32 = 20;

/// What the bus shows of the handshake.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Watch {
    /// The VCU's bit.
    vcu: Option<bool>,
    /// When it changed to that; `None` if that was before the first frame seen.
    edge_at: Option<i64>,
    /// The AI Computer's bit, while its frames are fresh.
    ai: Option<bool>,
    /// How many frames in a row the AI Computer has sent that bit.
    ai_run: u32,
    /// How many of them in a row the VCU's bit was the same as theirs.
    agreed: u32,
    /// The last edges of both, by what was recorded.
    edges: Edges,
    /// Whether the last edge was answered.
    answered: bool,
    /// How long the answer before took.
    last_response: i64,
    /// Whether frames that could have answered this edge may be missing from the log.
    blind: bool,
    /// How the handshake began, when the tractive system was seen to be switched on.
    began: Option<Beginning>,
    /// Whether the AI Computer's fault at this edge was reported, and the VCU's.
    pub(crate) reported_ai: bool,
    pub(crate) reported_vcu: bool,
}

/// The edges of both bits by what was recorded, however much may be missing: nothing certain.
#[derive(Clone, Copy, Debug, Default)]
struct Edges {
    /// The bits of the last frames, and when they changed to that.
    vcu: Option<(bool, i64)>,
    ai: Option<(bool, i64)>,
    /// The last edge that was answered, and when it was.
    answer: Option<(i64, i64)>,
    /// Since when both bits have been the same, how many frames of the AI Computer have shown that, and whether it was reported.
    still: Option<(i64, u32, bool)>,
}

impl Edges {
    fn vcu(&mut self, now: i64, bit: bool) {
        if self.vcu.is_none_or(|(before, _)| before != bit) {
            self.vcu = Some((bit, now));
            self.still = None;
        }
    }

    fn ai(&mut self, now: i64, bit: bool) {
        let changed = self.ai.is_some_and(|(before, _)| before != bit);
        if self.ai.is_none() || changed {
            self.ai = Some((bit, now));
        }
        let agreed = self.vcu.filter(|&(vcu, _)| vcu == bit);
        if let Some((_, edge)) = agreed.filter(|_| changed) {
            self.answer = Some((edge, now));
        }
        let (since, count, reported) = self.still.unwrap_or((now, 0, false));
        self.still = agreed.map(|_| (since, count.saturating_add(1), reported));
    }
}

/// The handshake began with 1, which the AI Computer had shown for long before: there is no rising edge to answer that with.
#[derive(Clone, Copy, Debug)]
struct Beginning {
    /// When the VCU showed that.
    t: i64,
    /// Whether the AI Computer's 1 counted as the answer: the VCU went on to 0, and nothing but 1 was seen before.
    went_on: bool,
}

/// An edge of the VCU's bit that came, as far as is seen yet, without an answer to the one before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Suspect {
    /// The bit that should have been answered.
    pub(crate) bit: bool,
    /// When it came.
    pub(crate) since: i64,
}

impl Watch {
    /// The VCU's bit was seen.
    pub(crate) fn vcu(&mut self, now: i64, bit: bool) -> Option<Suspect> {
        let before = self.vcu.replace(bit);
        self.edges.vcu(now, bit);
        if let Some(began) = self.began.as_mut().filter(|_| !bit) {
            began.went_on = true;
        }
        if before == Some(bit) {
            return None;
        }
        let unanswered = !self.answered && !self.blind && self.ai.is_some();
        let suspect = before.zip(self.edge_at).filter(|_| unanswered);
        self.edge_at = before.map(|_| now);
        if self.ai != Some(bit) {
            self.agreed = 0;
        }
        self.answered = false;
        self.blind = self.ai.is_none();
        (self.reported_ai, self.reported_vcu) = (false, false);
        suspect.map(|(bit, since)| Suspect { bit, since })
    }

    /// The AI Computer's bit was seen. Tells whether this changes what is known: it answers the edge, or shows that
    /// one is missing from the log, or has been the VCU's for long.
    pub(crate) fn ai(&mut self, now: i64, bit: bool) -> bool {
        self.ai_run = if self.ai == Some(bit) { self.ai_run.saturating_add(1) } else { 1 };
        self.ai = Some(bit);
        self.edges.ai(now, bit);
        // The VCU may have seen that before it began, and it came late.
        self.began = self.began.filter(|began| bit || began.went_on);
        self.agreed = match self.vcu {
            Some(vcu) if vcu == bit => self.agreed.saturating_add(1),
            // Meanwhile the VCU's bit cannot have gone to and fro: the AI Computer has answered nothing else.
            None if self.ai_run > 1 => self.agreed,
            _ => 0,
        };
        if self.answered && self.vcu != Some(bit) {
            // The AI Computer goes on to the next bit: an edge of the VCU is missing from the log.
            self.restart();
            return true;
        }
        if self.answered || self.vcu != Some(bit) {
            return self.agreed == STUCK;
        }
        self.answered = true;
        self.last_response = self.edge_at.map_or(self.last_response, |edge| now - edge);
        true
    }

    /// Whether the AI Computer has answered in time by what was recorded, though frames may be missing: its last answer came so
    /// soon, and so lately, that communication cannot be lost.
    pub(crate) fn seems_answered(&self, now: i64, limit: i64, window: i64) -> bool {
        let soon = limit - window;
        self.edges.answer.is_some_and(|(edge, at)| at - edge < soon && now - at < soon)
    }

    /// Whether by what was recorded the AI Computer has sent for longer than a window what the VCU's last frame showed, so that there was
    /// nothing for it to answer.
    pub(crate) fn seems_agreed(&self, now: i64, vcu: bool, window: i64) -> bool {
        self.edges.ai.is_some_and(|(ai, since)| ai == vcu && now - since > window)
    }

    /// Since when the VCU has not changed its bit by what was recorded, though many frames answered it; `None` also once that was
    /// reported.
    pub(crate) fn stands_still(&self) -> Option<i64> {
        let still = self.edges.still.filter(|&(_, count, reported)| count >= STUCK && !reported);
        still.map(|(since, ..)| since)
    }

    /// That the VCU does not change its bit was reported.
    pub(crate) fn still_reported(&mut self) {
        self.reported_vcu = true;
        if let Some((.., reported)) = &mut self.edges.still {
            *reported = true;
        }
    }

    /// Whether a suspect edge may have been answered after all: single answers may be missing from the log, so
    /// only a bit that has been stuck for many frames proves that there was none.
    pub(crate) fn clears(&self, suspect: Suspect) -> bool {
        self.ai != Some(!suspect.bit) || self.ai_run < STUCK
    }

    /// The handshake may have begun anew, or gone on in frames that are missing.
    fn restart(&mut self) {
        (self.edge_at, self.answered, self.blind) = (None, false, true);
    }

    /// The tractive system was switched on or off, or the VCU was silent for so long that it may have been off itself.
    pub(crate) fn begins_anew(&mut self) {
        self.restart();
        (self.edges.still, self.began) = (None, None);
    }

    /// The tractive system was switched on, and the VCU's bit rose to 1 with it. Tells whether the AI Computer can answer with a
    /// rising edge, as far as that is clear by what was recorded: it showed 0 last, or 1 for as long as many cycles.
    pub(crate) fn rises_at_once(&mut self, now: i64, cycle: i64) -> Option<bool> {
        let (bit, since) = self.edges.ai?;
        if !bit {
            return Some(true);
        }
        let long = now - since >= i64::from(STUCK) * cycle;
        self.began = long.then_some(Beginning { t: now, went_on: false });
        long.then_some(false)
    }

    /// Whether the handshake that began at this time took for its answer what had been there before.
    pub(crate) fn went_on_from(&self, began: i64) -> bool {
        self.began.is_some_and(|beginning| beginning.t == began && beginning.went_on)
    }

    /// The AI Computer's frames stopped, or cannot be read.
    pub(crate) fn ai_gone(&mut self) {
        (self.ai, self.ai_run, self.agreed, self.blind) = (None, 0, 0, true);
    }

    /// The VCU's frames stopped: nothing is known of its edge.
    pub(crate) fn vcu_gone(&mut self) {
        self.vcu = None;
        self.restart();
    }

    /// Whether the edge was answered.
    pub(crate) const fn is_answered(&self) -> bool {
        self.answered
    }

    /// How long the answer to this edge took, if it is certain that no earlier one is missing from the log.
    pub(crate) fn response(&self) -> Option<i64> {
        (self.answered && !self.blind && self.edge_at.is_some()).then_some(self.last_response)
    }

    /// When the VCU's bit changed last.
    pub(crate) const fn edge_at(&self) -> Option<i64> {
        self.edge_at
    }

    /// For how long the edge has been unanswered, as far as the log shows.
    pub(crate) fn unanswered(&self, now: i64) -> Option<i64> {
        if self.answered { None } else { self.edge_at.map(|edge| now - edge) }
    }

    /// Whether the AI Computer can be seen not to answer: its frames come, with the other bit.
    pub(crate) fn ai_is_wrong(&self) -> bool {
        !self.blind && !self.answered && self.ai.is_some() && self.ai != self.vcu
    }

    /// Whether the communication is lost: unanswered for `limit`, give or take `window`.
    pub(crate) fn lost(&self, now: i64, limit: i64, window: i64) -> Truth {
        let quick = self.last_response + window < limit;
        match self.unanswered(now) {
            // Whenever it began: a VCU that has seen its own bit for so long has its answer.
            _ if self.agreed >= STUCK && self.vcu.is_some() => Truth::False,
            // While the AI Computer is not heard, two edges may be missing from the log: the bit looks the same.
            None if self.edge_at.is_some() && quick && !self.blind => Truth::False,
            Some(elapsed) if elapsed + window < limit && quick => Truth::False,
            Some(elapsed) if elapsed >= limit + window && !self.blind => Truth::True,
            _ => Truth::Unknown,
        }
    }

    /// When an unanswered edge changes what is known: when communication may be lost, and when it must be.
    pub(crate) fn next(&self, after: i64, limit: i64, window: i64) -> i64 {
        let Some(edge) = self.edge_at.filter(|_| !self.answered) else { return i64::MAX };
        let times = [edge + limit - window, edge + limit + window];
        times.into_iter().find(|&at| after < at).unwrap_or(i64::MAX)
    }
}
