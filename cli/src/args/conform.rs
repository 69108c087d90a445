//! The arguments of the commands that judge a program: `conform`, and `suite`.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

use adsdv_conform::ConformOptions as Conform;
use adsdv_spec::Choice;
use clap::{Args, ColorChoice};

use super::EditionArgs;

/// The most steps that outputs may be late.
const LATEST: usize = 50;
/// The longest cycle that makes sense, in milliseconds.
const LONGEST_CYCLE: u32 = 1000;
/// The longest time that a program may take for an answer, in seconds.
const LONGEST_WAIT: f64 = 3600.0;
/// Nobody waits longer for a verdict, in seconds: a week.
const LONGEST_RUN: f64 = 604_800.0;

/// Print the conformance test suite, or prove that it is complete.
///
/// One test a line, as JSON, for any language: a named scenario with the requirements that it checks, the inputs step by
/// step, and the outputs that are expected. The keys are those of conform/PROTOCOL.md; inputs that a step does not have are
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

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none

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

    #[command(flatten)]
    pub(crate) edition: EditionArgs,
}

/// Judge a program: a VCU, a simulator or a model.
///
/// Starts the program once and asks it for one step of a VCU after the other: one JSON object a line on its standard input,
/// one on its standard output. conform/PROTOCOL.md says all about these lines, and conform/examples has complete adapters in
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
  adsdv conform -- python3 conform/examples/adapter.py   # after: pip install ./python

  A simulator that steps every 10 ms and shows its outputs up to 2 steps late:
      adsdv conform --cycle-ms 10 --latency 2 -- ./simulator --headless

  More random scenarios, from another seed:
      adsdv conform --seed 7 --runs 5000 -- ./vcu

  In CI, where some deviations are known:
      adsdv conform --write-accept known.txt -- ./vcu    # then give each a reason
      adsdv conform --accept known.txt -- ./vcu

  Its own Figure 2, drawn:
      adsdv conform --figure vcu.dot -- ./vcu; dot -Tsvg vcu.dot > vcu.svg

  The report as a page to look at, or to send to the rest of the team:
      adsdv conform --html vcu.html -- ./vcu

  The requirements that failed, for a program:
      adsdv conform --json -- ./vcu | jq '.requirements[] | select(.outcome == \"fail\")'

OUTPUT
  DEVIATIONS    where tests fail: what the program does otherwise than Figure 2, each by
                itself: an arrow that needs something else besides, or does not need
                something, that is missing, late, or leads elsewhere; a time, a threshold.
                Each with the shortest scenario that shows it, as a test for --suite
  FIGURE 2      as the program does it, with what differs
  REQUIREMENTS  those that tests name. Fail: an output that it is about is wrong. Differs:
                the same, of one that is only decided here (D-1 and on). Not
                checked: the program does not show all that it is about, or could not be
                asked for it. TESTS is how many name it, or how many of them checked it:
                a test does not if steps of the cycle cannot express it, and after a wrong
                state it says nothing of other outputs. FAILED names what breaks it
  OBSERVATIONS  what is otherwise than this project decided where the document is silent.
                It does not fail, but with --strict
  FAILURES      each thing that is wrong, the first 20 of the tests and of the random
                scenarios: the row of Figure 2 that was broken, with its
                section and its guard, and the shortest scenario that was found, step by
                step, with the state that was expected beside the one that was shown
  READINGS      which of the document's readings the program follows, as far as its answers
                tell, and which it mixes: some tests need one choice, others another
  Last comes the verdict.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  the program conforms
  1  it does not
  2  no verdict: the program could not be started, ended early, did not answer in
     time, was not done in time, or does not speak the protocol; no test of the
     suite could be run; or the arguments are wrong")]
pub(crate) struct ConformArgs {
    /// The program, and its arguments, after --.
    #[arg(value_name = "PROGRAM", required = true, last = true, num_args = 1..)]
    pub(crate) command: Vec<OsString>,

    /// Run the tests of this file instead of those of `adsdv suite`: JSON Lines, as that command writes them.
    ///
    /// A test of one's own needs steps and nothing else: {"steps":[{"dt_ms":10,"times":30,"answers":true,"inputs":{"tsms":true}}]}.
    /// "times" repeats a step, "answers" says whether the AI Computer answers the handshake, and what is expected the edition
    /// says. Failures and deviations are printed as such lines, too.
    #[arg(long, value_name = "FILE")]
    pub(crate) suite: Option<PathBuf>,

    /// Look for deviations from Figure 2 even where no test fails.
    ///
    /// Where one fails it is done without being asked for: some thousand experiments more, step by step, from the states
    /// that the program reaches, in the ways that it accepts. For a program that goes by `dt_ms` and shows its outputs at once; at
    /// a fixed cycle there are fewer of them.
    #[arg(long, conflicts_with = "latency")]
    pub(crate) diagnose: bool,

    /// Do not look for deviations: only run the tests.
    #[arg(long, conflicts_with_all = ["diagnose", "accept", "write_accept", "figure"])]
    pub(crate) no_diagnosis: bool,

    /// How long the search for deviations may take, within --time-limit.
    ///
    /// What the program does is found out in seconds where it can be explained. Where it cannot, a longer search may name more.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value = "60",
        value_parser = time_limit,
        allow_negative_numbers = true
    )]
    pub(crate) diagnosis_limit: Duration,

    /// Accept the deviations of this file: the verdict is about all others.
    ///
    /// A line is the id of a deviation, and why it is accepted. One that the program does not have any more is a warning.
    #[arg(long, value_name = "FILE", conflicts_with = "latency")]
    pub(crate) accept: Option<PathBuf>,

    /// Write the deviations of the program into a file for --accept; reasons that --accept has stay.
    #[arg(long, value_name = "FILE", conflicts_with = "latency")]
    pub(crate) write_accept: Option<PathBuf>,

    /// Draw Figure 2 as the program does it into a file: for Graphviz if it ends in .dot or .gv, else as Mermaid.
    #[arg(long, value_name = "FILE", conflicts_with = "latency")]
    pub(crate) figure: Option<PathBuf>,

    /// Pin a question that the document leaves open; may be repeated.
    ///
    /// Without a pin, every choice is allowed for. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    /// Where the document is silent, count what is otherwise than this project decided as a failure.
    ///
    /// Those are the requirements D-1 and on, and the questions that the document leaves open: one that is not pinned has
    /// its default answer then. Without it they are observations.
    #[arg(long)]
    pub(crate) strict: bool,

    /// Allow outputs that are late, by the same number of steps throughout, at most this one.
    ///
    /// Before the first outputs the program shows AS_OFF, or answers {}.
    #[arg(long, value_name = "STEPS", default_value_t = 0, value_parser = latency, allow_negative_numbers = true)]
    pub(crate) latency: usize,

    /// Step at this cycle only, in milliseconds.
    ///
    /// A longer time becomes as many steps. What they cannot express is not run, and named.
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

    /// List the requirements that passed as well, the tests that were not run, and the outputs that are not shown.
    #[arg(long)]
    pub(crate) all: bool,

    /// Write the report as a page to look at to this file, beside printing it.
    ///
    /// One file that needs nothing else and no network, with all that --json prints: the verdict and what to do next, each deviation
    /// with the scenario that shows it, the program's own Figure 2 drawn with what differs, the failures step by step, the requirements.
    /// The file is there when all of it is written. With - the page is printed in place of the report.
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,

    /// Print JSON; `adsdv schema conform` prints its schema.
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,

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

pub(super) fn seconds(text: &str) -> Result<Duration, String> {
    seconds_up_to(LONGEST_WAIT, text)
}

pub(super) fn time_limit(text: &str) -> Result<Duration, String> {
    seconds_up_to(LONGEST_RUN, text)
}

fn seconds_up_to(most: f64, text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| *seconds > 0.0 && *seconds <= most);
    let time =
        seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok()).filter(|time| !time.is_zero());
    time.ok_or_else(|| format!("expected a number of seconds above 0, at most {most}"))
}
