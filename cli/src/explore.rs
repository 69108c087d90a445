//! `adsdv explore`: the Explorer, in a web browser on this machine.

use adsdv_model::closed::Closed;
use adsdv_model::serve;

use crate::args::ExploreArgs;
use crate::error::Error;
use crate::status::Status;
use crate::{output, pins};

pub(crate) fn run(args: &ExploreArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let machine = pins::machine(chosen.edition(), &args.readings)?;
    let ready = |address| {
        // Nobody may be listening, or the address may not be written, and the Explorer is still there.
        if let Err(error) = output::plain(&format!("{chosen}\nhttp://{address}/ (stop with Ctrl-C)\n")) {
            error.print();
        }
    };
    serve(Closed::explorer(machine), args.port, ready).map_err(|error| Error::port(args.port, &error))?;
    Ok(Status::Conforms)
}
