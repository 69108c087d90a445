//! The way from state to state, and what two of them have in common.

use adsdv_spec::AsState;

use super::Which;
use crate::judge::Report;
use crate::why::Stay;

/// The states that the VCU was in, one after the other. A state that it shows again after a silence is one.
#[derive(Debug)]
pub struct Path<'a> {
    /// Each state, with the first and the last stay that are part of it.
    pub(super) states: Vec<[&'a Stay; 2]>,
}

impl<'a> Path<'a> {
    /// The path that a report tells of.
    pub fn of(report: &'a Report) -> Self {
        let mut states: Vec<[&Stay; 2]> = Vec::new();
        for stay in &report.stays {
            match states.last_mut() {
                Some([_, last]) if last.state == stay.state => *last = stay,
                _ => states.push([stay, stay]),
            }
        }
        Self { states }
    }

    /// From each state to the next.
    pub fn transitions(&self) -> Vec<(AsState, AsState)> {
        let state = |[stay, _]: &[&Stay; 2]| stay.state;
        self.states
            .iter()
            .zip(self.states.iter().skip(1))
            .map(|(from, to)| (state(from), state(to)))
            .collect()
    }

    /// The state after so many transitions.
    pub(super) fn at(&self, place: usize) -> Option<[&'a Stay; 2]> {
        self.states.get(place).copied()
    }
}

/// The places of the states that both come to, one after the same transition as the other. The first ones are, if they are the same.
pub(super) fn in_both(paths: &[Path<'_>; 2], steps: &[Aligned]) -> Vec<(usize, usize)> {
    let first = |path: &Path<'_>| path.at(0).map(|[stay, _]| stay.state);
    let begin = (first(&paths[0]) == first(&paths[1])).then_some((0, 0));
    let reached = steps.iter().filter_map(|step| match *step {
        Aligned::Both(i, j) => Some((i + 1, j + 1)),
        Aligned::Only(..) => None,
    });
    let mut places: Vec<(usize, usize)> = begin.into_iter().chain(reached).collect();
    if places.is_empty() {
        // They have no transition in common: the first state that both come to will do.
        let [good, bad] = paths;
        let alike = |(i, j): &(usize, usize)| {
            good.at(*i).map(|[stay, _]| stay.state) == bad.at(*j).map(|[stay, _]| stay.state)
        };
        let all = (0..good.states.len()).flat_map(|i| (0..bad.states.len()).map(move |j| (i, j)));
        places.extend(all.into_iter().find(alike));
    }
    places
}

/// The states that the recordings begin in, if these differ.
pub(super) fn begin(paths: &[Path<'_>; 2]) -> Option<[AsState; 2]> {
    let [good, bad] = paths;
    let states = [good.at(0)?[0].state, bad.at(0)?[0].state];
    (states[0] != states[1]).then_some(states)
}

/// What becomes of the next element of two sequences.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aligned {
    /// Both have it, at these places.
    Both(usize, usize),
    /// Only one has it, at this place.
    Only(Which, usize),
}

/// Aligns two sequences: with as much in common as they have, from the beginning on. What only the good one has comes before what
/// only the bad one has.
///
/// ```
/// use adsdv_oracle::compare::{Aligned, Which, align};
///
/// let steps = align(b"abd", b"acbd");
/// assert_eq!(steps, [Aligned::Both(0, 0), Aligned::Only(Which::Bad, 1), Aligned::Both(1, 2), Aligned::Both(2, 3)]);
/// ```
pub fn align<T: PartialEq>(good: &[T], bad: &[T]) -> Vec<Aligned> {
    let same = good.iter().zip(bad).take_while(|(good, bad)| good == bad).count();
    let mut steps: Vec<Aligned> = (0..same).map(|place| Aligned::Both(place, place)).collect();
    let (rest_good, rest_bad) = (good.get(same..).unwrap_or_default(), bad.get(same..).unwrap_or_default());
    let common = in_common(rest_good, rest_bad);
    let common =
        |good: usize, bad: usize| common.get(good).and_then(|row| row.get(bad)).copied().unwrap_or(0);
    let (mut i, mut j) = (0, 0);
    loop {
        steps.push(match (rest_good.get(i), rest_bad.get(j)) {
            (None, None) => break,
            (Some(one), Some(other)) if one == other => {
                (i, j) = (i + 1, j + 1);
                Aligned::Both(same + i - 1, same + j - 1)
            }
            (Some(_), other) if other.is_none() || common(i + 1, j) >= common(i, j + 1) => {
                i += 1;
                Aligned::Only(Which::Good, same + i - 1)
            }
            _ => {
                j += 1;
                Aligned::Only(Which::Bad, same + j - 1)
            }
        });
    }
    in_order(steps)
}

/// Between two steps that both have, what only the good one has first.
fn in_order(mut steps: Vec<Aligned>) -> Vec<Aligned> {
    let alone = |step: &Aligned| matches!(step, Aligned::Only(..));
    for run in steps.chunk_by_mut(|one, other| alone(one) && alone(other)) {
        run.sort_by_key(|step| match step {
            Aligned::Both(..) => None,
            Aligned::Only(which, _) => Some(*which),
        });
    }
    steps
}

/// How much the sequences have in common from each pair of places on. There are no more of them than a report lists.
fn in_common<T: PartialEq>(good: &[T], bad: &[T]) -> Vec<Vec<u16>> {
    let mut rows = vec![vec![0_u16; bad.len() + 1]];
    for one in good.iter().rev() {
        let mut row = vec![0; bad.len() + 1];
        let below = rows.last().map(Vec::as_slice).unwrap_or_default();
        for (place, other) in bad.iter().enumerate().rev() {
            let at = |row: &[u16], place: usize| row.get(place).copied().unwrap_or_default();
            let most = if one == other {
                at(below, place + 1) + 1
            } else {
                at(below, place).max(at(&row, place + 1))
            };
            if let Some(entry) = row.get_mut(place) {
                *entry = most;
            }
        }
        rows.push(row);
    }
    rows.reverse();
    rows
}

/// A transition that only one of the two has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OnlyTransition {
    /// The one that has it.
    pub which: Which,
    /// When, in nanoseconds since its first frame.
    pub t_ns: i64,
    /// The state before.
    pub from: AsState,
    /// The state after.
    pub to: AsState,
}

/// The transitions that only one has, in order.
pub(super) fn only_one(paths: &[Path<'_>; 2], steps: &[Aligned]) -> Vec<OnlyTransition> {
    let [good, bad] = paths;
    let only = |step: &Aligned| {
        let Aligned::Only(which, place) = *step else { return None };
        let path = if which == Which::Good { good } else { bad };
        let ([from, _], [to, _]) = (path.at(place)?, path.at(place + 1)?);
        Some(OnlyTransition { which, t_ns: to.since_ns, from: from.state, to: to.state })
    };
    steps.iter().filter_map(only).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The steps as text: what both have in small letters, what only one has behind its sign.
    fn steps(good: &str, bad: &str) -> String {
        let text = |step| match step {
            Aligned::Both(i, j) => {
                assert_eq!(good.as_bytes()[i], bad.as_bytes()[j]);
                good[i..=i].to_owned()
            }
            Aligned::Only(Which::Good, place) => format!("-{}", &good[place..=place]),
            Aligned::Only(Which::Bad, place) => format!("+{}", &bad[place..=place]),
        };
        align(good.as_bytes(), bad.as_bytes()).into_iter().map(text).collect()
    }

    #[test]
    fn sequences_are_aligned_with_as_much_in_common_as_they_have() {
        for (good, bad, expected) in [
            ("", "", ""),
            ("abc", "abc", "abc"),
            ("abcd", "ab", "ab-c-d"),
            ("", "ab", "+a+b"),
            ("abcd", "abx", "ab-c-d+x"),
            ("bcd", "abcd", "+abcd"),
            ("abcd", "xcy", "-a-b+xc-d+y"),
            ("abcdef", "abxbcdef", "ab+x+bcdef"),
            ("abc", "xyz", "-a-b-c+x+y+z"),
        ] {
            assert_eq!(steps(good, bad), expected, "{good:?} and {bad:?}");
        }
    }

    #[test]
    fn the_longest_sequences_of_a_report_are_aligned_in_time() {
        let good: Vec<usize> = (0..999).collect();
        let bad: Vec<usize> = (0..999).rev().collect();
        let both = align(&good, &bad).into_iter().filter(|step| matches!(step, Aligned::Both(..))).count();
        assert_eq!(both, 1);
    }
}
