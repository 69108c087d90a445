//! The judge of a log: holds both sides of a recorded run against the specification.
//!
//! A log is sampled, jittered, and silent about the shutdown circuit, but for the remote E-stop where that is on the bus. So the
//! judge reasons with three-valued truth: what every sample of a window agrees on is known, the rest is unknown, and no guess is
//! reported as a fact. A violation is what is one whatever the unknown is, under every reading of the document that is not excluded.
//!
//! ```text
//! frame --> slots (what each message last said, and how fresh that is)
//!             |
//!             v
//!        knowledge of the atoms, with its history --> transitions seen (judged once their window has passed)
//!             |                                   --> transitions due
//!             +--> handshake, fault flags and causes, the AI Computer's conduct, values and lengths
//! ```
//!
//! Beside that it keeps how close the run comes to its limits (`margins`), and what of the requirements it shows (`exercised`).
//!
//! Everything is online and in bounded memory: one frame after the other, as they come.
//!
//! ```
//! use adsdv_oracle::judge::{Judge, JudgeOptions, Verdict};
//! use adsdv_spec::{Control, Inputs, Machine};
//!
//! let mut judge = Judge::new(JudgeOptions::default());
//! let vcu = Machine::REFERENCE;
//! let (mut control, inputs) = (Control::INITIAL, Inputs::default());
//! for cycle in 0..100 {
//!     let (next, outputs) = vcu.step(&control, &inputs, 10);
//!     control = next;
//!     for frame in outputs.messages(&inputs).frames(&vcu.edition().bus) {
//!         judge.frame(cycle * 10_000_000, frame.id.into(), frame.data());
//!     }
//! }
//! assert_eq!(judge.finish().verdict(), Verdict::Conforms);
//! ```

mod ai;
mod ebs;
mod edges;
mod events;
mod evidence;
mod exercised;
mod finding;
mod flags;
mod handshake;
mod history;
mod lenient;
mod likely;
mod loss;
mod margins;
mod missed;
mod options;
mod output;
mod plausible;
mod remote;
mod report;
mod response;
mod scope;
mod seen;
mod senders;
mod slots;
mod status;
mod steer;
mod transitions;
mod values;
mod variants;

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, MessageDef, Node, Vcu2AiBrake,
    Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelSpeeds, Vcu2LogStatus,
};
use adsdv_spec::{AsState, Atoms, Edition, Knowledge, Reading};

pub use exercised::{Exercised, Lack, Required, RequiredError, Told, ToldRequirement};
pub use finding::{Evidence, Finding, Party, Rule, Section, Severity};
pub use margins::{Basis, Margin, Measure, Needs};
pub use options::JudgeOptions;
pub use report::{Report, Transition, Verdict};
pub use response::{Meter, ResponseTimes};
pub(crate) use seen::Seen;

use events::Pending;
use handshake::Watch;
use history::History;
use output::Output;
use scope::{AI_SCOPE, Shown};
use slots::{REMOTE, Slot, SlotOf, slot_of};
use status::VcuSide;
use variants::Variants;

use crate::why::{Stay, Why};

/// Milliseconds as nanoseconds.
const MS: i64 = 1_000_000;

/// After a silence of this length nothing is known of a VCU any more; it may have been power-cycled.
pub(crate) const SILENCE_NS: i64 = 500 * MS;

const STATUS: usize = slot_of(Vcu2AiStatus::ID);
const LOG_STATUS: usize = slot_of(Vcu2LogStatus::ID);
const STEER: usize = slot_of(Vcu2AiSteer::ID);
const BRAKE: usize = slot_of(Vcu2AiBrake::ID);
const WHEEL_SPEEDS: usize = slot_of(Vcu2AiWheelSpeeds::ID);
const AI_STATUS: usize = slot_of(Ai2VcuStatus::ID);
const AI_DRIVE_F: usize = slot_of(Ai2VcuDriveF::ID);
const AI_DRIVE_R: usize = slot_of(Ai2VcuDriveR::ID);
const AI_STEER: usize = slot_of(Ai2VcuSteer::ID);
const AI_BRAKE: usize = slot_of(Ai2VcuBrake::ID);

/// The judge of one log, or of one live bus.
#[derive(Debug)]
pub struct Judge {
    options: JudgeOptions,
    edition: Edition,
    variants: Variants,
    window: i64,
    deadline: i64,
    /// No shorter time without a frame is a silence.
    pause: i64,

    slot_of: SlotOf,
    slots: [Slot; slots::COUNT],
    shown: Shown,
    known: Knowledge,
    history: History,
    vcu: VcuSide,
    handshake: Watch,
    missed: missed::Missed,
    meter: Meter,
    /// When what is known of lost communication was last brought up to date.
    comms_known_at: i64,
    ai: ai::AiSide,
    remote: remote::RemoteSide,
    ebs: ebs::Stages,
    senders: senders::Senders,

    pending: Vec<Pending>,
    due: Option<transitions::Due>,
    likely: likely::Likely,
    why: Why,
    now: i64,
    /// When the last frame came, if time has been told to pass since.
    quiet_since: Option<i64>,
    loss: loss::Loss,
    margins: margins::Kept,
    tally: exercised::Tally,
    started: bool,
    /// Whether it was said that frames do not come in the order of time.
    shuffled: bool,
    /// What section 3.2, item 2, asks of the AI Computer.
    requests: Atoms,
    /// Added to the time of frames, so that time goes on after it was set back.
    offset: i64,
    /// Nothing is to be done before this time; the least of all when something is to be done at the next frame anyway.
    next_event: i64,
    frames: u64,
    /// What became known or unknown between frames, if somebody asks for it.
    seen: Option<Vec<Seen>>,
    out: Output,
}

impl Judge {
    /// A judge that has seen nothing yet.
    pub fn new(options: JudgeOptions) -> Self {
        let edition = *options.edition;
        let options = JudgeOptions { readings: edition.choices.intersection(options.readings), ..options };
        let variants = Variants::new(&edition, options.readings);
        let window = i64::from(options.window_ms) * MS;
        // Most messages come once a cycle, all at once: one frame may be missing.
        let pause = window.max(i64::from(edition.rules.timing.cycle_ms) * 2 * MS);
        let requests = variants.atoms(AsState::Ready, AsState::Driving).intersection(AI_SCOPE);
        Self {
            options,
            edition,
            variants,
            shuffled: false,
            requests,
            window,
            pause,
            deadline: i64::from(options.deadline_ms) * MS,
            slot_of: SlotOf::new(&edition.bus),
            slots: Slot::all(&edition.bus, options.complete),
            shown: Shown::new(&edition),
            known: Knowledge::NOTHING,
            history: History::new(),
            vcu: VcuSide::default(),
            handshake: Watch::default(),
            missed: missed::Missed::default(),
            meter: Meter::default(),
            comms_known_at: 0,
            ai: ai::AiSide::default(),
            remote: remote::RemoteSide::default(),
            ebs: ebs::Stages::default(),
            senders: senders::Senders::default(),
            pending: Vec::new(),
            due: None,
            likely: likely::Likely::default(),
            why: Why::new(options.edition, options.readings),
            now: 0,
            quiet_since: None,
            loss: loss::Loss::default(),
            margins: margins::Kept::default(),
            tally: exercised::Tally::default(),
            started: false,
            offset: 0,
            next_event: i64::MIN,
            frames: 0,
            seen: None,
            out: Output::default(),
        }
    }

    /// Judges a classic CAN data frame with an 11-bit identifier, at a time in nanoseconds since the first frame.
    ///
    /// Frames of no message of the document are left alone. Data of any length is fine, and time may jump.
    #[inline]
    pub fn frame(&mut self, t_ns: i64, id: u32, data: &[u8]) {
        self.frames += 1;
        let t = self.tick(t_ns);
        let Some(index) = self.slot_of.get(id) else { return self.other_id(t, id) };
        let Some(slot) = self.slots.get_mut(index) else { return };
        // What a frame says that is older than the last of its identifier is not so any more.
        if t_ns < slot.newest {
            return;
        }
        slot.newest = t_ns;
        let (word, len) = load(data);
        let before = slot.last;
        let longest = self.margins.longest_gap(index);
        let same = slot.fresh && slot.word == word && slot.len == len;
        // The AI Computer's program may well leave cycles out; the VCU keeps its own.
        let missing = slot.seen(t) && slot.is_from(Node::Vcu) && !slot.complete;
        if slot.is_lossy() {
            // It may be too old sooner than it was before.
            self.next_event = self.next_event.min(slot.stale_at());
        }
        if missing {
            self.frames_get_lost(t);
        }
        if let Some(before) = before.filter(|&before| t - before > longest) {
            self.longer_gap(index, before, t);
        }
        if !same {
            self.changed(index, t, word, len, before);
        } else if index == STATUS {
            self.status_repeated(t);
        } else if index == AI_STATUS {
            self.answer_repeated(t);
        } else if index == LOG_STATUS {
            self.assi_repeated(t);
        } else if index == REMOTE {
            self.remote_repeated(t);
        }
        self.ends_silence(index, t);
    }

    /// The edition of the interface that is judged by.
    pub const fn edition(&self) -> &Edition {
        &self.edition
    }

    /// What the edition says of the message with this identifier, if it is one that is judged.
    pub(crate) fn message(&self, id: u32) -> Option<&'static MessageDef> {
        self.slots.get(self.slot_of.get(id)?)?.def
    }

    /// Counts a frame that is not judged, and lets time pass. Returns the time that the judge gives it.
    pub fn other_frame(&mut self, t_ns: i64) -> i64 {
        self.frames += 1;
        self.tick(t_ns)
    }

    /// No frame has come up to this time, in nanoseconds since the first frame: what waited for it is judged.
    ///
    /// A time before that of the last frame changes nothing.
    pub fn time_passes(&mut self, t_ns: i64) {
        self.quiet_until(t_ns);
    }

    /// So many frames were lost before the next one: what they said is unknown, and nothing is known any more.
    ///
    /// Losses that follow one another within a window are reported as one.
    pub fn lost(&mut self, count: u64) {
        self.will_be_lost(count);
    }

    /// There is no further frame: settles what is still open. What is reported from now on has the time of the last one,
    /// whatever time has been told to pass since.
    pub(crate) fn end(&mut self) {
        let end = self.quiet_since.take().unwrap_or(self.now);
        self.now = end;
        self.lose(end, end);
        self.settle_all(end);
        self.report_loss();
        self.notice_end(end);
    }

    /// Adds what was found, by the judge itself, by the reader of the log, or by somebody who follows rules of his own. The
    /// requirements are those that the edition has for the ones that are named.
    pub fn found(&mut self, finding: Finding) {
        let requirements = exercised::of_edition(&self.edition, &finding.requirements);
        self.tally.found(finding.severity, &finding.requirements);
        self.out.finding(Finding { requirements, ..finding });
    }

    /// A note about the log itself, at this time.
    pub(crate) fn note_log(&mut self, rule: Rule, seen: String) {
        self.found(Finding::note(Party::Log, "2", rule, self.now).seen(seen));
    }

    /// The end of the log: settles what is still open.
    pub fn finish(mut self) -> Report {
        self.end();
        self.note_one_sided();
        let (margins, exercised) = (self.margins(), self.exercised());
        let (stays, go_presses) = self.why.end(self.now);
        Report { stays, go_presses, margins, exercised, ..self.out.report(self.frames, self.now) }
    }

    /// What has been settled since this was last asked, by time; for a live bus. The report has it as well. What takes longer to
    /// settle may be told after what happened later.
    ///
    /// Of the findings of one rule that the report only counts, because there are too many to be listed, one in a second is
    /// among it; the first of them comes behind a finding of [`Rule::Repeated`] that says so. These the report does not have.
    pub fn news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.out.news()
    }

    /// What has been found so far and not been taken yet, in order. The report does not have it any more.
    pub fn take_news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.out.take()
    }

    /// How fast the AI Computer has answered the handshake so far.
    pub fn responses(&self) -> &ResponseTimes {
        &self.out.responses
    }

    /// The AS state that the VCU showed last, while its frames are fresh.
    pub fn state(&self) -> Option<AsState> {
        self.vcu.state.filter(|_| self.vcu_is_seen())
    }

    /// When the last frame came, by the time that the judge gives it.
    pub(crate) fn now_ns(&self) -> i64 {
        self.now
    }

    /// How long after its cause an effect may be seen.
    pub(crate) const fn window_ns(&self) -> i64 {
        self.window
    }

    /// What is known now.
    pub fn known(&self) -> Knowledge {
        self.known
    }

    /// The state that lasts now, with what blocks its arrows, and the time up to which that is so; `None` while no state is known.
    pub fn waits(&self) -> Option<(i64, &Stay)> {
        Some((self.now, self.why.now()?))
    }

    /// From `t` on, what is known is `known`.
    fn learn(&mut self, t: i64, known: Knowledge) {
        if known != self.known {
            self.known = known;
            self.history.push(t, known, self.vcu.state);
            self.explain(t);
            self.reconsider(t);
        }
    }

    /// The state, or what is known, is another: what blocks the arrows may be, too.
    fn explain(&mut self, t: i64) {
        let stale = self.slots.iter().enumerate().filter(|(_, slot)| !slot.fresh);
        let stale = stale.fold(Atoms::NONE, |all, (index, _)| all.union(self.scope(index)));
        let (slots, slot_of) = (&self.slots, &self.slot_of);
        let last = |id: u16| {
            let slot = slots.get(slot_of.get(id.into())?).filter(|slot| slot.last.is_some())?;
            Some(slot.word.to_le_bytes())
        };
        self.why.sees(t, self.vcu.state, (self.known, stale), &last);
    }

    /// An event is to be looked at when this time comes.
    fn wake_at(&mut self, t: i64) {
        self.next_event = self.next_event.min(t);
    }

    /// How long an edge of the handshake may stay unanswered, in nanoseconds.
    fn handshake_limit(&self) -> i64 {
        i64::from(self.edition.rules.timing.handshake_ms) * MS
    }

    /// The cycle of the reference VCU, in nanoseconds.
    fn cycle(&self) -> i64 {
        i64::from(self.edition.rules.timing.cycle_ms) * MS
    }

    fn pinned(&self, reading: Reading) -> Option<adsdv_spec::Choice> {
        let mut choices = self.options.readings.of_reading(reading);
        match (choices.next(), choices.next()) {
            (Some(choice), None) => Some(choice),
            _ => None,
        }
    }
}

/// The first eight bytes as the word that signals are cut from, and the length.
#[inline]
fn load(data: &[u8]) -> (u64, u8) {
    let len = u8::try_from(data.len()).unwrap_or(u8::MAX);
    let word = match data.first_chunk::<8>() {
        Some(bytes) => u64::from_le_bytes(*bytes),
        None => data.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte)),
    };
    (word, len)
}
