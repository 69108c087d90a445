//! What leads from one state to the next.

use adsdv_conform::protocol::InputField;
use adsdv_spec::Term;
use adsdv_spec::messages::AsState;

/// From one state to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hop {
    pub(crate) by: By,
    /// Where it leads.
    pub(crate) to: AsState,
}

/// What leads on.
#[derive(Clone, Copy, Debug)]
pub(crate) enum By {
    /// An alternative of an arrow of the table.
    Term(Term),
    /// An input with a value, besides the table.
    Also(&'static InputField, i32),
}
