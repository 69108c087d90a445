//! Reads what Kani has printed: which theorems it has verified, and whether the interesting cases of each are reached.
//! `scripts/kani.sh` calls it.
//!
//! - `read`: the text as harnesses, with their checks;
//! - `findings`: what is wrong with them, and what only takes long.

mod findings;
mod read;

use std::process::ExitCode;
use std::{env, fs};

use findings::{Findings, expected};

const USAGE: &str = "\
Usage: kani_output [--some] [--limits] LOG

Reads LOG, the output of `cargo kani -p adsdv-proofs` in its regular format (the default).

Every theorem has to be verified, and each of its interesting cases (kani::cover!) reached: one of the checks with the
same function, description and place has to be SATISFIED. The sums that Kani prints itself (\"5 of 7 cover properties
satisfied\") count more: a condition of several parts, and one in a function that is inlined at several places, become
several checks, and some of these cannot be satisfied.

  --some    only some of the theorems were asked for; without it all of them have to be there
  --limits  a theorem that takes longer than 30 s is wrong, and an edition whose theorems take longer than 10 minutes;
            without it that is only said

Exit status: 0 all is verified and reached, 1 something is not, 2 wrong usage, or LOG cannot be read.
";

fn main() -> ExitCode {
    let args: Vec<String> = env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    if let ["-h" | "--help"] = args[..] {
        print!("{USAGE}");
        return ExitCode::SUCCESS;
    }
    let (options, paths): (Vec<&str>, Vec<&str>) = args.iter().partition(|arg| arg.starts_with('-'));
    let (&[path], true) = (&paths[..], options.iter().all(|option| ["--some", "--limits"].contains(option)))
    else {
        eprint!("{USAGE}");
        return ExitCode::from(2);
    };
    let text = match fs::read(path) {
        Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(error) => {
            eprintln!("kani_output: {path}: {error}");
            return ExitCode::from(2);
        }
    };
    let expected = if options.contains(&"--some") { Vec::new() } else { expected() };
    let findings = Findings::of(&read::harnesses(&text), &expected);
    let findings = if options.contains(&"--limits") { findings.within_limits() } else { findings };
    print!("{findings}");
    if findings.holds() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
