//! The arguments of the commands that explore the state machine: `verify`, `explore` and `export`.

use std::path::PathBuf;

use adsdv_model::{Engine, Vectors};
use adsdv_spec::Choice;
use clap::{Args, ColorChoice, ValueEnum};

use super::EditionArgs;

/// More threads than this only wait for each other.
const MOST_THREADS: usize = 256;

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

  What each reading of the document costs, edition by edition (this is
  model/READINGS.md):
      adsdv verify --readings > READINGS.md

  The same as a page to look at, of one edition:
      adsdv verify --readings --edition 3.0 --html readings.html

  Quickly, with only those inputs that can matter at each state:
      adsdv verify --vectors read

  Step by step, as a check of the engine that makes 64 steps at once:
      adsdv verify --engine single

OUTPUT
  For each model how many states and steps were explored, and whether that is
  complete: one exploration decides all of its properties. Then a line for each:
  holds, or FAILS and after how many steps; for what must be reachable: reached, and
  after how many steps, or NOT REACHED. What a property says is printed where it
  fails, and for all of them with --json. Last the rows of the table of Figure 2, the
  alternatives of their guards and the conditions of these, and how many decide some
  step. One that does not under these readings, but would under another answer, is
  moot; one that never does is DEAD, and a failure.

  A log is sampled, so that check may call certain less than verify does: what fails
  for a cycle only, or behind a hidden shutdown circuit, is no violation in a log.

  It takes some ten seconds, of the later versions half a minute, and so does
  --readings of each.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

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

    /// Check the combinations of readings that can matter, and print as Markdown or JSON what each costs: for every edition, or for the one
    /// that is asked for.
    #[arg(long = "readings", conflicts_with_all = ["readings", "model", "vectors", "logs", "color"])]
    pub(crate) sweep: bool,

    /// Which models are explored.
    #[arg(long, value_name = "WHICH", default_value_t = Models::All, value_enum)]
    pub(crate) model: Models,

    /// Which inputs the open model tries at a state.
    #[arg(long, value_name = "WHICH", default_value_t = Tried::Every, value_enum)]
    pub(crate) vectors: Tried,

    /// How the steps of the open model are made.
    ///
    /// Both find the same states, steps, verdicts and shortest runs.
    #[arg(long, value_name = "HOW", default_value_t = EngineArg::Words, value_enum)]
    pub(crate) engine: EngineArg,

    /// How many threads explore [default: one for each core].
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub(crate) threads: Option<usize>,

    /// Where counterexamples are written, as counterexample-PROPERTY.log.
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub(crate) logs: PathBuf,

    /// With --readings, write what they cost as a page to look at to this file, beside printing it.
    ///
    /// One file that needs nothing else and no network, with all that --json prints: a ranking of the answers by what they can cost,
    /// and of each property that fails the shortest run that shows it. The file is there when all of it is written. With - the page
    /// is printed in place of the text.
    #[arg(long, value_name = "FILE", requires = "sweep")]
    pub(crate) html: Option<PathBuf>,

    /// Print JSON; `adsdv schema verify` prints its schema.
    ///
    /// With --readings a line for each edition, and its schema is that of `adsdv schema costs`.
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,

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

/// How steps are made.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum EngineArg {
    /// For 64 inputs at once, by a network over machine words: theorems say that it is the step.
    Words,
    /// One by one, by the step itself: slower, and the reference.
    Single,
}

impl From<EngineArg> for Engine {
    fn from(engine: EngineArg) -> Self {
        match engine {
            EngineArg::Words => Self::Words,
            EngineArg::Single => Self::Single,
        }
    }
}

impl From<Tried> for Vectors {
    fn from(tried: Tried) -> Self {
        match tried {
            Tried::Every => Self::Every,
            Tried::Read => Self::Read,
        }
    }
}

pub(super) fn port(text: &str) -> Result<u16, String> {
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

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none

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

    #[command(flatten)]
    pub(crate) edition: EditionArgs,
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

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none

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

    #[command(flatten)]
    pub(crate) edition: EditionArgs,
}

/// The languages of other model checkers.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Exported {
    /// That of Spin.
    Promela,
}
