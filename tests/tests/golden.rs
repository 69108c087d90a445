//! The exports against the files in `golden/`, byte for byte: a change of a table shows as a change of a file that
//! other tools read. The files are also there to be used as they are.

use std::{env, fs, path::Path};

use adsdv_spec::export::{Dbc, Dot, Figure2, Mermaid};
use adsdv_spec::{Interface, Machine};

/// Set to 1, it makes these tests write the files instead of comparing them.
const BLESS: &str = "ADSDV_BLESS";

fn compare(file: &str, export: &impl std::fmt::Display) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(file);
    let export = export.to_string();
    if env::var_os(BLESS).is_some_and(|value| value == "1") {
        fs::write(&path, &export).unwrap_or_else(|error| panic!("cannot write golden/{file}: {error}"));
        return;
    }
    let renew = format!("to renew it: {BLESS}=1 cargo test -p adsdv-tests --test golden");
    let golden = fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("cannot read golden/{file}: {error}; {renew}"));
    if golden == export {
        return;
    }
    let lines = golden.lines().map(Some).chain(std::iter::repeat(None));
    let first =
        export.lines().map(Some).chain([None]).zip(lines).zip(1..).find(|((ours, file), _)| ours != file);
    panic!("the export is not golden/{file}; first difference (export, file), line: {first:#?}\n{renew}");
}

#[test]
fn dbc() {
    compare("adsdv.dbc", &Dbc(&Interface::V3_0));
}

#[test]
fn mermaid() {
    compare("figure2.mmd", &Mermaid(&Machine::REFERENCE));
}

#[test]
fn dot() {
    compare("figure2.dot", &Dot(&Machine::REFERENCE));
}

#[test]
fn markdown() {
    compare("figure2.md", &Figure2(&Machine::REFERENCE));
}
