//! A flag of 120h that was raised, which waits to be judged.

/// A flag that was raised.
#[derive(Clone, Copy, Debug)]
pub(super) enum Raised {
    /// The timeout of this one of the messages that are watched.
    Timeout(usize),
    /// That the handshake is not answered; whether it was by all that was recorded, and whether a frame of 120h may be missing before.
    Handshake { answered: bool, gap: bool },
    /// This one of the warnings.
    Warning(usize),
}

/// A flag that was raised, and since when: no frame showed it before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rise {
    pub(super) raised: Raised,
    pub(super) since: i64,
}
