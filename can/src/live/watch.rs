//! The judge of a live bus: what is told to it comes from a bus, and not from a log.

use adsdv_oracle::candump::FrameKind;
use adsdv_oracle::judge::{Finding, Report, Transition};
use adsdv_oracle::log::{LogError, LogJudge, LogOptions};

use crate::bus::{Received, Trouble};

/// A frame is told within this time after the kernel had it, or there is none: so long after, silence is told to the judge.
const DELAY_NS: i64 = 100_000_000;

/// What candump writes is as fine as this, in nanoseconds. The judge sees no more than the log will have.
const LOGGED_NS: i64 = 1000;

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
    /// The most frames that came in a second.
    pub busiest: u64,
    /// The frames of the second that has begun, and when it did, in nanoseconds since 1970.
    second: (u64, i64),
}

/// The judge of a live bus. It is told what comes, and never sends.
///
/// What it says is what [`judge_log`](adsdv_oracle::log::judge_log) says of the same frames in a log, and it says it as soon as
/// it is certain, also while nothing comes.
#[derive(Debug)]
pub struct Watch {
    judge: LogJudge,
    bus: String,
    traffic: Traffic,
    /// When the first frame came.
    first_ns: Option<i64>,
}

impl Watch {
    /// The judge of a bus of this name.
    pub fn new(bus: &str, options: LogOptions) -> Self {
        Self {
            judge: LogJudge::new(options),
            bus: bus.to_owned(),
            traffic: Traffic::default(),
            first_ns: None,
        }
    }

    /// A frame came. Returns it as the log is to have it.
    pub fn frame(&mut self, frame: &Received) -> Received {
        let time_ns = frame.time_ns.max(0);
        let frame = Received { time_ns: time_ns - time_ns % LOGGED_NS, ..*frame };
        self.first_ns.get_or_insert(frame.time_ns);
        self.traffic.count(&frame);
        self.judge.frame(&frame.record(&self.bus));
        frame
    }

    /// Nothing has come up to this time, in nanoseconds since 1970.
    pub fn silence(&mut self, now_ns: i64) {
        self.judge.time_passes(now_ns.saturating_sub(DELAY_NS));
    }

    /// Something went wrong with the bus.
    pub fn trouble(&mut self, _trouble: &Trouble) {
        self.traffic.troubles += 1;
    }

    /// The kernel has dropped so many frames so far, the last of them before the next frame. What they said is unknown to the
    /// judge, and so it does not take what follows for an answer to what came before.
    pub fn dropped(&mut self, dropped: u64) {
        let more = dropped.saturating_sub(self.traffic.dropped);
        if more > 0 {
            self.judge.lost(more);
        }
        self.traffic.dropped = dropped;
    }

    /// The transitions and findings that are new since this was last asked.
    pub fn news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.judge.news()
    }

    /// A time of the frames' clock, in nanoseconds since the first frame, as in transitions and findings; 0 before it.
    pub fn since_first(&self, time_ns: i64) -> i64 {
        self.first_ns.map_or(0, |first| time_ns.saturating_sub(first).max(0))
    }

    /// What went over the bus so far.
    pub fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// The end: what is still open is settled.
    pub fn finish(self) -> Result<Report, LogError> {
        self.judge.finish(0)
    }
}

impl Traffic {
    fn count(&mut self, frame: &Received) {
        self.frames += 1;
        self.errors += u64::from(frame.kind == FrameKind::Error);
        let (count, since) = &mut self.second;
        // A clock that was set back begins a new second as well.
        if !(0..1_000_000_000).contains(&(frame.time_ns - *since)) {
            (*count, *since) = (0, frame.time_ns);
        }
        *count += 1;
        self.busiest = self.busiest.max(*count);
    }
}
