//! The pages of the book that are tables of the specification, made from it.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-tests --test book` writes them anew.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use adsdv_spec::messages::{Coding, DeviceMessage, DeviceSignal, MessageDef, Node, SignalDef};
use adsdv_spec::{Edition, requirement};
use expect_test::expect_file;

/// Text in a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('<', "&lt;").replace('\n', " ")
}

fn row(page: &mut String, cells: &[String]) {
    writeln!(page, "| {} |", cells.join(" | ")).expect("a string takes it");
}

fn head(page: &mut String, cells: &[&str]) {
    row(page, &cells.iter().map(|cell| (*cell).to_owned()).collect::<Vec<_>>());
    writeln!(page, "|{}", "---|".repeat(cells.len())).expect("a string takes it");
}

fn bits(start: u8, width: u8) -> String {
    if width == 1 {
        start.to_string()
    } else {
        format!("{start} to {}", u16::from(start) + u16::from(width) - 1)
    }
}

fn values(signal: &SignalDef) -> String {
    if signal.values.is_empty() {
        return format!("{} to {}", signal.display(signal.min), signal.display(signal.max));
    }
    let named: Vec<_> = signal.values.iter().map(|(raw, name)| format!("{raw} {name}")).collect();
    named.join(", ")
}

fn message(page: &mut String, def: &MessageDef) {
    writeln!(
        page,
        "\n### {:03X}h {}\n\n{} {} bytes, every {} ms, section {}.\n",
        def.id,
        def.name,
        cell(def.doc),
        def.len,
        def.cycle_ms,
        def.section
    )
    .expect("a string takes it");
    head(page, &["signal", "bits", "values", "one step", "what it says"]);
    for signal in def.signals {
        let sign = if signal.signed { ", signed" } else { "" };
        let step = if signal.values.is_empty() {
            format!("{} {}", signal.scale, signal.unit)
        } else {
            String::new()
        };
        let bits = format!("{}{sign}", bits(signal.start, signal.width));
        row(
            page,
            &[signal.name.to_owned(), bits, cell(&values(signal)), cell(step.trim()), cell(signal.doc)],
        );
    }
}

fn device(page: &mut String, def: &DeviceMessage) {
    let cycle = def.cycle_ms.map_or_else(String::new, |cycle| format!(", every {cycle} ms"));
    writeln!(
        page,
        "\n### {:03X}h {}\n\n{} {}{cycle}, from {} ({}).\n",
        def.id,
        def.name,
        def.len,
        if def.len == 1 { "byte" } else { "bytes" },
        def.sender,
        def.sender.what()
    )
    .expect("a string takes it");
    head(page, &["signal", "bits", "values", "one step"]);
    for signal in def.signals {
        let DeviceSignal { name, start, width, coding, scale, offset, unit, min, max, values } = *signal;
        let coding = match coding {
            Coding::Unsigned => "",
            Coding::Signed => ", signed",
            Coding::Float => ", IEEE 754",
        };
        let named: Vec<_> = values.iter().map(|(raw, name)| format!("{raw} {name}")).collect();
        let offset = if offset == 0.0 { String::new() } else { format!(", from {offset}") };
        let (values, step) = if named.is_empty() {
            (format!("{min} to {max} {unit}"), format!("{scale} {unit}"))
        } else {
            (named.join(", "), String::new())
        };
        let bits = format!("{}{coding}", bits(start, width));
        row(page, &[name.to_owned(), bits, cell(values.trim()), cell(step.trim()) + &offset]);
    }
}

/// Every message of an edition, with its signals.
fn messages(edition: &Edition) -> String {
    let mut page = format!(
        "# Messages of edition {}\n\nMade from the tables of [`spec/`](../spec), of {}; `adsdv dbc --edition {}` prints the same as a CAN \
         database. Bit 0 is the lowest bit of the first byte, and a signal of several bytes has its lowest byte first.\n",
        edition.version, edition.document, edition.version
    );
    for node in [Node::Ai, Node::Vcu] {
        let who = if node == Node::Ai { "the AI Computer" } else { "the VCU" };
        writeln!(page, "\n## From {who}").expect("a string takes it");
        for def in edition.bus.messages.iter().filter(|def| def.sender == node) {
            message(&mut page, def);
        }
    }
    if !edition.bus.devices.is_empty() {
        page.push_str("\n## From other devices\n");
        for def in edition.bus.devices {
            device(&mut page, def);
        }
    }
    page
}

/// The numbers of each edition side by side.
fn numbers() -> String {
    let mut page = "# Times and thresholds\n\nMade from the tables of [`spec/`](../spec).\n\n".to_owned();
    let versions = Edition::ALL.iter().map(|edition| edition.version);
    head(&mut page, &["what"].into_iter().chain(versions).collect::<Vec<_>>());
    let mut line = |what: &str, of: &dyn Fn(&Edition) -> String| {
        let cells = Edition::ALL.iter().map(|edition| of(edition));
        row(&mut page, &[what.to_owned()].into_iter().chain(cells).collect::<Vec<_>>());
    };
    let ms = |ms: u16| format!("{ms} ms");
    line("AS_READY lasts at least (3.2)", &|edition| ms(edition.rules.timing.ready_dwell_ms));
    line("EMERGENCY_BRAKE lasts at least (3.9)", &|edition| ms(edition.rules.timing.ebs_timer_ms));
    line("an edge of HANDSHAKE is answered within (2.4)", &|edition| ms(edition.rules.timing.handshake_ms));
    line("a message of the AI Computer is missed after (2.4)", &|edition| {
        edition.rules.thresholds.missed_ms.map_or_else(|| "-".to_owned(), ms)
    });
    line("a wheel moves above, and is at rest below (3.3, 3.7)", &|edition| {
        edition.rules.thresholds.wheel_speed.to_string()
    });
    line("the steer angle is straight below, to either side (3.2)", &|edition| {
        edition.rules.thresholds.straight.to_string()
    });
    line("messages between the two", &|edition| edition.bus.messages.len().to_string());
    line("messages of other devices", &|edition| edition.bus.devices.len().to_string());
    page
}

/// The questions that the document leaves open, and the answers of each edition.
fn readings() -> String {
    let mut page = "# What the document leaves open\n\nMade from [`readings.rs`](../spec/src/readings.rs). Where the document allows several \
                    meanings, each is a named answer to a question. A judged VCU may follow any of them until `--reading ID=ANSWER` pins \
                    one; what this project implements is the answer that is marked for the edition. \
                    [`READINGS.md`](../model/READINGS.md) tells what each answer can cost, \
                    [`DISCREPANCIES.md`](../spec/DISCREPANCIES.md) where text, figures and database disagree.\n"
        .to_owned();
    for reading in adsdv_spec::Reading::ALL {
        writeln!(
            page,
            "\n## {}\n\nSection {}: {}\n",
            reading.id(),
            reading.section(),
            cell(reading.question())
        )
        .expect("a string takes it");
        if let Some(sentence) = requirement(reading.decision()) {
            writeln!(page, "{}: {}\n", reading.decision(), cell(sentence)).expect("a string takes it");
        }
        let versions = Edition::ALL.iter().map(|edition| edition.version);
        head(&mut page, &["answer", "in words"].into_iter().chain(versions).collect::<Vec<_>>());
        for &choice in reading.choices() {
            let mark = |edition: &&Edition| {
                let (possible, ours) = (edition.choices.has(choice), edition.readings.is(choice));
                if ours && possible {
                    "ours"
                } else if possible {
                    "possible"
                } else {
                    "-"
                }
            };
            let marks = Edition::ALL.iter().map(|edition| mark(edition).to_owned());
            let cells = [format!("`{}`", choice.id()), cell(choice.text())];
            row(&mut page, &cells.into_iter().chain(marks).collect::<Vec<_>>());
        }
    }
    page
}

#[test]
fn the_messages_in_the_book_are_those_of_each_edition() {
    for edition in Edition::ALL {
        expect_file![format!("../../docs/messages-{}.md", edition.version)].assert_eq(&messages(edition));
    }
}

#[test]
fn the_times_and_thresholds_in_the_book_are_those_of_each_edition() {
    expect_file!["../../docs/numbers.md"].assert_eq(&numbers());
}

#[test]
fn the_open_questions_in_the_book_are_those_of_the_readings() {
    expect_file!["../../docs/readings.md"].assert_eq(&readings());
}

#[test]
fn what_lists_the_editions_by_hand_lists_them_all() {
    let versions: Vec<_> = Edition::ALL.iter().map(|edition| edition.version).collect();
    let quoted = |quote: &str| versions.join(&format!("{quote}, {quote}"));
    let (double, plain) = (quoted("\""), versions.join(", "));
    let (newest, older) = versions.split_last().expect("an edition");
    let (_, from_4_0) = versions.split_first().expect("an edition");
    let mut expected = vec![
        (".github/ISSUE_TEMPLATE/wrong-finding.yml", format!("options: [\"{double}\", ")),
        ("docs/glossary.md", format!("with its CAN database: {plain} |")),
        ("exam/examples/ros2_bridge.py", format!("EDITIONS = (\"{}\")", from_4_0.join("\", \""))),
        ("exam/examples/stack.py", format!("in (\"{double}\")")),
        ("ffi/README.md", format!("expected one of {plain}\n")),
        ("python/README.md", format!("['{}']", quoted("'"))),
        ("scripts/sensitivity.sh", format!("{} or {newest}; ", older.join(", "))),
        ("web/page/tests/served.test.mjs", format!("[null, \"{double}\"]")),
        (
            "docs/first-diagnosis.md",
            format!("For today's car answer the hello with `{{\"edition\": \"{newest}\"}}`"),
        ),
        ("docs/first-drive.md", format!("ADSDV_EDITION={newest} ")),
        ("docs/first-drive.md", format!("today's car speaks\n{newest},")),
        ("docs/first-exam.md", format!("today's car is `--edition {newest}`")),
        ("docs/first-exam.md", format!("`--edition {newest}` is today's car")),
    ];
    for version in &versions {
        expected.push(("docs/editions.md", format!("\n| {version} | ")));
        expected.push(("docs/first-exam.md", format!("[{version}](messages-{version}.md)")));
        expected.push(("docs/interface.md", format!("[{version}](messages-{version}.md)")));
        expected.push(("spec/REQUIREMENTS.md", format!("\n| {version} | version ")));
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let has = |file: &str, text: &str| {
        fs::read_to_string(root.join(file)).expect("a file of the project").contains(text)
    };
    expected.retain(|(file, text)| !has(file, text));
    assert!(expected.is_empty(), "these are missing: {expected:#?}");
}
