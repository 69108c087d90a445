//! `adsdv verify`: explores the models, and tells what holds.
//!
//! ```text
//! outcome ------> table (text) or json
//!    |
//!    +--- what fails ---> counterexample: a log, judged as `adsdv check` judges it
//! ```

mod counterexample;
mod json;
mod outcome;
mod table;

use std::thread;

use adsdv_model::{Options, closed_models, sweep};
use adsdv_spec::Edition;

use crate::args::VerifyArgs;
use crate::error::Error;
use crate::progress::Line;
use crate::status::Status;
use crate::{output, pins};

use outcome::Outcome;

pub(crate) fn run(args: &VerifyArgs) -> Result<Status, Error> {
    let threads = args.threads.unwrap_or_else(|| Options::default().threads);
    let chosen = args.edition.chosen()?;
    if args.sweep {
        return readings(chosen.edition(), threads);
    }
    let machine = pins::machine(chosen.edition(), &args.readings)?;
    counterexample::expect_directory(&args.logs)?;
    let outcome = outcome::explore(&machine, args.model, args.vectors.into(), threads);
    let (failures, unwritten) = counterexample::write(chosen.edition(), &outcome, &args.logs)?;
    if args.json {
        output::plain(&json::text(&outcome, &failures))?;
    } else {
        output::styled(
            &table::text(chosen, &outcome, &args.readings, &failures, output::width()),
            args.color,
        )?;
    }
    unwritten.map_or(Ok(outcome.status()), Err)
}

/// What each reading costs.
fn readings(edition: &'static Edition, threads: usize) -> Result<Status, Error> {
    let (sender, receiver) = std::sync::mpsc::channel();
    let swept = thread::scope(|scope| {
        // The explorations tell how far they are from their own threads; this one looks after the line.
        scope.spawn(move || {
            let mut line = Line::new();
            for (done, all) in receiver {
                line.show_bar(done, all, "of every combination of readings");
            }
        });
        let models: Vec<_> = closed_models(edition).collect();
        sweep(edition, usize::MAX, &models, threads, move |done, all| {
            let _ = sender.send((done, all));
        })
    });
    output::plain(&swept.to_string())?;
    let defaults_hold = swept.costs.iter().all(|cost| !cost.choices.is_empty());
    Ok(if swept.complete && defaults_hold { Status::Conforms } else { Status::Violates })
}

impl Outcome {
    /// What the command's exit status says of it.
    fn status(&self) -> Status {
        if self.holds() { Status::Conforms } else { Status::Violates }
    }
}
