//! MCAP: what is in it, held against the other formats, the judge, and the reader of Python.

mod judged;
mod layout;
mod python;
mod read;
mod signals;
