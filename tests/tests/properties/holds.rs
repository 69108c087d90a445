//! A property of this folder is tried, and what breaks it is reported.

use std::fmt::Debug;

use adsdv_tests::property::Home;
use proptest::strategy::Strategy;

/// The file that keeps what has failed in a group of properties.
macro_rules! regressions {
    ($group:literal) => {
        concat!(env!("CARGO_MANIFEST_DIR"), "/tests/properties/regressions/", $group, ".txt")
    };
}
pub(crate) use regressions;

/// [`Home::holds`], for the properties of this folder.
pub(crate) fn holds<S: Strategy>(
    cases: u32,
    regressions: &'static str,
    values: &S,
    broken: impl Fn(&S::Value) -> Result<(), String>,
    tell: impl Fn(&S::Value) -> String,
) where
    S::Value: Debug,
{
    let home = Home { package: env!("CARGO_PKG_NAME"), test: env!("CARGO_CRATE_NAME"), regressions };
    home.holds(cases, values, broken, tell);
}
