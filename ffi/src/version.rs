//! What this is a library of.

use core::ffi::c_char;

use crate::edition::EDITION;
use crate::text;

static LIBRARY: [c_char; 16] = text::known(env!("CARGO_PKG_VERSION"));
static DOCUMENT: [c_char; 16] = text::known(EDITION.version);

/// The version of the library, such as "0.1.0". The text is the library's, and stays.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_version() -> *const c_char {
    LIBRARY.as_ptr()
}

/// The version of the ADS-DV Software Interface Specification that functions without an edition are about: "3.0". The text is
/// the library's, and stays. adsdv_edition_version has the others.
#[unsafe(no_mangle)]
pub extern "C" fn adsdv_document_version() -> *const c_char {
    DOCUMENT.as_ptr()
}
