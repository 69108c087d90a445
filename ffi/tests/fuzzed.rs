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
