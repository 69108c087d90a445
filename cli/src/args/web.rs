//! The arguments of `web`.

use std::net::IpAddr;

use clap::Args;

use super::verify::port;

/// Judge logs and drive the virtual car in a web browser.
///
/// Serves one page on this machine only, which needs no network and nothing else: drop a log in it, or a folder of logs, and see the
/// report that `check --html` makes, by any edition and any readings; or drive the virtual car with a judge beside it. What is judged
/// is judged in the browser, and leaves it for nowhere. The page can be saved, and opens from a disk as well.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv web
  adsdv web --open
  adsdv web --port 8080

  To have it as a file:
      adsdv web --print > adsdv.html

OUTPUT
  The address to open. It is served until the command is stopped (Ctrl-C).

EXIT STATUS
  0  the page has been printed
  2  the address could not be had, or the arguments are wrong")]
pub(crate) struct WebArgs {
    /// The port; 0 for any that is free.
    #[arg(long, value_name = "N", default_value_t = 3024, value_parser = port, allow_negative_numbers = true)]
    pub(crate) port: u16,

    /// The address to serve on.
    ///
    /// Who reaches another than 127.0.0.1 gets the page, and nothing of this machine.
    #[arg(long, value_name = "IP", default_value = "127.0.0.1")]
    pub(crate) address: IpAddr,

    /// Open it in the browser.
    #[arg(long)]
    pub(crate) open: bool,

    /// Print the page itself, and serve nothing.
    #[arg(long, conflicts_with_all = ["port", "address", "open"])]
    pub(crate) print: bool,
}
