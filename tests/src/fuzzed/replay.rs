//! Inputs, run again without a fuzzer.

use std::fs;
use std::path::Path;

use adsdv_proofs::seed;

use crate::world::{Chance, Random};

/// The folders of `fuzz` that have inputs of each body: those that a fuzzer starts from, and those that went wrong once.
pub const FOLDERS: [&str; 2] = ["corpus", "regressions"];

/// Whether this is the name of a file that a fuzzer has written itself.
pub fn is_found(name: &str) -> bool {
    name.len() == 40 && name.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// Runs every file of `fuzz/corpus` and `fuzz/regressions` for a body through it; how many there were.
///
/// # Panics
///
/// As the body does, after telling which file it was; and if a file cannot be read.
pub fn files(fuzz: &Path, target: &str, body: fn(&[u8])) -> usize {
    let mut run = 0;
    for folder in FOLDERS {
        // What has never gone wrong has no regressions.
        let Ok(entries) = fs::read_dir(fuzz.join(folder).join(target)) else { continue };
        for entry in entries {
            let path = entry.expect("the folder can be read").path();
            let bytes = fs::read(&path).expect("the file can be read");
            Running { bytes: &bytes, from: From::File(&path) }.run(body);
            run += 1;
        }
    }
    run
}

/// An input that is run, and reported if it goes wrong.
struct Running<'a> {
    bytes: &'a [u8],
    from: From<'a>,
}

/// Where an input is from.
enum From<'a> {
    File(&'a Path),
    Seed(u64),
}

impl Running<'_> {
    fn run(self, body: fn(&[u8])) {
        body(self.bytes);
        std::mem::forget(self);
    }
}

impl Drop for Running<'_> {
    fn drop(&mut self) {
        match self.from {
            From::File(path) => eprintln!("the input is {}", path.display()),
            From::Seed(seed) => {
                let bytes = self.bytes.escape_ascii();
                eprintln!("the input is \"{bytes}\", drawn with {}={seed}", seed::VARIABLE);
            }
        }
    }
}

/// Runs a body on nothing, and on so many small inputs that are the same for the same [`seed`](seed::seed): any bytes, and
/// now and then few of them repeated, as text is.
pub fn random(count: u64, body: fn(&[u8])) {
    body(&[]);
    let seed = seed::seed();
    let mut random = Random::with_seed(seed);
    let mut input = Vec::new();
    for _ in 0..count {
        input.clear();
        let alphabet: [u8; 8] = random.bits().to_le_bytes();
        let few = random.one_in(4);
        for _ in 0..random.below(200) {
            input.push(if few { random.pick(&alphabet) } else { random.bits().to_le_bytes()[0] });
        }
        Running { bytes: &input, from: From::Seed(seed) }.run(body);
    }
}
