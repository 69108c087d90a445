//! The command as its users run it: arguments, standard input, output and error, exit status.

#![forbid(unsafe_code)]

#[cfg(target_os = "linux")]
mod bad_input;
mod color;
mod compare;
mod conform;
mod decode;
mod decode_parquet;
mod demo;
mod diagnosis;
mod diff;
mod documents;
mod edition;
mod errors;
mod exam;
mod excerpt;
mod exercised;
mod explore;
mod export;
mod first_screen;
mod golden;
mod help;
mod html;
mod many;
mod piped;
mod readings;
mod rules;
mod run;
mod schema;
#[cfg(target_os = "linux")]
mod screen;
mod shell;
mod streams;
mod suite;
mod tables;
mod verify;
mod watch_web;
mod web;
mod why;
