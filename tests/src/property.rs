//! A property is tried on random values, and what breaks it is reported: the shortest value that was found, and the seed.

use std::env;
use std::fmt::Debug;
use std::thread;

use adsdv_proofs::seed::{again, seed};
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, FileFailurePersistence, RngSeed, TestCaseError, TestError, TestRunner};

/// So many shorter values are tried once one breaks the property.
pub const SHRINKING: u32 = 10_000;

/// Where a property is written: what finds it again.
#[derive(Clone, Copy, Debug)]
pub struct Home {
    /// The package, such as `adsdv-tests`.
    pub package: &'static str,
    /// The program of tests in it, such as `properties`.
    pub test: &'static str,
    /// The file that keeps what has failed once. It is tried first from then on.
    pub regressions: &'static str,
}

impl Home {
    /// Tries a property on so many random values, or more if `PROPTEST_CASES` wants more.
    ///
    /// `broken` says what is wrong with a value. If something is, `tell` prints the shortest such value that was found.
    ///
    /// # Panics
    ///
    /// If the property does not hold.
    pub fn holds<S: Strategy>(
        self,
        cases: u32,
        values: &S,
        broken: impl Fn(&S::Value) -> Result<(), String>,
        tell: impl Fn(&S::Value) -> String,
    ) where
        S::Value: Debug,
    {
        let wanted = env::var("PROPTEST_CASES").ok().and_then(|wanted| wanted.parse().ok());
        let cases = wanted.unwrap_or(cases).max(cases);
        let seed = seed();
        let config = Config {
            cases,
            rng_seed: RngSeed::Fixed(seed),
            max_shrink_iters: SHRINKING,
            failure_persistence: Some(Box::new(FileFailurePersistence::Direct(self.regressions))),
            ..Config::default()
        };
        let tried = TestRunner::new(config).run(values, |value| broken(&value).map_err(TestCaseError::fail));
        match tried {
            Ok(()) => {}
            Err(TestError::Fail(wrong, value)) => {
                let again =
                    again(seed, self.package, self.test, thread::current().name().unwrap_or_default());
                panic!("{wrong}\n{}\nAgain, with the seed {seed}: {again}", tell(&value))
            }
            Err(TestError::Abort(why)) => panic!("not tried with the seed {seed}: {why}"),
        }
    }
}
