//! What is still missing before the car drives.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Term};

use super::Car;

/// What an arrow of Figure 2 still waits for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// Where the arrow leads.
    pub to: AsState,
    /// The section that describes it.
    pub clause: &'static str,
    /// The conditions that do not hold yet, in the words of Figure 2, as they have to be.
    pub conditions: Vec<&'static str>,
}

/// What is missing for the next arrow on the way to `AS_DRIVING`; `None` where no such arrow leaves the state, and while the VCU
/// is without power.
///
/// ```
/// use adsdv_can::car::{Car, missing};
///
/// let mut car = Car::new(adsdv_spec::Machine::REFERENCE);
/// car.cycle(10);
/// let missing = missing(&car).expect("AS_OFF leads to AS_READY");
/// assert!(missing.conditions.contains(&"AS master switch ON"));
/// ```
pub fn missing(car: &Car) -> Option<Missing> {
    let state = car.outputs()?.state;
    let machine = car.machine();
    let table = &machine.interface().table;
    let on_the_way =
        |to| matches!((state, to), (AsState::Off, AsState::Ready) | (AsState::Ready, AsState::Driving));
    // What would be seen were the same seen once more: an arrow that is not taken then waits for something.
    let seen = car.inputs().observe(&machine.interface().thresholds);
    let atoms = machine.react(car.control(), seen, 0).atoms;
    let waits = |term: &Term| -> Vec<(Atom, bool)> {
        term.conditions().filter(|&(atom, value)| atoms.has(atom) != value).collect()
    };
    let arrows = machine.arrows(state).filter_map(|taken| Some((taken.row(table)?, taken.term(table)?)));
    let (row, conditions) = arrows
        .filter(|(row, _)| on_the_way(row.to))
        .map(|(row, term)| (row, waits(term)))
        .min_by_key(|(_, waits)| waits.len())?;
    let conditions = conditions.into_iter().map(|(atom, value)| atom.text(value)).collect();
    Some(Missing { to: row.to, clause: row.clause, conditions })
}
