//! What is still missing before the car drives, or before any state comes.

use std::fmt;

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Inputs, Machine, Row, Term};

use super::{Action, Car, Switch};

/// What an arrow of Figure 2 still waits for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// Where the arrow leads.
    pub to: AsState,
    /// The section that describes it.
    pub section: &'static str,
    /// The conditions that do not hold yet.
    pub conditions: Vec<Condition>,
    /// What the way waits for behind the arrow, if it is known by now: the power cycle after an emergency.
    pub then: Option<Condition>,
}

/// A condition that does not hold yet. It displays as what is missing, in the words of Figure 2 where they tell that.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    /// What it is about.
    pub atom: Atom,
    /// The value that it has to have.
    pub value: bool,
    /// What has to be, in the words of Figure 2.
    pub text: String,
    /// When it will hold by itself, in milliseconds from now; `None` if it does not.
    pub left_ms: Option<u16>,
    /// What the operator can do for it; `None` where this is not for the operator.
    pub action: Option<Action>,
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.atom {
            // "No power cycle needed" would read as if all were well.
            Atom::PowerCycleNeeded if !self.value => write!(f, "a {}", Action::POWER_CYCLE)?,
            _ => f.write_str(&self.text)?,
        }
        match self.left_ms.map(|left_ms| left_ms.div_ceil(100)) {
            Some(tenths) => write!(f, " (in {}.{} s)", tenths / 10, tenths % 10),
            None => Ok(()),
        }
    }
}

/// It displays as what has to be done, such as `AS_READY (section 3.1) still needs: AS master switch ON`.
impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { to, section, conditions, then } = self;
        let conditions: Vec<String> = conditions.iter().map(Condition::to_string).collect();
        let conditions = if conditions.is_empty() { "nothing".to_owned() } else { conditions.join(", ") };
        write!(f, "{to} (section {section}) still needs: {conditions}")?;
        then.as_ref().map_or(Ok(()), |then| write!(f, "; then {then}"))
    }
}

/// What is missing for the next arrow on the way to `AS_DRIVING`; `None` in that state, and while the VCU is without power.
///
/// ```
/// use adsdv_can::car::{Car, missing};
///
/// let mut car = Car::new(adsdv_spec::Machine::REFERENCE);
/// car.cycle(10);
/// let missing = missing(&car).expect("AS_OFF leads to AS_READY");
/// let asms = missing.conditions.first().expect("nothing is switched on");
/// assert_eq!(asms.to_string(), "AS master switch ON");
/// assert_eq!(asms.action, Some("asms on".parse()?));
/// # Ok::<(), adsdv_can::car::UnknownSwitch>(())
/// ```
pub fn missing(car: &Car) -> Option<Missing> {
    missing_for(car, AsState::Driving)
}

/// What is missing for the next arrow on the shortest way to a state; `None` in that state, and while the VCU is without
/// power. The way does not lead through `EMERGENCY_BRAKE`, unless it begins or ends there.
pub fn missing_for(car: &Car, wanted: AsState) -> Option<Missing> {
    let state = car.outputs()?.state;
    let machine = car.machine();
    // What would be seen were the same seen once more: an arrow that is not taken then waits for something.
    let seen = car.inputs().observe(&machine.edition().rules.thresholds);
    let atoms = machine.react(car.control(), seen, 0).atoms;
    let next = next_on_the_way(machine, state, wanted)?;
    let waits = |term: &Term| -> Vec<(Atom, bool)> {
        term.literals().filter(|&(atom, value)| atoms.has(atom) != value).collect()
    };
    let (row, conditions) = arrows(machine, state, next)
        .map(|(row, term)| (row, waits(term)))
        .min_by_key(|(_, waits)| waits.len())?;
    let condition = |(atom, value)| Condition {
        atom,
        value,
        text: machine.edition().rules.text(atom, value).to_string(),
        left_ms: left_ms(car, atom, value),
        action: action(car.inputs(), machine, atom, value),
    };
    let then = power_cycle(machine, next, wanted, atoms).map(condition);
    Some(Missing {
        to: row.to,
        section: row.section,
        conditions: conditions.into_iter().map(condition).collect(),
        then,
    })
}

/// The arrows from one state to another.
fn arrows(machine: &Machine, from: AsState, to: AsState) -> impl Iterator<Item = (&Row, &Term)> {
    let table = &machine.edition().rules.table;
    let arrows = machine.arrows(from).filter_map(|taken| Some((taken.row(table)?, taken.term(table)?)));
    arrows.filter(move |(row, _)| row.to == to)
}

/// The state that comes next on the shortest way; `None` if there is no way, or it is at its end.
fn next_on_the_way(machine: &Machine, from: AsState, wanted: AsState) -> Option<AsState> {
    if from == wanted {
        return None;
    }
    let leads = |from, to| arrows(machine, from, to).next().is_some();
    // From its end, those first from which it is shorter.
    let mut way = vec![wanted];
    let mut place = 0;
    while let Some(&to) = way.get(place) {
        if leads(from, to) {
            return Some(to);
        }
        for state in AsState::ALL {
            if state != AsState::EmergencyBrake && leads(state, to) && !way.contains(&state) {
                way.push(state);
            }
        }
        place += 1;
    }
    None
}

/// The power cycle, if it is needed and the way goes on with an arrow that waits for it.
fn power_cycle(machine: &Machine, from: AsState, wanted: AsState, atoms: Atoms) -> Option<(Atom, bool)> {
    let latch = Atom::PowerCycleNeeded;
    let next = next_on_the_way(machine, from, wanted)?;
    let waits = arrows(machine, from, next).all(|(_, term)| term.off.has(latch));
    (waits && atoms.has(latch)).then_some((latch, false))
}

/// For how long a timer of the state still runs.
fn left_ms(car: &Car, atom: Atom, value: bool) -> Option<u16> {
    let control = car.control();
    let is_timer = value && Atom::of_timer(control.state) == Some(atom);
    let limit = car.machine().edition().rules.timing.in_state_limit(control.state);
    is_timer.then(|| limit.saturating_sub(control.in_state_ms))
}

/// What the operator can do so that a condition holds: found by trying every switch.
fn action(inputs: &Inputs, machine: &Machine, atom: Atom, value: bool) -> Option<Action> {
    let (inputs, atom) = match atom {
        Atom::PowerCycleNeeded => return Some(Action::PowerCycle),
        // The edge is that of a switch which may be on already: it is turned off first.
        Atom::GoEdge => (Inputs::default(), Atom::GoOn),
        _ => (*inputs, atom),
    };
    let holds = |switch: Switch, raw: i32| {
        let mut inputs = inputs;
        switch.set(&mut inputs, raw);
        inputs.observe(&machine.edition().rules.thresholds).atoms().has(atom) == value
    };
    Switch::all().find_map(|switch| {
        let raw = switch.positions().into_iter().find(|&raw| holds(switch, raw))?;
        Some(Action::Set(switch, raw))
    })
}
