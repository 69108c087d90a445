//! The arguments of the command that decodes recordings.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Args, ValueEnum};

use super::RecognisedArgs;

/// Print every signal of a log, with its unit and the names of its values.
///
/// As text in the way of `cantools decode`, or for other tools: CSV, JSON Lines, VCD for GTKWave and Surfer, Parquet for DuckDB, pandas
/// and polars, or MCAP for Foxglove, Lichtblick and PlotJuggler. No database is needed: the signals are those of the edition that the log speaks, which is recognised by its frames as `adsdv check` does.
/// --dbc adds a team's own messages.
///
/// No frame is lost: one that nothing knows is printed with its bytes, and one that is too short with the signals that it has.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  What was on the bus?
      adsdv decode --single-line run.log | less

  From the bus as it comes, by an edition that is named, so that nothing is waited for:
      candump -L can0 | adsdv decode --edition 2026 --single-line -

  A team's own devices beside the ADS-DV's:
      adsdv decode --dbc team.dbc run.log

  For a spreadsheet or pandas, and for jq:
      adsdv decode --format csv -o run.csv run.log
      adsdv decode --format jsonl run.log | jq -c 'select(.message == \"VCU2AI_Status\") | .signals.AS_STATE.name'

  For DuckDB, pandas and polars, with the type of each column: a file for each message in the
  directory run, or every signal in one file:
      adsdv decode --format parquet --table messages -o run run.log
      duckdb -c \"SELECT time, AS_STATE_name FROM 'run/VCU2AI_Status.parquet'\"
      adsdv decode --format parquet -o run.parquet run.log
      duckdb -c \"SELECT signal, max(value) FROM 'run.parquet' WHERE unit = 'deg' GROUP BY signal\"

  As waves, with what blocks each arrow of the state machine:
      adsdv decode --format vcd -o run.vcd run.log
      gtkwave run.vcd

  In Foxglove or Lichtblick: open run.mcap, and import run-layout.json as a layout
      adsdv decode --format mcap -o run.mcap --layout run-layout.json run.log

OUTPUT
  text   the frame as candump -L prints it, and behind it the message with its signals: a
         line for each, or with --single-line all in one. Unlike cantools 45, fractions
         are exact, and a frame of another length than its message is decoded as far as
         it goes, with `Wrong data size` behind it.
  csv    a row for each signal: time_s,interface,id,message,signal,value,unit,name.
         value is always a number. A frame that nothing knows has a row with its bytes in
         name. id is in hexadecimal digits: let it be read as text, not as a number, with
         dtype={'id': str} of pandas, or types={'id': 'VARCHAR'} of DuckDB.
  jsonl  an object for each frame: time_s, interface, id, data, and of a message that is
         known message and signals, each with value, unit and name
  vcd    a scope for each message, with wires and reals; `state` has the AS state, and
         `blocked` what blocks each arrow of Figure 2: a condition is 1 if it is as the
         arrow needs it, 0 if not, x if that is not known. Of one interface.
  parquet
         typed tables, by --table, with times as timestamps in nanoseconds:
         signals   a row for each signal: time, interface, id, kind, message, signal,
                   value, exact, name, unit, data. exact is null but for whole numbers
                   that no double is; a frame without a signal has a row with its data.
         frames    a row for each frame: time, interface, id, extended, kind, direction,
                   length, flags, message, data
         messages  a file for each message in the directory of --output, with a row for
                   each frame: time, interface, and a column for each signal, which is
                   null where the frame has none. Names of values have a column as well:
                   AS_STATE is a number, AS_STATE_name a text. Frames that nothing knows
                   are in unknown_frames.parquet.
         What --output names is there when all is written, and not before. A feature of
         the build: cargo install --path cli --features parquet
  mcap   a channel for each message, as JSON with its JSON Schema, under /adsdv; the same
         of other interfaces under their names, and a team's own messages under /dbc.
         /adsdv/as_state has the AS state, /adsdv/blocked what blocks each arrow of
         Figure 2, and /adsdv/findings what `adsdv check` finds. /can has every frame as
         it was, so that `adsdv check run.mcap` judges it again. Where --output names a
         file, that is there when all of it is written, and not before.
  Times are those of the log; in a VCD, since its first frame. Lines that could not be
  read, frames that the log says were lost, and frames that nothing knows are counted on
  standard error at the end.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none and the log does not tell

EXIT STATUS
  0  the log was decoded
  2  a log or a database could not be read, the answer not be written, or the arguments
     are wrong; of a log that could not be read to its end, what could be was decoded")]
pub(crate) struct DecodeArgs {
    /// The log: a file of `candump -L`, or - for standard input.
    #[arg(value_name = "LOG")]
    pub(crate) log: PathBuf,

    /// What to make of it.
    #[arg(long, value_name = "FORMAT", default_value_t = Decoded::Text, value_enum)]
    pub(crate) format: Decoded,

    /// What a row of Parquet is.
    #[arg(long, value_name = "TABLE", value_enum)]
    pub(crate) table: Option<DecodedTable>,

    /// Text in one line for each frame.
    #[arg(short, long)]
    pub(crate) single_line: bool,

    /// Write to this file instead of standard output, which is - as well. One that is there is replaced.
    ///
    /// With --table messages it is a directory, which is made; one that is there has to be empty.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// Write a layout for Foxglove and Lichtblick to this file, which shows the MCAP.
    ///
    /// The states, what blocks each arrow, a plot for each unit, the findings, and the status of the VCU. It is of the edition that
    /// the log speaks, not of the log: one does for all of a team's logs. In Foxglove and Lichtblick: Layout, Import from file.
    #[arg(long, value_name = "FILE")]
    pub(crate) layout: Option<PathBuf>,

    /// Decode the messages of this database (DBC) as well; may be repeated.
    ///
    /// Extended identifiers, multiplexers, both byte orders, floats and value tables are read. Of an identifier that the edition
    /// has as well, the edition's counts, and a note says so; what this database says is never judged.
    #[arg(long, value_name = "FILE")]
    pub(crate) dbc: Vec<PathBuf>,

    /// Decode the frames of this CAN interface alone, as the log names it.
    #[arg(long, value_name = "NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) interface: Option<String>,

    #[command(flatten)]
    pub(crate) edition: RecognisedArgs,
}

/// What a log is decoded to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Decoded {
    /// Text in the way of `cantools decode`.
    Text,
    /// A row for each signal.
    Csv,
    /// A JSON object for each frame.
    Jsonl,
    /// Waves for GTKWave and Surfer.
    Vcd,
    /// Tables for DuckDB, pandas and polars.
    Parquet,
    /// Channels for Foxglove, Lichtblick and PlotJuggler.
    Mcap,
}

impl Decoded {
    /// Whether it is no text, and nothing for a terminal.
    pub(crate) const fn is_binary(self) -> bool {
        matches!(self, Self::Parquet | Self::Mcap)
    }

    /// Whether nobody can read a part of it.
    pub(crate) const fn is_whole(self) -> bool {
        matches!(self, Self::Parquet | Self::Mcap)
    }
}

/// What a row of Parquet is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DecodedTable {
    /// A signal of a frame; this is the default.
    Signals,
    /// A frame.
    Frames,
    /// A frame, in a file for each message with a column for each signal.
    Messages,
}
