//! Frames behind the decision: whether they still fit the edition that was recognised.

use super::{Recognised, Recogniser};

/// Identifiers of 11 bits.
const IDS: usize = 0x800;

/// The bus as it was when the edition was recognised, and what has changed since.
#[derive(Debug)]
pub(crate) struct Later {
    recogniser: Recogniser,
    /// The length of the last frame of each identifier; none yet where that is longer than any.
    lens: Box<[u8; IDS]>,
    reported: bool,
}

impl Later {
    pub(super) fn new(recogniser: Recogniser) -> Self {
        Self { recogniser, lens: Box::new([u8::MAX; IDS]), reported: false }
    }

    /// A frame came. Where it shows for the first time that another edition fits better than the one that is judged by, it is
    /// that one.
    #[inline]
    pub(crate) fn frame(&mut self, id: u32, data: &[u8], judged: &str) -> Option<Recognised> {
        let len = u8::try_from(data.len()).unwrap_or(u8::MAX);
        let last = self.lens.get_mut(id as usize)?;
        if std::mem::replace(last, len) == len || self.reported {
            return None;
        }
        self.changed(id, data, judged)
    }

    #[cold]
    fn changed(&mut self, id: u32, data: &[u8], judged: &str) -> Option<Recognised> {
        self.recogniser.is_now(id, data);
        let now = self.recogniser.recognise();
        self.reported = now.certain && now.edition.version != judged;
        self.reported.then_some(now)
    }
}
