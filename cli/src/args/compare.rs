//! The arguments of the command that compares two recordings.

use std::path::PathBuf;

use adsdv_spec::Choice;
use clap::builder::NonEmptyStringValueParser;
use clap::{Args, ColorChoice};

use super::RecognisedArgs;

/// Say what differs between two recordings: it worked yesterday.
///
/// Both logs are judged as by `adsdv check`, each by the edition that it speaks. They are aligned by the AS states that the
/// VCU was in, one after the other, and not by the clock. What comes first is the first state that they leave for different
/// ones: what blocked the way there, whose move it was, which message shows it, and how that was in the other recording.
///
/// What varies from run to run counts only if it differs by more than 20 %: how long a state lasted, which range a request had,
/// how often a message came, how fast the handshake was answered. How close it came to its limits counts from a tenth of these on.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  It worked yesterday:
      adsdv compare yesterday.log today.log

  With a log that is compressed, or on another machine:
      zcat yesterday.log.gz | adsdv compare - today.log
      ssh car cat run.log | adsdv compare yesterday.log -

  Both by the same edition:
      adsdv compare --edition 2026 yesterday.log today.log

  In a script, the identifiers that are missing today:
      adsdv compare --json yesterday.log today.log | jq -r '.frames[] | select(.only == \"good\") | .id'

OUTPUT
  WHERE THEY PART  the first state that both come to and leave for different ones, or that
                   one of them does not leave; what decided there, what blocked the way
                   that the other one took, and how that condition was in the other one
  TRANSITIONS      the changes of AS_STATE that only one has
  STATES           how long each lasted, the largest difference first; states that a
                   recording begins or ends in are left out
  FINDINGS         what only one was found to do, by rule, party and severity; the first
                   of each
  REQUESTS         the range that each request of the AI Computer had in a state, from
                   a window of 30 ms after it began on, and the values of MISSION_STATUS,
                   DIRECTION_REQUEST and ESTOP_REQUEST one after the other
  MARGINS          how much closer to its limits one came, by a tenth of the limit or
                   past it: what got worse in BAD first
  FRAMES           identifiers that only one has, the median of their cycles, lengths, and
                   the times of the AI Computer's answers to the handshake
  Times are in seconds since the first frame of that log. A section that has nothing to
  say is left out; of one that has much to say the first lines are printed, and --json
  has all of it.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none and a log does not tell
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  nothing that matters differs
  1  something does
  2  no answer: a log could not be read, which is named, or the answer not be written, or
     the arguments are wrong")]
pub(crate) struct CompareArgs {
    /// The log in which it worked: a file of `candump -L`, or - for standard input.
    #[arg(value_name = "GOOD")]
    pub(crate) good: PathBuf,

    /// The log in which it did not: a file of `candump -L`, or - for standard input.
    #[arg(value_name = "BAD")]
    pub(crate) bad: PathBuf,

    /// Print one JSON object instead of text; `adsdv schema compare` prints its schema.
    #[arg(long)]
    pub(crate) json: bool,

    /// Pin a question that the document leaves open; may be repeated.
    ///
    /// Without a pin, the judge allows for every choice. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    /// The CAN interface to judge, as both logs name it.
    ///
    /// Without it, of each log the first interface that carries a message of the ADS-DV.
    #[arg(long, value_name = "NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) interface: Option<String>,

    #[command(flatten)]
    pub(crate) edition: RecognisedArgs,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}
