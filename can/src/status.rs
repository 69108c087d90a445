//! How a car on a bus stands at this moment: everything that a screen shows.

use std::collections::VecDeque;

use adsdv_oracle::judge::ResponseTimes;
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::messages::{AsState, Node};
use adsdv_spec::{Inputs, Outputs};

use crate::bus::Disturbance;
use crate::car::Missing;
use crate::scenario::Stuck;

/// So many happenings are kept.
pub const KEPT: usize = 200;

/// How the car and its bus stand.
#[derive(Clone, Debug, Default)]
pub struct Status {
    /// The name of the bus.
    pub bus: String,
    /// The version of the edition that the node follows; empty as long as there is no node.
    pub edition: &'static str,
    /// For how long an edge of the HANDSHAKE bit may be unanswered in that edition, in milliseconds.
    pub answer_limit_ms: u64,
    /// What is wrong with the bus; `None` while it is well.
    pub trouble: Option<Disturbance>,
    /// What the VCU sees.
    pub inputs: Inputs,
    /// What the last cycle came to; `None` while the VCU is without power.
    pub outputs: Option<Outputs>,
    /// For how long the state has lasted, in milliseconds.
    pub in_state_ms: u64,
    /// What is missing for the next arrow on the way to `AS_DRIVING`.
    pub missing: Option<Missing>,
    /// For how long no frame of the AI Computer has come, in milliseconds; `None` if none came yet.
    pub ai_silent_ms: Option<u64>,
    /// How fast the AI Computer answers the handshake.
    pub responses: ResponseTimes,
    /// Its last answer, in milliseconds.
    pub last_response_ms: Option<f64>,
    /// The cycles.
    pub cycles: Cycles,
    /// Frames that came.
    pub received: u64,
    /// Frames that were sent.
    pub sent: u64,
    /// Frames that could not be sent.
    pub unsent: u64,
    /// Frames that the kernel dropped because they were not taken in time, as of the last frame that came.
    pub dropped: u64,
    /// Frames of the other node that did not decode: of the AI Computer, to a VCU; of the VCU, to an AI Computer.
    pub refused: u64,
    /// Frames with identifiers of this node that somebody else sent.
    pub foreign: u64,
    /// Error frames.
    pub errors: u64,
    /// The speed of the vehicle, in metres per second.
    pub speed_mps: f64,
    /// How far it has come, in metres.
    pub distance_m: f64,
    /// For how long the program runs, in milliseconds.
    pub time_ms: u64,
    /// What the scenario does next, in words; `None` without a scenario, or at its end.
    pub next: Option<String>,
    /// Why the scenario was given up, if it was: see [`Vcu::with_patience`](crate::live::Vcu::with_patience).
    pub stuck: Option<Stuck>,
    /// What happened, the latest last; see [`KEPT`].
    pub happened: VecDeque<Happening>,
    /// How many things have happened so far, those that are not kept any more among them.
    pub happenings: u64,
}

impl Status {
    /// What has happened since there were so many happenings, as far as it is kept; and how many there are now.
    ///
    /// ```
    /// use adsdv_can::status::{HappeningKind, Status};
    ///
    /// let mut status = Status::default();
    /// status.happen(10, HappeningKind::AiHeard);
    /// let (news, seen) = status.since(0);
    /// assert_eq!(news.count(), 1);
    /// assert_eq!(status.since(seen).0.count(), 0);
    /// ```
    pub fn since(&self, seen: u64) -> (impl Iterator<Item = &Happening>, u64) {
        let new = usize::try_from(self.happenings.saturating_sub(seen)).unwrap_or(usize::MAX);
        (self.happened.iter().skip(self.happened.len().saturating_sub(new)), self.happenings)
    }

    /// Something happens. The oldest that is kept gives way.
    pub fn happen(&mut self, time_ms: u64, what: HappeningKind) {
        if self.happened.len() >= KEPT {
            self.happened.pop_front();
        }
        self.happened.push_back(Happening { time_ms, what });
        self.happenings += 1;
    }
}

/// How well the cycle was held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cycles {
    /// How many cycles there were.
    pub count: u64,
    /// How many of them began more than a cycle late, so that at least one was left out.
    pub late: u64,
    /// How many were left out. Together with `count`, these are all that were due.
    pub left_out: u64,
    /// How late the latest one began, in milliseconds.
    pub worst_ms: f64,
    /// The lateness that every second cycle kept, in milliseconds.
    pub p50_ms: f64,
    /// The lateness that 99 of 100 cycles kept, in milliseconds.
    pub p99_ms: f64,
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Happening {
    /// When, in milliseconds since the program began.
    pub time_ms: u64,
    /// What.
    pub what: HappeningKind,
}

/// What happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HappeningKind {
    /// The AS state changed, by this section of the document.
    State {
        /// Before; `None` if the VCU was without power.
        from: Option<AsState>,
        /// After; `None` if the VCU is without power.
        to: Option<AsState>,
        /// The section of the arrow, or empty.
        section: &'static str,
        /// The conditions that decided, in the words of Figure 2.
        why: String,
    },
    /// The operator did something.
    Did(String),
    /// A frame of the other node did not decode: its identifier, and what is wrong with it.
    Refused(String),
    /// Somebody else sends frames with identifiers of the VCU.
    OtherVcu(String),
    /// Somebody else sends frames with identifiers of the AI Computer, to an AI Computer.
    OtherAi(String),
    /// The other node speaks another edition than this one.
    OtherEdition {
        /// Who that is.
        node: Node,
        /// What it speaks, and by what it differs from the edition of this node.
        spoken: Recognised,
        /// The version of the edition of this node.
        own: &'static str,
    },
    /// An error frame came.
    ErrorFrame(String),
    /// Something is wrong with the bus.
    Disturbance(Disturbance),
    /// The bus is there again.
    Up,
    /// The kernel dropped frames, because they were not taken in time.
    Dropped {
        /// How many, since this was reported last.
        frames: u64,
        /// Whether the kernel keeps fewer for this program than were asked for.
        small_buffer: bool,
    },
    /// So many cycles were left out, since this was reported last, because others began late.
    Late(u64),
    /// The AI Computer is heard for the first time; or again, for a second without a pause or after a longer one.
    AiHeard,
    /// The AI Computer has fallen silent.
    AiSilent,
}
