//! The fuzzer of `adsdv_tests::fuzzed::database`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| adsdv_tests::fuzzed::database::body(bytes));
