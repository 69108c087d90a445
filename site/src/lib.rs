//! The page that judges recordings in a browser, and a server of it.
//!
//! ```text
//! web/ (the judge as WebAssembly) + web/page (TypeScript) --scripts/web.sh --build--> dist/adsdv.html --> PAGE --> serve
//! ```
//!
//! The page is one file, which is checked in, so that nobody needs Node or another compiler who wants it. It needs nothing but itself,
//! so that the server has one answer: no path of a request reaches a file. With a
//! [`Feed`] it has a second one: the lines of a stream, for the page alone.

#![forbid(unsafe_code)]

mod feed;
mod headers;
mod live;
mod serve;
mod stream;

pub use feed::{Feed, Lines};
pub use serve::{Site, SiteError};

/// The page, whole.
///
/// ```
/// assert!(adsdv_site::PAGE.starts_with("<!doctype html>"));
/// assert!(adsdv_site::PAGE.contains("default-src 'none'"));
/// ```
pub const PAGE: &str = include_str!("../dist/adsdv.html");
