//! The editions of the interface: a folder for each, in which it stands as what it changes.
//!
//! A folder has its layouts (`ai.rs`, `vcu.rs`, `log.rs`: a table for each message that is laid out anew), its Figure 2
//! (`figure2.rs`), the numbers of its requirements (`requirements.rs`) and, in `mod.rs`, the [`Edition`] itself: an edition before it with other values. A further edition is one
//! more folder and its line here; `fictional.rs` shows the least that one takes. What a message says in any of them, and what
//! its numbers mean, stands in [`messages`](crate::messages).

#[cfg(test)]
mod fictional;
mod v2026;
mod v3_0;
mod v4_0;

pub use v3_0::V3_0;
pub use v4_0::V4_0;
pub use v2026::V2026;

use crate::edition::Edition;

impl Edition {
    /// Every edition, the oldest first.
    pub const ALL: &'static [&'static Self] = &[&Self::V3_0, &Self::V4_0, &Self::V2026];

    /// The edition that holds where nothing names another and no recording tells.
    pub const DEFAULT: &'static Self = &Self::V3_0;
}
