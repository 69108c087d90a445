//! States that lasted longer in one recording than in the other.

use adsdv_spec::AsState;

use super::{Aligned, Path, differs};

/// A difference below this is how long people take for a switch, or how frames come.
const SHORTEST_NS: i64 = 100_000_000;

/// A state that both recordings were in, one after the same transitions as the other, for different times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LastedDiffers {
    /// The state.
    pub state: AsState,
    /// Since when it lasted, in nanoseconds since the first frame: in the good one, and in the bad one.
    pub since_ns: [i64; 2],
    /// How long it lasted in each.
    pub for_ns: [i64; 2],
}

impl LastedDiffers {
    /// How much longer it lasted in one of them.
    pub const fn by_ns(&self) -> i64 {
        (self.for_ns[0] - self.for_ns[1]).abs()
    }
}

/// The states that began and ended with the same transitions in both. One that a recording begins or ends in lasted longer.
pub(super) fn between(paths: &[Path<'_>; 2], steps: &[Aligned]) -> Vec<LastedDiffers> {
    let [good, bad] = paths;
    let pairs = steps.iter().zip(steps.iter().skip(1));
    let whole = pairs.filter_map(|(begins, ends)| match (begins, ends) {
        (Aligned::Both(i, j), Aligned::Both(..)) => Some((i + 1, j + 1)),
        _ => None,
    });
    let lasted = whole.filter_map(|(i, j)| {
        let ([first, last], [other_first, other_last]) = (good.at(i)?, bad.at(j)?);
        let since_ns = [first.since_ns, other_first.since_ns];
        let for_ns = [last.until_ns - first.since_ns, other_last.until_ns - other_first.since_ns];
        Some(LastedDiffers { state: first.state, since_ns, for_ns })
    });
    #[allow(clippy::cast_precision_loss, reason = "a share of a duration")]
    let matters = |lasted: &LastedDiffers| {
        lasted.by_ns() > SHORTEST_NS && differs(lasted.for_ns[0] as f64, lasted.for_ns[1] as f64)
    };
    let mut lasted: Vec<_> = lasted.filter(matters).collect();
    lasted.sort_by_key(|lasted| -lasted.by_ns());
    lasted
}
