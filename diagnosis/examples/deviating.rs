//! A program under test that deviates from the specification as its arguments say: for the tests of `adsdv conform`.
//!
//! ```text
//! deviating off-ready:needs:ami=3 handshake:+450ms finished:shows:as_state=0
//! deviating --edition 4.0 go:level
//! ```

use std::error::Error;
use std::io::{self, BufRead, BufReader, BufWriter, Write};

use adsdv_diagnosis::{Deviation, Model, Subject};
use adsdv_oracle::protocol::{Protocol, Request};
use adsdv_spec::Edition;

fn main() -> Result<(), Box<dyn Error>> {
    let mut edition = Edition::DEFAULT;
    let mut deviations = Vec::new();
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        if arg == "--edition" {
            let version = args.next().ok_or("--edition needs a version")?;
            edition = Edition::find(&version).ok_or(format!("no such edition: {version}"))?;
        } else {
            deviations.push(Deviation::find(edition, &arg).ok_or(format!("no such deviation: {arg}"))?);
        }
    }
    let mut program = Model::new(edition, &deviations).running();
    let protocol = Protocol::of(edition);
    let mut requests = BufReader::new(io::stdin().lock());
    let mut answers = BufWriter::new(io::stdout().lock());
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
                program.reset()?;
                writeln!(answers, "{{}}")?;
            }
            Request::Step { dt_ms, inputs } => writeln!(answers, "{}", program.shown(dt_ms, &inputs))?,
        }
    }
}
