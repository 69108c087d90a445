//! Missed messages: whether one of the AI Computer's has been silent for too long (section 2.4 of version 4.0).
//!
//! A recorder loses frames as well. So a silence that is about as long as the limit, give or take the window, may be one or
//! not; and that nothing at all comes from the AI Computer may be the recorder's doing: what becomes of that, the judge learns from the
//! handshake.

use adsdv_spec::Truth;

use crate::judge::sampler::Sampler;
use crate::judge::sampler::places::{AI_BRAKE, AI_DRIVE_F, AI_DRIVE_R, AI_STATUS, AI_STEER};
use crate::judge::sampler::slot::Slot;

/// The messages that are watched.
pub(crate) const WATCHED: [usize; 5] = [AI_STATUS, AI_DRIVE_F, AI_DRIVE_R, AI_STEER, AI_BRAKE];

/// The place of a message among those that are watched; they stand together among the slots.
#[inline]
pub(crate) const fn place_of(index: usize) -> Option<usize> {
    match index.checked_sub(AI_STATUS) {
        Some(place) if place < WATCHED.len() => Some(place),
        _ => None,
    }
}

const _: () = {
    let mut place = 0;
    while place < WATCHED.len() {
        assert!(WATCHED[place] == AI_STATUS + place);
        place += 1;
    }
};

/// What is kept of the messages that are watched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Silences {
    /// How long a message may be silent; `None` where the edition has no such rule.
    pub(crate) limit: Option<i64>,
    window: i64,
    /// Whether every VCU watches them, whatever TSMS is.
    always: bool,
    /// When the last frame of each came that nobody can refuse.
    valid_at: [Option<i64>; WATCHED.len()],
    /// When a silence of each ended that may have been too long, or its first frame came.
    ended_at: [i64; WATCHED.len()],
    /// What 120h says of each: whether it is missed, and since when, if that was seen to begin.
    raised: [bool; WATCHED.len()],
    raised_at: [Option<i64>; WATCHED.len()],
    /// Until when none of them has been silent for too long, as far as they had come when that was looked at last.
    none_until: i64,
    /// Since when TSMS is known to have been on.
    on_since: Option<i64>,
    /// Whether any has been silent for too long, when that was looked at last.
    pub(crate) silent: Truth,
}

impl Silences {
    pub(crate) const fn new(limit: Option<i64>, window: i64, always: bool) -> Self {
        Self {
            limit,
            window,
            always,
            valid_at: [None; WATCHED.len()],
            ended_at: [i64::MIN; WATCHED.len()],
            raised: [true; WATCHED.len()],
            raised_at: [None; WATCHED.len()],
            none_until: i64::MIN,
            on_since: None,
            silent: Truth::Unknown,
        }
    }

    /// How long this message may be silent; `None` if nobody watches it.
    pub(crate) fn limit_of(&self, index: usize) -> Option<i64> {
        self.limit.filter(|_| place_of(index).is_some())
    }

    /// Nothing is known of what came.
    pub(crate) fn forget(&mut self) {
        *self = Self::new(self.limit, self.window, self.always);
    }

    /// The VCU's frames stopped: whether the switch stayed on is not known.
    pub(crate) fn vcu_gone(&mut self) {
        self.on_since = None;
    }

    /// A frame of a message came. A VCU may refuse one with a value out of range, or of another length than the edition's.
    pub(crate) fn heard(&mut self, place: usize, t: i64, sampler: &Sampler) {
        let Some(slot) = WATCHED.get(place).and_then(|&index| sampler.slot(index)) else { return };
        let valid = slot.fresh && slot.bad == 0 && slot.def.is_some_and(|def| def.len == slot.len);
        let enough = self.limit.unwrap_or_default() - self.window;
        if let (true, Some(at), Some(ended_at)) =
            (valid, self.valid_at.get_mut(place), self.ended_at.get_mut(place))
            && at.replace(t).is_none_or(|before| t - before >= enough)
        {
            *ended_at = t;
        }
    }

    /// 120h says of each message whether it is missed; `None` if it says nothing any more.
    pub(crate) fn vcu_shows(&mut self, t: i64, raised: Option<[bool; WATCHED.len()]>) {
        let before = std::mem::replace(&mut self.raised, raised.unwrap_or([true; WATCHED.len()]));
        for ((at, is), was) in self.raised_at.iter_mut().zip(self.raised).zip(before) {
            *at = if is && !was { Some(t) } else { at.filter(|_| is && raised.is_some()) };
        }
    }

    /// Whether 120h says that a message is missed, of the silence that lasts now: the flag was raised once it was long enough.
    pub(crate) fn vcu_tells(&self, place: usize, sampler: &Sampler) -> bool {
        let raised_at = self.raised_at.get(place).copied().flatten();
        let long = self.limit.unwrap_or_default() - self.window;
        raised_at.zip(Self::heard_at(place, sampler)).is_some_and(|(at, last)| at - last >= long)
    }

    /// Whether valid frames of a message have come from `since` to `t` without a silence that may have been too long.
    pub(crate) fn has_come(&self, place: usize, since: i64, t: i64) -> bool {
        let enough = self.limit.unwrap_or_default() - self.window;
        let now = self.valid_at.get(place).copied().flatten().is_some_and(|at| t - at < enough);
        now && self.ended_at.get(place).is_some_and(|&ended_at| ended_at < since)
    }

    /// When a frame of a message came last, valid or not.
    pub(crate) fn heard_at(place: usize, sampler: &Sampler) -> Option<i64> {
        sampler.last(*WATCHED.get(place)?)
    }

    /// Whether each message has come for so long that none can have been silent for too long, by what was recorded.
    pub(crate) fn seem_present(&self, t: i64) -> bool {
        self.limit.is_none_or(|limit| (0..WATCHED.len()).all(|place| self.has_come(place, t - limit, t)))
    }

    /// Whether another message of the AI Computer comes, so that it is not the recorder that hears nothing.
    pub(crate) fn others_come(&self, place: usize, t: i64, sampler: &Sampler) -> bool {
        let within = self.limit.unwrap_or_default() - self.window;
        let others = (0..WATCHED.len()).filter(|&other| other != place);
        others.filter_map(|other| Self::heard_at(other, sampler)).any(|last| t - last < within)
    }

    /// Whether a message has been silent for too long. One that was never heard may have been left out by the recorder, and of two
    /// silences a single frame between may be lost where the recorder loses frames.
    pub(crate) fn is_silent(&self, place: usize, t: i64, sampler: &Sampler) -> Truth {
        let lossy = || WATCHED.get(place).and_then(|&index| sampler.slot(index)).is_some_and(Slot::is_lossy);
        match self.seems_silent(place, t, sampler) {
            Truth::True if lossy() => Truth::Unknown,
            silent => silent,
        }
    }

    /// The same by all that was recorded, as if the recorder lost nothing.
    pub(crate) fn seems_silent(&self, place: usize, t: i64, sampler: &Sampler) -> Truth {
        let Some(limit) = self.limit else { return Truth::False };
        match (self.valid_at.get(place), Self::heard_at(place, sampler)) {
            (Some(Some(valid)), _) if t - valid < limit - self.window => Truth::False,
            (_, Some(last)) if t - last < limit + self.window => Truth::Unknown,
            (_, Some(_)) if self.others_come(place, t, sampler) => Truth::True,
            _ => Truth::Unknown,
        }
    }

    /// Whether a VCU watches the messages, and has for long enough. One that does not yet may from its next step on, and a
    /// silence counts from before that.
    //= D-52
    pub(crate) fn is_watching(&self, t: i64, tsms: Truth) -> Truth {
        let enough = self.limit.unwrap_or_default() + self.window;
        let long = self.on_since.is_some_and(|since| t - since >= enough);
        if self.always || tsms == Truth::True && long { Truth::True } else { Truth::Unknown }
    }

    /// Whether communication is lost because a message is missed.
    pub(crate) fn is_missed(&mut self, t: i64, tsms: Truth, sampler: &Sampler) -> Truth {
        self.on_since = if tsms == Truth::True { self.on_since.or(Some(t)) } else { None };
        if t >= self.none_until {
            let each = (0..WATCHED.len()).map(|place| self.is_silent(place, t, sampler));
            self.silent = each.fold(Truth::False, Truth::or);
            let first = self.valid_at.iter().flatten().min().filter(|_| self.silent == Truth::False);
            self.none_until = match (self.limit, first) {
                (Some(limit), Some(first)) => first + limit - self.window,
                (None, _) => i64::MAX,
                _ => i64::MIN,
            };
        }
        self.is_watching(t, tsms).and(self.silent)
    }

    /// When a silence changes what is known, after this time.
    pub(crate) fn next(&self, after: i64, sampler: &Sampler) -> i64 {
        if self.silent == Truth::False {
            return self.none_until;
        }
        let Some(limit) = self.limit else { return i64::MAX };
        let (sure, certain) = (limit - self.window, limit + self.window);
        let valid = self.valid_at.iter().flatten().map(|at| at + sure);
        let heard =
            (0..WATCHED.len()).filter_map(|place| Self::heard_at(place, sampler)).map(|at| at + certain);
        let on = self.on_since.map(|at| at + certain);
        valid.chain(heard).chain(on).filter(|&at| at > after).min().unwrap_or(i64::MAX)
    }
}
