//! The remote control, where its frames come: the "Go" switch and the E-stop as they are, and not as the VCU takes them.
//!
//! What else is known of them is less. `GO_SIGNAL` of 520h may be the switch or the edge that the VCU accepted, and that the
//! shutdown circuit is open shows in no frame but by a fault.
//!
//! No document says which level of the E-stop's bit means that it is pressed. But the vehicle neither stays in `AS_READY` nor in
//! `AS_DRIVING` while it is: the level that lasts in these is that of a button which is released.

use adsdv_spec::{AsState, Atom, Truth};

use super::events::PendingKind;
use super::{Judge, REMOTE};
use crate::remote::{Remote, Switches};

/// What is kept of the remote control.
#[derive(Debug, Default)]
pub(super) struct RemoteSide {
    /// What it showed last; `None` while that is too old to speak for now.
    shown: Option<Switches>,
    /// When "Go" changed last, or was first seen.
    go_changed_at: Option<i64>,
    /// When the VCU has seen the last change of "Go", or what may have been one.
    go_settles: Option<i64>,
    /// The level of the E-stop's bit that means that it is released, once that is known.
    released: Option<bool>,
    /// Since when the bit and a state in which the E-stop is released have both lasted.
    lasts_since: Option<i64>,
    /// From when to when the E-stop was pressed last; to the end of time while it is.
    pressed: Option<(i64, i64)>,
}

impl RemoteSide {
    fn is_pressed(&self) -> bool {
        self.shown.zip(self.released).is_some_and(|(shown, released)| shown.estop != released)
    }

    /// The VCU shows another state.
    pub(super) fn state_changes(&mut self) {
        self.lasts_since = None;
    }
}

impl Judge {
    /// Whether the frames of the remote control come.
    pub(super) fn remote_is_seen(&self) -> bool {
        self.remote.shown.is_some()
    }

    /// Whether the log has frames of the remote control at all.
    pub(super) fn has_remote(&self) -> bool {
        self.slots.get(REMOTE).is_some_and(|slot| slot.last.is_some())
    }

    /// A frame of the remote control came with another content than the one before, or after a silence.
    pub(super) fn remote_changed(&mut self, t: i64, word: u64, len: u8) {
        let data = word.to_le_bytes();
        let read = |remote: Remote| remote.read(data.get(..usize::from(len))?);
        let shown = Remote::of(&self.edition.bus).and_then(read);
        let Some(slot) = self.slots.get_mut(REMOTE) else { return };
        (slot.word, slot.len, slot.fresh) = (word, len, shown.is_some());
        let stale_at = slot.stale_at();
        let Some(shown) = shown else { return self.remote_gone(t) };
        self.wake_at(stale_at);
        let before = self.remote.shown.replace(shown);
        if before.map(|before| before.estop) != Some(shown.estop) {
            self.remote.lasts_since = None;
        }
        self.press(t);
        if shown.go && before.is_some_and(|before| !before.go) {
            self.why.go_pressed(t);
            if self.remote.go_changed_at.is_some_and(|at| t - at > self.window) {
                self.go_shown_on(t);
            }
        }
        if before.map(|before| before.go) != Some(shown.go) {
            self.remote.go_changed_at = Some(t);
        }
        let edge = self.go_shown(t, before.map(|before| before.go), shown.go);
        let known = self.known.set(Atom::GoOn, shown.go.into()).set(Atom::SdcOpen, self.sdc_open());
        if edge == Truth::True && shown.go && before.is_some_and(|before| !before.go) {
            let wait = self.wait_for(self.deciding(AsState::Ready));
            self.suspend(t, wait, known.set(Atom::GoEdge, edge), PendingKind::Change(Atom::GoEdge));
        }
        self.learn(t, known.set(Atom::GoEdge, edge));
        self.remote_repeated(t);
    }

    /// A frame of the remote control came again with the same content.
    pub(super) fn remote_repeated(&mut self, t: i64) {
        let Some(shown) = self.remote.shown.filter(|_| self.remote.released.is_none()) else { return };
        if !matches!(self.vcu.state, Some(AsState::Ready | AsState::Driving)) || !self.vcu_is_seen() {
            self.remote.lasts_since = None;
            return;
        }
        let since = *self.remote.lasts_since.get_or_insert(t);
        if t - since >= self.window + self.deadline {
            self.remote.released = Some(shown.estop);
        }
    }

    /// What the remote control shows is not known any more.
    pub(super) fn remote_gone(&mut self, t: i64) {
        let RemoteSide { released, pressed, .. } = std::mem::take(&mut self.remote);
        self.remote = RemoteSide { released, pressed, ..RemoteSide::default() };
        self.press(t);
        let known = self.known.forget(self.scope(REMOTE)).set(Atom::SdcOpen, self.sdc_open());
        self.learn(t, known);
    }

    /// Takes down from when to when the E-stop is pressed.
    fn press(&mut self, t: i64) {
        self.remote.pressed = match (self.remote.is_pressed(), self.remote.pressed) {
            (true, Some((since, i64::MAX))) => Some((since, i64::MAX)),
            (true, _) => Some((t, i64::MAX)),
            (false, Some((since, i64::MAX))) => Some((since, t)),
            (false, pressed) => pressed,
        };
    }

    /// Whether the remote E-stop is certain to open the shutdown circuit.
    pub(super) fn remote_opens(&self) -> bool {
        self.remote.is_pressed()
    }

    /// Whether the remote E-stop was seen to be pressed at some time between these.
    pub(super) fn remote_pressed(&self, start: i64, end: i64) -> bool {
        self.remote.pressed.is_some_and(|(since, until)| since <= end && start <= until)
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
        let at = t + self.window;
        self.remote.go_settles = Some(at);
        self.wake_at(at);
        edge
    }

    /// Whether a rise of the switch at `t` is an edge that section 3.2, item 3, accepts, whatever the readings are: for a window
    /// the switch was off and all other conditions held.
    fn is_accepted(&self, t: i64) -> bool {
        let off = self.history.throughout(t - self.window, t - 1).of(Atom::GoOn) == Truth::False;
        let ready = self.vcu.state == Some(AsState::Ready) && self.vcu_is_seen();
        off && ready && self.go_conditions(t, self.known) == Truth::True
    }

    /// When a change of "Go" is over.
    pub(super) fn go_event(&self) -> i64 {
        self.remote.go_settles.unwrap_or(i64::MAX)
    }

    /// The VCU has seen the last change of "Go".
    pub(super) fn go_settles(&mut self, t: i64) {
        self.remote.go_settles = None;
        self.learn(t, self.known.set(Atom::GoEdge, Truth::False));
    }
}
