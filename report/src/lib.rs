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
//! The page itself is in `page/`: TypeScript that is built into one template (`page/dist/page.html`), which is checked in, so that
//! nobody needs Node who wants a page. It takes one object of data, and asks for nothing else.
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
pub mod json;
mod lanes;
mod mood;
mod overview;
mod packed;
mod page;
mod plots;
mod questions;
mod recorder;
mod recording;
mod requests;
mod summary;
mod time;

pub use asked::Asked;
pub use catalog::catalog;
pub use page::{PageError, Subject};
pub use recorder::Recorder;
pub use recording::{Found, Kept, Lost, Recording, signal};
