//! The worst of each measure so far.

use adsdv_spec::Fault;

use crate::judge::estimator::readings::WayOut;
use crate::judge::sampler::places;

/// What is forbidden to the AI Computer while the vehicle is moving.
pub(in crate::judge) const AT_SPEED: [Fault; 2] = [Fault::MissionStatusFault, Fault::AutonomousBrakingFault];

/// A value with the time at which it was seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Peak {
    pub(super) value: i64,
    pub(super) t: i64,
}

/// Keeps the higher of two values, the first of equal ones.
pub(super) fn raise(kept: &mut Option<Peak>, peak: Peak) {
    if kept.is_none_or(|kept| peak.value > kept.value) {
        *kept = Some(peak);
    }
}

/// Keeps the lower one.
pub(super) fn lower(kept: &mut Option<Peak>, peak: Peak) {
    if kept.is_none_or(|kept| peak.value < kept.value) {
        *kept = Some(peak);
    }
}

/// How long the way to EMERGENCY_BRAKE took, and what led there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reaction {
    pub(super) took: Peak,
    pub(super) way: WayOut,
    pub(super) from: adsdv_spec::AsState,
}

/// AS_DRIVING was entered, and it is not judged yet whether rightly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Go {
    pub(super) t: i64,
    /// The steer angle to either side, in raw steps.
    pub(super) angle: Option<i64>,
    /// How long AS_READY may have lasted, in nanoseconds.
    pub(super) dwell: Option<i64>,
}

/// What is kept for the margins. Times are in nanoseconds, speeds and angles in raw steps.
#[derive(Debug, Default)]
pub(in crate::judge) struct Kept {
    pub(super) answer: Option<Peak>,
    /// The longest time between two frames of each message.
    pub(super) gaps: [Peak; places::COUNT],
    /// When a time ended in which no frame came at all: what lasted longer, the recorder may have made.
    pub(super) whole_since: Option<i64>,
    pub(super) slowest: Option<Reaction>,
    pub(super) fastest: Option<Reaction>,
    /// What was due before the frame that shows a change of state: since when, and whether that was reported.
    pub(in crate::judge) due: Option<(i64, WayOut, bool)>,
    /// The highest speeds at FINISHED and at NEUTRAL.
    pub(super) speeds: [Option<Peak>; 2],
    /// Those past the limit, as long as they are not judged.
    pub(super) too_fast: [Option<Peak>; 2],
    /// When AS_READY was entered at the earliest, while the VCU is in it.
    pub(super) ready_since: Option<i64>,
    pub(super) going: Option<Go>,
    pub(super) angle: Option<Peak>,
    pub(super) dwell: Option<Peak>,
}

impl Kept {
    /// How long the longest time between two frames of a message was.
    #[inline]
    pub(in crate::judge) fn longest_gap(&self, index: usize) -> i64 {
        self.gaps.get(index).map_or(i64::MAX, |gap| gap.value)
    }

    /// A time in which no frame came at all goes on until `t`.
    pub(in crate::judge) fn silent_until(&mut self, t: i64) {
        self.whole_since = Some(t);
    }

    /// A frame of a message came, or was reported to be missing, this long after the one before.
    pub(in crate::judge) fn gap(&mut self, index: usize, gap: i64, t: i64) {
        if let Some(kept) = self.gaps.get_mut(index).filter(|kept| gap > kept.value) {
            *kept = Peak { value: gap, t };
        }
    }

    /// The AI Computer answered the handshake after this time, or has not for as long.
    pub(in crate::judge) fn answered(&mut self, t: i64, after: i64) {
        raise(&mut self.answer, Peak { value: after, t });
    }

    pub(super) fn reacted(&mut self, reaction: Reaction) {
        let took = reaction.took.value;
        if self.slowest.is_none_or(|kept| took > kept.took.value) {
            self.slowest = Some(reaction);
        }
        if self.fastest.is_none_or(|kept| took < kept.took.value) {
            self.fastest = Some(reaction);
        }
    }

    /// Something past the limit was reported: it counts.
    pub(super) fn is_too_fast(&mut self, index: usize) {
        let peak = self.too_fast.get_mut(index).and_then(Option::take);
        if let (Some(peak), Some(kept)) = (peak, self.speeds.get_mut(index)) {
            raise(kept, peak);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_equal_values_the_first_is_kept() {
        for keeps in [raise, lower] {
            let mut kept = None;
            for t in 0..3 {
                keeps(&mut kept, Peak { value: 7, t });
            }
            assert_eq!(kept.map(|kept| kept.t), Some(0));
        }
    }
}
