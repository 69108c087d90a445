//! What went over a bus: how many frames, how fast, and what was wrong.

use adsdv_oracle::candump::FrameKind;

use crate::bus::Disturbance;

/// The second in which frames are counted moves on in steps of this length.
const STEP_NS: i64 = 100_000_000;
/// The steps of a second.
const STEPS: usize = 10;

/// So many troubles are kept; more are counted.
const MAX_OUTAGES: usize = 1000;

/// What went over the bus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Frames of every kind.
    pub frames: u64,
    /// Error frames among them.
    pub errors: u64,
    /// Frames that the kernel dropped because they were not taken in time.
    pub dropped: u64,
    /// How often something went wrong with the bus.
    pub troubles: u64,
    /// The most frames that came within a second. The second may begin at any tenth of one: what is counted came within one
    /// indeed, and at most a tenth of a busier one is missing.
    pub busiest: u64,
    last_second: LastSecond,
}

impl Traffic {
    /// Another frame, of this kind, came at this time, in nanoseconds.
    pub fn count(&mut self, kind: FrameKind, time_ns: i64) {
        self.frames += 1;
        self.errors += u64::from(kind == FrameKind::Error);
        self.busiest = self.busiest.max(self.last_second.count(time_ns));
    }
}

/// The frames of the last second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct LastSecond {
    /// The frames of its steps; the current one stands at its number modulo their count.
    steps: [u64; STEPS],
    /// The sum of them.
    sum: u64,
    /// The number of the current step since 1970.
    now: i64,
}

impl LastSecond {
    /// Another frame; tells how many came in the last second.
    fn count(&mut self, time_ns: i64) -> u64 {
        let now = time_ns.div_euclid(STEP_NS);
        if now != self.now {
            self.move_on(now);
        }
        if let Some(step) = self.steps.get_mut(place(now)) {
            *step += 1;
        }
        self.sum += 1;
        self.sum
    }

    fn move_on(&mut self, now: i64) {
        match usize::try_from(now.saturating_sub(self.now)) {
            Ok(by) if by < STEPS => {
                for number in self.now + 1..=now {
                    if let Some(step) = self.steps.get_mut(place(number)) {
                        self.sum -= std::mem::take(step);
                    }
                }
            }
            // Nothing for a second, or a clock that was set back: it begins anew.
            _ => *self = Self::default(),
        }
        self.now = now;
    }
}

/// Where the step of this number stands.
fn place(number: i64) -> usize {
    usize::try_from(number.unsigned_abs() % STEPS as u64).unwrap_or(0)
}

/// A time in which something was wrong with the bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outage {
    /// When it was noticed, in nanoseconds since the first frame; 0 if that was before it.
    pub t_ns: i64,
    /// What was wrong.
    pub trouble: Disturbance,
    /// When the bus was there again, likewise; `None` if it was not.
    pub until_ns: Option<i64>,
}

/// The troubles of a bus, in order; of very many the first.
#[derive(Debug, Default)]
pub(super) struct Outages(Vec<Outage>);

impl Outages {
    pub(super) fn begin(&mut self, t_ns: i64, trouble: &Disturbance) {
        if self.0.len() < MAX_OUTAGES {
            self.0.push(Outage { t_ns, trouble: trouble.clone(), until_ns: None });
        }
    }

    /// The bus is there again: everything that was wrong is over.
    pub(super) fn end(&mut self, t_ns: i64) {
        for outage in self.0.iter_mut().rev().take_while(|outage| outage.until_ns.is_none()) {
            outage.until_ns = Some(t_ns);
        }
    }

    pub(super) fn all(&self) -> &[Outage] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const S: i64 = 1_000_000_000;

    fn busiest(times: impl IntoIterator<Item = i64>) -> u64 {
        let mut traffic = Traffic::default();
        for time_ns in times {
            let kind = FrameKind::Standard;
            traffic.count(kind, time_ns);
        }
        traffic.busiest
    }

    #[test]
    fn a_burst_is_counted_whole_wherever_it_lies() {
        for begin in (0..2000).step_by(37) {
            // 100 frames a second for four seconds, and 1000 more within half a second.
            let even = (0..400).map(|frame| frame * S / 100);
            let burst = (0..1000).map(|frame| begin * S / 1000 + frame * S / 2000);
            let mut times: Vec<i64> = even.chain(burst).map(|time| 1_795_209_995 * S + time).collect();
            times.sort_unstable();
            let found = busiest(times);
            assert!((1090..=1100).contains(&found), "{found} from {begin} ms on");
        }
    }

    #[test]
    fn no_second_has_more_than_came_in_one() {
        assert_eq!(busiest([0, S - 1]), 2);
        assert_eq!(busiest([0, S]), 1);
        assert_eq!(busiest([0, 5 * S, 5 * S + 1, 5 * S + 2]), 3);
        // A clock that was set back, and one that was set far.
        assert_eq!(busiest([5 * S, 2 * S, 2 * S + 1]), 2);
        assert_eq!(busiest([-S, 0, i64::MAX, i64::MIN]), 1);
    }

    #[test]
    fn an_outage_ends_when_the_bus_is_there_again() {
        let mut outages = Outages::default();
        outages.begin(5, &Disturbance::Down);
        outages.begin(6, &Disturbance::Gone);
        outages.end(9);
        outages.begin(12, &Disturbance::BusOff);
        let until: Vec<_> = outages.all().iter().map(|outage| (outage.t_ns, outage.until_ns)).collect();
        assert_eq!(until, [(5, Some(9)), (6, Some(9)), (12, None)]);
        (0..2000).for_each(|t| outages.begin(20 + t, &Disturbance::Full));
        assert_eq!(outages.all().len(), MAX_OUTAGES);
    }
}
