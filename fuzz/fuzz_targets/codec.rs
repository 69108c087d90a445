//! The fuzzer of `adsdv_tests::fuzzed::codec`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| adsdv_tests::fuzzed::codec::body(bytes));
