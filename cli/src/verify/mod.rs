//! `adsdv verify`: explores the models, and tells what holds.
//!
//! ```text
//! outcome ------> table (text) or json
//!    |
//!    +--- what fails ---> counterexample: a log, judged as `adsdv check` judges it
//!
//! --readings: a sweep of each edition ---> Markdown, costs (json), or a page
//! ```

mod costs;
mod counterexample;
mod json;
mod outcome;
mod table;

use std::thread;

use adsdv_model::{Engine, Options, READINGS_HEAD, Sweep, closed_models, state_machines, sweep, together};
use adsdv_spec::Edition;

use crate::args::VerifyArgs;
use crate::error::Error;
use crate::progress::ProgressLine;
use crate::status::Status;
use crate::{html, output, pins};

use outcome::Outcome;

pub(crate) fn run(args: &VerifyArgs) -> Result<Status, Error> {
    let threads = args.threads.unwrap_or_else(|| Options::default().threads);
    let chosen = args.edition.chosen()?;
    if args.sweep {
        let one = chosen.asked_for().map(|_| chosen.edition());
        let editions: Vec<_> = one.map_or_else(|| state_machines().collect(), |one| vec![one]);
        return readings(args, &editions, threads);
    }
    let machine = pins::machine(chosen.edition(), &args.readings)?;
    counterexample::expect_directory(&args.logs)?;
    let outcome = {
        let document = machine.edition().rules.timing;
        let options = Options {
            vectors: args.vectors.into(),
            threads,
            document,
            engine: args.engine.into(),
            ..Options::default()
        };
        outcome::explore(&machine, args.model, options)
    };
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

/// What each reading of these editions costs: as Markdown, a line of JSON for each, or a page.
fn readings(args: &VerifyArgs, editions: &[&'static Edition], threads: usize) -> Result<Status, Error> {
    let file = args.html.as_deref();
    html::prepare_long(file, args.json)?;
    let is_text = !args.json && !html::is_printed(file);
    if is_text {
        output::plain(READINGS_HEAD)?;
    }
    let (mut lines, mut holds) = (Vec::new(), true);
    for edition in editions {
        let swept = explored(edition, threads, args.engine.into());
        holds &= costs::holds(&swept);
        let line = costs::json(&swept);
        if is_text {
            output::plain(&format!("\n{swept}"))?;
        } else if args.json {
            output::plain(&line)?;
        }
        lines.push(line);
    }
    if let Some(file) = file {
        html::write(file, costs::page(editions, &lines, holds))?;
    }
    Ok(if holds { Status::Conforms } else { Status::Violates })
}

/// What each reading of an edition costs, with a line that tells how far it is.
fn explored(edition: &'static Edition, threads: usize, engine: Engine) -> Sweep {
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
        sweep(edition, together(edition), &models, threads, engine, move |done, all| {
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
