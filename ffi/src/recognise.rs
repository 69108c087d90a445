//! Recognising the edition that a bus speaks, behind a handle.

use core::ffi::c_char;
use std::ffi::CString;

use adsdv_oracle::recognise::Recogniser;
use adsdv_spec::Edition;

use crate::border::{Plain, answer, check, out, slice};
use crate::edition::{self, adsdv_edition};
use crate::error::{Refusal, adsdv_error, adsdv_status};

/// Which edition the frames fit best, and why.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_recognised {
    /// The edition; where the frames do not tell, the one that the recogniser was made with.
    pub edition: adsdv_edition,
    /// 1 if it fits better than every other, 0 if another fits as well.
    pub certain: u8,
    /// The edition and what tells it, such as "version 4.0: 511h has 4 bytes (3.0: 8)"; behind "but", what does not fit it. The
    /// text is the recogniser's; it stays until the next call with it.
    pub text: *const c_char,
}

// SAFETY: `repr(C)`; integers and a pointer, which is never followed.
unsafe impl Plain for adsdv_recognised {}

/// What takes down of the frames of one bus which edition they are of. It is made by adsdv_recogniser_new and freed by
/// adsdv_recogniser_free.
#[derive(Debug)]
pub struct adsdv_recogniser {
    recogniser: Recogniser,
    /// Whether it is at work: true where some begins means that a panic left it half done.
    at_work: bool,
    /// The text that was handed out last.
    text: CString,
}

impl adsdv_recogniser {
    fn new(default: &'static Edition) -> Self {
        Self { recogniser: Recogniser::new(default), at_work: false, text: CString::default() }
    }

    /// Does what can go wrong in a way that nobody foresaw; after that, the recogniser is of no use.
    fn at_work<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> Result<T, Refusal<'static>> {
        if self.at_work {
            return Err(Refusal::Internal);
        }
        self.at_work = true;
        let done = work(self);
        self.at_work = false;
        Ok(done)
    }

    /// What the frames so far tell, for C.
    fn recognise(&mut self) -> Result<adsdv_recognised, Refusal<'static>> {
        let recognised = self.at_work(|this| this.recogniser.recognise())?;
        let number = Edition::ALL.iter().position(|edition| edition.version == recognised.edition.version);
        let edition =
            number.and_then(|number| adsdv_edition::try_from(number).ok()).ok_or(Refusal::Internal)?;
        // No version and no name has a NUL in it.
        self.text = CString::new(recognised.to_string()).map_err(|_| Refusal::Internal)?;
        Ok(adsdv_recognised { edition, certain: recognised.certain.into(), text: self.text.as_ptr() })
    }
}

/// The recogniser behind a handle. The caller promises that it is NULL or a handle of adsdv_recogniser_new that is not freed
/// yet, and that no other thread uses it meanwhile.
unsafe fn handle<'a>(
    recogniser: *mut adsdv_recogniser,
) -> Result<&'a mut adsdv_recogniser, Refusal<'static>> {
    check(recogniser, "recogniser")?;
    // SAFETY: it is not NULL, it is aligned, and the caller promises the rest.
    Ok(unsafe { &mut *recogniser })
}

/// A new recogniser of a bus, which adsdv_recogniser_free must free; NULL if there is an error. Where the frames do not tell,
/// the edition is `otherwise`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_recogniser_new(
    otherwise: adsdv_edition,
    error: *mut adsdv_error,
) -> *mut adsdv_recogniser {
    let mut made = core::ptr::null_mut();
    let work = || {
        let default = edition::given(otherwise, "")?;
        made = Box::into_raw(Box::new(adsdv_recogniser::new(default)));
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) };
    made
}

/// Frees a recogniser, whose text is gone then. NULL is left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_recogniser_free(recogniser: *mut adsdv_recogniser) {
    let work = || {
        check(recogniser, "recogniser")?;
        // SAFETY: it is not NULL, so the caller promises that `adsdv_recogniser_new` made it, with a `Box`, and that it was
        // not freed before.
        drop(unsafe { Box::from_raw(recogniser) });
        Ok(())
    };
    // SAFETY: there is no error to write.
    unsafe { answer(core::ptr::null_mut(), work) };
}

/// Takes down a classic CAN data frame with an 11-bit identifier, as adsdv_judge_frame takes it. Identifiers that are not the
/// interface's and any `length` are fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_recogniser_frame(
    recogniser: *mut adsdv_recogniser,
    t_ns: i64,
    id: u32,
    data: *const u8,
    length: usize,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the recogniser and for `length` bytes.
        let (recogniser, data) = unsafe { (handle(recogniser)?, slice(data, length, "data")?) };
        recogniser.at_work(|this| {
            this.recogniser.frame(t_ns, id, data);
        })
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// The edition that fits best what has been taken down so far. A few seconds of a bus tell; more frames may be taken down behind
/// it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_recogniser_recognise(
    recogniser: *mut adsdv_recogniser,
    found: *mut adsdv_recognised,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the recogniser and for what is recognised.
        let (recogniser, place) = unsafe { (handle(recogniser)?, out(found, "found")?) };
        place.set(recogniser.recognise()?);
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn a_recogniser_that_panicked_is_not_used_again() {
        let mut recogniser = adsdv_recogniser::new(Edition::DEFAULT);
        assert!(recogniser.recognise().is_ok());
        assert!(catch_unwind(AssertUnwindSafe(|| recogniser.at_work(|_| panic!("once")))).is_err());
        assert!(matches!(recogniser.recognise(), Err(Refusal::Internal)));
    }
}
