//! The arguments of `exam`.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

use adsdv_exam::SEED;
use clap::{Args, ColorChoice};

use super::EditionArgs;
use super::conform::{seconds, time_limit};

/// Examine an AI Computer: a team's stack, or its logic.
///
/// Is its car, its operator and its judge, in one scenario after the other: every mission, "Go" that comes late, early or not for
/// long, E-stops, power cycles, frames that are lost or late, wheels that stand or spin. Each requirement of the AI Computer
/// passes, fails, or was not exercised; an AI Computer that does nothing fails what it should have done.
///
/// On a CAN interface the program is a stack as it is, which knows nothing of an exam: it is started afresh for each scenario, in
/// real time, and gets the frames of a VCU. With --namespace the interface is made for it, and gone afterwards: that takes neither
/// root nor a bus that nobody else uses. With --attach it is a stack that runs all the time.
///
/// With --stdio the program is asked through its standard input and output, in simulated time: for every 10 ms one JSON object a
/// line with the frames on the bus, and one back with the frames that it sends. exam/PROTOCOL.md says all about these lines, and
/// exam/examples has stacks in C and in Python.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  A stack on SocketCAN, on a bus that is made for it, in two minutes:
      adsdv exam --namespace --quick -- ./my_stack vcan0

  All scenarios, four at once; on an interface that is there; and a stack that runs:
      adsdv exam --namespace --jobs 4 -- ./my_stack vcan0
      adsdv exam can0 -- ./my_stack can0
      adsdv exam can0 --attach

  The logic of a stack, in simulated time:
      adsdv exam --stdio -- python3 exam/examples/stack.py
      adsdv exam --stdio --edition 2026 -- ./my_stack --stdio

  What is there, and some of it:
      adsdv exam --list
      adsdv exam --stdio --only mission-skidpad --only estop -- ./my_stack

  A thousand scenarios by chance, and again the shortest one that fails:
      adsdv exam --stdio --runs 1000 --seed 7 --logs logs -- ./my_stack
      adsdv exam --stdio --scenario logs/finding-1.txt -- ./my_stack

  The report as a page to look at, or to send to the rest of the team:
      adsdv exam --stdio --html exam.html -- ./my_stack

  The logs of the scenarios, each as `adsdv check` reads it:
      adsdv exam --stdio --logs logs -- ./my_stack
      adsdv check logs/mission-skidpad.log

  A stack that drives for longer than a minute:
      adsdv exam --stdio --mission-time 300 -- ./my_stack

  In CI (exam/examples/workflow.yml is a whole workflow for GitHub):
      adsdv exam --stdio --junit exam.xml --summary \"$GITHUB_STEP_SUMMARY\" -- ./my_stack

  In CI, where some failures are known:
      adsdv exam --stdio --write-accept known.txt -- ./my_stack    # then give each a reason
      adsdv exam --stdio --accept known.txt -- ./my_stack

  The requirements that failed, for a program:
      adsdv exam --stdio --json -- ./my_stack | jq '.requirements[] | select(.outcome == \"fail\")'

OUTPUT
  FAILED         the requirements that are not kept, each with how many scenarios show it, and
                 what is wrong in the one in which it shows soonest
  FINDINGS       of each of these what was seen and what was expected, in the words of
                 `adsdv check` where that sees it as well; what the operator had done by
                 then, the last frames, what the car did, and, with --stdio, the shortest scenario
                 that was found to show it, to be copied into a file for --scenario
  NOT EXERCISED  the requirements that nothing shows, and why; in real time also those that
                 seemed not to be kept when this machine was late itself
  Last comes the verdict.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  nothing is wrong, or only what --accept accepts
  1  a requirement failed, or something else is wrong
  2  no verdict: the program could not be started; with --stdio it ended early, did not
     answer in time, or does not speak the protocol; the interface cannot be used, or went
     down; it was stopped (Ctrl-C); or the arguments are wrong
  A program on a bus that ends, hangs or floods the bus is one that fails.")]
pub(crate) struct ExamArgs {
    /// The CAN interface on which the program is, such as vcan0.
    ///
    /// Nobody else may be on it. With --namespace, the name of the one that is made, which is vcan0 if none is given.
    #[arg(value_name = "INTERFACE", required_unless_present_any = ["list", "stdio", "namespace"], conflicts_with = "stdio")]
    pub(crate) interface: Option<String>,

    /// The program, and its arguments, after --.
    #[arg(value_name = "PROGRAM", required_unless_present_any = ["list", "attach"], last = true, num_args = 1..)]
    pub(crate) command: Vec<OsString>,

    /// Ask the program through its standard input and output, in simulated time.
    #[arg(long)]
    pub(crate) stdio: bool,

    /// Make a virtual bus for the program, in a network namespace of its own.
    #[arg(long, conflicts_with = "stdio")]
    pub(crate) namespace: bool,

    /// Examine what is on the bus already, and is not started afresh: between the scenarios the VCU has no power.
    #[arg(long, requires = "interface", conflicts_with_all = ["command", "stdio", "namespace"])]
    pub(crate) attach: bool,

    /// Run so many scenarios at once, each on a bus of its own.
    #[arg(long, value_name = "N", default_value_t = 1, requires = "namespace", value_parser = clap::value_parser!(u16).range(1..=64))]
    pub(crate) jobs: u16,

    /// How long a program on a bus may take from its start to its first frame.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value = "1",
        value_parser = seconds,
        conflicts_with_all = ["stdio", "attach"],
        allow_negative_numbers = true
    )]
    pub(crate) startup: Duration,

    /// List the scenarios, with how long each is.
    #[arg(long, conflicts_with_all = ["command", "stdio", "namespace", "attach", "json", "logs", "junit", "summary", "accept", "write_accept"])]
    pub(crate) list: bool,

    /// Only the few scenarios that show most: two minutes in real time.
    #[arg(long, conflicts_with = "only")]
    pub(crate) quick: bool,

    /// Only the scenarios whose names begin so; may be repeated.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,

    /// Only the scenario of this file: one of `adsdv demo` that comes to its end, with lines of what goes wrong.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["only", "runs", "list"])]
    pub(crate) scenario: Option<PathBuf>,

    /// How many scenarios by chance follow: what an operator may do in each state, and what may go wrong meanwhile.
    ///
    /// Their names are random-0 and on.
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    pub(crate) runs: u32,

    /// The seed of these: the same seed is the same scenarios.
    #[arg(long, value_name = "N", default_value_t = SEED, allow_negative_numbers = true)]
    pub(crate) seed: u64,

    /// Of each finding that is shown, look for the shortest scenario in so many runs at most; with 0, do not.
    ///
    /// With --stdio only: on a bus each run would take the seconds that it says.
    #[arg(
        long,
        value_name = "RUNS",
        default_value_t = 40,
        conflicts_with_all = ["interface", "namespace", "attach"],
        allow_negative_numbers = true
    )]
    pub(crate) shrink: u32,

    /// Write the frames of each scenario to a log of its own in this directory, as the AI Computer would have recorded them.
    ///
    /// The directory is made if it is not there. `adsdv check` judges each log again. The shortest scenario of each finding is there as
    /// well, by the number of the finding, with its log.
    #[arg(long, value_name = "DIR")]
    pub(crate) logs: Option<PathBuf>,

    /// Accept the failures of this file: the verdict is about all others.
    ///
    /// A line is the id of a requirement, and why it may fail; for findings that are against no single requirement it is their rule.
    /// One that does not fail any more is a warning.
    #[arg(long, value_name = "FILE")]
    pub(crate) accept: Option<PathBuf>,

    /// Write what fails into a file for --accept; reasons that --accept has stay.
    #[arg(long, value_name = "FILE")]
    pub(crate) write_accept: Option<PathBuf>,

    /// Write a JUnit XML file for CI: a test case for each requirement.
    ///
    /// A failure has the words of the finding that shows soonest, its scenario and its frames; what was not exercised is skipped,
    /// with the reason.
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,

    /// Write a summary in Markdown for the page of a CI run; on GitHub: --summary "$GITHUB_STEP_SUMMARY".
    #[arg(long, value_name = "FILE")]
    pub(crate) summary: Option<PathBuf>,

    /// How long a mission may take, from AS_DRIVING to FINISHED.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds, allow_negative_numbers = true)]
    pub(crate) mission_time: Duration,

    /// How long the program may take for an answer.
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = seconds, allow_negative_numbers = true)]
    pub(crate) timeout: Duration,

    /// How long the program may take for all that it is asked.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value = "900",
        value_parser = time_limit,
        allow_negative_numbers = true
    )]
    pub(crate) time_limit: Duration,

    /// List the requirements that passed as well.
    #[arg(long)]
    pub(crate) all: bool,

    /// Write the report as a page to look at to this file, beside printing it.
    ///
    /// One file that needs nothing else and no network, with all that --json prints: the verdict and what to do next, each finding
    /// with what was seen and expected, its frames and its shortest scenario, the requirements, the scenarios.
    /// The file is there when all of it is written. With - the page is printed in place of the report.
    #[arg(long, value_name = "FILE", conflicts_with = "list")]
    pub(crate) html: Option<PathBuf>,

    /// Print JSON; `adsdv schema exam` prints its schema.
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}
