//! The specification's tables, printed: the CAN database, Figure 2, the readings, the JSON Schemas, the Promela model.

use std::fmt::Write as _;

use adsdv_model::Promela;
use adsdv_spec::export::{Dbc, Dot, Figure2, Mermaid};

use crate::args::{
    ChosenEdition, DbcArgs, DiagramArgs, ExportArgs, Exported, Format, ReadingsArgs, SchemaArgs, WithJson,
};
use crate::error::Error;
use crate::layout::wrapped;
use crate::status::Status;
use crate::{json, output, pins};

/// The database says its edition itself, as its version.
pub(crate) fn dbc(args: &DbcArgs) -> Result<Status, Error> {
    print(&Dbc(args.edition.chosen()?.edition()).to_string())
}

pub(crate) fn diagram(args: &DiagramArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let machine = pins::machine(chosen.edition(), &args.readings)?;
    // The first line is a comment of the language.
    print(&match args.format {
        Format::Mermaid => format!("%% {chosen}\n{}", Mermaid(&machine)),
        Format::Dot => format!("// {chosen}\n{}", Dot(&machine)),
        Format::Markdown => format!("<!-- {chosen} -->\n\n{}", Figure2(&machine)),
    })
}

pub(crate) fn readings(args: &ReadingsArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    print(&if args.json { json::readings(chosen.edition()) } else { questions(chosen) })
}

pub(crate) fn schema(args: &SchemaArgs) -> Result<Status, Error> {
    print(match args.command {
        WithJson::Check => json::CHECK_SCHEMA,
        WithJson::Compare => json::COMPARE_SCHEMA,
        WithJson::Watch => json::WATCH_SCHEMA,
        WithJson::Logs => json::LOGS_SCHEMA,
        WithJson::Conform => json::CONFORM_SCHEMA,
        WithJson::Exam => json::EXAM_SCHEMA,
        WithJson::Suite => json::SUITE_SCHEMA,
        WithJson::Prove => json::PROVE_SCHEMA,
        WithJson::Verify => json::VERIFY_SCHEMA,
        WithJson::Costs => json::COSTS_SCHEMA,
        WithJson::Readings => json::READINGS_SCHEMA,
        WithJson::Diff => json::DIFF_SCHEMA,
    })
}

pub(crate) fn export(args: &ExportArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let machine = pins::machine(chosen.edition(), &args.readings)?;
    let (document, vectors) = (chosen.edition().rules.timing, args.vectors.into());
    print(&match args.format {
        Exported::Promela => {
            format!("/* {chosen} */\n{}", Promela { machine: &machine, document, vectors })
        }
    })
}

fn print(text: &str) -> Result<Status, Error> {
    output::plain(text)?;
    Ok(Status::Conforms)
}

/// The readings for a person; a star marks the default.
fn questions(chosen: ChosenEdition) -> String {
    let edition = chosen.edition();
    let choices = |reading| edition.choices.of_reading(reading);
    let ids = edition.questions().flat_map(choices).map(|choice| choice.id().len());
    let width = ids.max().unwrap_or_default();
    let mut text = format!("{chosen}\n\n");
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
