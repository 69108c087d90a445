//! The network of `adsdv-network` is the step: what it finds for 64 observations at once is, lane by lane, what `react` finds for
//! each of them.
//!
//! Factor by factor: the conditions as the guards see them, the arrow that is taken first, the handshake. And what joins them: lanes
//! with one key come to one control state, so that a step in one of them is enough for all. Whatever the other lanes show.

use adsdv_network::{LANES, Planes};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Control, Edition, Machine, Observation, Reaction, Readings};

use crate::prelude::*;

/// Two lanes of a word in which anything stands beside them.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    before: Control,
    dt_ms: u32,
    planes: Planes,
    lane: usize,
    seen: Observation,
    other_lane: usize,
    other_seen: Observation,
}

impl Drawn {
    /// Anything, out of any control state of an AS state, also one that no run comes to.
    fn any(state: AsState) -> Self {
        // Written down, so that the proof knows it as a constant.
        Self::any_from(Control { state, ..kani::any() })
    }

    /// Anything, out of a control state.
    fn any_from(before: Control) -> Self {
        let in_word = |lane: &u8| usize::from(*lane) < LANES;
        let (lane, other_lane): (u8, u8) = (kani::any_where(in_word), kani::any_where(in_word));
        let (lane, other_lane) = (usize::from(lane), usize::from(other_lane));
        kani::assume(lane != other_lane);
        let (seen, other_seen): (Observation, Observation) = (kani::any(), kani::any());
        let planes = kani::any::<Planes>().with(lane, seen).with(other_lane, other_seen);
        Self { before, dt_ms: kani::any(), planes, lane, seen, other_lane, other_seen }
    }

    fn react(&self, machine: &Machine, seen: Observation) -> Reaction {
        subject().react_of(machine, &self.before, seen, self.dt_ms)
    }
}

const fn has(plane: u64, lane: usize) -> bool {
    plane >> lane & 1 == 1
}

/// The factors of a network are those of the step.
fn factors_agree(machine: &Machine, drawn: &Drawn) {
    let network = subject().network(machine);
    let wired = network.at(&drawn.before, drawn.dt_ms);
    let guarded = wired.guarded(&drawn.planes);
    let reaction = drawn.react(machine, drawn.seen);
    let mut atoms = Atoms::NONE;
    for &atom in Atom::ALL {
        atoms = atoms.union(Atoms::when(atom, has(guarded.atom(atom), drawn.lane)));
    }
    kani::cover!(reaction.taken.is_some(), "an arrow is taken");
    assert!(atoms == reaction.atoms, "the same conditions");
    let mut taken = None;
    for (gate, lanes) in wired.arrows(&guarded) {
        if has(lanes, drawn.lane) {
            assert!(taken.is_none(), "one arrow");
            assert!(gate.to == reaction.control.state, "which leads there");
            taken = Some(gate.taken);
        }
    }
    assert!(taken == reaction.taken, "the same arrow");
    let mut answered = 0;
    for (handshake, lanes) in wired.handshakes(&guarded) {
        if has(lanes, drawn.lane) {
            answered += 1;
            assert!(handshake == reaction.control.handshake, "the same handshake");
        }
    }
    assert!(answered == 1, "one handshake");
}

/// Lanes that a network puts into one group come to one control state.
fn groups_agree(machine: &Machine, drawn: &Drawn) {
    let network = subject().network(machine);
    let (mut own, mut other, mut times) = (None, None, 0);
    network.at(&drawn.before, drawn.dt_ms).groups(&drawn.planes, |key, lanes| {
        if has(lanes, drawn.lane) {
            own = Some(key);
            times += 1;
        }
        if has(lanes, drawn.other_lane) {
            other = Some(key);
        }
    });
    assert!(times == 1, "a lane is in one group");
    let (one, two) = (drawn.react(machine, drawn.seen), drawn.react(machine, drawn.other_seen));
    let same = own == other;
    let otherwise = drawn.seen != drawn.other_seen;
    let both = same & otherwise;
    kani::cover!(both, "another observation, in the same group");
    kani::cover!(!same, "another group");
    assert!(own.map(adsdv_network::Key::to) == Some(one.control.state), "the group leads there");
    assert!(!same || one.control == two.control, "the same control state");
}

/// Version 4.0 with all its other answers.
const OTHERWISE: &Machine = &Machine::new(Edition::V4_0, other_answers(&Edition::V4_0));

/// Version 3.0 where a change is the fault, not a value: what came before is remembered then.
const BY_EDGES: &Machine =
    &Machine::new(Edition::V3_0, Edition::V3_0.readings.with(adsdv_spec::Choice::FaultEdge));

const fn other_answers(edition: &Edition) -> Readings {
    let others = edition.alternatives();
    let mut readings = edition.readings;
    let mut place = 0;
    while place < adsdv_spec::Choice::ALL.len() {
        if others.has(adsdv_spec::Choice::ALL[place]) {
            readings = readings.with(adsdv_spec::Choice::ALL[place]);
        }
        place += 1;
    }
    readings
}

/// **From AS_OFF, the network sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_off() {
    let subject = subject();
    let machine = subject.machine();
    factors_agree(machine, &Drawn::any(AsState::Off));
}

/// **From AS_READY, the network sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_ready() {
    let subject = subject();
    let machine = subject.machine();
    factors_agree(machine, &Drawn::any(AsState::Ready));
}

/// **From AS_DRIVING, the network sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_driving() {
    let subject = subject();
    let machine = subject.machine();
    factors_agree(machine, &Drawn::any(AsState::Driving));
}

/// **From EMERGENCY_BRAKE, the network sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_emergency_brake() {
    let subject = subject();
    let machine = subject.machine();
    factors_agree(machine, &Drawn::any(AsState::EmergencyBrake));
}

/// **From AS_FINISHED, the network sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_finished() {
    let subject = subject();
    let machine = subject.machine();
    factors_agree(machine, &Drawn::any(AsState::Finished));
}

/// **From AS_OFF, the network of version 4.0 sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_off_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    factors_agree(machine, &Drawn::any(AsState::Off));
}

/// **From AS_READY, the network of version 4.0 sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_ready_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    factors_agree(machine, &Drawn::any(AsState::Ready));
}

/// **From AS_DRIVING, the network of version 4.0 sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_driving_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    factors_agree(machine, &Drawn::any(AsState::Driving));
}

/// **From EMERGENCY_BRAKE, the network of version 4.0 sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_emergency_brake_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    factors_agree(machine, &Drawn::any(AsState::EmergencyBrake));
}

/// **From AS_FINISHED, the network of version 4.0 sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_finished_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    factors_agree(machine, &Drawn::any(AsState::Finished));
}

/// **From AS_READY, the network of version 4.0 with all its other answers sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_ready_otherwise() {
    factors_agree(OTHERWISE, &Drawn::any(AsState::Ready));
}

/// **From AS_DRIVING, the network of version 4.0 with all its other answers sees, takes and hears what the step does**: in each lane the same conditions, the same arrow and the same
/// handshake.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_driving_otherwise() {
    factors_agree(OTHERWISE, &Drawn::any(AsState::Driving));
}

/// **From AS_OFF, lanes of one group come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_off() {
    let subject = subject();
    let machine = subject.machine();
    groups_agree(machine, &Drawn::any(AsState::Off));
}

/// **From AS_READY, lanes of one group come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_ready() {
    let subject = subject();
    let machine = subject.machine();
    groups_agree(machine, &Drawn::any(AsState::Ready));
}

/// **From AS_DRIVING, lanes of one group come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_driving() {
    let subject = subject();
    let machine = subject.machine();
    groups_agree(machine, &Drawn::any(AsState::Driving));
}

/// **From EMERGENCY_BRAKE, lanes of one group come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_emergency_brake() {
    let subject = subject();
    let machine = subject.machine();
    groups_agree(machine, &Drawn::any(AsState::EmergencyBrake));
}

/// **From AS_FINISHED, lanes of one group come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_finished() {
    let subject = subject();
    let machine = subject.machine();
    groups_agree(machine, &Drawn::any(AsState::Finished));
}

/// **From AS_OFF, lanes of one group of version 4.0 come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_off_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    groups_agree(machine, &Drawn::any(AsState::Off));
}

/// **From AS_READY, lanes of one group of version 4.0 come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_ready_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    groups_agree(machine, &Drawn::any(AsState::Ready));
}

/// **From AS_DRIVING, lanes of one group of version 4.0 come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_driving_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    groups_agree(machine, &Drawn::any(AsState::Driving));
}

/// **From EMERGENCY_BRAKE, lanes of one group of version 4.0 come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_emergency_brake_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    groups_agree(machine, &Drawn::any(AsState::EmergencyBrake));
}

/// **From AS_FINISHED, lanes of one group of version 4.0 come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_finished_in_4_0() {
    let subject = subject();
    let machine = subject.machine_of_4_0();
    groups_agree(machine, &Drawn::any(AsState::Finished));
}

/// **From AS_OFF, lanes of one group of version 4.0 with all its other answers come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_off_otherwise() {
    groups_agree(OTHERWISE, &Drawn::any(AsState::Off));
}

/// **From AS_READY, lanes of one group of version 4.0 with all its other answers come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_ready_otherwise() {
    groups_agree(OTHERWISE, &Drawn::any(AsState::Ready));
}

/// **From AS_DRIVING, lanes of one group of version 4.0 with all its other answers come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_driving_otherwise() {
    groups_agree(OTHERWISE, &Drawn::any(AsState::Driving));
}

/// **From EMERGENCY_BRAKE, lanes of one group of version 4.0 with all its other answers come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_emergency_brake_otherwise() {
    groups_agree(OTHERWISE, &Drawn::any(AsState::EmergencyBrake));
}

/// **From AS_FINISHED, lanes of one group of version 4.0 with all its other answers come to one control state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_finished_otherwise() {
    groups_agree(OTHERWISE, &Drawn::any(AsState::Finished));
}

/// **From AS_DRIVING, the network sees, takes and hears what the step does, where changes count** (`fault-trigger=edge`).
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn the_network_is_the_step_from_driving_by_edges() {
    factors_agree(BY_EDGES, &Drawn::any(AsState::Driving));
}

/// **From AS_DRIVING, lanes of one group come to one control state, where changes count** (`fault-trigger=edge`).
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(41))]
pub fn lanes_of_a_group_come_to_the_same_from_driving_by_edges() {
    groups_agree(BY_EDGES, &Drawn::any(AsState::Driving));
}

theorems![
    the_network_is_the_step_from_driving_by_edges,
    lanes_of_a_group_come_to_the_same_from_driving_by_edges,
    the_network_is_the_step_from_off,
    the_network_is_the_step_from_ready,
    the_network_is_the_step_from_driving,
    the_network_is_the_step_from_emergency_brake,
    the_network_is_the_step_from_finished,
    the_network_is_the_step_from_off_in_4_0,
    the_network_is_the_step_from_ready_in_4_0,
    the_network_is_the_step_from_driving_in_4_0,
    the_network_is_the_step_from_emergency_brake_in_4_0,
    the_network_is_the_step_from_finished_in_4_0,
    the_network_is_the_step_from_ready_otherwise,
    the_network_is_the_step_from_driving_otherwise,
    lanes_of_a_group_come_to_the_same_from_off,
    lanes_of_a_group_come_to_the_same_from_ready,
    lanes_of_a_group_come_to_the_same_from_driving,
    lanes_of_a_group_come_to_the_same_from_emergency_brake,
    lanes_of_a_group_come_to_the_same_from_finished,
    lanes_of_a_group_come_to_the_same_from_off_in_4_0,
    lanes_of_a_group_come_to_the_same_from_ready_in_4_0,
    lanes_of_a_group_come_to_the_same_from_driving_in_4_0,
    lanes_of_a_group_come_to_the_same_from_emergency_brake_in_4_0,
    lanes_of_a_group_come_to_the_same_from_finished_in_4_0,
    lanes_of_a_group_come_to_the_same_from_off_otherwise,
    lanes_of_a_group_come_to_the_same_from_ready_otherwise,
    lanes_of_a_group_come_to_the_same_from_driving_otherwise,
    lanes_of_a_group_come_to_the_same_from_emergency_brake_otherwise,
    lanes_of_a_group_come_to_the_same_from_finished_otherwise,
];
