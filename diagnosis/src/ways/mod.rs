//! The ways to the states, as a model knows them.

mod search;

use adsdv_conform::protocol::InputField;
use adsdv_spec::messages::AsState;

use crate::dials::Dial;
use crate::hop::Hop;
use crate::interface::Interface;
use crate::model::Model;

/// The ways to the states.
#[derive(Clone, Debug)]
pub(crate) struct Ways<'a> {
    pub(crate) model: &'a Model,
    /// What the program has.
    pub(crate) interface: &'a Interface,
    /// What can be changed.
    pub(crate) dials: Vec<Dial>,
    /// Those that are known, each with its state.
    known: Vec<(AsState, Vec<Hop>)>,
}

impl Ways<'_> {
    /// The way to a state.
    pub(crate) fn to(&self, state: AsState) -> Option<&[Hop]> {
        self.known.iter().find(|(to, _)| *to == state).map(|(_, way)| way.as_slice())
    }

    /// Every input with every value that is worth trying.
    pub(crate) fn changes(&self) -> impl Iterator<Item = (&'static InputField, i32)> + '_ {
        self.dials.iter().flat_map(|dial| dial.values.iter().map(|raw| (dial.field, *raw)))
    }

    /// The inputs with the values that tell something in a state besides the table, and with those that do not.
    pub(crate) fn visible_in(&self, state: AsState) -> impl Iterator<Item = (&'static InputField, i32)> + '_ {
        let keys: Vec<&str> = self.model.keys_besides(state).collect();
        self.changes().filter(move |(field, _)| keys.contains(&field.key))
    }
}
