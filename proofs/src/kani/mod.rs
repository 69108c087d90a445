//! A stand-in for Kani where there is none: the same harness bodies, run on concrete values.
//!
//! Kani's functions of the same names stand here with the same meaning, as far as single runs can have it: [`any`] draws
//! a value, [`assume`] ends a run that does not count, and [`cover!`](cover) notes that something was reached. [`check`]
//! runs a harness many times, or for every value of a small domain, and says what came out. [`replay`] runs it once on
//! bytes that somebody else has chosen, such as a fuzzer.
//!
//! One thing is coarser here: Kani counts a `cover!` in a generic function once for each type that the function is used
//! with, and here it is one place.
//!
//! - `source.rs`: where values come from;
//! - `values.rs`: how each type is drawn, the values at its boundaries more often than others;
//! - `run.rs`: the runs, and what is learnt from them.

mod run;
mod source;
mod values;

pub use run::{Complaint, Cover, Failure, Outcome, Runs, check, replay};
pub use source::Source;
pub use values::Arbitrary;

/// Any value of a type.
pub fn any<T: Arbitrary>() -> T {
    run::draw(T::any)
}

/// Any value of a type for which a condition holds.
pub fn any_where<T: Arbitrary>(holds: impl Fn(&T) -> bool) -> T {
    /// So often a value is drawn anew, instead of giving up the whole run at once.
    const TRIES: u32 = 32;
    if !run::enumerates() {
        for _ in 1..TRIES {
            let value = any();
            if holds(&value) {
                return value;
            }
        }
    }
    let value = any();
    assume(holds(&value));
    value
}

/// Nothing is claimed of a run in which the condition does not hold: it ends here, and does not count.
pub fn assume(condition: bool) {
    if !condition {
        run::reject();
    }
}

/// Notes that a harness was here, and whether the condition held; see [`cover!`](cover).
#[doc(hidden)]
pub fn covered(file: &'static str, line: u32, what: &'static str, condition: bool) {
    run::cover(Cover { file, line, what }, condition);
}

/// The interesting case of a harness: some run has to get here, and the condition has to hold there.
#[macro_export]
#[doc(hidden)]
macro_rules! __cover {
    () => {
        $crate::__cover!(true, "this place")
    };
    ($condition:expr $(,)?) => {
        $crate::__cover!($condition, stringify!($condition))
    };
    ($condition:expr, $what:literal $(,)?) => {
        $crate::kani::covered(file!(), line!(), $what, $condition)
    };
    ($condition:expr, $what:expr $(,)?) => {
        $crate::kani::covered(file!(), line!(), $what, $condition)
    };
}
pub use crate::__cover as cover;
