//! The border to C: the only place where pointers are followed.
//!
//! What is asked of a caller, and cannot be checked, is what C always asks: a pointer that is not NULL points to as
//! much as its type says, which nobody else writes meanwhile, and a text ends with a NUL. Everything else is checked:
//! structs that come from C hold integers of which every pattern of bits is a value, and what such a value cannot be
//! is an error.

use core::ffi::{CStr, c_char};
use core::ptr::NonNull;

use crate::error::{Refusal, adsdv_error, adsdv_status};

/// A struct that C may hand over: every pattern of its bits is one of its values.
///
/// # Safety
///
/// Only for structs that are `repr(C)` and hold nothing but integers, or such structs.
pub(crate) unsafe trait Plain: Copy {}

// SAFETY: integers.
unsafe impl Plain for u8 {}
// SAFETY: an integer.
unsafe impl Plain for i32 {}
// SAFETY: an integer.
unsafe impl Plain for u32 {}
// SAFETY: an integer.
unsafe impl Plain for usize {}
// SAFETY: `repr(C)`; an integer and an array of `char`.
unsafe impl Plain for adsdv_error {}

/// A struct of numbers and nothing else: first `BYTES` of a byte, then `WORDS` of two bytes.
///
/// # Safety
///
/// Only for structs that are `repr(C)` and hold just that: without anything between or behind them.
pub(crate) unsafe trait Packed<const BYTES: usize, const WORDS: usize>: Plain {
    /// Its numbers as they lie in memory; those with a sign as two's complement.
    #[inline(always)]
    fn numbers(&self) -> &Numbers<BYTES, WORDS> {
        const {
            assert!(
                size_of::<Self>() == BYTES + 2 * WORDS
                    && size_of::<Numbers<BYTES, WORDS>>() == size_of::<Self>()
            );
            assert!(align_of::<Self>() == align_of::<Numbers<BYTES, WORDS>>());
        }
        // SAFETY: they have the same size and alignment, and the struct is nothing but these numbers, all of whose bits are
        // values.
        unsafe { &*core::ptr::from_ref(self).cast() }
    }
}

/// The numbers of a [`Packed`] struct.
#[repr(C)]
#[derive(Clone, Copy)]
pub(crate) struct Numbers<const BYTES: usize, const WORDS: usize> {
    pub(crate) bytes: [u8; BYTES],
    pub(crate) words: [u16; WORDS],
}

/// Does the work of a function: no panic leaves it, and an error is written where the caller wants it.
#[inline(always)]
pub(crate) unsafe fn answer<'a>(
    error: *mut adsdv_error,
    work: impl FnOnce() -> Result<(), Refusal<'a>>,
) -> adsdv_status {
    match caught(work) {
        Ok(()) => adsdv_status::ADSDV_OK,
        // SAFETY: the caller of the function promises that `error` is NULL or its own.
        Err(trouble) => unsafe { report(error, &trouble) },
    }
}

#[cfg(feature = "std")]
#[inline(always)]
fn caught<'a>(work: impl FnOnce() -> Result<(), Refusal<'a>>) -> Result<(), Refusal<'a>> {
    // What a panic leaves half done is either the caller's own, which is written last, or a judge, which is given up.
    std::panic::catch_unwind(std::panic::AssertUnwindSafe(work)).unwrap_or(Err(Refusal::Internal))
}

#[cfg(not(feature = "std"))]
#[inline(always)]
fn caught<'a>(work: impl FnOnce() -> Result<(), Refusal<'a>>) -> Result<(), Refusal<'a>> {
    work()
}

#[cold]
unsafe fn report(error: *mut adsdv_error, trouble: &Refusal<'_>) -> adsdv_status {
    // SAFETY: the caller promises that `error` is NULL or its own; one that is not aligned is left alone.
    if let Ok(error) = unsafe { out(error, "error") } {
        error.set(adsdv_error::of(trouble));
    }
    trouble.status()
}

/// What a pointer points to. The caller promises that it is NULL or points to a `T`.
#[inline(always)]
pub(crate) unsafe fn load<T: Plain>(pointer: *const T, name: &'static str) -> Result<T, Refusal<'static>> {
    check(pointer, name)?;
    // SAFETY: it is not NULL, it is aligned, every pattern of bits is a `T`, and the caller promises the rest.
    Ok(unsafe { pointer.read() })
}

/// What a pointer points to, where it is. The caller promises that it is NULL or points to a `T` that nobody writes for as
/// long as it is used.
#[inline(always)]
pub(crate) unsafe fn get<'a, T: Plain>(
    pointer: *const T,
    name: &'static str,
) -> Result<&'a T, Refusal<'static>> {
    check(pointer, name)?;
    // SAFETY: it is not NULL, it is aligned, every pattern of bits is a `T`, and the caller promises the rest.
    Ok(unsafe { &*pointer })
}

/// A place that a function fills.
pub(crate) struct Out<T>(NonNull<T>);

/// The place behind a pointer. The caller promises that it is NULL or points to a `T` that is its own for as long as the
/// place is used.
#[inline(always)]
pub(crate) unsafe fn out<T: Plain>(pointer: *mut T, name: &'static str) -> Result<Out<T>, Refusal<'static>> {
    check(pointer, name)?;
    NonNull::new(pointer).map(Out).ok_or(Refusal::Null(name))
}

impl<T: Plain> Out<T> {
    #[inline(always)]
    pub(crate) fn set(self, value: T) {
        // SAFETY: `out` is the only way to a place: the pointer is not NULL, it is aligned, and its caller promised the
        // rest.
        unsafe { self.0.write(value) }
    }
}

/// An array of the caller's that a function reads and fills, place by place.
pub(crate) struct Array<T> {
    first: *mut T,
    count: usize,
}

/// The array behind a pointer; one without a place for a count of 0, whatever the pointer is. The caller promises that a
/// pointer that is not NULL points to `count` places that are its own for as long as the array is used.
#[inline(always)]
pub(crate) unsafe fn array<T: Plain>(
    pointer: *mut T,
    count: usize,
    name: &'static str,
) -> Result<Array<T>, Refusal<'static>> {
    if count > 0 {
        check(pointer, name)?;
        at_most::<T>(count, name)?;
    }
    Ok(Array { first: pointer, count })
}

/// The same where there may be none: NULL.
#[inline(always)]
pub(crate) unsafe fn some_array<T: Plain>(
    pointer: *mut T,
    count: usize,
    name: &'static str,
) -> Result<Option<Array<T>>, Refusal<'static>> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller promises the same.
    unsafe { array(pointer, count, name) }.map(Some)
}

impl<T: Plain> Array<T> {
    /// What is at a place, which the caller of the function has filled; `None` behind the last.
    #[inline(always)]
    pub(crate) fn get(&self, place: usize) -> Option<T> {
        // SAFETY: `array` is the only way to one: the pointer is not NULL, it is aligned, the place is less than `count`, every
        // pattern of bits is a `T`, and its caller promised the rest.
        (place < self.count).then(|| unsafe { self.first.add(place).read() })
    }

    /// A place to fill; `None` behind the last.
    #[inline(always)]
    pub(crate) fn at(&self, place: usize) -> Option<Out<T>> {
        // SAFETY: `array` is the only way to one: the pointer is not NULL, it is aligned, the place is less than `count`, and its
        // caller promised the rest.
        if place < self.count { NonNull::new(unsafe { self.first.add(place) }).map(Out) } else { None }
    }

    /// Fills a place; none behind the last.
    #[inline(always)]
    pub(crate) fn set(&self, place: usize, value: T) {
        if let Some(place) = self.at(place) {
            place.set(value);
        }
    }
}

/// `count` things of an array; none for a count of 0, whatever the pointer is. The caller promises that a pointer that
/// is not NULL points to that many which nobody writes for as long as they are used.
#[inline(always)]
pub(crate) unsafe fn slice<'a, T: Plain>(
    pointer: *const T,
    count: usize,
    name: &'static str,
) -> Result<&'a [T], Refusal<'static>> {
    if count == 0 {
        return Ok(&[]);
    }
    check(pointer, name)?;
    at_most::<T>(count, name)?;
    // SAFETY: it is not NULL, it is aligned, every pattern of bits is a `T`, and the caller promises the rest.
    Ok(unsafe { core::slice::from_raw_parts(pointer, count) })
}

/// No object is larger; a count beyond it would be undefined behaviour rather than wrong.
#[inline(always)]
fn at_most<T>(count: usize, name: &'static str) -> Result<(), Refusal<'static>> {
    let most = isize::MAX.cast_unsigned() / size_of::<T>().max(1);
    if count > most { Err(Refusal::TooMany { what: name, given: count, most }) } else { Ok(()) }
}

/// Fills the first places of an array that has room for them. The caller promises that a pointer that is not NULL points
/// to `room` places of its own.
#[inline(always)]
pub(crate) unsafe fn fill<T: Plain>(
    pointer: *mut T,
    room: usize,
    name: &'static str,
    values: impl ExactSizeIterator<Item = T>,
) -> Result<(), Refusal<'static>> {
    check(pointer, name)?;
    if values.len() > room {
        return Err(Refusal::NoRoom { what: name, given: room, needed: values.len() });
    }
    for (place, value) in values.take(room).enumerate() {
        // SAFETY: it is not NULL, it is aligned, `place` is less than `room`, and the caller promises the rest.
        unsafe { pointer.add(place).write(value) }
    }
    Ok(())
}

/// The text behind a pointer. The caller promises that it is NULL or points to a text with a NUL at its end, which
/// nobody writes for as long as it is used.
pub(crate) unsafe fn text<'a>(
    pointer: *const c_char,
    name: &'static str,
) -> Result<&'a str, Refusal<'static>> {
    check(pointer, name)?;
    // SAFETY: it is not NULL, and the caller promises the rest.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Refusal::NotText(name))
}

#[inline(always)]
pub(crate) fn check<T>(pointer: *const T, name: &'static str) -> Result<(), Refusal<'static>> {
    if pointer.is_null() {
        Err(Refusal::Null(name))
    } else if pointer.is_aligned() {
        Ok(())
    } else {
        Err(Refusal::Misaligned(name))
    }
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    #[test]
    fn a_panic_does_not_cross() {
        let mut error = adsdv_error::default();
        // SAFETY: the pointer is to an error.
        let status = unsafe { answer(&raw mut error, || panic!("this is not seen in C")) };
        assert_eq!(status, adsdv_status::ADSDV_INTERNAL);
        assert_eq!(error.status, adsdv_status::ADSDV_INTERNAL as i32);
    }
}
