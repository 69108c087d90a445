//! What was recorded of the interface that was judged.

use adsdv_spec::Bus;
use adsdv_spec::messages::{Node, SignalDef};

/// A frame, as it is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kept {
    /// When it came, by the time that the judge gives it: in nanoseconds since the first frame.
    pub t_ns: i64,
    /// Its identifier, of 11 bits.
    pub id: u16,
    /// The number of its data bytes.
    pub len: u8,
    /// The place of its interface among those of the log.
    pub(crate) interface: u8,
    /// Its data; what is behind its length is 0.
    pub data: [u8; 8],
}

/// The log says that frames were lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lost {
    /// The time of the frame before.
    pub t_ns: i64,
    /// How many.
    pub count: u64,
}

/// All frames of the interface that was judged, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// The interface; `None` if none carries a message of the edition.
    pub interface: Option<String>,
    /// Its frames of 11 bits.
    pub frames: Vec<Kept>,
    /// Where it lost frames.
    pub drops: Vec<Lost>,
    /// How many frames are of other interfaces or kinds.
    pub others: u64,
    /// When the last frame came, in nanoseconds since the first one.
    pub end_ns: i64,
}

impl Kept {
    /// Its data.
    pub fn data(&self) -> &[u8] {
        self.data.get(..usize::from(self.len)).unwrap_or(&self.data)
    }
}

impl Recording {
    /// What a signal of a side said, frame after frame, in raw steps; nothing where the edition has no such signal.
    pub fn series(&self, signal: Option<Found>) -> impl Iterator<Item = (i64, i32)> {
        self.frames.iter().filter_map(move |frame| {
            let Found { id, signal } = signal?;
            (frame.id == id).then(|| signal.raw(frame.data())).flatten().map(|raw| (frame.t_ns, raw))
        })
    }

    /// The same, and only where it changes.
    pub fn changes(&self, signal: Option<Found>) -> impl Iterator<Item = (i64, i32)> {
        let mut before = None;
        self.series(signal).filter(move |(_, raw)| before.replace(*raw) != Some(*raw))
    }
}

/// A signal, and the identifier of its message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The identifier.
    pub id: u16,
    /// The signal.
    pub signal: &'static SignalDef,
}

/// The signal that carries this field of a side, where the edition has one.
///
/// ```
/// use adsdv_report::signal;
/// use adsdv_spec::Edition;
/// use adsdv_spec::messages::Node;
///
/// let found = signal(&Edition::V3_0.bus, Node::Ai, "mission_status").expect("every edition has it");
/// assert_eq!((found.id, found.signal.name), (0x510, "MISSION_STATUS"));
/// ```
pub fn signal(bus: &Bus, sender: Node, field: &str) -> Option<Found> {
    bus.messages
        .iter()
        .filter(|message| message.sender == sender)
        .find_map(|message| Some(Found { id: message.id, signal: message.signal_of(field)? }))
}
