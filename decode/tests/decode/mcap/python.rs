//! The reader of Python opens it, and finds in it what its index says.

use std::fs;
use std::path::Path;
use std::process::Command;

use adsdv_decode::{Catalog, Options};
use adsdv_spec::Edition;

use super::judged::run;
use super::read::written;
use crate::frames::{catalog, random};
use crate::python::python;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/decode/read_mcap.py");

/// What the script says of a file.
fn read(name: &str, log: &str, catalog: &Catalog, options: &Options) -> Option<String> {
    let python = python()?;
    let (file, summary, _) = written(log, catalog, options);
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.mcap"));
    fs::write(&path, file).expect("the folder for tests can be written");
    let output = Command::new(python).arg(SCRIPT).arg(&path).output().expect("the interpreter starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {stderr}");
    let said = String::from_utf8(output.stdout).expect("text");
    assert!(said.starts_with(&format!("{} frames, ", summary.frames)), "{said}");
    Some(said)
}

#[test]
fn python_reads_every_message_and_it_is_as_its_schema_says() {
    for edition in Edition::ALL {
        let catalog = catalog(edition);
        let options = Options { edition: Some(edition), ..Options::default() };
        read(edition.version, &random(&catalog, 50), &catalog, &options);
    }
}

#[test]
fn python_finds_its_way_in_a_long_file_by_the_index() {
    let catalog = catalog(&Edition::V4_0);
    if let Some(said) = read("mission", &run("mission.log"), &catalog, &Options::default()) {
        assert!(said.contains(", 10 chunks, "), "{said}");
    }
}
