//! What is decoded, held against cantools, frame by frame and signal by signal.

use std::fs;
use std::path::Path;
use std::process::Command;

use adsdv_decode::{Catalog, Database};
use adsdv_spec::Edition;
use adsdv_spec::export::Dbc;

use crate::frames::{Format, catalog, decode, random};
use crate::python::python;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/decode/compare_cantools.py");

/// Lets cantools decode the same log by the same database.
fn compare(name: &str, dbc: &str, log: &str, decoded: &str, frames: u64) {
    let Some(python) = python() else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let files = [("dbc", dbc), ("log", log), ("jsonl", decoded)].map(|(kind, text)| {
        let file = folder.join(format!("cantools-{name}.{kind}"));
        fs::write(&file, text).expect("the folder for tests can be written");
        file
    });
    let output = Command::new(python).arg(SCRIPT).args(&files).output().expect("the interpreter starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {stderr}");
    assert_eq!(String::from_utf8_lossy(&output.stdout), format!("{frames} frames are alike\n"), "{stderr}");
}

#[test]
fn random_frames_of_every_edition_decode_as_cantools_decodes_them() {
    for edition in Edition::ALL {
        let catalog = catalog(edition);
        let log = random(&catalog, 100);
        let (decoded, summary, _) = decode(&log, &catalog, Format::JsonLines);
        assert_eq!((summary.frames, summary.unknown), (100 * catalog.messages().len() as u64, 0));
        compare(edition.version, &Dbc(edition).to_string(), &log, &decoded, summary.frames);
    }
}

#[test]
fn random_frames_of_a_database_of_ones_own_decode_as_cantools_decodes_them() {
    let dbc = include_str!("team.dbc");
    let database = Database::read("team.dbc", dbc.as_bytes()).expect("a database");
    let catalog = Catalog::with(&Edition::V2026, &[database]);
    let all = random(&catalog, 200);
    let is_of_team = |line: &&str| ["18FF50E5#", "7A0#", "7A1#", "7A2#"].iter().any(|id| line.contains(id));
    // A multiplexer of any other value is an error to cantools.
    let chosen = |(line, place): (&str, usize)| match line.split_once("7A0#") {
        Some((begin, data)) => format!("{begin}7A0#0{}{}\n", place % 2, data.get(2..).unwrap_or_default()),
        None => format!("{line}\n"),
    };
    let lines = all.lines().filter(is_of_team).enumerate();
    let log: String = lines.map(|(place, line)| chosen((line, place / 4))).collect();
    let (decoded, summary, _) = decode(&log, &catalog, Format::JsonLines);
    assert_eq!((summary.frames, summary.unknown), (800, 0));
    compare("team", dbc, &log, &decoded, summary.frames);
}
