//! A property is tried, and what breaks it is told.

use std::env;
use std::fmt::Debug;

use proptest::strategy::Strategy;
use proptest::test_runner::{Config, FileFailurePersistence, TestCaseError, TestError, TestRunner};

/// The file that keeps what has failed in a group of properties.
macro_rules! regressions {
    ($group:literal) => {
        concat!(env!("CARGO_MANIFEST_DIR"), "/tests/properties/regressions/", $group, ".txt")
    };
}
pub(crate) use regressions;

/// So many shorter values are tried once one breaks the property.
pub(crate) const SHRINKING: u32 = 10_000;

/// Tries a property on so many random values, or more if `PROPTEST_CASES` wants more.
///
/// `broken` says what is wrong with a value. If something is, `tell` tells the shortest such value that was found.
///
/// # Panics
///
/// If the property does not hold.
pub(crate) fn holds<S: Strategy>(
    cases: u32,
    regressions: &'static str,
    values: &S,
    broken: impl Fn(&S::Value) -> Result<(), String>,
    tell: impl Fn(&S::Value) -> String,
) where
    S::Value: Debug,
{
    let wanted = env::var("PROPTEST_CASES").ok().and_then(|wanted| wanted.parse().ok());
    let cases = wanted.unwrap_or(cases).max(cases);
    let config = Config {
        cases,
        max_shrink_iters: SHRINKING,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(regressions))),
        ..Config::default()
    };
    let tried = TestRunner::new(config).run(values, |value| broken(&value).map_err(TestCaseError::fail));
    match tried {
        Ok(()) => {}
        Err(TestError::Fail(wrong, value)) => panic!("{wrong}\n{}", tell(&value)),
        Err(TestError::Abort(why)) => panic!("not tried: {why}"),
    }
}
