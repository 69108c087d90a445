//! The fuzzer of `adsdv_tests::fuzzed::judge_any`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| adsdv_tests::fuzzed::judge_any::body(bytes));
