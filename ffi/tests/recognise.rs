//! The recogniser through the C interface tells what the recogniser tells, and is safe to use wrongly.
#![cfg(feature = "judge")]

mod common;

use std::ffi::CStr;
use std::ptr::{null, null_mut};

use adsdv::adsdv_status::*;
use adsdv::*;
use adsdv_oracle::recognise::Recogniser;
use adsdv_spec::Edition;
use adsdv_tests::world::World;
use common::{no_error, number, outcome, text};

/// A recogniser that is freed.
struct Handle(*mut adsdv_recogniser);

impl Handle {
    fn new(otherwise: &Edition) -> Self {
        let mut error = no_error();
        // SAFETY: the pointer is to what it is said to be.
        let recogniser = unsafe { adsdv_recogniser_new(number(otherwise), &raw mut error) };
        assert!(!recogniser.is_null() && error.status == 0);
        Self(recogniser)
    }

    fn frame(&self, t_ns: i64, id: u32, data: &[u8]) {
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe {
            adsdv_recogniser_frame(self.0, t_ns, id, data.as_ptr(), data.len(), error)
        })
        .unwrap();
    }

    /// The version, whether it is certain, and the text.
    fn recognise(&self) -> (&'static str, bool, String) {
        let mut recognised = adsdv_recognised { edition: adsdv_edition::MAX, certain: 9, text: null() };
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_recogniser_recognise(self.0, &raw mut recognised, error) }).unwrap();
        // SAFETY: the text ends with a NUL, and stays until the next call.
        let text = unsafe { CStr::from_ptr(recognised.text) }.to_str().unwrap().to_owned();
        let version = Edition::ALL[usize::try_from(recognised.edition).unwrap()].version;
        assert!(recognised.certain < 2);
        (version, recognised.certain == 1, text)
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: it is a recogniser that was not freed yet.
        unsafe { adsdv_recogniser_free(self.0) };
    }
}

#[test]
fn it_recognises_the_edition_of_every_bus() {
    for &otherwise in Edition::ALL {
        for edition in Edition::ALL {
            let mut world = World::of(edition);
            world.driving();
            let (in_c, mut in_rust) = (Handle::new(otherwise), Recogniser::new(otherwise));
            for recorded in &world.log {
                let (id, data) = (recorded.frame.id.into(), recorded.frame.data());
                in_c.frame(recorded.t, id, data);
                in_rust.frame(recorded.t, id, data);
            }
            let expected = in_rust.recognise();
            let found = in_c.recognise();
            // Of editions with the same bus it is the one that was given, or else the newest.
            assert_eq!(expected.edition.bus, edition.bus, "{expected}");
            assert_eq!(found, (expected.edition.version, expected.certain, expected.to_string()));
            assert_eq!(in_c.recognise(), found, "a second call says the same");
        }
    }
}

#[test]
fn a_bus_that_does_not_tell_is_of_the_edition_that_was_given() {
    for &otherwise in Edition::ALL {
        let recogniser = Handle::new(otherwise);
        let (version, certain, text) = recogniser.recognise();
        assert_eq!((version, certain), (otherwise.version, false));
        assert_eq!(text, format!("version {version}, as the frames do not tell which"));
        recogniser.frame(0, 0x511, &[0; 4]);
        recogniser.frame(0, u32::MAX, &[0; 64]);
        assert_ne!(recogniser.recognise().0, "3.0", "more frames may come behind an answer");
    }
}

#[test]
fn what_is_not_there_is_refused() {
    let none = adsdv_edition_count();
    let mut error = no_error();
    // SAFETY: the pointers are to what they are said to be, or NULL.
    unsafe {
        assert!(adsdv_recogniser_new(none, &raw mut error).is_null());
        assert!(adsdv_recogniser_new(none, null_mut()).is_null());
        adsdv_recogniser_free(null_mut());
    }
    let said = format!("edition is {none}; expected less than {none}");
    assert_eq!((error.status, text(&error.text)), (ADSDV_UNKNOWN_EDITION as i32, said));
    let recogniser = Handle::new(Edition::DEFAULT);
    let mut found = adsdv_recognised { edition: 0, certain: 0, text: null() };
    // SAFETY: the pointers are to what they are said to be, or NULL.
    let refused = unsafe {
        [
            outcome(|error| adsdv_recogniser_frame(null_mut(), 0, 0, null(), 0, error)),
            outcome(|error| adsdv_recogniser_frame(recogniser.0, 0, 0, null(), 1, error)),
            outcome(|error| adsdv_recogniser_recognise(null_mut(), &raw mut found, error)),
            outcome(|error| adsdv_recogniser_recognise(recogniser.0, null_mut(), error)),
        ]
    };
    for refused in refused {
        assert_eq!(refused.map_err(|(status, _)| status), Err(ADSDV_BAD_POINTER));
    }
    // No data is data of no bytes.
    // SAFETY: no byte is read.
    let empty = outcome(|error| unsafe { adsdv_recogniser_frame(recogniser.0, 0, 0x510, null(), 0, error) });
    assert_eq!(empty, Ok(()));
}
