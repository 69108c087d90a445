//! How the ways are found: from each state that is reached, the model itself is led on.

use std::collections::VecDeque;

use adsdv_conform::ProgramError;
use adsdv_spec::messages::AsState;

use super::Ways;
use crate::dials::dials;
use crate::hop::Hop;
use crate::interface::Interface;
use crate::model::Model;
use crate::pilot::Pilot;

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

    /// Whether the model gets there by a hop from a state to which the way is known.
    fn leads(&self, from: AsState, hop: &Hop) -> bool {
        let mut model = self.model.clone().running();
        let arrives = |pilot: Result<Pilot<'_>, _>| -> Result<bool, ProgramError> {
            let mut pilot = pilot?;
            Ok(pilot.to(from)? && pilot.hop(hop)?)
        };
        arrives(Pilot::new(&mut model, self)).unwrap_or(false)
    }
}
