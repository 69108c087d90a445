//! What clap has to say: help and version, which were asked for, or what is wrong with the arguments, and what to do where clap
//! does not know it.

use std::ffi::OsString;
use std::io::{self, Write as _};
use std::path::Path;

use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::error::Error;
use crate::output;
use crate::status::Status;

/// The words behind `adsdv` are those that clap did not take.
pub(crate) fn usage(mut text: clap::Error, words: &[OsString]) -> Result<Status, Error> {
    if text.use_stderr() {
        let hint = hint(&text, words);
        if hint.is_some() {
            // The nearest name of an option is no help then.
            text.remove(ContextKind::SuggestedArg);
            if words.first().is_some_and(|word| word.as_encoded_bytes().starts_with(b"-")) {
                // Nor is a line that has this option in it.
                let line = "Usage: adsdv <COMMAND> [OPTIONS]";
                text.insert(ContextKind::Usage, ContextValue::StyledStr(line.into()));
            }
        }
        // If standard error cannot be written there is nobody left to tell; the status still tells.
        let _ = text.print();
        if let Some(hint) = hint {
            let _ = writeln!(io::stderr(), "hint: {hint}");
        }
        return Ok(Status::NoAnswer);
    }
    output::styled(&text.render().ansi().to_string(), clap::ColorChoice::Auto)?;
    Ok(Status::Conforms)
}

/// What to do, where somebody meant something that can be told.
fn hint(error: &clap::Error, words: &[OsString]) -> Option<String> {
    let command = words.first()?.to_str()?;
    let wrong = match (error.get(ContextKind::InvalidSubcommand), error.get(ContextKind::InvalidArg)) {
        (Some(ContextValue::String(wrong)), _) | (_, Some(ContextValue::String(wrong))) => {
            vec![wrong.as_str()]
        }
        (_, Some(ContextValue::Strings(all))) => all.iter().map(String::as_str).collect(),
        _ => Vec::new(),
    };
    let lacks = |what: &str| error.kind() == ErrorKind::MissingRequiredArgument && wrong.contains(&what);
    let stray =
        error.kind() == ErrorKind::UnknownArgument && wrong.iter().any(|wrong| !wrong.starts_with('-'));
    let hint = match (command, error.kind()) {
        (_, ErrorKind::InvalidSubcommand) if Path::new(command).exists() => {
            return Some(format!("a recording is judged by: adsdv check {command}"));
        }
        (_, ErrorKind::UnknownArgument) if command.starts_with('-') => {
            "options stand behind the command, such as: adsdv check --edition 4.0 run.log"
        }
        ("check", _) if lacks("<LOG>...") && words.iter().any(|word| word == "--html") => {
            "--html names the page that is to be written, and the recording comes behind it: adsdv check --html run.html run.log"
        }
        ("conform", _) if stray || lacks("<PROGRAM>...") => {
            "the program stands behind --, with what starts it: adsdv conform -- python3 vcu.py"
        }
        ("exam", ErrorKind::ArgumentConflict)
            if wrong.contains(&"--stdio") || wrong.contains(&"[INTERFACE]") =>
        {
            "the program stands behind --, and with --stdio it has no interface: adsdv exam --stdio -- ./my_stack"
        }
        ("exam", _) if lacks("<INTERFACE>") => {
            "name the interface on which the stack is, or --namespace to have one made; --stdio asks a program without CAN"
        }
        ("exam", _) if lacks("<PROGRAM>...") => {
            "the program stands behind --, with what starts it: adsdv exam --stdio -- python3 my_stack.py"
        }
        _ => return None,
    };
    Some(hint.to_owned())
}
