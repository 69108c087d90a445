//! The header says what the library has: it is made from the sources, and committed.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-ffi --test header` writes it anew.

use std::path::{Path, PathBuf};

use expect_test::expect_file;

/// The sources in the order in which a reader wants to meet what is in them.
const SOURCES: [&str; 13] = [
    "version",
    "error",
    "edition",
    "constants",
    "names",
    "machine",
    "control",
    "inputs",
    "outputs",
    "frame",
    "step",
    "steps",
    "signal",
];
/// And the recogniser and the judge, which are a feature.
const JUDGE: [&str; 3] = ["recognise", "judge", "rules"];

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn source(name: &str) -> PathBuf {
    folder().join("src").join(name).with_extension("rs")
}

fn header() -> String {
    let config =
        cbindgen::Config::from_file(folder().join("cbindgen.toml")).expect("the settings can be read");
    let builder = cbindgen::Builder::new().with_config(config);
    let builder = SOURCES.iter().chain(&JUDGE).fold(builder, |builder, name| builder.with_src(source(name)));
    let bindings = builder.generate().expect("the sources can be read");
    let mut bytes = Vec::new();
    bindings.write(&mut bytes);
    String::from_utf8(bytes).expect("the header is UTF-8")
}

#[test]
fn the_header_is_that_of_the_sources() {
    expect_file!["../include/adsdv.h"].assert_eq(&header());
}

#[test]
fn the_header_has_every_function_of_every_source() {
    let header = header();
    let mut functions = 0;
    for entry in std::fs::read_dir(folder().join("src")).expect("the sources are there") {
        let text = std::fs::read_to_string(entry.expect("an entry").path()).expect("a source can be read");
        for line in text.lines().filter(|line| line.starts_with("pub ") && line.contains("extern \"C\" fn "))
        {
            let name = line.split(" fn ").nth(1).and_then(|rest| rest.split('(').next()).expect("a name");
            assert!(name.starts_with("adsdv_"), "{name}");
            assert!(header.contains(&format!("{name}(")), "{name} is not in the header");
            functions += 1;
        }
    }
    assert!(functions > 15, "{functions}");
}
