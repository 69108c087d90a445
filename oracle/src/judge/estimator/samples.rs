//! What all other messages tell: the AI Computer's requests, what the VCU measures, the remote control; and what silence takes away.

use adsdv_spec::messages::{
    Ai2VcuStatus, AnyMessage, AsState, DirectionRequest, EbsState, MissionStatus, Node,
};
use adsdv_spec::{Atom, Choice, Reading, Truth};

use super::base::{Estimator, is_active};
use super::silences::place_of;
use crate::judge::sampler::Came;
use crate::judge::sampler::content::FrameContent;
use crate::judge::sampler::places::{AI_STATUS, REMOTE, STATUS, VCU_STATUS, scope};
use crate::judge::time::SILENCE_NS;
use crate::remote::Switches;

impl Estimator {
    /// A message says nothing that can be read, or has not come for so long that one may be missing.
    pub(crate) fn says_nothing(&mut self, index: usize, t: i64) {
        if index == REMOTE {
            return self.remote_gone(t);
        }
        if index == VCU_STATUS {
            self.silences.vcu_shows(t, None);
        }
        if index == AI_STATUS {
            self.handshake.ai_gone();
            self.update_comms(t);
        }
        self.learn(t, self.known.forget(self.sampler.scope(index)));
    }

    /// A message has not come for so long that one may be missing: what it said is not certain any more.
    pub(crate) fn becomes_stale(&mut self, index: usize, t: i64) {
        if let Some(slot) = self.sampler.slots.get_mut(index) {
            slot.fresh = false;
        }
        if index == STATUS {
            self.vcu.gap_since = Some(t);
            self.handshake.vcu_gone();
            self.silences.vcu_gone();
            self.update_comms(t);
        }
        self.says_nothing(index, t);
    }

    /// A message of requests, or of what the VCU measures, says something else than before.
    pub(crate) fn learns(&mut self, came: &Came, content: &FrameContent) {
        let &Came { index, t, before, was_fresh, .. } = came;
        let atoms = content.atoms(&self.edition.rules.thresholds);
        let scope = self.sampler.scope(index);
        // In EMERGENCY_BRAKE it is TRIGGERED whatever the EBS itself reports, and a 520h may be missing that would
        // have shown that state; none but AS_OFF is safe from it.
        //= D-28, D-61
        let hidden = matches!(content.message, AnyMessage::Vcu2AiBrake(brake) if brake.status_ebs == EbsState::Triggered)
            && self.vcu.state != Some(AsState::Off);
        let Some(slot) = self.sampler.slots.get_mut(index) else { return };
        let last = std::mem::replace(&mut slot.atoms, atoms.filter(|_| !hidden));
        let measured = slot.is_from(Node::Vcu);
        let Some(atoms) = slot.atoms else { return self.says_nothing(index, t) };
        // A silence between two frames that say the same hid nothing: what the VCU measures is physical.
        let silence = before.map_or(i64::MAX, |before| t - before);
        if last == Some(atoms) && !was_fresh && silence < SILENCE_NS && measured {
            self.history.fill(t - silence, scope, atoms);
        }
        self.learn(t, self.known.learn(scope, atoms));
    }

    /// 502h shows the state: a moment of its own, so that a change until the next sample can be distinguished from this one.
    pub(crate) fn sampled(&mut self, t: i64) {
        self.history.push(t, self.known, self.vcu.state);
    }

    /// 510h came with something new. Tells the one before, where that is known.
    pub(crate) fn ai_says(&mut self, came: &Came, status: Ai2VcuStatus) -> Option<Ai2VcuStatus> {
        let t = came.t;
        let previous = self.ai.replace(status).filter(|_| came.was_fresh);
        let mut known = self.known.learn(scope(AI_STATUS), status.atoms());
        let driving = self.vcu.state == Some(AsState::Driving);
        let finished = |s: Ai2VcuStatus| s.mission_status == MissionStatus::Finished;
        let running = |s: Ai2VcuStatus| s.mission_status == MissionStatus::Running;
        let neutral = |s: Ai2VcuStatus| s.direction_request == DirectionRequest::Neutral;
        let forward = |s: Ai2VcuStatus| s.direction_request == DirectionRequest::Forward;
        for (edge, is, was) in [
            (Atom::MissionFinishedEdge, finished(status), previous.map(|p| (finished(p), running(p)))),
            (Atom::DirectionNeutralEdge, neutral(status), previous.map(|p| (neutral(p), forward(p)))),
        ] {
            let truth = match was {
                _ if !is || !driving => Truth::False,
                Some((true, _)) => continue,
                Some((_, false)) => Truth::False,
                // At rest it does no harm, but when the VCU sees it the vehicle may move.
                Some((_, true)) => Truth::Unknown.or(known.of(Atom::Moving)),
                None => Truth::Unknown,
            };
            known = known.set(edge, truth);
            self.change_seen(t, edge, truth);
        }
        self.learn(t, known);
        previous
    }

    /// The AI Computer's handshake bit was seen. Tells whether that changes what is known of the handshake.
    pub(crate) fn ai_answers(&mut self, t: i64, bit: bool) -> bool {
        let changes = self.handshake.ai(t, bit);
        if changes {
            self.update_comms(t);
        }
        changes
    }

    /// A message of the AI Computer came, and all else that it says is known. Tells its place among those that are watched.
    #[inline]
    pub(crate) fn ends_silence(&mut self, index: usize, t: i64) -> Option<usize> {
        self.silences.limit?;
        let place = place_of(index)?;
        self.silences.heard(place, t, &self.sampler);
        if self.silences.silent != Truth::False {
            self.update_comms(t);
        }
        Some(place)
    }

    /// Brings what is known of lost communication up to date.
    pub(crate) fn update_comms(&mut self, t: i64) {
        let tsms = self.known.of(Atom::Tsms);
        let raised = self.shows_comms_lost() && is_active(self.vcu.state);
        let missed = self.silences.is_missed(t, tsms, &self.sampler);
        let lost = self.handshake.lost(t, self.handshake_limit(), self.window);
        let unanswered = match (tsms, self.pinned(Reading::HandshakeActive)) {
            (Truth::True, _) | (_, Some(Choice::HandshakeAlways)) => lost,
            (Truth::False, Some(_)) => Truth::False,
            _ => lost.and(Truth::Unknown),
        };
        let truth = if raised { Truth::True } else { unanswered.or(missed) };
        self.learn(t, self.known.set(Atom::AiCommsLost, truth));
        let edge = self.handshake.next(t, self.handshake_limit(), self.window);
        self.comms_at = edge.min(self.silences.next(t, &self.sampler));
    }

    /// A frame of the remote control came with another content than the one before, or after a silence. Tells whether it shows
    /// "Go" switched on after it was off for a while.
    pub(crate) fn remote_shows(&mut self, t: i64, shown: Switches) -> bool {
        let goes_on = self.remote.go_goes_on(t, shown.go, self.window);
        let before = self.remote.shows(t, shown).map(|before| before.go);
        let pressed = shown.go && before == Some(false);
        if pressed {
            self.why.go_pressed(t);
        }
        if before != Some(shown.go) {
            self.remote.go_changed_at = Some(t);
        }
        let edge = self.go_shown(t, before, shown.go);
        if edge == Truth::True && pressed {
            self.edges.push((Atom::GoEdge, edge));
        }
        let known = self.known.set(Atom::GoOn, shown.go.into()).set(Atom::SdcOpen, self.sdc_open());
        self.learn(t, known.set(Atom::GoEdge, edge));
        self.remote_lasts(t);
        goes_on
    }

    /// A frame of the remote control came with the same content.
    pub(crate) fn remote_lasts(&mut self, t: i64) {
        self.remote.lasts(t, self.state_seen(), self.patience());
    }

    /// What the remote control shows is not known any more.
    fn remote_gone(&mut self, t: i64) {
        self.remote.gone(t);
        let known = self.known.forget(self.sampler.scope(REMOTE)).set(Atom::SdcOpen, self.sdc_open());
        self.learn(t, known);
    }

    /// What is known of the edge that section 3.2, item 3, accepts, now that the switch shows this.
    ///
    /// The VCU sees a change within a window, so that each is over then.
    fn go_shown(&mut self, t: i64, before: Option<bool>, go: bool) -> Truth {
        let edge = match (before, go, self.known.of(Atom::GoEdge)) {
            (Some(before), go, known) if before == go => return known,
            // A switch that goes off takes no edge back that the VCU may have seen.
            (Some(_), false, Truth::False) => return Truth::False,
            (Some(false), true, _) if self.is_accepted(t) => Truth::True,
            _ => Truth::Unknown,
        };
        self.remote.go_settles = Some(t + self.window);
        edge
    }

    /// Whether a rise of the switch at `t` is an edge that section 3.2, item 3, accepts, whatever the readings are: for a window
    /// the switch was off and all other conditions held.
    fn is_accepted(&self, t: i64) -> bool {
        let off = self.history.throughout(t - self.window, t - 1).of(Atom::GoOn) == Truth::False;
        off && self.state_seen() == Some(AsState::Ready) && self.go_conditions(t, self.known) == Truth::True
    }

    /// The VCU has seen the last change of "Go".
    pub(crate) fn go_settles(&mut self, t: i64) {
        self.remote.go_settles = None;
        self.learn(t, self.known.set(Atom::GoEdge, Truth::False));
    }
}
