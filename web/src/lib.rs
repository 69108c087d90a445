//! The judge and the virtual car for a browser: requests and answers in JSON, the bytes of a log beside them.
//!
//! ```text
//! page --request--> Session::answer --+--> logs: formats --> Recorder --> the judge --> the data of the page
//!      <--answer---                   +--> drive: the car, the AI Computer, the live judge
//!                                     +--> about: editions, readings, switches, Figure 2, examples
//! ```
//!
//! Built for `wasm32-unknown-unknown` it is a module of a few functions (`abi.rs` has all of them), which `page/` runs in a worker:
//! nothing of a log leaves the browser. Built for anything else it is the same, for tests.
//!
//! An error is an answer: what was given, what is wrong with it, and what to do.

#![deny(unsafe_code)]

#[cfg(target_family = "wasm")]
mod abi;
mod about;
mod drive;
mod error;
mod examples;
mod figure;
mod live;
mod logs;
mod session;
mod subject;

pub use session::{Answer, Session};
