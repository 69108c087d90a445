//! Follows a VCU from state to state.

use adsdv_spec::messages::SignalDef;
use adsdv_spec::{AsState, Atom, Atoms, Choices, Edition, Knowledge};

use super::arrows::{Arrow, Arrows, Miss};
use super::go::{self, GoPress};
use super::shown::LastKnown;
use super::{Blocked, Condition, Stay, Untaken, place_of};

/// So many states are kept; of more, the first and the last.
const MAX_STAYS: usize = 1000;
/// So many times are kept of an arrow; of more, the first and the last.
const MAX_BLOCKED: usize = 32;
/// So many presses of "Go" are kept.
const MAX_PRESSES: usize = 100;
/// What lasts for less, between two times that are alike, is how frames come: a window before and behind.
const BRIEF_NS: i64 = 60_000_000;

/// Reads what a message showed last: its identifier, and the data.
pub(crate) type Last<'a> = &'a dyn Fn(u16) -> Option<[u8; 8]>;

/// Follows a VCU from state to state, and takes down what blocks its arrows.
#[derive(Debug)]
pub(crate) struct StayRecorder {
    edition: &'static Edition,
    arrows: Arrows,
    shown: LastKnown,
    running: Option<OngoingStay>,
    stays: Vec<Stay>,
    presses: Vec<GoPress>,
}

/// The state that lasts.
#[derive(Debug)]
struct OngoingStay {
    stay: Stay,
    /// What blocks each arrow now.
    misses: Vec<Option<Miss>>,
}

impl StayRecorder {
    pub(crate) fn new(edition: &'static Edition, readings: Choices) -> Self {
        let arrows = Arrows::new(edition, readings);
        Self {
            edition,
            arrows,
            shown: LastKnown::new(),
            running: None,
            stays: Vec::new(),
            presses: Vec::new(),
        }
    }

    /// The VCU shows a state, or none that is known, and this is known. `late` are the conditions of the messages that should have
    /// come by now.
    pub(crate) fn sees(
        &mut self,
        t: i64,
        state: Option<AsState>,
        (known, late): (Knowledge, Atoms),
        last: Last<'_>,
    ) {
        let before = self.shown.all();
        let known = self.shown.at(t, known, late);
        if self.running.as_ref().map(|running| running.stay.state) != state {
            self.ends(t, state);
            self.running = state.map(|state| OngoingStay::new(t, state, self.arrows.of(state)));
        } else if known == before {
            return;
        }
        let Some(running) = &mut self.running else { return };
        let arrows = self.arrows.of(running.stay.state);
        for ((arrow, untaken), miss) in arrows.iter().zip(&mut running.stay.arrows).zip(&mut running.misses) {
            let now = arrow.miss(known);
            if *miss != now {
                *miss = now;
                untaken.changes(t, now, |atom, needed| condition(self.edition, atom, needed, last));
            }
        }
    }

    /// "Go" was switched on.
    pub(crate) fn go_pressed(&mut self, t: i64) {
        let Some(stay) = self.running.as_ref().map(|running| &running.stay) else { return };
        if stay.state != AsState::Ready || self.presses.len() >= MAX_PRESSES {
            return;
        }
        self.presses.push(go::pressed(&self.edition.rules, t, stay.since_ns, self.shown.all()));
    }

    /// Nothing is known any more from here on.
    pub(crate) fn forget(&mut self, t: i64) {
        self.ends(t, None);
        self.shown.forget();
    }

    fn ends(&mut self, t: i64, left_to: Option<AsState>) {
        let Some(OngoingStay { mut stay, .. }) = self.running.take() else { return };
        if (stay.state, left_to) == (AsState::Ready, Some(AsState::Driving)) {
            // That one did start it.
            self.presses.pop_if(|press| press.t_ns >= stay.since_ns && !press.is_in_vain());
        }
        (stay.until_ns, stay.left_to) = (t, left_to);
        for untaken in &mut stay.arrows {
            untaken.ends(t);
        }
        if self.stays.len() >= MAX_STAYS {
            self.stays.pop();
        }
        self.stays.push(stay);
    }

    /// What was shown last.
    pub(crate) const fn shown(&self) -> Knowledge {
        self.shown.all()
    }

    /// The state that lasts now, with what blocks its arrows.
    pub(crate) fn now(&self) -> Option<&Stay> {
        self.running.as_ref().map(|running| &running.stay)
    }

    /// Everything, at the end.
    pub(crate) fn end(mut self, t: i64) -> (Vec<Stay>, Vec<GoPress>) {
        self.ends(t, None);
        (self.stays, self.presses)
    }
}

impl OngoingStay {
    fn new(t: i64, state: AsState, arrows: &[Arrow]) -> Self {
        let untaken = |arrow: &Arrow| Untaken {
            to: arrow.to,
            section: arrow.section,
            requirements: arrow.requirements,
            blocked: Vec::new(),
            more: 0,
        };
        let arrows: Vec<Untaken> = arrows.iter().map(untaken).collect();
        let misses = vec![None; arrows.len()];
        Self { stay: Stay { state, since_ns: t, until_ns: t, left_to: None, arrows }, misses }
    }
}

impl Untaken {
    /// From `t` on, this is missing.
    fn changes(&mut self, t: i64, miss: Option<Miss>, condition: impl Fn(Atom, bool) -> Condition) {
        self.ends(t);
        let Some(miss) = miss else { return };
        let conditions =
            |atoms: Atoms| atoms.iter().map(|atom| condition(atom, miss.on.has(atom))).collect::<Vec<_>>();
        let holding = miss.all.difference(miss.failed).difference(miss.unknown);
        let (failed, unknown) = (conditions(miss.failed), conditions(miss.unknown));
        let blocked = Blocked { since_ns: t, until_ns: i64::MAX, failed, unknown, holding };
        if let [.., before, brief] = self.blocked.as_slice()
            && before.is_like(&blocked)
            && t - before.until_ns <= BRIEF_NS
            && brief.until_ns == t
        {
            self.blocked.pop();
        }
        if let Some(before) = self.blocked.last_mut()
            && before.is_like(&blocked)
            && t - before.until_ns <= BRIEF_NS
        {
            before.until_ns = i64::MAX;
            return;
        }
        if self.blocked.len() >= MAX_BLOCKED {
            self.blocked.pop();
            self.more += 1;
        }
        self.blocked.push(blocked);
    }

    fn ends(&mut self, t: i64) {
        if let Some(last) = self.blocked.last_mut().filter(|last| last.until_ns == i64::MAX) {
            last.until_ns = t;
        }
        // What came and went at one moment was never so.
        self.blocked.pop_if(|last| last.since_ns == last.until_ns);
    }
}

impl Blocked {
    /// Whether the same conditions block.
    fn is_like(&self, other: &Self) -> bool {
        let atoms =
            |conditions: &[Condition]| conditions.iter().fold(Atoms::NONE, |all, one| all.with(one.atom));
        atoms(&self.failed) == atoms(&other.failed)
            && atoms(&self.unknown) == atoms(&other.unknown)
            && self.holding == other.holding
    }
}

fn condition(edition: &Edition, atom: Atom, needed: bool, last: Last<'_>) -> Condition {
    let place = place_of(&edition.bus, atom);
    let values = place.map_or_else(Vec::new, |place| {
        let data = last(place.message.id);
        let value = |signal: &'static SignalDef| Some((signal, signal.raw(&data?)?));
        place.signals.into_iter().flatten().filter_map(value).collect()
    });
    Condition { atom, needed, id: place.map(|place| place.message.id), values }
}
