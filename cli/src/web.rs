//! `adsdv web`: the page that judges in a browser.

use std::io;
use std::net::SocketAddr;
use std::process::{Command, Stdio};

use adsdv_site::{PAGE, Site};

use crate::args::WebArgs;
use crate::error::Error;
use crate::output;
use crate::status::Status;

pub(crate) fn run(args: &WebArgs) -> Result<Status, Error> {
    if args.print {
        output::plain(PAGE)?;
        return Ok(Status::Conforms);
    }
    let site = Site::bind(args.address, args.port).map_err(|error| refused(args, error.source_error()))?;
    // Nobody may be listening, or the address may not be written, and the page is still there.
    if let Err(error) = output::plain(&format!("http://{}/ (stop with Ctrl-C)\n", site.address())) {
        error.print();
    }
    if args.open
        && let Err(error) = open(site.address())
    {
        let why = format!("cannot be opened from here: {error}");
        let hint = "open the address in a browser yourself".to_owned();
        Error { what: "the browser".to_owned(), why, hint }.print();
    }
    site.serve();
    Ok(Status::Conforms)
}

fn refused(args: &WebArgs, error: &io::Error) -> Error {
    if error.kind() == io::ErrorKind::AddrNotAvailable {
        let why = format!("cannot serve on this address: {error}");
        let hint =
            "name an address of this machine with --address, or 0.0.0.0 for all that it has".to_owned();
        return Error { what: format!("address {}", args.address), why, hint };
    }
    Error::port(args.port, error)
}

/// Opens it with what the system opens addresses with.
fn open(address: SocketAddr) -> io::Result<()> {
    let url = format!("http://{address}/");
    let mut command = if cfg!(target_os = "macos") {
        Command::new("open")
    } else if cfg!(windows) {
        let mut command = Command::new("cmd");
        command.args(["/C", "start", ""]);
        command
    } else {
        Command::new("xdg-open")
    };
    command.arg(url).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().map(drop)
}
