//! Which edition of the interface a bus speaks, as its frames show.
//!
//! No frame names the version. What tells is how the frames look: how long they are, which messages there are and how often
//! they come, and which bits and values they use. What is expected of each stands in the editions' own tables, so that a
//! further edition is recognised without a line here.
//!
//! ```text
//! frames --> Recogniser (what was seen of each identifier) --> facts (which edition each fits) --> Recognised
//! ```
//!
//! ```
//! use adsdv_oracle::recognise::Recogniser;
//! use adsdv_spec::Edition;
//!
//! let mut recogniser = Recogniser::new(Edition::DEFAULT);
//! recogniser.frame(0, 0x511, &[0; 4]);
//! recogniser.frame(0, 0x181, &[0; 8]);
//! let recognised = recogniser.recognise();
//! assert_eq!((recognised.edition.version, recognised.certain), ("2026", true));
//! assert_eq!(
//!     recognised.to_string(),
//!     "version 2026: 181h is there (3.0: no such device, 4.0: no such device), 511h has 4 bytes (3.0: 8)"
//! );
//! ```

mod devices;
mod fact;
mod facts;
mod hearing;
mod later;
mod recognised;
mod seen;
#[cfg(test)]
mod tests;

pub use recognised::Recognised;

pub(crate) use hearing::{Hearing, Held};
pub(crate) use later::Later;

use adsdv_spec::Edition;
use devices::Devices;
use facts::facts;
use seen::FrameStats;

/// Takes down what tells the edition, frame by frame, in memory that does not grow.
#[derive(Debug)]
pub struct Recogniser {
    editions: &'static [&'static Edition],
    default: &'static Edition,
    /// What was seen of each identifier that is a message of some edition, by ascending identifier.
    seen: Vec<(u16, FrameStats)>,
    devices: Devices,
}

impl Recogniser {
    /// Nothing has been seen yet; the default is for a bus that does not tell.
    pub fn new(default: &'static Edition) -> Self {
        Self::among(Edition::ALL, default)
    }

    /// Recognises one of these editions.
    pub fn among(editions: &'static [&'static Edition], default: &'static Edition) -> Self {
        let ids = editions.iter().flat_map(|edition| edition.bus.messages).map(|message| message.id);
        let mut seen: Vec<(u16, FrameStats)> = ids.map(|id| (id, FrameStats::new(editions, id))).collect();
        seen.sort_by_key(|(id, _)| *id);
        seen.dedup_by_key(|(id, _)| *id);
        Self { editions, default, seen, devices: Devices::new(editions) }
    }

    /// A classic CAN data frame with an 11-bit identifier came, at a time in nanoseconds. Tells whether it is a message of any
    /// edition between the VCU and the AI Computer.
    pub fn frame(&mut self, t_ns: i64, id: u32, data: &[u8]) -> bool {
        let Ok(id) = u16::try_from(id) else { return false };
        let Some((_, seen)) = self.place(id).and_then(|place| self.seen.get_mut(place)) else {
            self.devices.frame(id, data.len());
            return false;
        };
        seen.frame(t_ns, data);
        true
    }

    /// Whether this identifier is a message of any edition between the VCU and the AI Computer.
    pub fn knows(&self, id: u32) -> bool {
        u16::try_from(id).is_ok_and(|id| self.place(id).is_some())
    }

    /// What this message is like from now on, whatever it was before.
    fn is_now(&mut self, id: u32, data: &[u8]) {
        let place = u16::try_from(id).ok().and_then(|id| self.place(id));
        if let Some((_, seen)) = place.and_then(|place| self.seen.get_mut(place)) {
            seen.is_now(data);
        }
    }

    fn place(&self, id: u16) -> Option<usize> {
        self.seen.binary_search_by_key(&id, |(id, _)| *id).ok()
    }

    /// The edition that fits best what has been seen so far.
    pub fn recognise(&self) -> Recognised {
        recognised::best(self.editions, self.default, &facts(&self.seen, &self.devices))
    }

    /// The edition that fits better than the default, if there is one. Its evidence is what does not fit the default.
    ///
    /// ```
    /// # use adsdv_oracle::recognise::Recogniser;
    /// # use adsdv_spec::Edition;
    /// let mut recogniser = Recogniser::new(&Edition::V4_0);
    /// recogniser.frame(0, 0x511, &[0; 4]);
    /// assert_eq!(recogniser.fits_better(), None);
    /// let mut recogniser = Recogniser::new(&Edition::V4_0);
    /// recogniser.frame(0, 0x511, &[0; 8]);
    /// assert_eq!(recogniser.fits_better().map(|other| other.edition.version), Some("3.0"));
    /// ```
    pub fn fits_better(&self) -> Option<Recognised> {
        let facts = facts(&self.seen, &self.devices);
        let best = recognised::best(self.editions, self.default, &facts);
        let own = self.editions.iter().position(|edition| edition.version == self.default.version)?;
        (best.edition.version != self.default.version).then(|| best.rather_than(own, self.editions, &facts))
    }
}
