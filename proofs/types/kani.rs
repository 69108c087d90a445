//! The signatures of Kani, as far as this project uses them, so that `cfg(kani)` code can be type-checked where there is
//! no Kani. Nothing here does anything: see `scripts/check-kani-types.sh`.

pub use kani_macros::{Arbitrary, proof, solver, unwind};

pub trait Arbitrary: Sized {
    fn any() -> Self;
}

macro_rules! integers {
    ($($type:ty),+) => {$(
        impl Arbitrary for $type {
            fn any() -> Self {
                panic!("only a signature")
            }
        }
    )+};
}

integers!(bool, char, u8, u16, u32, u64, u128, usize, i8, i16, i32, i64, i128, isize, ());

impl<T: Arbitrary, const N: usize> Arbitrary for [T; N] {
    fn any() -> Self {
        panic!("only a signature")
    }
}

impl<T: Arbitrary> Arbitrary for Option<T> {
    fn any() -> Self {
        panic!("only a signature")
    }
}

pub fn any<T: Arbitrary>() -> T {
    T::any()
}

pub fn any_where<T: Arbitrary, F: FnOnce(&T) -> bool>(holds: F) -> T {
    let value = T::any();
    assume(holds(&value));
    value
}

pub fn assume(_condition: bool) {}

#[macro_export]
macro_rules! cover {
    () => {};
    ($condition:expr $(,)?) => {
        let _: bool = $condition;
    };
    ($condition:expr, $message:literal) => {
        let _: bool = $condition;
    };
}
