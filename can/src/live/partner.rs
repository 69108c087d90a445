//! Whether the node at the other end speaks the same edition.

use adsdv_oracle::recognise::{Recognised, Recogniser};
use adsdv_spec::Edition;
use adsdv_spec::messages::{Frame, Node};

/// So long it is listened to before what it speaks is looked at, in nanoseconds, and each time anew: ten frames of the slowest
/// message, so that a single odd frame is outweighed, and a partner that is exchanged is noticed.
const LISTEN_NS: i64 = 1_000_000_000;

/// What is heard of the other node. It changes nothing of what this one sends.
#[derive(Debug)]
pub(super) struct Partner {
    node: Node,
    /// What this node follows; `None` if that is none of the editions that there are.
    own: Option<&'static Edition>,
    heard: Option<Listening>,
    /// The edition that was reported last.
    reported: Option<&'static str>,
}

/// What was heard, and since when.
#[derive(Debug)]
struct Listening {
    recogniser: Recogniser,
    since_ns: i64,
}

impl Partner {
    /// The other node of one that follows this edition.
    pub(super) fn new(node: Node, own: &Edition) -> Self {
        Self { node, own: Edition::find(own.version), heard: None, reported: None }
    }

    /// Who it is.
    pub(super) const fn node(&self) -> Node {
        self.node
    }

    /// A frame came at this time, from whomever. Where it shows that the partner speaks another edition, it is that one, once.
    pub(super) fn frame(&mut self, now_ns: i64, frame: &Frame) -> Option<Recognised> {
        let own = self.own?;
        let sender = |edition: &&Edition| edition.bus.message(frame.id).map(|message| message.sender);
        if !Edition::ALL.iter().any(|edition| sender(edition) == Some(self.node)) {
            return None;
        }
        let news = self.heard.take_if(|heard| now_ns.saturating_sub(heard.since_ns) >= LISTEN_NS);
        let begin = || Listening { recogniser: Recogniser::new(own), since_ns: now_ns };
        self.heard.get_or_insert_with(begin).recogniser.frame(now_ns, frame.id.into(), frame.data());
        let other = news?.recogniser.fits_better()?;
        let before = self.reported.replace(other.edition.version);
        (before != self.reported).then_some(other)
    }
}
