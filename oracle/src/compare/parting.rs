//! Where two recordings part: the first state that both come to and do not leave alike.

use adsdv_spec::AsState;

use super::{Path, Recording, Which};
use crate::judge::Transition;
use crate::why::{Stay, Untaken};

/// The first state that both recordings come to, one after the same states as the other, and leave for different ones, or that
/// one of them does not leave.
#[derive(Debug)]
pub struct Parting<'a> {
    /// The state.
    pub state: AsState,
    /// How the good one went on.
    pub good: Way<'a>,
    /// How the bad one did.
    pub bad: Way<'a>,
}

/// How a recording goes on from a state.
#[derive(Debug)]
pub struct Way<'a> {
    /// Since when the state lasted, in nanoseconds since the first frame.
    pub since_ns: i64,
    /// Until when.
    pub until_ns: i64,
    /// The state behind it; `None`: the recording ends in it.
    pub to: Option<AsState>,
    /// The transition there, if it was seen.
    pub transition: Option<&'a Transition>,
    /// The stay in the state that ended so.
    pub stay: &'a Stay,
}

impl<'a> Way<'a> {
    /// The arrow to another state, which was not taken here.
    pub fn untaken(&self, to: AsState) -> Option<&'a Untaken> {
        self.stay.arrows.iter().find(|untaken| untaken.to == to)
    }
}

impl<'a> Parting<'a> {
    /// The state that the good recording goes on to, and the bad one does not; if that one ends, the other way round.
    pub fn missed(&self) -> Option<(Which, AsState)> {
        match (self.good.to, self.bad.to) {
            (Some(to), _) => Some((Which::Bad, to)),
            (None, to) => to.map(|to| (Which::Good, to)),
        }
    }

    /// The way of one of the two.
    pub const fn way(&self, which: Which) -> &Way<'a> {
        match which {
            Which::Good => &self.good,
            Which::Bad => &self.bad,
        }
    }
}

/// The first place at which the recordings part, of those that both come to.
pub(super) fn find<'a>(
    recordings: [&'a Recording; 2],
    paths: &[Path<'a>; 2],
    places: &[(usize, usize)],
) -> Option<Parting<'a>> {
    places.iter().find_map(|&(i, j)| {
        let good = way(recordings[0], &paths[0], i)?;
        let bad = way(recordings[1], &paths[1], j)?;
        (good.to != bad.to).then_some(Parting { state: good.stay.state, good, bad })
    })
}

fn way<'a>(recording: &'a Recording, path: &Path<'a>, place: usize) -> Option<Way<'a>> {
    let [first, last] = path.at(place)?;
    let next = path.at(place + 1).map(|[next, _]| next);
    let to = next.map(|next| next.state);
    let taken = |transition: &&Transition| {
        Some(transition.to) == to
            && transition.from == last.state
            && next.is_some_and(|next| next.since_ns == transition.t_ns)
    };
    let transition = recording.report.transitions.iter().find(taken);
    Some(Way { since_ns: first.since_ns, until_ns: last.until_ns, to, transition, stay: last })
}
