//! What a page sees of the module: two buffers in its memory, one function to call, and one that it gives.
//!
//! ```text
//! into(len) -> where the page writes its request    call(len) -> 0, or 1 if it is refused; the answer is at out(), out_len() bytes long
//! host.read(at, room) -> how many bytes of the log the page wrote there; 0 at its end, and -1 if it cannot read on
//! ```

// Names that are not mangled, and a function from outside, are what the module is made of.
#![allow(unsafe_code)]

use std::io::{self, Read};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::{Answer, Session};

#[link(wasm_import_module = "host")]
unsafe extern "C" {
    /// The page writes no more than there is room for.
    safe fn read(at: *mut u8, room: usize) -> i32;
}

static STATE: Mutex<State> = Mutex::new(State { session: None, request: Vec::new(), answer: Vec::new() });

struct State {
    session: Option<Session>,
    request: Vec<u8>,
    answer: Vec<u8>,
}

fn state() -> MutexGuard<'static, State> {
    STATE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The log that the page gives.
struct FromPage;

impl Read for FromPage {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        usize::try_from(read(room.as_mut_ptr(), room.len()))
            .map_err(|_| io::Error::other("the browser cannot read it any more"))
    }
}

#[unsafe(no_mangle)]
extern "C" fn into(len: usize) -> *mut u8 {
    let request = &mut state().request;
    request.clear();
    request.resize(len, 0);
    request.as_mut_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn call() -> u32 {
    let State { session, request, answer } = &mut *state();
    let (refused, text) =
        match session.get_or_insert_default().answer(&String::from_utf8_lossy(request), FromPage) {
            Answer::Text(text) => (0, text),
            Answer::Refused(text) => (1, text),
        };
    *answer = text.into_bytes();
    refused
}

#[unsafe(no_mangle)]
extern "C" fn out() -> *const u8 {
    state().answer.as_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn out_len() -> usize {
    state().answer.len()
}
