//! The seed that everything is drawn from that is drawn at random: theorems without Kani, and the property tests of other
//! crates.
//!
//! It is the same every time, so that `cargo test` gives the same result every time. `scripts/fresh-seeds.sh` sets others.

use std::env;

/// The variable of the environment that sets another seed.
pub const VARIABLE: &str = "ADSDV_SEED";

/// The seed unless another is set.
pub const USUAL: u64 = 0;

/// The seed of this run.
///
/// # Panics
///
/// If [`VARIABLE`] is set to anything but a whole number of 64 bits.
pub fn seed() -> u64 {
    let Some(given) = env::var_os(VARIABLE) else { return USUAL };
    let number = given.to_str().and_then(|given| given.parse().ok());
    number
        .unwrap_or_else(|| panic!("{VARIABLE} is {given:?}; expected a whole number from 0 to {}", u64::MAX))
}

/// How the test of this package that has failed with a seed is run again: the command.
pub fn again(seed: u64, package: &str, test: &str, name: &str) -> String {
    format!("{VARIABLE}={seed} cargo test -p {package} --test {test} {name}")
}
