//! The remote control, where its frames come: the "Go" switch and the E-stop as they are, and not as the VCU takes them.
//!
//! What else is known of them is less. `GO_SIGNAL` of 520h may be the switch or the edge that the VCU accepted, and that the
//! shutdown circuit is open shows in no frame but by a fault.
//!
//! No document says which level of the E-stop's bit means that it is pressed. But the vehicle neither stays in `AS_READY` nor in
//! `AS_DRIVING` while it is: the level that lasts in these is that of a button which is released.

use adsdv_spec::AsState;

use crate::judge::time::SILENCE_NS;
use crate::remote::Switches;

/// What is kept of the remote control.
#[derive(Debug, Default)]
pub(crate) struct RemoteSide {
    /// What it showed last; `None` while that is too old to speak for now.
    pub(crate) shown: Option<Switches>,
    /// When "Go" changed last, or was first seen.
    pub(super) go_changed_at: Option<i64>,
    /// "Go" by what was recorded, however old that is.
    recorded: Option<RecordedGo>,
    /// When the VCU has seen the last change of "Go", or what may have been one.
    pub(crate) go_settles: Option<i64>,
    /// The level of the E-stop's bit that means that it is released, once that is known.
    released: Option<bool>,
    /// Since when the bit and a state in which the E-stop is released have both lasted.
    pub(super) lasts_since: Option<i64>,
    /// From when to when the E-stop was pressed last; to the end of time while it is.
    pressed: Option<(i64, i64)>,
}

/// "Go" by what was recorded: what it was last, since when, and when that was last seen.
#[derive(Clone, Copy, Debug)]
struct RecordedGo {
    on: bool,
    since: i64,
    seen_at: i64,
}

impl RemoteSide {
    /// Whether the E-stop is certain to open the shutdown circuit.
    pub(super) fn is_pressed(&self) -> bool {
        self.shown.zip(self.released).is_some_and(|(shown, released)| shown.estop != released)
    }

    /// Whether the E-stop was seen to be pressed at some time between these.
    pub(crate) fn was_pressed(&self, start: i64, end: i64) -> bool {
        self.pressed.is_some_and(|(since, until)| since <= end && start <= until)
    }

    /// Whether "Go" changed after this, or was first seen after it.
    pub(crate) fn go_changed_since(&self, since: i64) -> bool {
        self.go_changed_at.is_none_or(|at| at > since)
    }

    /// It shows "Go" on or off. Tells whether that was switched on after it had been off for a while, by what was recorded, though
    /// frames may be missing.
    pub(super) fn go_goes_on(&mut self, t: i64, on: bool, window: i64) -> bool {
        let before = self.recorded;
        let since = before.filter(|before| before.on == on).map_or(t, |before| before.since);
        self.recorded = Some(RecordedGo { on, since, seen_at: t });
        let was_off =
            |before: RecordedGo| !before.on && t - before.since > window && t - before.seen_at < SILENCE_NS;
        on && before.is_some_and(was_off)
    }

    /// It shows this.
    pub(super) fn shows(&mut self, t: i64, shown: Switches) -> Option<Switches> {
        let before = self.shown.replace(shown);
        if before.map(|before| before.estop) != Some(shown.estop) {
            self.lasts_since = None;
        }
        self.press(t);
        before
    }

    /// It still shows the same, in a state of the VCU if that is known; after `enough` that tells when it is released.
    pub(super) fn lasts(&mut self, t: i64, state: Option<AsState>, enough: i64) {
        if let Some(recorded) = &mut self.recorded {
            recorded.seen_at = t;
        }
        let Some(shown) = self.shown.filter(|_| self.released.is_none()) else { return };
        if !matches!(state, Some(AsState::Ready | AsState::Driving)) {
            self.lasts_since = None;
            return;
        }
        if t - *self.lasts_since.get_or_insert(t) >= enough {
            self.released = Some(shown.estop);
        }
    }

    /// What it shows is not known any more.
    pub(super) fn gone(&mut self, t: i64) {
        let Self { recorded, released, pressed, .. } = std::mem::take(self);
        *self = Self { recorded, released, pressed, ..Self::default() };
        self.press(t);
    }

    /// Takes down from when to when the E-stop is pressed.
    fn press(&mut self, t: i64) {
        self.pressed = match (self.is_pressed(), self.pressed) {
            (true, Some((since, i64::MAX))) => Some((since, i64::MAX)),
            (true, _) => Some((t, i64::MAX)),
            (false, Some((since, i64::MAX))) => Some((since, t)),
            (false, pressed) => pressed,
        };
    }
}
