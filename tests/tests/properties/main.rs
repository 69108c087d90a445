//! Properties of whole runs, of reports and of exports: what no theorem about a single step says, tried on random runs and
//! values. The first example that breaks a property is shrunk to a short one before it is reported.
//!
//! - `operations`: a run is a list of short operations, which are drawn along the way of a mission and an emergency.
//! - `run`: a run takes place, step by step, for properties to see.
//! - `timeline`: a run is written as a scenario that `adsdv demo --scenario` and `adsdv vcu --scenario` read, with what the AI
//!   Computer, the vehicle and the state machine do as comments in between.
//! - `holds`: proptest tries a property, and shows what breaks it.
//! - `runs`: what holds at every moment of every run: `second_opinion`, `clocks`, `power` and `handshake`.
//! - `recovery`: what can be done after any run.
//! - `time`: looking more often changes nothing.
//! - `log`: what the judge makes of a run that was recorded.
//! - `mutants`: every change of the table, of a time and of a threshold breaks a property, and the run that shows it is short.
//! - `suite`: a run as a line of a test suite reads back.
//! - `belief`: what may be known of a step allows what it comes to.
//! - `dbc`: the exported CAN database, read by another program, decodes what the codec encodes.
//!
//! So many cases are tried that all takes some seconds, the same ones every time: `ADSDV_SEED=7` draws others, and
//! `scripts/fresh-seeds.sh` goes from seed to seed for as long as one likes. `PROPTEST_CASES=10000 cargo test -p adsdv-tests
//! --test properties` tries more. What has failed once is kept beside these files, under `regressions`, and tried first from
//! then on.

mod belief;
mod clocks;
mod dbc;
mod handshake;
mod holds;
mod log;
mod mutants;
mod operations;
mod power;
mod recovery;
mod run;
mod runs;
mod second_opinion;
mod suite;
mod time;
mod timeline;
