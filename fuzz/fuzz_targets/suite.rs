//! The fuzzer of `adsdv_tests::fuzzed::suite`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| adsdv_tests::fuzzed::suite::body(bytes));
