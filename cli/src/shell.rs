//! `adsdv completions` and `adsdv man`: made from the arguments and their help texts, for who packages the command.

use std::io;

use clap::{Command, CommandFactory as _};
use clap_mangen::Man;
use clap_mangen::roff::{Inline, Roff, roman};

use crate::args::{Cli, CompletionsArgs, ManArgs};
use crate::error::Error;
use crate::output;
use crate::status::Status;

pub(crate) fn completions(args: &CompletionsArgs) -> Result<Status, Error> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "adsdv", &mut script);
    output::plain(&String::from_utf8_lossy(&script))?;
    Ok(Status::Conforms)
}

pub(crate) fn man(args: &ManArgs) -> Result<Status, Error> {
    let mut cli = Cli::command();
    // Names as in `adsdv check`, in each usage and heading.
    cli.build();
    let command = match &args.command {
        None => &cli,
        Some(name) => cli.find_subcommand(name).ok_or_else(|| unknown(&cli, name))?,
    };
    let page = page(command).map_err(|error| Error::system("the manual page", &error))?;
    output::plain(&page)?;
    Ok(Status::Conforms)
}

fn unknown(cli: &Command, name: &str) -> Error {
    let names: Vec<&str> = cli.get_subcommands().map(Command::get_name).collect();
    Error {
        what: name.to_owned(),
        why: format!("no such command; expected one of {}", names.join(", ")),
        hint: "adsdv man, without a command, prints the page of all".to_owned(),
    }
}

/// A page: what clap knows of the command, and behind it the headings of its help text as headings of the page.
fn page(command: &Command) -> io::Result<String> {
    let name = command.get_bin_name().unwrap_or(command.get_name()).replace(' ', "-");
    let man = Man::new(command.clone())
        .title(name.to_uppercase())
        .section("1")
        .source(concat!("adsdv ", env!("CARGO_PKG_VERSION")));
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_description_section(&mut page)?;
    man.render_options_section(&mut page)?;
    if command.has_subcommands() {
        man.render_subcommands_section(&mut page)?;
    }
    let text = command.get_after_long_help().map(ToString::to_string).unwrap_or_default();
    sections(&text).to_writer(&mut page)?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}

/// The headings of a help text, which stand at the margin, and their lines as they are.
fn sections(text: &str) -> Roff {
    let mut roff = Roff::new();
    for line in text.lines() {
        if line.starts_with(|first: char| first.is_ascii_uppercase()) && line == line.to_uppercase() {
            roff.control("fi", []).control("SH", [line]).control("nf", []);
        } else {
            let lines: [Inline; 1] = [roman(line)];
            roff.text(lines);
        }
    }
    roff
}
