//! Writes what fuzzers begin with, `fuzz/corpus` and `fuzz/dictionaries`: see `adsdv_tests::fuzzed::seeds`.
//!
//! Usage: `cargo run -p adsdv-tests --bin seeds`, in the root of the project. What is there and is not made here any more is
//! removed; what a fuzzer has found itself (its name is 40 hexadecimal digits) stays.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;
use std::process::ExitCode;

use adsdv_tests::fuzzed::{replay, seeds};

fn main() -> ExitCode {
    let fuzz = Path::new("fuzz");
    if !fuzz.join("Cargo.toml").is_file() {
        eprintln!("seeds: there is no fuzz/Cargo.toml here; run it in the root of the project");
        return ExitCode::from(2);
    }
    match write(fuzz) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("seeds: {error}");
            ExitCode::from(2)
        }
    }
}

fn write(fuzz: &Path) -> io::Result<()> {
    for (target, inputs) in seeds::corpus() {
        write_all(&fuzz.join("corpus").join(target), &inputs)?;
    }
    let dictionaries = seeds::dictionaries().into_iter();
    let files = dictionaries.map(|(target, text)| (format!("{target}.dict"), text.into_bytes())).collect();
    write_all(&fuzz.join("dictionaries"), &files)
}

/// Makes a folder have these files, and no others.
fn write_all(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if !files.contains_key(name) && !replay::is_found(name) {
            fs::remove_file(&path)?;
        }
    }
    files.iter().try_for_each(|(name, bytes)| fs::write(folder.join(name), bytes))
}
