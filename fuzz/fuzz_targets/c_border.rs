//! The fuzzer of `ffi/tests/c_border`.

#![no_main]

#[path = "../../ffi/tests/c_border/mod.rs"]
mod c_border;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| c_border::body(bytes));
