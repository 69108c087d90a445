//! What the VCU shows in 520h, and what the judge keeps of it.

use adsdv_spec::messages::{ShutdownCause, Vcu2AiStatus};
use adsdv_spec::{AsState, Atom, Atoms, Choice, Fault, Faults, Knowledge, Reading, Truth};

use super::events::PendingKind;
use super::flags::{CauseWatch, Sums};
use super::{Judge, STATUS};

/// The VCU as the bus shows it.
#[derive(Debug, Default)]
pub(super) struct VcuSide {
    /// The last AS state; `None` if it is not known.
    pub(super) state: Option<AsState>,
    /// The last 520h.
    pub(super) status: Option<Vcu2AiStatus>,
    /// Since when 520h is missing.
    pub(super) gap_since: Option<i64>,
    /// Whether `EMERGENCY_BRAKE`, or the cause of one, was seen.
    pub(super) braked: bool,
    /// The faults that open the shutdown circuit and were first shown while the Autonomous System was active.
    pub(super) opening: Faults,
    /// When conditions of the current state change with time.
    pub(super) timers: Vec<Timer>,
    pub(super) cause: Option<CauseWatch>,
    pub(super) brake: Option<super::flags::BrakeWatch>,
    pub(super) sums: Sums,
    pub(super) estop_since: Option<i64>,
    /// The last change of state.
    pub(super) left: Option<Left>,
    pub(super) assi: Option<super::flags::AssiSuspect>,
}

impl VcuSide {
    /// Whether the VCU says that communication with the AI Computer is lost.
    pub(super) fn shows_comms_lost(&self) -> bool {
        self.status.is_some_and(|status| status.ai_comms_lost)
    }
}

/// A change of state: when the old one was last seen, when the new one first was, and whether a frame may be missing in
/// between.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    pub(super) before: i64,
    pub(super) at: i64,
    pub(super) gap: bool,
}

/// A condition that changes when time passes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timer {
    pub(super) at: i64,
    pub(super) atom: Atom,
    pub(super) becomes: Truth,
}

/// Whether a state is one in which the Autonomous System is active.
pub(super) const fn is_active(state: Option<AsState>) -> bool {
    matches!(state, Some(AsState::Ready | AsState::Driving | AsState::Finished))
}

/// What shows is certain; what does not may be so all the same.
const fn certain(shows: bool) -> Truth {
    if shows { Truth::True } else { Truth::Unknown }
}

impl Judge {
    /// 520h came with the same content as before.
    pub(super) fn status_repeated(&mut self, t: i64) {
        if self.senders.several() {
            return;
        }
        self.due_at_status(t);
        self.likely_due_at_status(t);
        self.comms_due(t);
        self.missed_due(t);
        self.flags_over_time(t);
        self.compare_ebs(t);
    }

    /// 520h came with something new. `before` is when it came last; `readable` are the atoms that it shows.
    pub(super) fn status(
        &mut self,
        t: i64,
        status: Vcu2AiStatus,
        state_readable: bool,
        readable: Atoms,
        before: Option<i64>,
    ) {
        if self.senders.several() {
            return;
        }
        if let (Some(from), true) = (self.vcu.state.filter(|&from| from != status.as_state), state_readable)
            && self.is_of_another(t, from, status.as_state)
        {
            return;
        }
        if let Some(before) = before {
            self.after_silence(t, t - before);
        }
        let gap = self.vcu.gap_since.take().is_some();
        let previous = self.vcu.status.replace(status);
        let old_state = self.vcu.state;
        let new_state = if state_readable { Some(status.as_state) } else { None };

        self.tally.handshake(previous.map(|p| p.handshake), status.handshake, self.handshake.is_answered());
        self.margins.due = self.due;
        self.meter.vcu(t, status.handshake);
        if previous.is_some_and(|previous| previous.ts_switch_status != status.ts_switch_status) {
            self.handshake.restart();
        }
        if let Some(suspect) = self.handshake.vcu(t, status.handshake)
            && status.ts_switch_status
        {
            self.suspend(t, self.window, self.known, PendingKind::Edge(suspect));
        }
        let before_flags = self.known;
        self.learn_status(t, status, readable, previous, new_state, gap);
        let at_step = self.known;
        match (old_state, new_state) {
            (Some(from), Some(to)) if from != to => {
                self.transition_seen(t, from, to, before.unwrap_or(t), gap, at_step);
                self.enter(t, to, Some(before.unwrap_or(t)));
            }
            (None, Some(to)) => {
                self.notice_unknown_state();
                self.enter(t, to, None);
            }
            (_, None) => {
                self.vcu.state = None;
                self.due = None;
                self.explain(t);
            }
            _ => {}
        }
        let pressed = status.go_signal && previous.is_some_and(|previous| !previous.go_signal);
        if pressed && !gap && !self.remote_is_seen() {
            self.why.go_pressed(t);
        }
        if let Some(previous) = previous.filter(|_| !gap) {
            self.flags_changed(t, &previous, &status, old_state, before_flags);
        }
        self.sums_seen(t, &status, gap);
        self.update_comms(t);
        self.reconsider(t);
        self.status_repeated(t);
    }

    /// Learns what 520h shows of the conditions.
    fn learn_status(
        &mut self,
        t: i64,
        status: Vcu2AiStatus,
        readable: Atoms,
        previous: Option<Vcu2AiStatus>,
        new_state: Option<AsState>,
        gap: bool,
    ) {
        let raw = self.pinned(Reading::GoSignal) == Some(Choice::GoRaw);
        let driving = new_state == Some(AsState::Driving);
        let go_on = match (status.go_signal, raw || driving) {
            (true, _) => Truth::True,
            (false, true) => Truth::False,
            // In other states GO_SIGNAL may be the accepted edge, which says nothing about the switch.
            (false, false) => Truth::Unknown,
        };
        if is_active(self.vcu.state) {
            let shown = Faults::shown_by(&status);
            let risen = previous.map_or(Faults::NONE, |p| shown.difference(Faults::shown_by(&p)));
            self.vcu.opening =
                self.vcu.opening.union(risen).intersection(shown).intersection(Faults::OPENING);
        } else {
            self.vcu.opening = Faults::NONE;
        }
        let battery = certain(self.battery_by_itself() && self.vcu.opening.has(Fault::BmsFault));
        self.vcu.braked |=
            status.shutdown_cause != ShutdownCause::NoShutdown || new_state == Some(AsState::EmergencyBrake);
        let power_cycle = match (self.vcu.braked, self.pinned(Reading::PowerCycle)) {
            (false, _) | (true, Some(Choice::PowerCycleNotLatched)) => Truth::False,
            (true, Some(_)) => Truth::True,
            (true, None) => Truth::Unknown,
        };
        let known = self
            .known
            .learn(readable.intersection(Vcu2AiStatus::SCOPE), status.atoms())
            .set(Atom::SdcOpen, self.sdc_open())
            .set(Atom::BmsFault, battery)
            .set(Atom::PowerCycleNeeded, power_cycle);
        if self.remote_is_seen() {
            // It shows the switch itself.
            return self.learn(t, known);
        }
        let known = known.set(Atom::GoOn, go_on);
        let go_before = previous.filter(|_| !gap).map(|p| p.go_signal);
        let edge = self.go_edge(t, known, go_before, status.go_signal, raw, new_state);
        if go_before == Some(false) && status.go_signal {
            self.change_seen(t, Atom::GoEdge, edge);
        }
        self.learn(t, known.set(Atom::GoEdge, edge));
    }

    /// Whether a fault of the battery may act by itself, so that it does not tell that the circuit is open.
    fn battery_by_itself(&self) -> bool {
        self.options.readings.has(Choice::BmsDriving)
    }

    /// Whether the shutdown circuit is open, as far as faults and the remote control show it.
    pub(super) fn sdc_open(&self) -> Truth {
        let opening = self.vcu.opening;
        let opening = if self.battery_by_itself() { opening.without(Fault::BmsFault) } else { opening };
        certain(!opening.is_empty() || self.remote_opens())
    }

    /// Whether a "Go" edge was accepted, as far as `GO_SIGNAL` tells (section 3.2, item 3).
    ///
    /// Whether `GO_SIGNAL` is the accepted edge or the switch: when it rises in AS_READY the other conditions must
    /// hold already, and when it is 1 without having risen there was no edge.
    fn go_edge(
        &self,
        t: i64,
        known: Knowledge,
        before: Option<bool>,
        go: bool,
        raw: bool,
        new_state: Option<AsState>,
    ) -> Truth {
        let was_ready = self.vcu.state == Some(AsState::Ready);
        let enters = new_state == Some(AsState::Ready) && !was_ready;
        match (before, go) {
            (_, false) if raw => Truth::False,
            (_, false) | (None, true) => Truth::Unknown,
            (Some(false), true) if was_ready => self.go_conditions(t, known),
            (Some(_), true) if enters && self.vcu.state.is_some() => Truth::False,
            (Some(_), true) => self.known.of(Atom::GoEdge),
        }
    }

    /// Whether the conditions of section 3.2, items 1 and 2, held throughout the window before.
    pub(super) fn go_conditions(&self, t: i64, known: Knowledge) -> Truth {
        let window = self.history.throughout(t - self.window, t).meet(known);
        self.variants
            .of(AsState::Ready)
            .iter()
            .flatten()
            .filter(|guard| guard.to == AsState::Driving)
            .flat_map(|guard| &guard.terms)
            .map(|term| adsdv_spec::Term { on: term.on.without(Atom::GoEdge), ..*term }.truth(window))
            .reduce(Truth::agree)
            .unwrap_or(Truth::Unknown)
    }

    /// The VCU shows a state that it did not show before. `before` is when it showed another one; `None` if the
    /// state may be old.
    fn enter(&mut self, t: i64, state: AsState, before: Option<i64>) {
        self.vcu.state = Some(state);
        self.tally.shows(state);
        self.due = None;
        self.likely = super::likely::Likely::default();
        let timing = &self.edition.rules.timing;
        let limit = i64::from(timing.in_state_limit(state)) * super::MS;
        self.vcu.timers.clear();
        let mut known = self.known;
        for timed in AsState::ALL {
            let Some(atom) = Atom::of_timer(timed) else { continue };
            known = known.set(atom, Truth::False);
            if state == timed {
                // The timer began between the two frames, give or take the window.
                if let Some(before) = before {
                    let at = before + limit - self.window;
                    self.vcu.timers.push(Timer { at, atom, becomes: Truth::Unknown });
                    self.wake_at(at);
                } else {
                    known = known.set(atom, Truth::Unknown);
                }
                let at = t + limit;
                self.vcu.timers.push(Timer { at, atom, becomes: Truth::True });
                self.wake_at(at);
            }
        }
        self.remote.state_changes();
        if state != AsState::Ready && !self.remote_is_seen() {
            known = known.set(Atom::GoEdge, Truth::Unknown);
        }
        for edge in super::edges::IN_DRIVING {
            known = known.set(edge, if before.is_some() { Truth::False } else { Truth::Unknown });
            self.change_passes(t, edge);
        }
        self.vcu.brake = match state {
            AsState::EmergencyBrake if before.is_some() => {
                Some(super::flags::BrakeWatch { since: t, certain: false })
            }
            _ => None,
        };
        self.ai.entered();
        if before.is_none() {
            // In which state the AI Computer did something before that, nobody has seen.
            self.pending.retain(|pending| !matches!(pending.what, PendingKind::AtSpeed(_)));
        }
        self.known = known;
        self.history.push(t, known, Some(state));
        self.explain(t);
    }

    /// Whether 520h is coming.
    pub(super) fn vcu_is_seen(&self) -> bool {
        self.slots.get(STATUS).is_some_and(|slot| slot.fresh)
    }
}
