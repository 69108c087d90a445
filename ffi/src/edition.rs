//! The editions of the interface: their numbers and versions, and the signal that a field has in each.

use core::ffi::c_char;

use adsdv_spec::Edition;
use adsdv_spec::messages::SignalDef;

use crate::border::{answer, out, text};
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::text;

/// An edition of the interface by its number, which counts from 0, the oldest first. adsdv_edition_find has it. A number is
/// this library's; what is to be kept for another is the version.
pub type adsdv_edition = u32;

/// How many there are.
pub(crate) const COUNT: usize = Edition::ALL.len();

/// The edition of functions that are given none: this library names it here and nowhere else.
pub(crate) const EDITION: &Edition = Edition::DEFAULT;

/// The number of the default.
pub(crate) const DEFAULT: adsdv_edition = {
    let (mut place, mut number) = (0, 0);
    while !same(Edition::ALL[place].version, EDITION.version) {
        place += 1;
        number += 1;
    }
    number
};

const fn same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    if one.len() != other.len() {
        return false;
    }
    let mut i = 0;
    while i < one.len() {
        if one[i] != other[i] {
            return false;
        }
        i += 1;
    }
    true
}

/// The versions, with a NUL at the end of each.
static VERSIONS: [[c_char; 16]; COUNT] = {
    let mut versions = [[0; 16]; COUNT];
    let mut number = 0;
    while number < COUNT {
        versions[number] = text::known(Edition::ALL[number].version);
        number += 1;
    }
    versions
};

/// The place of an edition in what is kept for each of them.
#[inline(always)]
pub(crate) fn place(number: adsdv_edition) -> usize {
    // A number that does not fit is that of no edition either.
    usize::try_from(number).unwrap_or(usize::MAX)
}

/// The edition with this number.
#[inline(always)]
pub(crate) fn numbered(number: adsdv_edition) -> Option<&'static Edition> {
    Edition::ALL.get(place(number)).copied()
}

/// The edition with this number; an error says where it was given.
#[inline(always)]
pub(crate) fn given(number: adsdv_edition, of: &'static str) -> Result<&'static Edition, Refusal<'static>> {
    numbered(number).ok_or(Refusal::NoEdition { of, given: number })
}

/// The signals that a field has, edition by edition.
#[derive(Clone, Copy)]
pub(crate) enum Rows {
    /// Every edition has the same range.
    Same(Option<&'static SignalDef>),
    Other([Option<&'static SignalDef>; COUNT]),
}

impl Rows {
    /// Those of a field.
    pub(crate) const fn of(field: &str) -> Self {
        let mut rows = [None; COUNT];
        let mut alike = true;
        let mut number = 0;
        while number < COUNT {
            rows[number] = Edition::ALL[number].bus.signal_of(on_the_bus(field));
            alike = alike && ranges_alike(rows[0], rows[number]);
            number += 1;
        }
        if alike { Self::Same(rows[0]) } else { Self::Other(rows) }
    }

    /// That of the edition at this place.
    #[inline(always)]
    pub(crate) const fn get(self, place: usize) -> Option<&'static SignalDef> {
        match self {
            Self::Same(row) => row,
            Self::Other(rows) if place < COUNT => rows[place],
            Self::Other(_) => None,
        }
    }
}

/// What a field is called where it is on the bus.
pub(crate) const fn on_the_bus(field: &str) -> &str {
    match field.as_bytes() {
        b"ami" => "ami_state",
        b"ebs" => "state_ebs",
        b"state" => "as_state",
        _ => field,
    }
}

const fn ranges_alike(one: Option<&SignalDef>, other: Option<&SignalDef>) -> bool {
    match (one, other) {
        (None, None) => true,
        (Some(one), Some(other)) => one.min == other.min && one.max == other.max,
        _ => false,
    }
}

/// How many editions of the interface there are.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_edition_count() -> u32 {
    // There are a few.
    u32::try_from(COUNT).unwrap_or(u32::MAX)
}

/// The version of an edition, such as "4.0"; NULL if there is no edition with that number. The text is the library's, and
/// stays.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_edition_version(edition: adsdv_edition) -> *const c_char {
    VERSIONS.get(place(edition)).map_or(core::ptr::null(), |version| version.as_ptr())
}

/// The edition that functions without an edition are about: that of adsdv_document_version.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_edition_default() -> adsdv_edition {
    DEFAULT
}

/// The edition with this version, such as "4.0". A version that there is not is an error (ADSDV_UNKNOWN_EDITION), which names
/// those that there are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_edition_find(
    version: *const c_char,
    edition: *mut adsdv_edition,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the text and the edition.
        let (version, place) = unsafe { (text(version, "version")?, out(edition, "edition")?) };
        let number = Edition::ALL.iter().position(|edition| edition.version == version);
        let number = number.and_then(|number| adsdv_edition::try_from(number).ok());
        place.set(number.ok_or(Refusal::NoVersion(version))?);
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
