//! Runs: paths of the model as logs, and what the judge of logs says of them.
//!
//! - `path`: writing down a path as changes of what the VCU sees.
//! - `judged`: whole runs, right and wrong, judged as they should be.
//! - `random`: random paths, whose raw inputs do what the observations did, and whose logs blame nobody wrongly.

#[path = "../chance/mod.rs"]
mod chance;
mod judged;
mod path;
mod random;
