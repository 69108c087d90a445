//! `adsdv decode`: every signal of a recording, as text or for another tool.
//!
//! ```text
//! LOG --> Recording::begin (which edition?) --> Catalog, with --dbc --> a sink of the format --> notes on standard error
//! ```

mod database;
mod destination;
mod errors;
mod notes;

use std::fs::File;
use std::io::{self, IsTerminal as _};
use std::path::{Path, PathBuf};

use adsdv_decode::{
    Catalog, Csv, DecodeError, JsonLines, Options, Recording, Sink, Table, Text, TextLayout, VcdFile, mcap,
    mcap_layout, parquet, parquet_messages,
};

use self::destination::Unfinished;
use crate::args::{DecodeArgs, Decoded, DecodedTable};
use crate::error::Error;
use crate::kept::keep;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{files, recording};

pub(crate) fn run(args: &DecodeArgs) -> Result<Status, Error> {
    if args.single_line && args.format != Decoded::Text {
        return Err(errors::single_line());
    }
    if args.table.is_some() && args.format != Decoded::Parquet {
        return Err(errors::table());
    }
    if args.layout.is_some() && args.format != Decoded::Mcap {
        return Err(errors::layout());
    }
    let output = destination::output(args)?;
    for (option, file) in [("--output", output), ("--layout", args.layout.as_deref())] {
        keep(args.dbc.iter().chain([&args.log]).map(PathBuf::as_path), option, file)?;
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
    let (mut sink, unfinished) = sink(args, output, &catalog, &options, &name)?;
    if let Some(file) = &args.layout {
        let layout = mcap_layout(catalog.edition()).map_err(errors::not_built)?;
        files::write_file(file, "--layout", &layout)?;
    }
    let mut shown = ProgressLine::new();
    let decoded = recording.decode(&catalog, &mut *sink, |lines| shown.show(format_args!("{lines} lines")));
    drop(shown);
    let of_format = sink.notes();
    drop(sink);
    match decoded {
        Ok(summary) => {
            unfinished.finish()?;
            notes::print(&recognised, options.edition.is_none(), &catalog, &summary, &of_format);
            let failure = summary.failure.map(adsdv_oracle::log::LogError::Read);
            failure.map_or(Ok(Status::Conforms), |failure| Err(Error::log(&name, &failure)))
        }
        Err(DecodeError::Log(error)) => Err(Error::log(&name, &error)),
        // The reader has seen enough.
        Err(DecodeError::Sink(error)) if output.is_none() && error.0.kind() == io::ErrorKind::BrokenPipe => {
            Ok(Status::Conforms)
        }
        Err(DecodeError::Sink(error)) => Err(errors::written(output, &error.0)),
    }
}

/// What makes the answer, and what has to be done when all of it is written.
fn sink<'a>(
    args: &DecodeArgs,
    output: Option<&Path>,
    catalog: &'a Catalog,
    options: &Options,
    log: &str,
) -> Result<(Box<dyn Sink + 'a>, Unfinished), Error> {
    let table = match args.table {
        Some(DecodedTable::Messages) => return messages(output, catalog, log),
        Some(DecodedTable::Frames) => Table::Frames,
        Some(DecodedTable::Signals) | None => Table::Signals,
    };
    let (writer, unfinished) = if args.format.is_whole() {
        destination::whole(output)?
    } else {
        (destination::stream(output)?, Unfinished::Nothing)
    };
    // Somebody may be waiting for each line of it.
    let live = args.log == Path::new(recording::STDIN) || output.is_none() && io::stdout().is_terminal();
    let sink: Box<dyn Sink + 'a> = match args.format {
        Decoded::Text if args.single_line => {
            Box::new(Text::new(catalog, writer, TextLayout::SingleLine, live))
        }
        Decoded::Text => Box::new(Text::new(catalog, writer, TextLayout::Lines, live)),
        Decoded::Csv => Box::new(Csv::new(catalog, writer, live)),
        Decoded::Jsonl => Box::new(JsonLines::new(catalog, writer, live)),
        Decoded::Vcd => Box::new(VcdFile::new(catalog, writer)),
        Decoded::Parquet => {
            parquet(table, catalog, writer, log).map_err(|error| errors::begin(output, &error))?
        }
        Decoded::Mcap => mcap(catalog, options, writer).map_err(errors::not_built)?,
    };
    Ok((sink, unfinished))
}

/// The same for a table of each message, in a directory.
fn messages<'a>(
    output: Option<&Path>,
    catalog: &'a Catalog,
    log: &str,
) -> Result<(Box<dyn Sink + 'a>, Unfinished), Error> {
    let target = output.ok_or_else(errors::messages_without_directory)?;
    let (folder, unfinished) = destination::directory(target)?;
    let sink = parquet_messages(catalog, move |name| File::create_new(folder.join(name)), log)
        .map_err(|error| errors::begin(output, &error))?;
    Ok((sink, unfinished))
}
