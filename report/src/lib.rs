//! A judged recording as a page to look at: one file that needs no network, no program and no other file.
//!
//! ```text
//! a log --> Recorder --> the judge --> Report, and what --json prints of it
//!              |                          |
//!              v                          v
//!          Recording (every frame) --> Subject --> one object of JSON --> page.html
//!                                        |
//!              summary, questions: sentences;  lanes: what changes;  plots, overview: the first picture;
//!              chunks: every frame, for all that is looked at closely;  catalog: how frames are read
//! ```
//!
//! The pages themselves are in `page/`: TypeScript that is built into templates (`page/dist`), which are checked in, so that nobody needs
//! Node who wants a page. Each takes one object of data, and asks for nothing else.
//!
//! What came of a program or of the readings of the document is a page as well: an [`Outcome`], of what `--json` prints of it.
//!
//! There are no threads here, no files and no clock: what comes in is entries of a log, and what goes out is text. So a browser can
//! do the same.
//!
//! Nothing that stands in a log is markup on the page. The data is JSON in which no `<` is left, the page shows it as text, and a
//! content security policy lets run only the one script of the template.

#![forbid(unsafe_code)]

mod answers;
pub mod asked;
mod catalog;
mod chunks;
mod clock;
mod facts;
mod figure;
pub mod json;
mod lanes;
mod mood;
mod next;
mod outcome;
mod overview;
mod packed;
mod page;
mod plots;
mod questions;
mod recorder;
mod recording;
mod requests;
mod summary;
mod template;
mod time;

pub use asked::Asked;
pub use catalog::catalog;
pub use figure::Picture;
pub use mood::Mood;
pub use next::next;
pub use outcome::{Outcome, Shown};
pub use page::{PageError, Subject};
pub use recorder::Recorder;
pub use recording::{Found, Kept, Lost, Recording, signal};
