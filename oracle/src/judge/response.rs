//! How fast the AI Computer answers the handshake (section 2.4): a histogram, so that memory does not grow.

/// The resolution, in nanoseconds.
const STEP_NS: i64 = 10_000;
/// Answers of this many steps and more are counted as one group, with the exact maximum kept beside it.
const STEPS: usize = 20_000;

/// Response times of the AI Computer, with a resolution of 0.01 ms.
///
/// ```
/// use adsdv_oracle::judge::ResponseTimes;
/// let mut times = ResponseTimes::default();
/// for ms in 1..=100 { times.add(ms * 1_000_000); }
/// assert_eq!((times.min_ms(), times.quantile_ms(0.5), times.max_ms()), (Some(1.0), Some(50.0), Some(100.0)));
/// assert_eq!(times.quantile_ms(0.99), Some(99.0));
/// ```
#[derive(Clone, Debug)]
pub struct ResponseTimes {
    counts: Vec<u32>,
    count: u64,
    min_ns: i64,
    max_ns: i64,
}

impl Default for ResponseTimes {
    fn default() -> Self {
        Self { counts: vec![0; STEPS + 1], count: 0, min_ns: i64::MAX, max_ns: 0 }
    }
}

impl ResponseTimes {
    /// Counts one answer.
    pub fn add(&mut self, ns: i64) {
        let ns = ns.max(0);
        let step = usize::try_from(ns / STEP_NS).unwrap_or(STEPS).min(STEPS);
        if let Some(count) = self.counts.get_mut(step) {
            *count = count.saturating_add(1);
        }
        self.count += 1;
        self.min_ns = self.min_ns.min(ns);
        self.max_ns = self.max_ns.max(ns);
    }

    /// How many answers were counted.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The fastest answer in milliseconds; `None` if there was none.
    pub fn min_ms(&self) -> Option<f64> {
        (self.count > 0).then(|| ms(self.min_ns))
    }

    /// The slowest answer in milliseconds; `None` if there was none.
    pub fn max_ms(&self) -> Option<f64> {
        (self.count > 0).then(|| ms(self.max_ns))
    }

    /// The time within which this share of the answers came, in milliseconds; `None` if there was none. Beyond 200 ms it is the
    /// slowest of all.
    pub fn quantile_ms(&self, share: f64) -> Option<f64> {
        if self.count == 0 {
            return None;
        }
        #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let rank = ((self.count as f64 * share).ceil() as u64).clamp(1, self.count);
        let mut seen = 0;
        for (step, &count) in (0_i64..).zip(&self.counts).take(STEPS) {
            seen += u64::from(count);
            if seen >= rank {
                return Some(ms((step * STEP_NS).clamp(self.min_ns, self.max_ns)));
            }
        }
        self.max_ms()
    }
}

/// Measures each answer, from the VCU's edge to the first frame of the AI Computer that shows the same bit.
///
/// Unlike the watch that judges, it measures whatever the log shows: leaving out what is not certain would leave out
/// the slow answers.
///
/// ```
/// use adsdv_oracle::judge::Meter;
///
/// let mut meter = Meter::default();
/// meter.vcu(0, false);
/// meter.ai(1_000_000, false);
/// meter.vcu(10_000_000, true);
/// assert_eq!(meter.ai(12_000_000, false), None);
/// assert_eq!(meter.ai(14_000_000, true), Some(4_000_000));
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter {
    vcu: Option<bool>,
    edge_at: Option<i64>,
    ai_was_heard: bool,
}

impl Meter {
    /// The VCU's HANDSHAKE bit was seen, at this time in nanoseconds.
    pub fn vcu(&mut self, now: i64, bit: bool) {
        let before = self.vcu.replace(bit);
        if before != Some(bit) {
            // Nobody answers who is not there yet.
            self.edge_at = before.filter(|_| self.ai_was_heard).map(|_| now);
        }
    }

    /// The AI Computer's HANDSHAKE bit was seen: tells the response time in nanoseconds if this is the answer.
    pub fn ai(&mut self, now: i64, bit: bool) -> Option<i64> {
        self.ai_was_heard = true;
        //= HS-11
        if self.vcu == Some(bit) { self.edge_at.take().map(|edge| now - edge) } else { None }
    }

    /// The VCU was silent: its bit may have changed meanwhile.
    pub fn restart(&mut self) {
        self.vcu = None;
        self.edge_at = None;
    }
}

#[allow(clippy::cast_precision_loss, reason = "a duration for display")]
fn ms(ns: i64) -> f64 {
    ns as f64 / 1e6
}
