//! MCAP, for Foxglove, Lichtblick and PlotJuggler: a channel for each message, and what the judge says beside it.
//!
//! | topic | what a message of it is |
//! |---|---|
//! | `/adsdv/VCU2AI_Status` | a frame: each signal as a number, and of one with names the name as well, as `AS_STATE_name` |
//! | `/adsdv/can1/VCU2AI_Status` | the same of another interface than the one that is judged |
//! | `/adsdv/as_state` | the AS state, when it changes and each second |
//! | `/adsdv/blocked` | of each arrow of Figure 2 whether it is blocked, what by, and of each condition `true`, `false` or `unknown` |
//! | `/adsdv/findings` | what `adsdv check` finds, as `foxglove.Log` |
//! | `/can/can0/from_can_bus`, `to_can_bus` | every frame as it was, as `can_msgs/msg/Frame`; `_fd` those of CAN FD |
//!
//! The messages of a team's own database are under `/dbc` in place of `/adsdv`. All but the frames are JSON, each with its JSON Schema;
//! the frames are as ROS 2 records them, so that `adsdv check` judges the file as it judges the recording.
//!
//! ```text
//! Frame --> signals --> Topics --> McapWriter: chunk --LZ4--> out
//!   |                                |    \-- index of the chunk --> a temporary file, where it is long
//!   \--> Judged: AS state, blocked, findings         out <-- summary, at the end
//! ```
//!
//! The records are written here, and not by the crate `mcap`: that keeps the index of every chunk in memory until the end, and compresses
//! with libraries of C.

#[cfg(feature = "mcap")]
mod frames;
#[cfg(feature = "mcap")]
mod judged;
#[cfg(feature = "mcap")]
mod layout;
#[cfg(feature = "mcap")]
mod record;
#[cfg(feature = "mcap")]
mod schema;
#[cfg(feature = "mcap")]
mod sink;
#[cfg(feature = "mcap")]
mod summary;
#[cfg(feature = "mcap")]
mod topics;
#[cfg(feature = "mcap")]
mod writer;

use std::io::Write;

use adsdv_spec::Edition;

use crate::{Catalog, NotBuilt, Options, Sink};

/// Writes MCAP: the frames of these messages, and what a judge beside them says, who is asked as the recording was begun.
///
/// Nothing has to be read back or sought, so that the writer may be a pipe. Up to a few MB are kept in memory; what of the index does not
/// fit goes through a temporary file.
///
/// # Errors
///
/// Fails in a build without the feature `mcap`.
#[cfg_attr(
    not(feature = "mcap"),
    expect(unused_variables, clippy::needless_pass_by_value, reason = "there is nobody to use them")
)]
pub fn mcap<'a>(
    catalog: &'a Catalog,
    options: &Options,
    writer: impl Write + Send + 'a,
) -> Result<Box<dyn Sink + 'a>, NotBuilt> {
    #[cfg(feature = "mcap")]
    return Ok(Box::new(sink::McapFile::new(catalog, options, Box::new(writer))));
    #[cfg(not(feature = "mcap"))]
    Err(NotBuilt { format: "MCAP", feature: "mcap" })
}

/// A layout for Foxglove and Lichtblick that shows such a file of this edition, as they import it: JSON.
///
/// # Errors
///
/// Fails in a build without the feature `mcap`.
#[cfg_attr(not(feature = "mcap"), expect(unused_variables, reason = "there is nobody to use them"))]
pub fn mcap_layout(edition: &'static Edition) -> Result<String, NotBuilt> {
    #[cfg(feature = "mcap")]
    return Ok(layout::of(edition));
    #[cfg(not(feature = "mcap"))]
    Err(NotBuilt { format: "MCAP", feature: "mcap" })
}

#[cfg(all(test, not(feature = "mcap")))]
mod tests {
    use super::*;

    #[test]
    fn a_build_without_the_feature_names_it() {
        let catalog = Catalog::of(Edition::DEFAULT);
        let refused = mcap(&catalog, &Options::default(), Vec::new()).err().map(|error| error.to_string());
        let says = "this build does not write MCAP: it was built without the feature mcap";
        assert_eq!(refused.as_deref(), Some(says));
        assert!(mcap_layout(Edition::DEFAULT).is_err());
    }
}
