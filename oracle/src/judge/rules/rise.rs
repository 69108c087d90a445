//! A flag of 120h that was raised, which waits to be judged.

/// A flag that was raised.
#[derive(Clone, Copy, Debug)]
pub(super) enum Raised {
    /// The timeout of this one of the messages that are watched.
    Timeout(usize),
    /// That the handshake is not answered; whether it was by all that was recorded.
    Handshake { answered: bool },
    /// This one of the warnings.
    Warning(usize),
}

/// A flag that was raised, since when, as no frame showed it before, and whether a frame may be missing in between.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rise {
    pub(super) raised: Raised,
    pub(super) since: i64,
    pub(super) gap: bool,
}
