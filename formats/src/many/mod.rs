//! Many recordings: which files they are, and all of them at once on all cores. The unit of work is one recording.
//!
//! ```text
//! paths, patterns, directories --> find --> Found: its source --> open --> whatever is done with it, by each
//! ```

mod each;
mod find;

pub use each::{Step, each};
pub use find::{FindError, Found, find, is_several};
