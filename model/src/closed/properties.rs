//! The properties of the closed model, as data, and the exploration that decides them.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use adsdv_spec::messages::{AsState, ShutdownCause};
use stateright::{Checker, Expectation, HasDiscoveries, Model, Path, Property};

use super::{Closed, ClosedAction, ClosedState, Mission, Operator, Wheels};

/// A property of the closed model.
#[derive(Clone, Debug)]
pub struct ClosedProperty {
    /// The stable name.
    pub name: &'static str,
    /// What it says, in one sentence. What stands in braces is a time of the edition, which
    /// [`statement_in`](Self::statement_in) puts there.
    pub statement: &'static str,
    /// The requirements that it covers in some edition, as `spec/REQUIREMENTS.md` numbers them; none where it is about the model
    /// itself. [`requirements_in`](Self::requirements_in) has those of one.
    pub requirements: &'static [&'static str],
    /// With which operators it is checked.
    pub operators: &'static [Operator],
    /// Whether it is to hold always, in the end, or once.
    pub expectation: Expectation,
    condition: fn(&Closed, &ClosedState) -> bool,
}

impl ClosedProperty {
    /// Whether its condition holds in a state.
    pub(super) fn holds_in(&self, model: &Closed, state: &ClosedState) -> bool {
        (self.condition)(model, state)
    }
}

const BOTH: &[Operator] = &[Operator::WellBehaved, Operator::Any];
const WELL_BEHAVED: &[Operator] = &[Operator::WellBehaved];
const ANY: &[Operator] = &[Operator::Any];

/// Every property of the closed model.
pub const CLOSED_PROPERTIES: &[ClosedProperty] = &[
    ClosedProperty {
        name: "conforming-ai-always-finishes",
        statement: "With a conforming AI Computer, a well-behaved operator and no fault, every run reaches AS_FINISHED \
                    and then AS_OFF",
        requirements: &[
            "SM-9", "SM-11", "SM-14", "SM-16", "RDY-5", "RDY-6", "RDY-7", "RDY-8", "DRV-11", "DRV-13",
            "DRV-15", "FIN-1", "FIN-2", "FIN-3", "FIN-4", "FTO-1",
        ],
        operators: WELL_BEHAVED,
        expectation: Expectation::Eventually,
        condition: |_, state| state.mission == Mission::Over,
    },
    ClosedProperty {
        name: "no-emergency-without-a-reason",
        statement: "With a conforming AI Computer, a well-behaved operator and no fault, EMERGENCY_BRAKE is never reached",
        requirements: &["SM-18", "DTE-4", "DTE-5", "DTE-7", "DTE-8", "HS-13"],
        operators: WELL_BEHAVED,
        expectation: Expectation::Always,
        condition: |_, state| state.control.state != AsState::EmergencyBrake,
    },
    ClosedProperty {
        name: "every-action-moves-on",
        statement: "With a well-behaved operator no run comes back to a state in which it was, so that what holds at the \
                    end of every path holds eventually",
        requirements: &[],
        operators: WELL_BEHAVED,
        expectation: Expectation::Always,
        condition: |model, state| {
            let rank = model.rank(state);
            model.next_states(state).iter().all(|next| rank < model.rank(next))
        },
    },
    ClosedProperty {
        name: "conforming-ai-causes-no-emergency",
        statement: "Whatever the operator does, and whenever a fault opens the shutdown circuit, SHUTDOWN_CAUSE never blames a conforming AI Computer: \
                    it is none of 1, 6, 7 and 8",
        requirements: &["MSG-64", "HS-9", "HS-10", "HS-17", "DTE-4", "DTE-5", "DTE-7", "DTE-8"],
        operators: BOTH,
        expectation: Expectation::Always,
        condition: |_, state| {
            !matches!(
                state.control.shutdown_cause,
                ShutdownCause::AiComputerRequest
                    | ShutdownCause::AiCommsFault
                    | ShutdownCause::AutonomousBrakingFault
                    | ShutdownCause::MissionStatusFault
            )
        },
    },
    ClosedProperty {
        name: "conforming-ai-is-never-lost",
        statement: "AI_COMMS_LOST is never raised while the AI Computer answers each edge in less than {handshake}",
        requirements: &["HS-9", "HS-13", "HS-16", "HS-17", "HS-18", "HS-19", "D-8", "D-44"],
        operators: BOTH,
        expectation: Expectation::Always,
        condition: |model, state| {
            !state.control.handshake.is_lost(model.machine.edition().rules.timing.handshake_ms)
        },
    },
    ClosedProperty {
        name: "handshake-goes-round",
        statement: "The VCU asks for 1, is answered, and asks for 0 again",
        requirements: &["HS-4", "HS-5", "HS-6", "HS-11", "HS-12"],
        operators: WELL_BEHAVED,
        expectation: Expectation::Sometimes,
        condition: |_, state| {
            let handshake = state.control.handshake;
            handshake.active && !handshake.bit && state.received.status.handshake
        },
    },
    ClosedProperty {
        name: "vehicle-can-be-driven",
        statement: "In AS_DRIVING the AI Computer asks for FORWARD and torque, which reach the motors: the vehicle moves",
        requirements: &["DRV-1", "DRV-10"],
        operators: BOTH,
        expectation: Expectation::Sometimes,
        condition: |_, state| {
            state.control.state == AsState::Driving
                && state.motion.driven
                && state.motion.wheels == Wheels::Moving
        },
    },
    ClosedProperty {
        name: "mission-can-be-finished",
        statement: "AS_FINISHED can be reached",
        requirements: &["SM-14", "FIN-4"],
        operators: BOTH,
        expectation: Expectation::Sometimes,
        condition: |_, state| state.control.state == AsState::Finished,
    },
    ClosedProperty {
        name: "emergency-can-happen",
        statement: "EMERGENCY_BRAKE can be reached, by a fault or by the operator",
        requirements: &["SM-12", "SM-13", "SM-15", "RTE-1", "DTE-1", "FTE-1"],
        operators: ANY,
        expectation: Expectation::Sometimes,
        condition: |_, state| state.control.state == AsState::EmergencyBrake,
    },
];

/// A property that cannot fail. The checker stops as soon as it has an example or a counterexample for each property;
/// there is none for this one.
pub const EXHAUSTIVE: &str = "exploration-is-exhaustive";

/// No property: waiting for it, the checker never finishes early.
const NEVER: &str = "no such property";

pub(super) fn properties_of(operator: Operator) -> impl Iterator<Item = &'static ClosedProperty> {
    CLOSED_PROPERTIES.iter().filter(move |property| property.operators.contains(&operator))
}

pub(super) fn of(model: &Closed) -> Vec<Property<Closed>> {
    let sentinel = Property::always(EXHAUSTIVE, |model: &Closed, _| {
        model.looked_at.fetch_add(1, Ordering::Relaxed);
        true
    });
    // People look at what they like: there, nothing is exhaustive.
    let sentinel = (!model.skips_time).then_some(sentinel);
    properties_of(model.operator)
        .map(|property| Property {
            expectation: property.expectation.clone(),
            name: property.name,
            condition: property.condition,
        })
        .chain(sentinel)
        .collect()
}

/// What an exploration of the closed model found.
#[derive(Debug)]
pub struct ClosedExploration {
    /// What was found of each property, in the order of [`CLOSED_PROPERTIES`].
    pub results: Vec<Found>,
    /// How many different states there are.
    pub states: usize,
    /// How many times a state was reached from another one.
    pub transitions: usize,
    /// How many steps the farthest state is away, by the paths that were found: with one thread, shortest ones.
    pub depth: usize,
    /// How long it took.
    pub time: Duration,
    /// Whether every state was looked at. Without this, nothing is verified.
    pub complete: bool,
}

/// What was found of one property.
#[derive(Debug)]
pub struct Found {
    /// The property.
    pub property: &'static ClosedProperty,
    /// Whether it holds.
    pub holds: bool,
    /// A run that shows why it fails, or, for something that is to be possible, that it is.
    pub run: Option<Path<ClosedState, ClosedAction>>,
}

impl Closed {
    /// A shortest run that shows that a property fails, or, for something that is to be possible, that it is.
    ///
    /// It explores only until it has one; `None` after a complete exploration, or if the operator has no such property.
    pub fn run_for(self, name: &str) -> Option<Path<ClosedState, ClosedAction>> {
        let property = properties_of(self.operator).find(|property| property.name == name)?;
        self.checker()
            .finish_when(HasDiscoveries::AnyOf(BTreeSet::from([property.name])))
            .spawn_bfs()
            .join()
            .discovery(property.name)
    }

    /// Explores every state, with this many threads, and decides every property of the operator.
    ///
    /// The exploration is complete: it ends when there is no state left that was not looked at. Runs are shortest ones
    /// when there is one thread.
    pub fn explore(self, threads: usize) -> ClosedExploration {
        let operator = self.operator;
        let begin = Instant::now();
        let looked_at = Arc::<AtomicUsize>::default();
        let model = Self { looked_at: Arc::clone(&looked_at), ..self };
        let checker = model
            .checker()
            .threads(threads.max(1))
            .finish_when(HasDiscoveries::AllOf(BTreeSet::from([NEVER])))
            .spawn_bfs()
            .join();
        let time = begin.elapsed();
        let mut runs = checker.discoveries();
        let results = properties_of(operator)
            .map(|property| {
                let run = runs.remove(property.name);
                let holds = run.is_some() != property.expectation.discovery_is_failure();
                Found { property, holds, run }
            })
            .collect();
        ClosedExploration {
            results,
            states: checker.unique_state_count(),
            transitions: checker.state_count(),
            depth: checker.max_depth(),
            time,
            complete: looked_at.load(Ordering::Relaxed) == checker.unique_state_count(),
        }
    }
}
