//! Identifiers that only one recording has, or that come otherwise, and how fast the handshake was answered.

use super::{Collected, Recording, Seen, Which, differs};
use crate::judge::ResponseTimes;

/// An identifier whose frames differ.
#[derive(Clone, Debug)]
pub struct FrameDiffers {
    /// The identifier.
    pub id: u32,
    /// The name of the message, if one of the editions has it.
    pub name: Option<&'static str>,
    /// The recording that has it, if only one does.
    pub only: Option<(Which, u64)>,
    /// The median of the time between two frames in milliseconds, if it differs.
    pub cycle_ms: Option<[f64; 2]>,
    /// The lengths in bytes, if they differ: bit n for n bytes.
    pub lengths: Option<[u16; 2]>,
}

/// How fast the AI Computer answered the handshake, where that differs.
#[derive(Clone, Debug)]
pub struct AnswersDiffer {
    /// The times in the good recording and in the bad one.
    pub times: [ResponseTimes; 2],
}

/// The identifiers that differ, in ascending order.
pub(super) fn between(good: &Collected, bad: &Collected) -> Vec<FrameDiffers> {
    let mut ids: Vec<u32> = good.ids.keys().chain(bad.ids.keys()).copied().collect();
    ids.sort_unstable();
    ids.dedup();
    ids.into_iter().filter_map(|id| differ(id, good.ids.get(&id), bad.ids.get(&id))).collect()
}

fn differ(id: u32, good: Option<&Seen>, bad: Option<&Seen>) -> Option<FrameDiffers> {
    let name = good.and_then(|seen| seen.name).or(bad.and_then(|seen| seen.name));
    let same = FrameDiffers { id, name, only: None, cycle_ms: None, lengths: None };
    match (good, bad) {
        (Some(good), Some(bad)) => {
            let cycles = good.cycle.median_ms().zip(bad.cycle.median_ms());
            let cycle_ms = cycles.filter(|(good, bad)| differs(*good, *bad)).map(|(good, bad)| [good, bad]);
            let lengths = (good.lengths != bad.lengths).then_some([good.lengths, bad.lengths]);
            (cycle_ms.is_some() || lengths.is_some()).then_some(FrameDiffers { cycle_ms, lengths, ..same })
        }
        (Some(good), None) => Some(FrameDiffers { only: Some((Which::Good, good.count)), ..same }),
        (None, Some(bad)) => Some(FrameDiffers { only: Some((Which::Bad, bad.count)), ..same }),
        (None, None) => None,
    }
}

/// The answers, where the median or the slowest one in a hundred differs by more than a tenth of a cycle as well.
pub(super) fn answers(good: &Recording, bad: &Recording) -> Option<AnswersDiffer> {
    let times = [&good.report.responses, &bad.report.responses];
    let least = f64::from(good.edition.rules.timing.cycle_ms) / 10.0;
    let differ = |share: f64| match times.map(|times| times.quantile_ms(share)) {
        [Some(one), Some(other)] => differs(one, other) && (one - other).abs() > least,
        [one, other] => one.is_some() != other.is_some(),
    };
    (differ(0.5) || differ(0.99)).then(|| AnswersDiffer { times: times.map(Clone::clone) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of this identifier, so far apart, of this length.
    fn frames(id: u32, apart_ms: i64, len: u16) -> Collected {
        let mut seen = Seen { count: 20, lengths: 1 << len, ..Seen::default() };
        (0..20).for_each(|place| seen.cycle.seen(place * apart_ms * 1_000_000));
        Collected { ids: [(id, seen)].into(), ..Collected::default() }
    }

    #[test]
    fn a_cycle_differs_from_a_fifth_on() {
        let differ = |one, other| between(&frames(1, one, 8), &frames(1, other, 8)).len();
        assert_eq!([differ(10, 10), differ(10, 12), differ(10, 13), differ(13, 10)], [0, 0, 1, 1]);
    }

    #[test]
    fn lengths_and_absent_identifiers_differ() {
        let differences = between(&frames(1, 10, 8), &frames(1, 10, 7));
        assert_eq!(differences.first().and_then(|one| one.lengths), Some([1 << 8, 1 << 7]));
        let differences = between(&frames(1, 10, 8), &frames(2, 10, 8));
        let only: Vec<_> = differences.iter().map(|one| (one.id, one.only)).collect();
        assert_eq!(only, [(1, Some((Which::Good, 20))), (2, Some((Which::Bad, 20)))]);
    }
}
