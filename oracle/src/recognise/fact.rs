//! Something that a recording shows, and how much it says against an edition.

/// Something that was seen.
#[derive(Debug)]
pub(super) struct Fact {
    /// In words, such as `511h has 4 bytes`.
    pub(super) text: String,
    /// What each edition says instead, such as `8`; `None` where it fits.
    pub(super) instead: Vec<Option<String>>,
    /// How much it says against the editions that it does not fit.
    pub(super) weight: u32,
}

/// How much each kind of fact weighs. A length is nobody's choice. Where the two sides differ, the VCU's counts for more: it is
/// its state machine that is judged.
pub(super) mod weight {
    pub(in crate::recognise) const LENGTH_OF_VCU: u32 = 9;
    pub(in crate::recognise) const LENGTH_OF_AI: u32 = 8;
    /// Bits for which an edition has no signal, and another has.
    pub(in crate::recognise) const BITS: u32 = 4;
    /// A message that an edition does not have: somebody else may send that identifier.
    pub(in crate::recognise) const PRESENT: u32 = 2;
    pub(in crate::recognise) const CYCLE: u32 = 2;
    /// Messages of devices that an edition does not name: its vehicle may have them all the same.
    pub(in crate::recognise) const DEVICE: u32 = 1;
    /// A value that an edition does not allow: it may be a fault of the sender.
    pub(in crate::recognise) const VALUE: u32 = 1;
    /// Frames of another length beside most of them.
    pub(in crate::recognise) const ALSO: u32 = 1;
    /// The recorder may have left it out.
    pub(in crate::recognise) const ABSENT: u32 = 0;
}
