//! The arguments, and the help texts that stand for a manual page.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

use adsdv_model::Vectors;
use adsdv_oracle::conform::Options as Conform;
use adsdv_oracle::judge::Options;
use adsdv_spec::Choice;
use clap::builder::NonEmptyStringValueParser;
use clap::{Args, ColorChoice, Parser, Subcommand, ValueEnum};

mod bus;

pub(crate) use bus::{AiArgs, DemoArgs, VcuArgs, WatchArgs};

/// The longest window and deadline that make sense, in milliseconds.
const LONGEST: u32 = 60_000;
/// The most steps that outputs may be late.
const LATEST: usize = 50;
/// The longest cycle that makes sense, in milliseconds.
const LONGEST_CYCLE: u32 = 1000;
/// The longest time that a program may take for an answer, in seconds.
const LONGEST_WAIT: f64 = 3600.0;
/// Nobody waits longer for a verdict, in seconds: a week.
const LONGEST_RUN: f64 = 604_800.0;
/// More threads than this only wait for each other.
const MOST_THREADS: usize = 256;

/// The executable specification of the ADS-DV AI/VCU interface.
///
/// The ADS-DV is the car that Formula Student AI teams share. Its AI Computer talks over CAN to a Vehicle Control
/// Unit (VCU) that runs the Autonomous System state machine. adsdv holds a recorded log of that bus, a live one or a program
/// against the ADS-DV Software Interface Specification 3.0 and says who broke which section, when, and why; it is a virtual
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

  Drive an AI stack against the virtual VCU, with a judge beside it:
      adsdv vcu vcan0
      adsdv watch vcan0

  Explore the whole state machine, and walk through it in a browser:
      adsdv verify
      adsdv explore

  Give the CAN database to another tool, and draw Figure 2:
      adsdv dbc > adsdv.dbc
      adsdv diagram --format dot | dot -Tsvg > figure2.svg

  What each command does, in full:
      adsdv check --help

EXIT STATUS
  0  the log conforms, every property holds, or what was asked for has been printed
  1  the log violates the document, or a property fails
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
    Conform(ConformArgs),
    /// Print the CAN database (DBC).
    ///
    /// Every message of the interface with its identifier, sender, length and cycle, and every signal with its
    /// place, scale, unit, range and value names. For cantools, SavvyCAN, Kvaser and Vector tools, and the like.
    #[command(after_long_help = "\
EXAMPLES
  adsdv dbc > adsdv.dbc
  adsdv dbc > adsdv.dbc && candump can0 | cantools decode adsdv.dbc

EXIT STATUS
  0  the database has been printed
  2  it could not be written, or the arguments are wrong")]
    Dbc,
    Demo(DemoArgs),
    Diagram(DiagramArgs),
    Explore(ExploreArgs),
    Export(ExportArgs),
    Readings(ReadingsArgs),
    Schema(SchemaArgs),
    Suite(SuiteArgs),
    Vcu(VcuArgs),
    Verify(VerifyArgs),
    Watch(WatchArgs),
}

/// Print the conformance test suite, or prove that it is complete.
///
/// One test a line, as JSON, for any language: a named scenario with the requirements that it checks, the inputs step by
/// step, and the outputs that are expected. The keys are those of oracle/PROTOCOL.md; inputs that a step does not have are
/// at their defaults. `adsdv conform` runs the suite against a program.
///
/// The suite is generated from the table of Figure 2: every row and every alternative of one; every condition shown to
/// matter on its own (MC/DC); every threshold and time just below, at and just above; every two rows that can hold at once;
/// the handshake at every phase; each fault and its cause; and for each question that the document leaves open what tells
/// its answers apart.
///
/// It grows with the conditions that the rows name, not with the number of their combinations: one test for each
/// alternative, one for each of its conditions, one for each pair of alternatives of two rows of a state, three for each
/// limit, and one for each fault in each state in which it counts.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv suite > suite.jsonl
  adsdv suite | jq -r '.name + \": \" + .about'
  adsdv suite --prove

EXIT STATUS
  0  the suite has been printed; with --prove, it tells every mutation from the specification
  1  with --prove, some mutation lives
  2  it could not be written, or the arguments are wrong")]
pub(crate) struct SuiteArgs {
    /// Prove that the suite is complete.
    ///
    /// Every mutation of the table, the times and the thresholds (a condition dropped or turned round, an alternative or a
    /// row dropped, another destination or order, a time or threshold off by one) has to show something else than the
    /// specification in some test.
    #[arg(long, conflicts_with = "readings")]
    pub(crate) prove: bool,

    /// With --prove, print one JSON object instead of text.
    #[arg(long, requires = "prove")]
    pub(crate) json: bool,

    /// Expect what the specification shows under another answer to a question that the document leaves open; may be
    /// repeated.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,
}

/// Judge a program: a VCU, a simulator or a model.
///
/// Starts the program once and asks it for one step of a VCU after the other: one JSON object a line on its standard input,
/// one on its standard output. oracle/PROTOCOL.md says all about these lines, and oracle/examples has complete adapters in
/// C, in C++, in Python and in Rust.
///
/// It is asked for the test suite (`adsdv suite`), and then for random scenarios that lead to every state. Its answers are
/// held against the specification under every combination of the readings that the document allows: a program conforms if
/// one combination explains all of them.
///
/// At the end the program is killed with all that it started, but for a process that has left its process group (setsid).
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv conform -- ./vcu
  adsdv conform -- python3 oracle/examples/adapter.py   # after: pip install ./python

  A simulator that steps every 10 ms and shows its outputs up to 2 steps late:
      adsdv conform --cycle-ms 10 --latency 2 -- ./simulator --headless

  More random scenarios, from another seed:
      adsdv conform --seed 7 --runs 5000 -- ./vcu

  The requirements that failed, for a program:
      adsdv conform --json -- ./vcu | jq '.requirements[] | select(.outcome == \"fail\")'

OUTPUT
  REQUIREMENTS  those that tests name. Fail: an output that it is about is wrong. Not
                checked: the program does not show all that it is about, or could not be
                asked for it. TESTS is how many name it, or how many of them checked it:
                a test does not if it cannot be told at the cycle, and after a wrong
                state it says nothing of other outputs. FAILED names what breaks it
  FAILURES      each thing that is wrong, the first 20 of the tests and of the random
                scenarios: the row of Figure 2 that was broken, with its
                section and its guard, and the shortest scenario that was found, step by
                step, with the state that was expected beside the one that was shown
  READINGS      which of the document's readings the program follows, as far as its answers
                tell, and which it mixes: some tests need one choice, others another
  Last comes the verdict.

ENVIRONMENT
  NO_COLOR  if set and not empty, --color auto means never

EXIT STATUS
  0  the program conforms
  1  it does not
  2  no verdict: the program could not be started, ended early, did not answer in
     time, was not done in time, or does not speak the protocol; or the arguments
     are wrong")]
pub(crate) struct ConformArgs {
    /// The program, and its arguments, after --.
    #[arg(value_name = "PROGRAM", required = true, last = true, num_args = 1..)]
    pub(crate) command: Vec<OsString>,

    /// Run the tests of this file instead of those of `adsdv suite`: JSON Lines, as that command writes them.
    #[arg(long, value_name = "FILE")]
    pub(crate) suite: Option<PathBuf>,

    /// Pin a question that the document leaves open; may be repeated.
    ///
    /// Without a pin, every choice is allowed for. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    /// Allow outputs that are late, by the same number of steps throughout, at most this one.
    ///
    /// Before the first outputs the program shows AS_OFF, or answers {}.
    #[arg(long, value_name = "STEPS", default_value_t = 0, value_parser = latency, allow_negative_numbers = true)]
    pub(crate) latency: usize,

    /// Step at this cycle only, in milliseconds.
    ///
    /// A longer time becomes as many steps. What cannot be told in them is not run, and named.
    #[arg(long, value_name = "MS", value_parser = cycle, allow_negative_numbers = true)]
    pub(crate) cycle_ms: Option<u32>,

    /// The seed of the random scenarios: the same seed is the same scenarios for a program with the same readings.
    #[arg(long, value_name = "N", default_value_t = Conform::default().seed, allow_negative_numbers = true)]
    pub(crate) seed: u64,

    /// How many random scenarios follow the suite.
    #[arg(long, value_name = "N", default_value_t = Conform::default().runs, allow_negative_numbers = true)]
    pub(crate) runs: u32,

    /// How long the program may take for an answer.
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = seconds, allow_negative_numbers = true)]
    pub(crate) timeout: Duration,

    /// How long the program may take for all that it is asked.
    ///
    /// One that is slow is stopped then, with an error that says how far it came. Many random scenarios may need more.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value = "600",
        value_parser = time_limit,
        allow_negative_numbers = true
    )]
    pub(crate) time_limit: Duration,

    /// Print JSON; `adsdv schema conform` prints its schema.
    #[arg(long)]
    pub(crate) json: bool,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}

fn latency(text: &str) -> Result<usize, String> {
    let steps = text.parse().ok().filter(|&steps| steps <= LATEST);
    steps.ok_or_else(|| format!("expected a number of steps from 0 to {LATEST}"))
}

fn cycle(text: &str) -> Result<u32, String> {
    let ms = text.parse().ok().filter(|ms| (1..=LONGEST_CYCLE).contains(ms));
    ms.ok_or_else(|| format!("expected a whole number of milliseconds from 1 to {LONGEST_CYCLE}"))
}

fn seconds(text: &str) -> Result<Duration, String> {
    seconds_up_to(LONGEST_WAIT, text)
}

fn time_limit(text: &str) -> Result<Duration, String> {
    seconds_up_to(LONGEST_RUN, text)
}

fn seconds_up_to(most: f64, text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| *seconds > 0.0 && *seconds <= most);
    let time =
        seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok()).filter(|time| !time.is_zero());
    time.ok_or_else(|| format!("expected a number of seconds above 0, at most {most}"))
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
    /// adsdv watch.
    Watch,
    /// adsdv conform.
    Conform,
    /// adsdv suite: a line of the suite.
    Suite,
    /// adsdv suite --prove.
    Prove,
    /// adsdv verify.
    Verify,
}

/// Check every property of the state machine, exhaustively.
///
/// Explores every control state that the VCU can reach, with the real times of the document and every input at every
/// step: any AI Computer, any driver, any fault (the open model). Then the VCU with an AI Computer that follows the
/// document, over real CAN frames, an operator and a fault (the closed models). A property holds only if the exploration
/// was complete, and each names the requirements of spec/REQUIREMENTS.md that it covers.
///
/// For a property that fails, the shortest run that shows it is written as a candump log, and printed as `adsdv check`
/// judges that log.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv verify

  What if the change to NEUTRAL or FINISHED is the fault, not the value?
      adsdv verify --reading fault-trigger=edge
      adsdv check --reading fault-trigger=level counterexample-driving-neutral.log

  What each reading of the document costs (this is model/READINGS.md):
      adsdv verify --readings > READINGS.md

  Quickly, with only those inputs that can matter at each state:
      adsdv verify --vectors read

OUTPUT
  For each model how many states and steps were explored, and whether that is
  complete: one exploration decides all of its properties. Then a line for each:
  holds, or FAILS and after how many steps; for what must be reachable: reached, and
  after how many steps, or NOT REACHED. What a property says is printed where it
  fails, and for all of them with --json. Last the rows of the table of Figure 2, the
  alternatives of their guards and the conditions of these, and how many decide some
  step: one that does not is DEAD (under these readings).

  A log is sampled, so that check may call certain less than verify does: what fails
  for a cycle only, or behind a hidden shutdown circuit, is no violation in a log.

  It takes some 20 seconds, and --readings a minute or two.

ENVIRONMENT
  NO_COLOR  if set and not empty, --color auto means never

EXIT STATUS
  0  every property holds, and everything that must be is reachable; with --readings,
     every exploration was complete
  1  something fails, or an exploration was not complete
  2  no answer: the output or a log could not be written, or the arguments are wrong")]
pub(crate) struct VerifyArgs {
    /// Answer a question that the document leaves open; may be repeated.
    ///
    /// Without it, the default. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    /// Check every combination of readings that can matter, and print as Markdown what each costs.
    #[arg(long = "readings", conflicts_with_all = ["readings", "model", "vectors", "json", "logs", "color"])]
    pub(crate) sweep: bool,

    /// Which models are explored.
    #[arg(long, value_name = "WHICH", default_value_t = Models::All, value_enum)]
    pub(crate) model: Models,

    /// Which inputs the open model tries at a state.
    #[arg(long, value_name = "WHICH", default_value_t = Tried::Every, value_enum)]
    pub(crate) vectors: Tried,

    /// How many threads explore [default: one for each core].
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub(crate) threads: Option<usize>,

    /// Where counterexamples are written, as counterexample-PROPERTY.log.
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub(crate) logs: PathBuf,

    /// Print JSON; `adsdv schema verify` prints its schema.
    #[arg(long)]
    pub(crate) json: bool,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}

/// Which models are explored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Models {
    /// All of them.
    All,
    /// The VCU alone, with any input at every step.
    Open,
    /// The VCU with an AI Computer that follows the document.
    Closed,
}

/// Which input vectors are tried.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Tried {
    /// Every combination of all faults and of every condition that the rows of the state, the handshake and the memory
    /// mention.
    Every,
    /// Those that can still matter, by the lemmas of model/README.md.
    Read,
}

impl From<Tried> for Vectors {
    fn from(tried: Tried) -> Self {
        match tried {
            Tried::Every => Self::Every,
            Tried::Read => Self::Read,
        }
    }
}

fn port(text: &str) -> Result<u16, String> {
    text.parse().map_err(|_| format!("expected a port from 0 to {}", u16::MAX))
}

fn threads(text: &str) -> Result<usize, String> {
    text.parse()
        .ok()
        .filter(|threads| (1..=MOST_THREADS).contains(threads))
        .ok_or_else(|| format!("expected a number of threads from 1 to {MOST_THREADS}"))
}

/// Walk through the state machine in a web browser.
///
/// Serves stateright's Explorer on this machine only. It shows the VCU together with an AI Computer that follows the
/// document, the frames between them, an operator, a fault and the vehicle; one change at a time, with the real times. The
/// way to the current state is drawn as a sequence diagram.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv explore
  adsdv explore --port 8080 --reading go-edge=edge

OUTPUT
  The address to open. It is served until the command is stopped (Ctrl-C).

EXIT STATUS
  2  the port could not be had, or the arguments are wrong")]
pub(crate) struct ExploreArgs {
    /// The port on loopback; 0 for any that is free.
    #[arg(long, value_name = "N", default_value_t = 3000, value_parser = port, allow_negative_numbers = true)]
    pub(crate) port: u16,

    /// Answer a question that the document leaves open; may be repeated.
    ///
    /// Without it, the default. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,
}

/// Print the state machine for another model checker.
///
/// The same table, times and properties as a Promela model, which Spin checks: the same control states, the same
/// verdicts. The model says in its first lines how to run it.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv export --format promela > vcu.pml
  spin -a vcu.pml
  gcc -O2 -DSAFETY -DNOREDUCE -DNOCOMP -o pan pan.c
  ./pan -m1000000 -w20

EXIT STATUS
  0  the model has been printed
  2  it could not be written, or the arguments are wrong")]
pub(crate) struct ExportArgs {
    /// The language.
    #[arg(long, value_enum)]
    pub(crate) format: Exported,

    /// Which inputs the model tries at a state.
    #[arg(long, value_name = "WHICH", default_value_t = Tried::Read, value_enum)]
    pub(crate) vectors: Tried,

    /// Answer a question that the document leaves open; may be repeated.
    ///
    /// Without it, the default. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,
}

/// The languages of other model checkers.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Exported {
    /// That of Spin.
    Promela,
}

/// Judge a recorded CAN log.
///
/// Reads a log of `candump -L` (can-utils), of any length, and holds both sides of it against the document: every
/// transition of the AS state machine that was seen or was due, the handshake, fault flags and shutdown causes, the
/// conduct of the AI Computer, values and lengths.
///
/// A log is sampled and silent about the shutdown circuit. What cannot be known from it is called "not certain" and
/// never a violation; a violation is what is one under every reading of the document that is still possible.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  Why did the car make an emergency stop?
      adsdv check run.log

  Judge a compressed log, or one that is still being recorded:
      zcat run.log.gz | adsdv check -
      candump -L can0 | adsdv check -

  The VCU takes the change to FINISHED as the fault, not the value:
      adsdv check --reading fault-trigger=edge run.log

  List the violations for a program:
      adsdv check --json run.log | jq '.findings[] | select(.severity == \"violation\")'

  In a script: stop at a log that violates, or that cannot be read:
      adsdv check run.log > report.txt || exit 1

OUTPUT
  TIMELINE  each change of AS_STATE, its section, and the conditions that decided:
            justified; not certain, where a condition cannot be seen, or changed at
            that moment; VIOLATION
  FINDINGS  violations and warnings in order of time, each with its severity, the
            party at fault (AI, VCU, or the LOG itself), section and rule, and below
            that what was seen and what was expected
  NOTES     facts about the log
  Last come the times of the AI Computer's answers to the handshake (p99: 99 percent
  came within it), and the verdict.

ENVIRONMENT
  NO_COLOR  if set and not empty, --color auto means never

EXIT STATUS
  0  the log conforms: no violation was found
  1  the log violates the document
  2  no verdict: the log could not be read or the report not written, or the
     arguments are wrong")]
pub(crate) struct CheckArgs {
    /// The log: a file of `candump -L`, or - for standard input.
    ///
    /// A file whose name is - is given as ./-
    #[arg(value_name = "LOG")]
    pub(crate) log: PathBuf,

    /// Print one JSON object instead of text.
    ///
    /// `adsdv schema` prints its JSON Schema. Times are in seconds since the first frame.
    #[arg(long)]
    pub(crate) json: bool,

    /// The window W: how long after its cause an effect may be seen, in milliseconds.
    ///
    /// The cycle of the VCU and the delay of the bus. A wider window finds less, and is wrong less often.
    #[arg(long, value_name = "MS", default_value_t = Options::default().window_ms, value_parser = milliseconds,
        allow_negative_numbers = true)]
    pub(crate) window: u32,

    /// The deadline D: how long a cause must last before its missing effect is a violation, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = Options::default().deadline_ms, value_parser = milliseconds,
        allow_negative_numbers = true)]
    pub(crate) deadline: u32,

    /// Pin a question that the document leaves open; may be repeated.
    ///
    /// Without a pin, the judge allows for every choice. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    /// The CAN interface to judge, as the log names it.
    ///
    /// Without it, the first interface that carries a message of the ADS-DV. Other interfaces are passed over.
    #[arg(long, value_name = "NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) interface: Option<String>,

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
  adsdv readings --json | jq -r '.[] | .id as $id | .choices[] | $id + \"=\" + .id'

EXIT STATUS
  0  the list has been printed
  2  it could not be written, or the arguments are wrong")]
pub(crate) struct ReadingsArgs {
    /// Print a JSON array instead of text.
    #[arg(long)]
    pub(crate) json: bool,
}

fn milliseconds(text: &str) -> Result<u32, String> {
    text.parse()
        .ok()
        .filter(|&ms| ms <= LONGEST)
        .ok_or_else(|| format!("expected a whole number of milliseconds from 0 to {LONGEST}"))
}
