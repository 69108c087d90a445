//! State machines as somebody writes them in an evening from the page of the protocol: with code of their own, and with mistakes that
//! hide one another: what a diagnosis has to name, whether or not its deviations were made with such programs in mind.

mod asked;
mod first;
mod second;
