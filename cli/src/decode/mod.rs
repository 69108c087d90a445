//! `adsdv decode`: every signal of a recording, as text or for another tool.
//!
//! ```text
//! LOG --> Recording::begin (which edition?) --> Catalog, with --dbc --> a sink of the format --> notes on standard error
//! ```

mod database;
mod errors;
mod notes;
mod whole;

use std::fs::File;
use std::io::{self, IsTerminal as _, Write};
use std::path::Path;

use adsdv_decode::{
    Catalog, Csv, DecodeError, JsonLines, Options, Recording, Sink, Text, TextLayout, VcdFile, mcap,
    mcap_layout,
};

use crate::args::{DecodeArgs, Decoded};
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{files, recording};
use whole::WholeFile;

pub(crate) fn run(args: &DecodeArgs) -> Result<Status, Error> {
    if args.single_line && args.format != Decoded::Text {
        return Err(errors::single_line());
    }
    if args.layout.is_some() && args.format != Decoded::Mcap {
        return Err(errors::layout());
    }
    let databases = args.dbc.iter().map(|file| database::read(file)).collect::<Result<Vec<_>, _>>()?;
    let chosen = args.edition.chosen()?;
    let options = Options {
        edition: chosen.asked_for().map(|_| chosen.edition()),
        default: chosen.edition(),
        interface: args.interface.clone(),
    };
    let name = recording::name(&args.log);
    let log = recording::open(&args.log, &name)?;
    let recording = Recording::begin(log, &options).map_err(|error| Error::log(&name, &error))?;
    let catalog = Catalog::with(recording.recognised().edition, &databases);
    let recognised = recording.recognised().clone();
    let layout = layout(args, &catalog)?;
    let whole = args.output.as_deref().filter(|_| args.format == Decoded::Mcap);
    let whole = whole.map(WholeFile::begin).transpose()?.flatten();
    let (writer, live) = match &whole {
        Some(whole) => (Box::new(whole.writer()?) as Box<dyn Write>, false),
        None => writer(args)?,
    };
    let mut sink: Box<dyn Sink + '_> = match args.format {
        Decoded::Text if args.single_line => {
            Box::new(Text::new(&catalog, writer, TextLayout::SingleLine, live))
        }
        Decoded::Text => Box::new(Text::new(&catalog, writer, TextLayout::Lines, live)),
        Decoded::Csv => Box::new(Csv::new(&catalog, writer, live)),
        Decoded::Jsonl => Box::new(JsonLines::new(&catalog, writer, live)),
        Decoded::Vcd => Box::new(VcdFile::new(&catalog, writer)),
        Decoded::Mcap => {
            mcap(&catalog, &options, writer).map_err(|error| errors::not_built("mcap", error))?
        }
    };
    if let (Some(file), Some(layout)) = (&args.layout, layout) {
        files::write_file(file, "--layout", &layout)?;
    }
    let mut shown = ProgressLine::new();
    let decoded = recording.decode(&catalog, &mut *sink, |lines| shown.show(format_args!("{lines} lines")));
    drop(shown);
    match decoded {
        Ok(summary) => {
            whole.map_or(Ok(()), WholeFile::keep)?;
            notes::print(&recognised, options.edition.is_none(), &catalog, &summary, &sink.notes());
            let failure = summary.failure.map(adsdv_oracle::log::LogError::Read);
            failure.map_or(Ok(Status::Conforms), |failure| Err(Error::log(&name, &failure)))
        }
        Err(DecodeError::Log(error)) => Err(Error::log(&name, &error)),
        // Whoever reads it has seen enough.
        Err(DecodeError::Sink(error))
            if args.output.is_none() && error.0.kind() == io::ErrorKind::BrokenPipe =>
        {
            Ok(Status::Conforms)
        }
        Err(DecodeError::Sink(error)) => Err(match &args.output {
            Some(file) => errors::write(file, &error.0),
            None => Error::output(&error.0),
        }),
    }
}

/// The layout that shows it, where there is one for the format.
fn layout(args: &DecodeArgs, catalog: &Catalog) -> Result<Option<String>, Error> {
    let layout = (args.format == Decoded::Mcap).then(|| mcap_layout(catalog.edition()));
    layout.transpose().map_err(|error| errors::not_built("mcap", error))
}

/// Where the answer goes, and whether somebody may be waiting for each line of it.
fn writer(args: &DecodeArgs) -> Result<(Box<dyn Write>, bool), Error> {
    let is_stream = args.log == Path::new(recording::STDIN);
    match &args.output {
        Some(file) => {
            let opened = File::create(file).map_err(|error| errors::write(file, &error))?;
            Ok((Box::new(opened), is_stream))
        }
        None => Ok((Box::new(io::stdout()), is_stream || io::stdout().is_terminal())),
    }
}
