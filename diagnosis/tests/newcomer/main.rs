//! State machines as somebody writes them in an evening from the page of the protocol: with code of their own, and with mistakes that
//! hide one another. No deviation was made for them to have.

mod asked;
mod first;
mod second;
