//! What the AI Computer requested while a state lasted, where that differs.

use adsdv_spec::AsState;

use super::collect::{Collected, Range, Requests, Sequence};
use super::differs;

/// A request that had another range in a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeDiffers {
    /// The state.
    pub state: AsState,
    /// Whether the good one had been in that state before.
    pub again: bool,
    /// The range in the good recording; `None`: the message did not come in that state.
    pub good: Option<Range>,
    /// That in the bad one.
    pub bad: Option<Range>,
}

/// Something that the AI Computer says in 510h, of which it said other values in a state, or in another order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SequenceDiffers<'a> {
    /// The state.
    pub state: AsState,
    /// Whether the good one had been in that state before.
    pub again: bool,
    /// The values in the good recording.
    pub good: &'a Sequence,
    /// Those in the bad one.
    pub bad: &'a Sequence,
}

/// What was requested in one and the same state of both.
#[derive(Clone, Copy)]
struct Pair<'a> {
    again: bool,
    good: &'a Requests,
    bad: &'a Requests,
}

/// The states at these places of both recordings.
fn pairs<'a>([good, bad]: [&'a Collected; 2], places: &[(usize, usize)]) -> impl Iterator<Item = Pair<'a>> {
    places.iter().filter_map(|&(i, j)| {
        let (one, other) = (good.requests.get(i)?, bad.requests.get(j)?);
        let again = good.requests.iter().take(i).any(|before| before.state == one.state);
        (one.state == other.state).then_some(Pair { again, good: one, bad: other })
    })
}

/// The ranges that differ.
pub(super) fn ranges(collected: [&Collected; 2], places: &[(usize, usize)]) -> Vec<RangeDiffers> {
    let mut differ = Vec::new();
    for Pair { again, good, bad } in pairs(collected, places) {
        let of = |requests: &Requests, field: &str| {
            requests.ranges.iter().find(|range| range.signal.field == field).copied()
        };
        let more = bad.ranges.iter().filter(|range| of(good, range.signal.field).is_none());
        for range in good.ranges.iter().chain(more) {
            let (one, other) = (of(good, range.signal.field), of(bad, range.signal.field));
            let matters = if let (Some(one), Some(other)) = (one, other) {
                let mut ends = one.physical().into_iter().zip(other.physical());
                ends.any(|(one, other)| differs(one, other))
            } else {
                // Where the message never came, or the state was over soon, there is nothing to compare.
                let heard = !good.ranges.is_empty() && !bad.ranges.is_empty();
                heard && collected.iter().all(|collected| collected.ids.contains_key(&range.id.into()))
            };
            if matters {
                differ.push(RangeDiffers { state: good.state, again, good: one, bad: other });
            }
        }
    }
    differ
}

/// The sequences that differ, of AI Computers that both were heard.
pub(super) fn sequences<'a>(
    collected: [&'a Collected; 2],
    places: &[(usize, usize)],
) -> Vec<SequenceDiffers<'a>> {
    let mut differ = Vec::new();
    for Pair { again, good, bad } in pairs(collected, places) {
        for one in &good.sequences {
            let other = bad.sequences.iter().find(|other| other.signal.field == one.signal.field);
            let matters = |other: &&Sequence| (&one.values, one.more) != (&other.values, other.more);
            if let Some(other) = other.filter(matters) {
                differ.push(SequenceDiffers { state: good.state, again, good: one, bad: other });
            }
        }
    }
    differ
}
