//! What the frames of a recording were like, taken down beside the judge, in memory that does not grow with the log.

use std::collections::BTreeMap;

use adsdv_spec::messages::{Ai2VcuStatus, MessageDef, SignalDef};
use adsdv_spec::{AiMessages, AsState};

use super::cycle::Cycle;
use crate::judge::Judge;

/// What it says in 510h that leads from state to state.
const SAYS: [&str; 3] = ["mission_status", "direction_request", "estop_request"];
/// So many values of a sequence are kept.
const LONGEST: usize = 16;
/// Of so many states, one after the other, the requests are kept.
const MOST: usize = 100;

/// What the frames of a recording were like.
#[derive(Debug, Default)]
pub struct Collected {
    /// Every identifier that came.
    pub ids: BTreeMap<u32, Seen>,
    /// What the AI Computer requested in each state, one after the other.
    pub requests: Vec<Requests>,
}

/// How the frames of an identifier came.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// How many.
    pub count: u64,
    /// How often.
    pub cycle: Cycle,
    /// The lengths that they had: bit n for n bytes.
    pub lengths: u16,
    /// The name of the message, if the edition has it.
    pub name: Option<&'static str>,
}

/// What the AI Computer requested while a state lasted.
#[derive(Debug)]
pub struct Requests {
    /// The state.
    pub state: AsState,
    /// The range of each request, by message and place in it.
    pub ranges: Vec<Range>,
    /// The values of each of the others, one after the other.
    pub sequences: Vec<Sequence>,
}

/// The range of a request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The message.
    pub id: u16,
    /// The signal.
    pub signal: &'static SignalDef,
    /// The lowest raw value.
    pub min: i32,
    /// The highest raw value.
    pub max: i32,
}

/// The values of a signal one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// The signal.
    pub signal: &'static SignalDef,
    /// The first raw values, each of which is another one than that before.
    pub values: Vec<i32>,
    /// Whether there were more.
    pub more: bool,
}

/// Takes all of that down.
#[derive(Debug, Default)]
pub(crate) struct Collector {
    collected: Collected,
    /// The state that was shown last, and since when.
    state: Option<(AsState, i64)>,
    /// How many states there have been.
    states: usize,
}

impl Collector {
    /// The judge has seen a frame.
    pub(crate) fn frame(&mut self, judge: &Judge, id: u32, data: &[u8]) {
        let (t, bus) = (judge.now_ns(), &judge.edition().bus);
        let message = u16::try_from(id).ok().and_then(|id| bus.message(id));
        let seen = self.collected.ids.entry(id).or_default();
        seen.count += 1;
        seen.cycle.seen(t);
        seen.lengths |= u16::try_from(data.len()).map_or(0, |len| 1_u16.checked_shl(len.into()).unwrap_or(0));
        seen.name = message.map(|message| message.name);
        let Some(state) = judge.state() else { return };
        if self.state.is_none_or(|(before, _)| before != state) {
            self.state = Some((state, t));
            self.states += 1;
            if self.states <= MOST {
                self.collected.requests.push(Requests::new(state));
            }
        }
        let requests = self.collected.requests.last_mut().filter(|_| self.states <= MOST);
        if let (Some((_, since)), Some(message), Some(requests)) = (self.state, message, requests) {
            // What was requested before the AI Computer could know of the state is about the one before.
            let may_know = t - since > judge.window_ns();
            match message.id {
                Ai2VcuStatus::ID => requests.says(message, data),
                id if may_know && AiMessages::IDS.contains(&id) => requests.requests(message, data),
                _ => {}
            }
        }
    }

    pub(crate) fn end(self) -> Collected {
        self.collected
    }
}

impl Requests {
    const fn new(state: AsState) -> Self {
        Self { state, ranges: Vec::new(), sequences: Vec::new() }
    }

    fn requests(&mut self, message: &MessageDef, data: &[u8]) {
        for signal in message.signals.iter().filter(|signal| signal.values.is_empty()) {
            let Some(raw) = signal.raw(data) else { continue };
            match self.ranges.iter_mut().find(|range| range.signal.field == signal.field) {
                Some(range) => (range.min, range.max) = (range.min.min(raw), range.max.max(raw)),
                None => self.ranges.push(Range { id: message.id, signal, min: raw, max: raw }),
            }
        }
    }

    fn says(&mut self, message: &MessageDef, data: &[u8]) {
        for signal in SAYS.iter().filter_map(|field| message.signal_of(field)) {
            let Some(raw) = signal.raw(data) else { continue };
            match self.sequences.iter_mut().find(|sequence| sequence.signal.field == signal.field) {
                Some(sequence) if sequence.values.last() == Some(&raw) => {}
                Some(sequence) if sequence.values.len() >= LONGEST => sequence.more = true,
                Some(sequence) => sequence.values.push(raw),
                None => self.sequences.push(Sequence { signal, values: vec![raw], more: false }),
            }
        }
    }
}

impl Range {
    /// Both ends, in the unit of the signal.
    pub fn physical(&self) -> [f64; 2] {
        [self.min, self.max].map(|raw| self.signal.physical(raw))
    }
}

/// Whether an edition has everything that is collected.
#[cfg(test)]
fn is_complete(bus: &adsdv_spec::Bus) -> bool {
    let says = bus.message(Ai2VcuStatus::ID);
    AiMessages::IDS.iter().all(|id| bus.message(*id).is_some())
        && says.is_some_and(|message| SAYS.iter().all(|field| message.signal_of(field).is_some()))
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;

    use super::*;
    use crate::judge::JudgeOptions;

    #[test]
    fn every_edition_has_what_is_collected() {
        for edition in Edition::ALL {
            assert!(is_complete(&edition.bus), "{}", edition.version);
        }
    }

    /// Frames of a VCU in this state, and of an AI Computer that requests this torque and reports laps and a speed.
    fn collected(state: u8, torques: &[u8]) -> Collected {
        let mut judge = Judge::new(JudgeOptions::default());
        let mut collector = Collector::default();
        for (torque, ms) in torques.iter().zip((0..).step_by(10)) {
            let frames = [
                (0x520, [0, 0, state, 0, 0, 0, 0, 0]),
                (0x510, [0, 0, 1, 0, 0, 0, *torque, 0]),
                (0x511, [*torque, 0, 0, 0, 0, 0, 0, 0]),
            ];
            for (id, data) in frames {
                judge.frame(ms * 1_000_000, id, &data);
                collector.frame(&judge, id, &data);
            }
        }
        collector.end()
    }

    #[test]
    fn a_range_begins_when_the_ai_computer_can_know_of_the_state() {
        let collected = collected(2, &[90, 90, 90, 90, 4, 3, 5, 4]);
        let ranges = &collected.requests.first().expect("it lasts").ranges;
        let torque = ranges.iter().find(|range| range.signal.field == "front_axle_trq_request");
        assert_eq!(torque.map(|range| (range.min, range.max)), Some((3, 5)));
        assert_eq!(
            collected.requests.iter().map(|requests| requests.state).collect::<Vec<_>>(),
            [AsState::Ready]
        );
        let seen = collected.ids.get(&0x511).expect("it came");
        assert_eq!((seen.count, seen.lengths), (8, 1 << 8));
    }

    #[test]
    fn the_numbers_that_510h_reports_are_no_requests() {
        let collected = collected(2, &[4; 8]);
        let ranges = &collected.requests.first().expect("it lasts").ranges;
        assert!(ranges.iter().all(|range| range.id == 0x511), "{ranges:?}");
    }

    #[test]
    fn a_sequence_is_bounded() {
        let message = Edition::DEFAULT.bus.message(Ai2VcuStatus::ID).expect("510h");
        let mission = message.signal_of("mission_status").expect("its signal");
        let mut requests = Requests::new(AsState::Off);
        for raw in [0, 0, 1, 1, 2].into_iter().chain((0..40).map(|place| place % 2)) {
            requests.says(message, &mission.put([0; 8], raw));
        }
        let sequence = requests.sequences.first().expect("it was said");
        assert_eq!((&sequence.values[..3], sequence.values.len(), sequence.more), (&[0, 1, 2][..], 16, true));
    }
}
