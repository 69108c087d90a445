//! The arguments of the command that compares two editions.

use adsdv_spec::Edition;
use clap::{Args, ColorChoice};

use super::edition;

/// Say what one edition of the interface changes of another.
///
/// Messages and signals that are new, gone, renamed or laid out otherwise; the arrows of Figure 2 with the alternatives of
/// their guards; priorities, times and thresholds; faults and shutdown causes; reserved identifiers; and the questions that
/// the document leaves open. All of it is computed from the tables of the two editions.
///
/// A message is the same by its identifier, and a signal by what it carries, whatever they are called. An alternative of a
/// guard is the same by its conditions.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv diff 3.0 4.0

  For a page on GitHub:
      adsdv diff 3.0 4.0 --markdown > changes.md

  The messages that have another length, for a program:
      adsdv diff 3.0 4.0 --json | jq '.messages.changed[]
          | select(any(.changes[]; .property == \"length\")) | .name'

OUTPUT
  A line is one difference: what it is about, the property, and the value before and
  after (from -> to). What only the second edition has is new, what only the first
  has is gone. A section that has nothing to say is left out.
  Values of a signal are listed as far as they differ. An alternative of a guard is
  listed with its section, with the fault that it reports, and with the answer to an
  open question without which it is not there (see `adsdv readings`).

ENVIRONMENT
  NO_COLOR  if set and not empty, --color auto means never

EXIT STATUS
  0  the editions have been compared, whether they differ or not
  2  the answer could not be written, or the arguments are wrong")]
pub(crate) struct DiffArgs {
    /// The edition before.
    #[arg(value_name = "FROM", value_parser = edition::known())]
    pub(crate) from: &'static Edition,

    /// The edition after.
    #[arg(value_name = "TO", value_parser = edition::known())]
    pub(crate) to: &'static Edition,

    /// Print Markdown instead of text: a table for each section.
    #[arg(long, conflicts_with = "json")]
    pub(crate) markdown: bool,

    /// Print one JSON object instead of text; `adsdv schema diff` prints its schema.
    #[arg(long)]
    pub(crate) json: bool,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}
