//! What is decoded opens in the tools that it is for: Parquet and CSV in DuckDB, pandas and polars, VCD in pyvcd.
//!
//! The interpreter that has them is `ADSDV_PYTHON`; without it this test says that it is left out, unless `ADSDV_REQUIRE_PYTHON_CAN` is 1.

use std::fs;
use std::path::Path;
use std::process::Command;

use adsdv_spec::Edition;

use crate::frames::{Format, catalog, decode};
use crate::parquet::{messages, mission, table};
use crate::python::python;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/decode/read_tables.py");
const DOCUMENT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/formats.md");

#[test]
fn tables_and_waves_open_in_the_tools_that_they_are_for() {
    let Some(python) = python() else { return };
    let (log, catalog) = (mission(), catalog(&Edition::V4_0));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tables");
    let write =
        |name: &str, file: &[u8]| fs::write(folder.join(name), file).expect("the folder can be written");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("run")).expect("the folder for tests can be written");
    for (name, format) in [("csv", Format::Csv), ("jsonl", Format::JsonLines), ("vcd", Format::Vcd)] {
        write(&format!("run.{name}"), decode(&log, &catalog, format).0.as_bytes());
    }
    write("run.parquet", &table(&log, &catalog, adsdv_decode::Table::Signals));
    write("frames.parquet", &table(&log, &catalog, adsdv_decode::Table::Frames));
    for (name, file) in messages(&log, &catalog) {
        write(&format!("run/{name}"), &file);
    }
    let output = Command::new(python)
        .arg(SCRIPT)
        .args([folder.as_path(), Path::new(DOCUMENT)])
        .output()
        .expect("the interpreter starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    let rows = decode(&log, &catalog, Format::Csv).0.lines().count() - 1;
    assert_eq!(String::from_utf8_lossy(&output.stdout), format!("{rows} rows are alike\n"), "{stderr}");
}
