//! A complete adapter in Rust for `adsdv conform`, around the specification itself.
//!
//! ```text
//! cargo build --release -p adsdv-oracle --example adapter
//! adsdv conform -- target/release/examples/adapter
//! ```
//!
//! Put your own VCU in place of `Machine`. `conform/PROTOCOL.md` says what the lines mean.

use std::io::{self, BufRead, BufReader, BufWriter, Write};

use adsdv_conform::protocol::{Protocol, Request, Shown};
use adsdv_spec::{Control, Edition, Machine};

fn main() -> io::Result<()> {
    let mut requests = BufReader::new(io::stdin().lock());
    let mut answers = BufWriter::new(io::stdout().lock());
    let mut vcu = Machine::default();
    let mut protocol = Protocol::of(vcu.edition());
    let mut control = Control::INITIAL;
    let mut line = String::new();
    let mut is_first = true;
    loop {
        // The judge waits for what has been answered so far, unless there is more to do.
        if requests.buffer().is_empty() {
            answers.flush()?;
        }
        line.clear();
        if requests.read_line(&mut line)? == 0 {
            return answers.flush();
        }
        let request = protocol.request(&line).map_err(io::Error::other)?;
        if std::mem::take(&mut is_first) && !matches!(request, Request::Hello { .. }) {
            // Nobody asks for an edition, so that it speaks of itself in a line of its own.
            writeln!(answers, "{{{}}}", about(&protocol))?;
        }
        match request {
            Request::Hello { edition } => {
                // A program of one edition answers with that, whatever it is asked.
                let known = *Edition::find(&edition).unwrap_or(vcu.edition());
                vcu = Machine::new(known, known.readings);
                protocol = Protocol::of(&known);
                writeln!(answers, "{{\"edition\":{:?},{}}}", known.version, about(&protocol))?;
            }
            Request::Reset => {
                control = Control::INITIAL;
                writeln!(answers, "{{}}")?;
            }
            Request::Step { dt_ms, inputs } => {
                let (after, outputs) = vcu.step(&control, &inputs, dt_ms);
                control = after;
                writeln!(answers, "{}", Shown::of(vcu.edition(), &outputs, &inputs))?;
            }
        }
    }
}

/// What it says of itself. A program that steps at a fixed cycle adds "cycle_ms", one that goes by a clock "clock":"wall".
fn about(protocol: &Protocol) -> String {
    let outputs: Vec<&str> = protocol.shown().map(|(field, _)| field.key).collect();
    format!("\"outputs\":{outputs:?}")
}
