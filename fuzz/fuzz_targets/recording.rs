//! The fuzzer of `adsdv_tests::fuzzed::recording`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| adsdv_tests::fuzzed::recording::body(bytes));
