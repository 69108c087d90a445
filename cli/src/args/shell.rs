//! What a package installs beside the command: completions for shells, and manual pages.

use clap::Args;
use clap_complete::Shell;

/// Print the completions for a shell.
///
/// The script that lets a shell complete the commands and options of adsdv, for where that shell looks for them.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv completions bash > ~/.local/share/bash-completion/completions/adsdv
  adsdv completions zsh > ~/.zfunc/_adsdv
  adsdv completions fish > ~/.config/fish/completions/adsdv.fish
  adsdv completions powershell >> $PROFILE

EXIT STATUS
  0  they have been printed
  2  they could not be written, or the arguments are wrong")]
pub(crate) struct CompletionsArgs {
    /// The shell.
    #[arg(value_name = "SHELL", value_enum)]
    pub(crate) shell: Shell,
}

/// Print the manual page of a command.
///
/// What `--help` says, as roff for man. Without a command, the page of adsdv itself.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv man check | man -l -
  adsdv man > adsdv.1
  adsdv man check > adsdv-check.1

EXIT STATUS
  0  the page has been printed
  2  it could not be written, or the arguments are wrong: there is no such command")]
pub(crate) struct ManArgs {
    /// The command that the page is about.
    #[arg(value_name = "COMMAND")]
    pub(crate) command: Option<String>,
}
