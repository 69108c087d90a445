//! The specification's tables, printed: the CAN database, Figure 2, the readings, the JSON Schemas, the Promela model.

use std::fmt::Write as _;

use adsdv_model::Promela;
use adsdv_spec::export::{Dbc, Dot, Figure2, Mermaid};
use adsdv_spec::{Edition, Machine};

use crate::args::{DiagramArgs, ExportArgs, Exported, Format, ReadingsArgs, SchemaArgs, WithJson};
use crate::error::Error;
use crate::layout::wrapped;
use crate::status::Status;
use crate::{json, output, pins};

pub(crate) fn dbc() -> Result<Status, Error> {
    print(&Dbc(Edition::DEFAULT).to_string())
}

pub(crate) fn diagram(args: &DiagramArgs) -> Result<Status, Error> {
    let machine = Machine::new(*Edition::DEFAULT, pins::answers(&args.readings)?);
    print(&match args.format {
        Format::Mermaid => Mermaid(&machine).to_string(),
        Format::Dot => Dot(&machine).to_string(),
        Format::Markdown => Figure2(&machine).to_string(),
    })
}

pub(crate) fn readings(args: &ReadingsArgs) -> Result<Status, Error> {
    print(&if args.json { json::readings() } else { questions() })
}

pub(crate) fn schema(args: &SchemaArgs) -> Result<Status, Error> {
    print(match args.command {
        WithJson::Check => json::CHECK_SCHEMA,
        WithJson::Watch => json::WATCH_SCHEMA,
        WithJson::Conform => json::CONFORM_SCHEMA,
        WithJson::Suite => json::SUITE_SCHEMA,
        WithJson::Prove => json::PROVE_SCHEMA,
        WithJson::Verify => json::VERIFY_SCHEMA,
    })
}

pub(crate) fn export(args: &ExportArgs) -> Result<Status, Error> {
    let machine = Machine::new(*Edition::DEFAULT, pins::answers(&args.readings)?);
    let (document, vectors) = (Edition::DEFAULT.rules.timing, args.vectors.into());
    print(&match args.format {
        Exported::Promela => Promela { machine: &machine, document, vectors }.to_string(),
    })
}

fn print(text: &str) -> Result<Status, Error> {
    output::plain(text)?;
    Ok(Status::Conforms)
}

/// The readings for a person; a star marks the default.
fn questions() -> String {
    let edition = Edition::DEFAULT;
    let choices = |reading| edition.choices.of_reading(reading);
    let ids = edition.questions().flat_map(choices).map(|choice| choice.id().len());
    let width = ids.max().unwrap_or_default();
    let mut text = String::new();
    for reading in edition.questions() {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{} (section {})", reading.id(), reading.section());
        wrapped(&mut text, reading.question().split(' '), 4, output::width());
        for choice in choices(reading) {
            let mark = if edition.readings.is(choice) { '*' } else { ' ' };
            let _ = writeln!(text, "  {mark} {:width$}  {}", choice.id(), choice.text());
        }
        text.push('\n');
    }
    text.push_str("* the default: what the reference VCU does. The judge of a log allows for every\n");
    text.push_str("  choice of a reading, until --reading ID=CHOICE pins it.\n");
    text
}
