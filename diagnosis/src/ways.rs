//! The ways to the states, as a model knows them.

use std::collections::VecDeque;

use adsdv_oracle::conform::ProgramError;
use adsdv_oracle::protocol::InputField;
use adsdv_spec::Term;
use adsdv_spec::messages::AsState;

use crate::dials::{Dial, dials};
use crate::interface::Interface;
use crate::model::Model;
use crate::pilot::Pilot;

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

impl<'a> Ways<'a> {
    /// The shortest way to each state to which the model finds one with the inputs that a program has.
    pub(crate) fn of(model: &'a Model, interface: &'a Interface) -> Self {
        let (dials, known) = (dials(model, interface), vec![(AsState::Off, Vec::new())]);
        let mut ways = Self { model, interface, dials, known };
        let mut begins = VecDeque::from([AsState::Off]);
        while let Some(from) = begins.pop_front() {
            for hop in model.hops(from) {
                if ways.to(hop.to).is_none() && ways.leads(from, &hop) {
                    let way = ways.to(from).unwrap_or_default().iter().copied().chain([hop]).collect();
                    ways.known.push((hop.to, way));
                    begins.push_back(hop.to);
                }
            }
        }
        ways
    }

    /// The way to a state.
    pub(crate) fn to(&self, state: AsState) -> Option<&[Hop]> {
        self.known.iter().find(|(to, _)| *to == state).map(|(_, way)| way.as_slice())
    }

    /// Whether the model gets there by a hop from a state to which the way is known.
    fn leads(&self, from: AsState, hop: &Hop) -> bool {
        let mut model = self.model.clone().running();
        let arrives = |pilot: Result<Pilot<'_>, _>| -> Result<bool, ProgramError> {
            let mut pilot = pilot?;
            Ok(pilot.to(from)? && pilot.hop(hop)?)
        };
        arrives(Pilot::new(&mut model, self)).unwrap_or(false)
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
