//! `adsdv`: the executable specification of the ADS-DV AI/VCU interface, at the command line.
//!
//! ```text
//! args ----> check ----> report (text, for a person)
//!   |          |         json   (for a program)
//!   |          |         html   (a page to look at)
//!   |          +-------> the verdict is the exit status
//!   +------> compare --> what differs between two logs, and the exit status
//!   +------> decode --> every signal of a log, for a person or for another tool
//!   +------> conform --> a program under test, asked and judged, and the exit status
//!   +------> exam -----> an AI Computer under test, asked and judged, and the exit status
//!   +------> demo -----> a mission without any CAN, judged as a log is
//!   +------> vcu, ai --> the car, or a small AI Computer, on a bus until it is stopped
//!   +------> watch ----> the judge of a live bus until it is stopped, and the exit status
//!   +------> verify ---> the properties of the state machine, and the exit status
//!   +------> explore:    a web page, until it is stopped
//!   +------> web:        the page that judges in a browser, until it is stopped
//!   +------> diff -----> what one edition changes of another
//!   +------> suite ----> the conformance test suite, or the proof that it is complete
//!   +------> shell:      completions, and manual pages
//!   +------> tables:     the CAN database, Figure 2, the readings, the JSON Schemas, the Promela model
//! ```
//!
//! Every command makes its whole text first and hands it to [`output`], which alone writes to standard output, but for those
//! that go on until they are stopped: these hand over one piece after the other, or have a [`screen`].

#![forbid(unsafe_code)]

mod accept;
mod ai;
mod args;
mod check;
mod compare;
mod conform;
mod decode;
mod demo;
mod diff;
mod error;
mod exam;
mod excerpt;
mod explore;
mod files;
mod html;
mod interrupt;
mod json;
mod judged;
mod kept;
mod layout;
mod many;
mod markdown;
mod operate;
mod output;
mod pins;
mod plain;
mod progress;
mod recording;
mod report;
mod requires;
mod rules;
mod screen;
mod shell;
mod status;
mod suite;
mod tables;
mod usage;
mod vcu;
mod verify;
mod watch;
mod web;
mod whole;

use std::env;
use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};
use error::Error;
use status::Status;

fn main() -> ExitCode {
    let result = match Cli::try_parse() {
        Ok(cli) => run(&cli.command),
        Err(text) => usage::usage(text, &env::args_os().skip(1).collect::<Vec<_>>()),
    };
    result.unwrap_or_else(|error| error.print()).into()
}

fn run(command: &Command) -> Result<Status, Error> {
    match command {
        Command::Ai(args) => ai::run(args),
        Command::Check(args) => check::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Completions(args) => shell::completions(args),
        Command::Demo(args) => demo::run(args),
        Command::Conform(args) => conform::run(args),
        Command::Exam(args) => exam::run(args),
        Command::Decode(args) => decode::run(args),
        Command::Dbc(args) => tables::dbc(args),
        Command::Diagram(args) => tables::diagram(args),
        Command::Diff(args) => diff::run(args),
        Command::Man(args) => shell::man(args),
        Command::Readings(args) => tables::readings(args),
        Command::Schema(args) => tables::schema(args),
        Command::Suite(args) => suite::run(args),
        Command::Explore(args) => explore::run(args),
        Command::Export(args) => tables::export(args),
        Command::Vcu(args) => vcu::run(args),
        Command::Verify(args) => verify::run(args),
        Command::Watch(args) => watch::run(args),
        Command::Web(args) => web::run(args),
    }
}
