//! The arguments, and the help texts that stand for a manual page: `shell` has those for who packages the command, `bus`, `conform`, `exam` and `verify` those of the commands on
//! a bus, of those that judge a program, of the one that examines an AI Computer, and of those that explore the state machine, `diff` those of the comparison of editions,
//! `compare` those of the comparison of recordings, `decode` those of the one that decodes them, and `web` those of the page that judges; this file has all others.

use std::path::PathBuf;

use adsdv_oracle::judge::{JudgeOptions, Required};
use adsdv_spec::Choice;
use clap::builder::NonEmptyStringValueParser;
use clap::{Args, ColorChoice, Parser, Subcommand, ValueEnum};

mod bus;
mod compare;
mod conform;
mod decode;
mod diff;
mod edition;
mod exam;
mod shell;
mod verify;
mod web;

pub(crate) use bus::{AiArgs, DemoArgs, VcuArgs, WatchArgs};
pub(crate) use compare::CompareArgs;
pub(crate) use conform::{ConformArgs, SuiteArgs};
pub(crate) use decode::{DecodeArgs, Decoded, DecodedTable};
pub(crate) use diff::DiffArgs;
pub(crate) use edition::{ChosenEdition, EditionArgs, RecognisedArgs};
pub(crate) use exam::ExamArgs;
pub(crate) use shell::{CompletionsArgs, ManArgs};
pub(crate) use verify::{ExploreArgs, ExportArgs, Exported, Models, VerifyArgs};
pub(crate) use web::WebArgs;

/// The longest window and deadline that make sense, in milliseconds.
const LONGEST: u32 = 60_000;

/// The executable specification of the ADS-DV AI/VCU interface.
///
/// The ADS-DV is the car that Formula Student AI teams share. Its AI Computer talks over CAN to a Vehicle Control
/// Unit (VCU) that runs the Autonomous System state machine. adsdv holds a recorded log of that bus, a live one or a program
/// against the ADS-DV Software Interface Specification and says who broke which section, when, and why; it is a virtual
/// VCU that an AI stack can be driven against; it shows that the state machine it judges by keeps the document's promises;
/// and it prints its tables.
#[derive(Debug, Parser)]
#[command(
    name = "adsdv",
    version,
    max_term_width = 100,
    arg_required_else_help = true,
    after_long_help = "\
EXAMPLES
  See a whole mission driven and judged, without a car and without CAN:
      adsdv demo

  Record a run, and have it judged:
      candump -L can0 > run.log
      adsdv check run.log

  The same in a browser, by dropping a log, and a virtual car to drive:
      adsdv web --open

  It worked yesterday: what differs between two recordings?
      adsdv compare yesterday.log today.log

  Every signal of a log, with units and the names of values:
      adsdv decode run.log

  Drive an AI stack against the virtual VCU, with a judge beside it:
      adsdv vcu vcan0
      adsdv watch vcan0

  Examine an AI stack, without CAN and without a car:
      adsdv exam --stdio -- python3 my_stack.py

  Explore the whole state machine, and walk through it in a browser:
      adsdv verify
      adsdv explore

  Give the CAN database to another tool, and draw Figure 2:
      adsdv dbc > adsdv.dbc
      adsdv diagram --format dot | dot -Tsvg > figure2.svg

  By the edition of today's car, for one command or for all:
      adsdv dbc --edition 2026
      export ADSDV_EDITION=2026

  What another edition changes:
      adsdv diff 3.0 4.0

  What each command does, in full:
      adsdv check --help

EXIT STATUS
  0  the log conforms, every property holds, or what was asked for has been printed
  1  the log violates the document, a property fails, or two logs differ
  2  no answer: the input could not be read or the output not written, or the
     arguments are wrong"
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Ai(AiArgs),
    Check(CheckArgs),
    Compare(CompareArgs),
    Completions(CompletionsArgs),
    Conform(ConformArgs),
    Dbc(DbcArgs),
    Decode(DecodeArgs),
    Demo(DemoArgs),
    Diagram(DiagramArgs),
    Diff(DiffArgs),
    Exam(ExamArgs),
    Explore(ExploreArgs),
    Export(ExportArgs),
    Man(ManArgs),
    Readings(ReadingsArgs),
    Schema(SchemaArgs),
    Suite(SuiteArgs),
    Vcu(VcuArgs),
    Verify(VerifyArgs),
    Watch(WatchArgs),
    Web(WebArgs),
}

/// Print the CAN database (DBC).
///
/// Every message of the interface with its identifier, sender, length and cycle, and every signal with its
/// place, scale, unit, range and value names. For cantools, SavvyCAN, Kvaser and Vector tools, and the like.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv dbc > adsdv.dbc
  adsdv dbc > adsdv.dbc && candump can0 | cantools decode adsdv.dbc

OUTPUT
  VERSION, in the first line, is the edition.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none

EXIT STATUS
  0  the database has been printed
  2  it could not be written, or the arguments are wrong")]
pub(crate) struct DbcArgs {
    #[command(flatten)]
    pub(crate) edition: EditionArgs,
}

/// Print the JSON Schema of what a command prints with `--json`.
///
/// JSON Schema, draft 2020-12. That of `check` lists every rule that a finding can name.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv schema > check.schema.json
  adsdv check --json run.log > run.json
  check-jsonschema --schemafile check.schema.json run.json
  adsdv schema verify > verify.schema.json

EXIT STATUS
  0  the schema has been printed
  2  it could not be written, or the arguments are wrong")]
pub(crate) struct SchemaArgs {
    /// The command.
    #[arg(value_name = "COMMAND", default_value_t = WithJson::Check, value_enum)]
    pub(crate) command: WithJson,
}

/// The commands whose `--json` has a schema.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum WithJson {
    /// adsdv check, and adsdv demo.
    Check,
    /// adsdv check of several logs: a line.
    Logs,
    /// adsdv watch.
    Watch,
    /// adsdv conform.
    Conform,
    /// adsdv exam.
    Exam,
    /// adsdv suite: a line of the suite.
    Suite,
    /// adsdv suite --prove.
    Prove,
    /// adsdv verify.
    Verify,
    /// adsdv verify --readings: a line for an edition.
    Costs,
    /// adsdv readings.
    Readings,
    /// adsdv diff.
    Diff,
    /// adsdv compare.
    Compare,
}

/// Judge a recorded CAN log.
///
/// Reads a log of any length, and holds both sides of it against the document: every
/// transition of the AS state machine that was seen or was due, the handshake, fault flags and shutdown causes, the
/// conduct of the AI Computer, values and lengths.
///
/// A log is sampled and silent about the shutdown circuit. What cannot be known from it is called "not certain" and
/// never a violation; a violation is what is one under every reading of the document that is still possible.
///
/// Which edition of the interface the log speaks is recognised by its frames: how long they are, which there are, and what
/// they say. The first line says which it is and by what, and a note what does not fit it. --edition overrides.
///
/// The format of a log is recognised by its content, whatever its name: candump (with -L, or as it prints on a screen), what
/// python-can prints, Vector ASC and BLF, PEAK TRC, the CSV of python-can and of SavvyCAN, and MCAP of ROS 2 where it is built in; gzip and Zstandard around any of these.
///
/// Several logs, and directories of logs, are judged on all cores: a line for each, the worst first, then the report of the
/// worst. In a directory, what has no frame is passed over.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  Why did the car make an emergency stop?
      adsdv check run.log

  Judge a compressed log, or one that is still being recorded:
      adsdv check run.log.gz
      candump -L can0 | adsdv check -

  A season of logs, and what came of it for a CI:
      adsdv check logs
      adsdv check --junit check.xml --summary check.md logs/2026/*.log.zst

  The VCU takes the change to FINISHED as the fault, not the value:
      adsdv check --edition 3.0 --reading fault-trigger=edge run.log

  By another edition than the one that the log speaks:
      adsdv check --edition 4.0 run.log

  List the violations for a program:
      adsdv check --json run.log | jq '.findings[] | select(.severity == \"violation\")'

  To look at: one page with the timeline, plots and each finding, which opens from a mail as well:
      adsdv check --html run.html run.log

  The few frames that show each violation, to send to somebody:
      adsdv check --excerpt excerpts run.log

  A team's own rules beside the document:
      adsdv check --rules team.rules run.log

  In a script: stop at a log that violates, or that cannot be read:
      adsdv check run.log > report.txt || exit 1

  And at one in which nothing drove, so that there was little to violate:
      adsdv check --require AS_DRIVING --require ai run.log || exit 1

OUTPUT
  WHY NOT   what keeps the car in the state in which the log ends: each arrow that was not
            taken, since when, what blocked it, and whose move that is; \"Go\" pressed in vain
  TIMELINE  each change of AS_STATE, its section, and the conditions that decided:
            justified; not certain, where a condition cannot be seen, or changed at
            that moment; VIOLATION
  FINDINGS  violations and warnings in order of time, each with its severity, the
            party at fault (AI, VCU, the LOG itself, or OWN: a rule of --rules), section
            and rule, and below that what was seen and what was expected
  NOTES     facts about the log
  CUSTOM RULES  with --rules, of each whether it holds, is broken or was never decided,
            how many times, and why it was never decided
  MARGINS   how close the run came to its limits: of each kind the closest, and five of
            these; --json has all
  Last come the times of the AI Computer's answers to the handshake (p99: 99 percent
  came within it), how many requirements the log shows to hold, and the verdict, which
  says what was not there: one side, a state other than AS_OFF, or any at all.
  Of several logs a line for each comes first: its verdict, violations and warnings, how
  long it is, its name and the first violation; then the report of the worst.
  With --excerpt the logs that were written follow, on standard error with --json; of one
  that does not show its finding alone, with up to 20 s of what came before, that is said.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  the log conforms: no violation was found
  1  the log violates the document or a rule of --rules, or does not show what --require
     asks for
  2  no verdict: the log or the rules could not be read, the report or an excerpt not be written, or
     the arguments are wrong")]
pub(crate) struct CheckArgs {
    /// The log, or - for standard input; or several logs, and directories of logs.
    ///
    /// A text of candump or python-can, or any format that is named above, compressed or not. A file whose name is - is given
    /// as ./-
    #[arg(value_name = "LOG", required = true)]
    pub(crate) logs: Vec<PathBuf>,

    /// Print one JSON object instead of text.
    ///
    /// `adsdv schema` prints its JSON Schema. Times are in seconds since the first frame. Of several logs there is a line for
    /// each, in their order, with its name: `adsdv schema logs`.
    #[arg(long)]
    pub(crate) json: bool,

    /// Vouch that the log has every frame that was on the bus.
    ///
    /// Without it, a frame that may be missing excuses what only that frame could: where all that was recorded says that a
    /// transition was due, and it did not come, that is a warning. With it, that is a violation, however late frames were
    /// recorded; what was shown last counts for half a second.
    #[arg(long)]
    pub(crate) complete: bool,

    /// The window W: how long after its cause an effect may be seen, in milliseconds.
    ///
    /// The cycle of the VCU and the delay of the bus. A wider window finds less, and is wrong less often.
    #[arg(long, value_name = "MS", default_value_t = JudgeOptions::default().window_ms, value_parser = milliseconds,
        allow_negative_numbers = true)]
    pub(crate) window: u32,

    /// The deadline D: how long a cause must last before its missing effect is a violation, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = JudgeOptions::default().deadline_ms, value_parser = milliseconds,
        allow_negative_numbers = true)]
    pub(crate) deadline: u32,

    /// Pin a question that the document leaves open; may be repeated.
    ///
    /// Without a pin, the judge allows for every choice. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    /// What the log has to show, else the exit status is 1; may be repeated.
    ///
    /// An AS state, such as AS_DRIVING; a requirement of REQUIREMENTS.md that a log can show, such as DRV-4: what it is about has
    /// to happen, whether it is kept, broken or not certain; ai or vcu: a message of that side.
    #[arg(long = "require", value_name = "WHAT")]
    pub(crate) required: Vec<Required>,

    /// Judge a team's own rules as well: a file with a rule in each line.
    ///
    /// Such as `calm: never VEH_SPEED_ACTUAL > 20 km/h and AS_STATE is AS_READY`. RULES.md has the language. A rule that is broken is
    /// a violation of party OWN. Not with --excerpt: what breaks a rule may lie far before the finding.
    #[arg(long, value_name = "FILE", conflicts_with = "excerpt")]
    pub(crate) rules: Option<PathBuf>,

    /// Write the report as a page to look at to this file, beside printing it.
    ///
    /// One file that needs nothing else and no network: the verdict and what to do next, a timeline, plots of what was asked for
    /// and what was, each finding with its frames. For any browser of the last years. The file is there when all of it is
    /// written. With - the page is printed in place of the report. Of one log.
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,

    /// Write the few frames that show each violation and warning to a log of its own in this directory.
    ///
    /// Such as 01-transition-unjustified.log: it gives the same finding when it is judged by the same edition and options.
    /// The directory is made if it is not there; files of other names are left alone. At most 20 are written.
    #[arg(long, value_name = "DIR")]
    pub(crate) excerpt: Option<PathBuf>,

    /// Write what came of it to this file as JUnit XML: a suite for each log, a case for each rule.
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,

    /// Write what came of it to this file in Markdown, for the summary page of a CI run.
    #[arg(long, value_name = "FILE")]
    pub(crate) summary: Option<PathBuf>,

    /// The CAN interface to judge, as the log names it.
    ///
    /// Without it, the first interface that carries a message of the ADS-DV. Other interfaces are passed over.
    #[arg(long, value_name = "NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) interface: Option<String>,

    #[command(flatten)]
    pub(crate) edition: RecognisedArgs,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}

/// Print Figure 2, the state machine, from the table that is executed.
///
/// Mermaid and Graphviz draw it; Markdown lists the arrows, each with its section and its guard.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv diagram --format markdown
  adsdv diagram --format dot | dot -Tsvg > figure2.svg
  adsdv diagram --reading comms-lost=no-arrow > figure2.mmd

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none

EXIT STATUS
  0  the diagram has been printed
  2  it could not be written, or the arguments are wrong")]
pub(crate) struct DiagramArgs {
    /// The language of the diagram.
    #[arg(long, default_value_t = Format::Mermaid, value_enum)]
    pub(crate) format: Format,

    /// Answer a question that the document leaves open; may be repeated.
    ///
    /// Without it, the default. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,
}

/// The languages that Figure 2 is printed in.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Format {
    /// Mermaid `stateDiagram-v2`.
    Mermaid,
    /// Graphviz.
    Dot,
    /// A table: from, to, section, guard.
    Markdown,
}

/// List the questions that the document leaves open.
///
/// Each has an id, two or three choices, and a default, which is what the reference VCU does. The judge of a log
/// allows for every choice, until `adsdv check --reading ID=CHOICE` pins one.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv readings
  adsdv readings --json | jq -r '.readings[] | .id as $id | .choices[] | $id + \"=\" + .id'

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none

EXIT STATUS
  0  the list has been printed
  2  it could not be written, or the arguments are wrong")]
pub(crate) struct ReadingsArgs {
    /// Print one JSON object instead of text; `adsdv schema readings` prints its schema.
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,
}

fn milliseconds(text: &str) -> Result<u32, String> {
    text.parse()
        .ok()
        .filter(|&ms| ms <= LONGEST)
        .ok_or_else(|| format!("expected a whole number of milliseconds from 0 to {LONGEST}"))
}
