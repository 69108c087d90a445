//! What was found by fuzzing the border to C: each input is run again.

mod c_border;

use std::path::Path;

use adsdv_tests::fuzzed::replay;

#[test]
fn every_input_of_the_corpus_and_every_regression_is_taken_or_an_error() {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz");
    let run = replay::files(&fuzz, "c_border", c_border::body);
    assert!(run > 0, "fuzz/corpus/c_border has seeds");
}

#[test]
fn small_random_inputs_are_taken_or_an_error() {
    replay::random(if cfg!(miri) { 20 } else { 5_000 }, c_border::body);
}

/// What is no function of the header's is followed by no parenthesis.
#[test]
fn each_function_of_the_header_is_called() {
    let body = include_str!("c_border/mod.rs");
    let header = include_str!("../include/adsdv.h");
    let code = header.lines().filter(|line| !line.trim_start().starts_with("//"));
    let functions = code.filter_map(|line| line.split_once('(')?.0.rsplit([' ', '*']).next());
    let functions: Vec<&str> = functions.filter(|name| name.starts_with("adsdv_")).collect();
    assert!(functions.len() > 20, "{functions:?}");
    for name in functions {
        assert!(body.contains(&format!("{name}(")), "{name} is not fuzzed");
    }
}
