//! A program under test that deviates from the specification as its arguments say: for the tests of `adsdv conform`.
//!
//! ```text
//! deviating off-ready:needs:ami=3 handshake:+450ms finished:shows:as_state=0
//! deviating --edition 4.0 go:level
//! deviating --about '{"inputs":["asms","tsms"],"outputs":["as_state"]}' go:level
//! ```
//!
//! With `--no-reset` it goes on at a reset as if there was none.
//!
//! With what it announces it is blind to all other inputs, and ends with an error if any of them is given, or if a step does not take
//! the cycle that it announces.

use std::error::Error;
use std::io::{self, BufRead, BufReader, BufWriter, Write};

use adsdv_conform::protocol::{About, Domain, INPUTS, Protocol, Request, Shown};
use adsdv_diagnosis::{Deviation, Model, Subject};
use adsdv_spec::{Edition, Inputs};

fn main() -> Result<(), Box<dyn Error>> {
    let mut edition = Edition::DEFAULT;
    let (mut deviations, mut announced, mut resets) = (Vec::new(), None, true);
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        if arg == "--edition" {
            let version = args.next().ok_or("--edition needs a version")?;
            edition = Edition::find(&version).ok_or(format!("no such edition: {version}"))?;
        } else if arg == "--about" {
            announced = Some(args.next().ok_or("--about needs a line of the protocol")?);
        } else if arg == "--no-reset" {
            resets = false;
        } else {
            deviations.push(Deviation::find(edition, &arg).ok_or(format!("no such deviation: {arg}"))?);
        }
    }
    let protocol = Protocol::of(edition);
    let about = announced.as_deref().map(|line| About::read(line, &protocol)).transpose()?.flatten();
    let About { inputs: has, outputs, cycle_ms, .. } = about.unwrap_or_default();
    let lacking: Vec<_> =
        INPUTS.iter().filter(|field| has.as_ref().is_some_and(|has| !has.contains(&field.key))).collect();
    deviations.extend(lacking.iter().map(|field| Deviation::Ignores { key: field.key }));
    let mut program = Model::new(edition, &deviations).running();
    let mut requests = BufReader::new(io::stdin().lock());
    let mut answers = BufWriter::new(io::stdout().lock());
    if let Some(line) = announced {
        writeln!(answers, "{line}")?;
    }
    let mut line = String::new();
    loop {
        if requests.buffer().is_empty() {
            answers.flush()?;
        }
        line.clear();
        if requests.read_line(&mut line)? == 0 {
            return Ok(answers.flush()?);
        }
        match protocol.request(&line)? {
            Request::Hello { .. } => writeln!(answers, "{{\"edition\":{:?}}}", edition.version)?,
            Request::Reset => {
                if resets {
                    program.reset()?;
                }
                writeln!(answers, "{{}}")?;
            }
            Request::Step { dt_ms, inputs } => {
                let given =
                    lacking.iter().find(|field| (field.get)(&inputs) != (field.get)(&Inputs::default()));
                if let Some(field) = given {
                    return Err(format!("{} was given and is not announced", field.key).into());
                }
                if let Some(cycle_ms) = cycle_ms.filter(|cycle_ms| *cycle_ms != dt_ms) {
                    return Err(format!("a step of {dt_ms} ms, and the cycle is {cycle_ms} ms").into());
                }
                let shown = program.shown(dt_ms, &inputs);
                match &outputs {
                    Some(outputs) => writeln!(answers, "{}", among(&shown, outputs))?,
                    None => writeln!(answers, "{shown}")?,
                }
            }
        }
    }
}

/// The answer with these outputs alone.
fn among(shown: &Shown, outputs: &[&str]) -> String {
    let there = shown.iter().filter(|(field, _)| outputs.contains(&field.key));
    let each = there.map(|(field, value)| match (value.domain, value.raw) {
        (Domain::Names(_), Some(raw)) if value.domain.has(raw) => format!("\"{}\":\"{value}\"", field.key),
        _ => format!("\"{}\":{value}", field.key),
    });
    format!("{{{}}}", each.collect::<Vec<_>>().join(","))
}
