//! Texts for C that are allocated: those of the judge, which stay until the next call with it.

use core::ffi::c_char;
use std::ffi::CString;

/// A text for C. None of the judge's has a NUL in it; one that had would lose it, and nothing else.
pub(crate) fn without_nul(text: &str) -> CString {
    CString::new(text.bytes().filter(|&byte| byte != 0).collect::<Vec<u8>>()).unwrap_or_default()
}

/// The texts of a rule that was reported last.
#[derive(Debug, Default)]
pub(crate) struct Texts([CString; 3]);

impl Texts {
    /// Keeps these in the place of those before, and tells where they are.
    pub(crate) fn keep(&mut self, texts: [&str; 3]) -> [*const c_char; 3] {
        self.0 = texts.map(without_nul);
        self.0.each_ref().map(|text| text.as_ptr())
    }
}
