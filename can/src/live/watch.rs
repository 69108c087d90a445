//! The judge of a live bus: its frames come from a bus, and not from a log.

use adsdv_oracle::candump::Dropped;
use adsdv_oracle::judge::{Finding, Report, Transition};
use adsdv_oracle::log::{LogError, LogJudge, LogOptions};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::Edition;

use super::traffic::{Outage, Outages, Traffic};
use crate::bus::{Disturbance, Received};

/// A frame arrives within this time after the kernel had it, or there is none: so long after, the judge learns of silence.
const DELAY_NS: i64 = 100_000_000;

/// What candump writes is as fine as this, in nanoseconds. The judge sees no more than the log will have.
const LOGGED_NS: i64 = 1000;

/// The judge of a live bus. It gets what comes, and never sends.
///
/// What it says is what [`judge_log`](adsdv_oracle::log::judge_log) says of the log that has what [`frame`](Self::frame) and
/// [`dropped`](Self::dropped) return, and it says it as soon as it is certain, also while nothing comes.
#[derive(Debug)]
pub struct Watch {
    judge: LogJudge,
    bus: String,
    traffic: Traffic,
    outages: Outages,
    /// When the first frame came.
    first_ns: Option<i64>,
}

impl Watch {
    /// The judge of a bus of this name.
    pub fn new(bus: &str, options: LogOptions) -> Self {
        Self::by(bus, LogJudge::new(options))
    }

    /// The judge of a bus that tells by its frames which edition it speaks; the one of the options is for frames that do not.
    ///
    /// It says nothing before it [is known](Self::recognised), then about all that came: see [`LogJudge::recognising`].
    pub fn recognising(bus: &str, options: LogOptions) -> Self {
        Self::by(bus, LogJudge::recognising(options))
    }

    fn by(bus: &str, judge: LogJudge) -> Self {
        Self {
            judge,
            bus: bus.to_owned(),
            traffic: Traffic::default(),
            outages: Outages::default(),
            first_ns: None,
        }
    }

    /// The edition of the interface that is judged by.
    pub const fn edition(&self) -> &Edition {
        self.judge.edition()
    }

    /// Which edition was recognised, and by what, once that is known. `None` before, and where it was not asked for.
    pub const fn recognised(&self) -> Option<&Recognised> {
        self.judge.recognised()
    }

    /// Nothing more is to come: the edition is recognised by the frames that have, where it is not known yet.
    pub fn decide(&mut self) {
        if self.first_ns.is_some() {
            self.judge.decide();
        }
    }

    /// A frame came. Returns it as the log is to have it.
    pub fn frame(&mut self, frame: &Received) -> Received {
        let frame = Received { time_ns: logged(frame.time_ns.max(0)), ..*frame };
        self.first_ns.get_or_insert(frame.time_ns);
        self.traffic.count(frame.kind, frame.time_ns);
        self.judge.frame(&frame.record(&self.bus));
        frame
    }

    /// Nothing has come up to this time, in nanoseconds since 1970.
    pub fn silence(&mut self, now_ns: i64) {
        self.judge.time_passes(logged(now_ns.saturating_sub(DELAY_NS)));
    }

    /// Something went wrong with the bus, at a time in nanoseconds since 1970.
    pub fn trouble(&mut self, now_ns: i64, trouble: &Disturbance) {
        self.traffic.troubles += 1;
        self.outages.begin(self.since_first(now_ns), trouble);
    }

    /// The bus is there again, at a time in nanoseconds since 1970.
    pub fn up(&mut self, now_ns: i64) {
        self.outages.end(self.since_first(now_ns));
    }

    /// The kernel has dropped so many frames so far, the last of them before the next frame. What they said is unknown to the
    /// judge, and so it does not take what follows for an answer to what came before.
    ///
    /// Returns what the log is to have before that frame, so that its reader knows as much; `None` if nothing is new.
    pub fn dropped(&mut self, dropped: u64) -> Option<Dropped<'_>> {
        let count = dropped.checked_sub(self.traffic.dropped).filter(|&count| count > 0)?;
        self.judge.lost(count);
        self.traffic.dropped = dropped;
        Some(Dropped { line: 0, interface: &self.bus, count, total: dropped })
    }

    /// The transitions and findings that are new since this was last asked.
    pub fn news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.judge.news()
    }

    /// The judge of the frames, whatever they come from.
    pub const fn judge(&mut self) -> &mut LogJudge {
        &mut self.judge
    }

    /// A time of the frames' clock, in nanoseconds since the first frame, as in transitions and findings; 0 before it.
    pub fn since_first(&self, time_ns: i64) -> i64 {
        self.first_ns.map_or(0, |first| time_ns.saturating_sub(first).max(0))
    }

    /// What went over the bus so far.
    pub fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// What was wrong with the bus so far, in order. Of very many troubles the first thousand are here, and
    /// [`Traffic::troubles`] counts all.
    pub fn outages(&self) -> &[Outage] {
        self.outages.all()
    }

    /// The end: what is still open is settled.
    ///
    /// # Errors
    ///
    /// Fails if there is nothing to judge: no frame came.
    pub fn finish(self) -> Result<Report, LogError> {
        self.judge.finish(0)
    }
}

/// A time as the log has it.
fn logged(time_ns: i64) -> i64 {
    time_ns - time_ns % LOGGED_NS
}
