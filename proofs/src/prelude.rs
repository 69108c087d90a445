//! What every file of theorems uses.

pub(crate) use crate::coded::Coded;
pub(crate) use crate::document::{EDITION, Layouts};
#[cfg(not(kani))]
pub(crate) use crate::kani;
pub(crate) use crate::steps::{
    Step, any_control, any_control_in, any_end, any_outputs, any_step, any_step_from, any_step_of_4_0,
    any_step_of_4_0_from, any_step_of_2026, any_step_that_may_stay,
};
#[cfg(kani)]
pub(crate) use crate::subject::Subject;
pub(crate) use crate::subject::subject;

/// Lists the theorems of a file: those that are run on random values and, after `every`, those that are run for every
/// value.
macro_rules! theorems {
    ($($random:ident),* $(,)? $(; every $($every:ident),+ $(,)?)?) => {
        /// The theorems of this file.
        #[cfg(not(kani))]
        pub const THEOREMS: &[$crate::theorems::Theorem] = &[
            $($crate::theorems::Theorem {
                module: module_path!(),
                name: stringify!($random),
                harness: $random,
                runs: $crate::kani::Runs::Random($crate::theorems::RANDOM_RUNS),
            },)*
            $($($crate::theorems::Theorem {
                module: module_path!(),
                name: stringify!($every),
                harness: $every,
                runs: $crate::kani::Runs::Every,
            },)+)?
        ];
    };
}
pub(crate) use theorems;

/// Harnesses of one claim, one for each of several states or messages: so a proof knows each as a constant, and none takes long.
///
/// Each line is `name = claim;`.
macro_rules! harnesses {
    ($(#[$doc:meta])* unwind $unwind:literal; $($name:ident = $claim:expr;)+) => {
        harnesses! { @ [$(#[$doc])*] $unwind $($name = $claim;)+ }
    };
    (@ $docs:tt $unwind:literal $($name:ident = $claim:expr;)+) => {
        $(harnesses! { @one $docs $unwind $name $claim })+
    };
    (@one [$(#[$doc:meta])*] $unwind:literal $name:ident $claim:expr) => {
        $(#[$doc])*
        #[cfg_attr(kani, kani::proof, kani::unwind($unwind))]
        pub fn $name() {
            $claim;
        }
    };
}
pub(crate) use harnesses;
