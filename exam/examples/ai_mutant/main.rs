//! The reference AI Computer, or one with a mistake, as a program for `adsdv exam`.
//!
//! ```console
//! $ cargo build -p adsdv-exam --example ai_mutant
//! $ adsdv exam --stdio -- target/debug/examples/ai_mutant never-selects
//! ```

mod mutants;

use std::io;

use adsdv_exam::serve;
use mutants::{MUTANTS, Mutant};

fn main() -> io::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_default();
    if !name.is_empty() && !MUTANTS.iter().any(|mutant| mutant.name == name) {
        let all = MUTANTS.iter().map(|mutant| format!("{} ({})", mutant.name, mutant.breaks.join(" ")));
        let all: Vec<String> = all.collect();
        return Err(io::Error::other(format!(
            "no mutant {name:?}; expected none, or one of {}",
            all.join(", ")
        )));
    }
    serve(&mut Mutant::new(&name), io::stdin().lock(), io::stdout().lock())
}
