//! The lanes of the timeline that frames show: switches, missions, brakes, the shutdown circuit as far as it is known, faults.
//!
//! The states and their arrows are in the report itself, and the page draws them from there.

use adsdv_oracle::judge::SILENCE_NS;
use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{MessageDef, Node, SignalDef};
use adsdv_spec::{Bus, Fault, Faults};
use serde::Serialize;

use crate::recording::{Found, Kept, Recording, signal};
use crate::time::micros;

/// So many changes can be told from each other on a screen; beyond that, those that are close together are one.
const CHANGES: usize = 4000;
/// So many are left of those.
const DRAWN: u32 = 2000;

/// How a span looks; its word says what it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Tone {
    /// Nothing to see.
    Off,
    /// On, or chosen.
    On,
    /// A fault, or a stop.
    Bad,
    /// Nobody knows.
    Unknown,
    /// Several within less than can be drawn.
    Several,
}

/// A lane.
#[derive(Serialize)]
pub(crate) struct LaneJson {
    pub(crate) id: &'static str,
    title: String,
    /// Where it is from.
    of: String,
    pub(crate) words: Vec<(String, Tone)>,
    /// From when, in microseconds, and which word counts until the next span; -1 where nothing is known.
    pub(crate) spans: Vec<(i64, i32)>,
}

/// The signals that have a lane: who says them, their field, what the lane is called, and whether on is bad.
const LANES: &[(&str, Node, &str, &str, bool)] = &[
    ("go", Node::Vcu, "go_signal", "\"Go\"", false),
    ("asms", Node::Vcu, "as_switch_status", "AS master switch", false),
    ("tsms", Node::Vcu, "ts_switch_status", "TS master switch", false),
    ("mission", Node::Vcu, "ami_state", "Mission", false),
    ("mission-status", Node::Ai, "mission_status", "MISSION_STATUS", false),
    ("direction", Node::Ai, "direction_request", "DIRECTION_REQUEST", false),
    ("estop-request", Node::Ai, "estop_request", "ESTOP_REQUEST", true),
    ("ebs", Node::Vcu, "state_ebs", "EBS", false),
    ("ebs-brake", Node::Vcu, "status_ebs", "EBS, as the brakes see it", false),
    ("ebs-state", Node::Vcu, "ebs_state", "EBS, in the status", false),
    ("steering", Node::Vcu, "steering_status", "Steering", false),
    ("shutdown-request", Node::Vcu, "shutdown_request", "SHUTDOWN_REQUEST", true),
    ("cause", Node::Vcu, "shutdown_cause", "SHUTDOWN_CAUSE", true),
];

/// Every lane of which the recording shows something, or could.
pub(crate) fn lanes(recording: &Recording, bus: &Bus) -> Vec<LaneJson> {
    let mut lanes = Vec::new();
    let mut remote = remote(recording, bus).into_iter();
    for &(id, sender, field, title, bad) in LANES {
        let Some(Found { id: message, signal }) = signal(bus, sender, field) else { continue };
        let mut lane = Spans::new(recording);
        for frame in recording.frames.iter().filter(|frame| frame.id == message) {
            lane.frame(frame, signal.raw(frame.data()), |raw| word(signal, *raw, bad));
        }
        lanes.push(lane.lane(id, title.to_owned(), format!("{} {message:03X}h", signal.name)));
        if id == "go" {
            lanes.extend(remote.next());
        }
    }
    lanes.extend(remote);
    if let Some(status) = signal(bus, Node::Vcu, "as_state").and_then(|found| bus.message(found.id)) {
        lanes.push(circuit(recording, status));
        lanes.push(faults(recording, status, "faults", "Faults", None));
    }
    lanes
}

fn word(signal: &SignalDef, raw: i32, bad: bool) -> (String, Tone) {
    let tone = match raw {
        0 => Tone::Off,
        _ if bad => Tone::Bad,
        _ => Tone::On,
    };
    (signal.display(raw).to_string(), tone)
}

/// The switches of the remote control, where it is on the bus.
fn remote(recording: &Recording, bus: &Bus) -> Vec<LaneJson> {
    let Some(remote) = Remote::of(bus) else { return Vec::new() };
    let id = remote.message().id;
    let shown = |on| (if on { "ON" } else { "OFF" }.to_owned(), if on { Tone::On } else { Tone::Off });
    let of = format!("{} {id:03X}h", remote.message().name);
    let (mut go, mut estop) = (Spans::new(recording), Spans::new(recording));
    for frame in recording.frames.iter().filter(|frame| frame.id == id) {
        let switches = remote.read(frame.data());
        go.frame(frame, switches.map(|switches| switches.go), |on| shown(*on));
        estop.frame(frame, switches.map(|switches| switches.estop), |on| shown(*on));
    }
    // Which level of the E-stop's bit means that it is pressed, no document says.
    vec![
        go.lane("remote-go", "\"Go\", remote control".to_owned(), of.clone()),
        estop.lane("remote-estop", "E-stop bit, remote control".to_owned(), of),
    ]
}

/// The shutdown circuit: that it is open is known while a fault that opens it is shown. No message shows that it is closed.
fn circuit(recording: &Recording, status: &MessageDef) -> LaneJson {
    faults(recording, status, "sdc", "Shutdown circuit, as far as known", Some(Faults::OPENING))
}

/// The faults that are raised; with a choice of them, what these say of the shutdown circuit.
fn faults(
    recording: &Recording,
    status: &MessageDef,
    id: &'static str,
    title: &str,
    chosen: Option<Faults>,
) -> LaneJson {
    let counts = |fault: &Fault| chosen.is_none_or(|chosen| chosen.has(*fault));
    let flags = Fault::ALL.iter().copied().filter(counts);
    let flags: Vec<&SignalDef> = flags.filter_map(|fault| status.signal(fault.flag())).collect();
    let mut lane = Spans::new(recording);
    for frame in recording.frames.iter().filter(|frame| frame.id == status.id) {
        let raised = |place: usize| {
            flags.get(place).and_then(|flag| flag.raw(frame.data())).is_some_and(|raw| raw != 0)
        };
        let set = (0..flags.len()).filter(|place| raised(*place)).fold(0_u32, |set, place| set | 1 << place);
        lane.frame(frame, Some(set), |set| {
            let names = flags.iter().enumerate().filter(|(place, _)| set >> place & 1 == 1);
            let names: Vec<&str> = names.map(|(_, flag)| flag.name).collect();
            match (&names[..], chosen) {
                ([], None) => ("none".to_owned(), Tone::Off),
                ([], Some(_)) => ("not shown".to_owned(), Tone::Unknown),
                (names, None) => (names.join(", "), Tone::Bad),
                (names, Some(_)) => (format!("open: {}", names.join(", ")), Tone::Bad),
            }
        });
    }
    lane.lane(id, title.to_owned(), format!("{} {:03X}h", status.name, status.id))
}

/// Spans of one lane, while frame after frame comes.
struct Spans<T> {
    end: i64,
    /// Values that were seen, in the order of their words.
    seen: Vec<T>,
    words: Vec<(String, Tone)>,
    changes: Vec<(i64, i32)>,
    last: Option<i64>,
}

impl<T: PartialEq> Spans<T> {
    fn new(recording: &Recording) -> Self {
        Self {
            end: micros(recording.end_ns),
            seen: Vec::new(),
            words: Vec::new(),
            changes: Vec::new(),
            last: None,
        }
    }

    /// A frame says this; `word` says it in a word.
    fn frame(&mut self, frame: &Kept, value: Option<T>, word: impl FnOnce(&T) -> (String, Tone)) {
        let Some(value) = value else { return };
        let now = micros(frame.t_ns);
        if let Some(last) = self.last.replace(now).filter(|last| now - last > micros(SILENCE_NS)) {
            self.span(last + micros(SILENCE_NS), -1);
        }
        let place = self.seen.iter().position(|seen| *seen == value).unwrap_or_else(|| {
            self.words.push(word(&value));
            self.seen.push(value);
            self.seen.len() - 1
        });
        self.span(now, i32::try_from(place).unwrap_or(-1));
    }

    fn span(&mut self, from: i64, place: i32) {
        if self.changes.last().is_none_or(|(_, before)| *before != place) {
            self.changes.push((from, place));
        }
    }

    fn lane(mut self, id: &'static str, title: String, of: String) -> LaneJson {
        if let Some(last) = self.last.filter(|last| self.end - last > micros(SILENCE_NS)) {
            self.span(last + micros(SILENCE_NS), -1);
        }
        if self.changes.len() > CHANGES {
            self.thin();
        }
        LaneJson { id, title, of, words: self.words, spans: self.changes }
    }

    /// Changes that are too close to be told from each other become one span of several.
    fn thin(&mut self) {
        let several = i32::try_from(self.words.len()).unwrap_or(-1);
        self.words.push(("several".to_owned(), Tone::Several));
        let width = self.end / i64::from(DRAWN) + 1;
        let mut thinned: Vec<(i64, i32)> = Vec::new();
        let mut spans = std::mem::take(&mut self.changes).into_iter().peekable();
        while let Some((from, place)) = spans.next() {
            let bucket = from / width;
            let mut last = place;
            let mut many = false;
            while let Some((_, place)) = spans.next_if(|(from, _)| from / width == bucket) {
                (last, many) = (place, true);
            }
            let mut push = |from: i64, place: i32| {
                if thinned.last().is_none_or(|(_, before)| *before != place) {
                    thinned.push((from, place));
                }
            };
            if many {
                push(from, several);
                if spans.peek().is_none_or(|(from, _)| from / width > bucket + 1) {
                    push((bucket + 1) * width, last);
                }
            } else {
                push(from, place);
            }
        }
        self.changes = thinned;
    }
}

/// Times in which no frame of the interface came, though its messages come often: from when until when, in microseconds.
pub(crate) fn gaps(recording: &Recording, bus: &Bus) -> Vec<(i64, i64)> {
    /// So many cycles of the message that comes most often are more than jitter.
    const CYCLES: i64 = 10;
    let fastest = bus.messages.iter().map(|message| message.cycle_ms).min().unwrap_or_default();
    let longest = i64::from(fastest) * 1000 * CYCLES;
    let times = recording.frames.windows(2).filter_map(|pair| match pair {
        [before, after] => Some((micros(before.t_ns), micros(after.t_ns))),
        _ => None,
    });
    times.filter(|(before, after)| after - before > longest).take(CHANGES).collect()
}
