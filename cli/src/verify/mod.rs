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

use adsdv_model::{Options, READINGS_HEAD, Sweep, closed_models, state_machines, sweep, together};
use adsdv_spec::Edition;

use crate::args::VerifyArgs;
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{output, pins};

use outcome::Outcome;

pub(crate) fn run(args: &VerifyArgs) -> Result<Status, Error> {
    let threads = args.threads.unwrap_or_else(|| Options::default().threads);
    let chosen = args.edition.chosen()?;
    if args.sweep {
        let one = chosen.asked_for().map(|_| chosen.edition());
        let editions: Vec<_> = one.map_or_else(|| state_machines().collect(), |one| vec![one]);
        return readings(&editions, threads);
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

/// What each reading of these editions costs.
fn readings(editions: &[&'static Edition], threads: usize) -> Result<Status, Error> {
    output::plain(READINGS_HEAD)?;
    let mut status = Status::Conforms;
    for edition in editions {
        let swept = explored(edition, threads);
        output::plain(&format!("\n{swept}"))?;
        let defaults_hold = swept.costs.iter().all(|cost| !cost.choices.is_empty());
        if !swept.complete || !defaults_hold {
            status = Status::Violates;
        }
    }
    Ok(status)
}

/// What each reading of an edition costs, with a line that tells how far it is.
fn explored(edition: &'static Edition, threads: usize) -> Sweep {
    let (sender, receiver) = std::sync::mpsc::channel();
    thread::scope(|scope| {
        // The explorations tell how far they are from their own threads; this one looks after the line.
        scope.spawn(move || {
            let mut line = ProgressLine::new();
            for (done, all) in receiver {
                line.show_bar(done, all, format!("of the combinations of readings of {}", edition.version));
            }
        });
        let models: Vec<_> = closed_models(edition).collect();
        sweep(edition, together(edition), &models, threads, move |done, all| {
            let _ = sender.send((done, all));
        })
    })
}

impl Outcome {
    /// What the command's exit status says of it.
    fn status(&self) -> Status {
        if self.holds() { Status::Conforms } else { Status::Violates }
    }
}
