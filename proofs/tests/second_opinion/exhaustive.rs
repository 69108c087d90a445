//! Every combination of the conditions that a state looks at, from every control state on a grid of time.

use std::collections::HashSet;

use adsdv_spec::messages::{
    AmiState, AsState, AxleTorqueRequest, DirectionRequest, EbsState, MissionStatus, SteerAngle, WheelSpeed,
};
use adsdv_spec::{Atom, Atoms, Choice, Control, Edition, Inputs, Machine, Readings};

use crate::compare::{self, Count, Disagreement, ROWS};

/// What an exploration saw.
pub(crate) struct Exploration {
    /// How often each row was taken.
    pub(crate) taken: Count,
    /// The first step that was seen differently; the exploration ends there.
    pub(crate) disagreement: Option<Box<Disagreement>>,
}

/// A breadth-first search from the power cycle on, in which every step is compared.
///
/// Covered is
/// - every control state that is reached by steps of 10 ms and of the state's timer less 20 ms, and whose time in the
///   state is no farther than 20 ms from 0 or from where it stops counting; the handshake takes all its values on the
///   grid of 10 ms;
/// - from each of them, with each of these two steps, every possible combination of the atoms of [`mentioned`].
///
/// The raw value behind an atom (which cause opens the circuit, which wheel turns how fast) changes from one
/// combination to the next, boundary values among them.
pub(crate) fn explore(machine: &Machine) -> Exploration {
    let mut exploration = Exploration { taken: [0; ROWS], disagreement: None };
    let inputs = AsState::ALL.map(|state| (state, all_inputs(mentioned(state, machine.readings()))));
    let mut seen = HashSet::from([Control::INITIAL]);
    let mut level = vec![Control::INITIAL];
    while !level.is_empty() {
        let mut next = Vec::new();
        for control in &level {
            let seen_here = inputs.iter().filter(|(state, _)| *state == control.state);
            for inputs in seen_here.flat_map(|(_, inputs)| inputs) {
                for dt_ms in [10, jump_ms(control.state)] {
                    match compare::step(machine, control, inputs, dt_ms, &mut exploration.taken) {
                        Ok(after) if on_grid(&after) && seen.insert(after) => next.push(after),
                        Ok(_) => {}
                        Err(disagreement) => {
                            exploration.disagreement = Some(disagreement);
                            return exploration;
                        }
                    }
                }
            }
        }
        level = next;
    }
    exploration
}

/// Where the time in a state stops counting.
fn limit_ms(state: AsState) -> u16 {
    match state {
        AsState::Ready => 5000,
        AsState::EmergencyBrake => 15000,
        AsState::Off | AsState::Driving | AsState::Finished => 0,
    }
}

fn jump_ms(state: AsState) -> u32 {
    u32::from(limit_ms(state).saturating_sub(20))
}

fn on_grid(control: &Control) -> bool {
    let limit_ms = limit_ms(control.state);
    control.in_state_ms <= 20 || control.in_state_ms + 20 >= limit_ms
}

/// The conditions that the sections on a state mention, and those that a step into the next state remembers.
fn mentioned(state: AsState, readings: Readings) -> Atoms {
    #[allow(clippy::enum_glob_use, reason = "lists of atoms read like the sections")]
    use Atom::*;
    // The master switches, the handshake, and what can stop the vehicle in every active state; "Go" for GO_SIGNAL.
    let everywhere = Atoms::of(&[Asms, Tsms, AiHandshake, SdcOpen, AiEstop, GoOn]);
    everywhere.union(match state {
        AsState::Off => Atoms::of(&[AmiSelected, MissionSelected, EbsArmed]),
        AsState::Ready => {
            Atoms::of(&[FrontTorqueZero, RearTorqueZero, SteerRequestZero, SteerStraight, DirectionNeutral])
                .union(Atoms::when(MissionRunning, readings.is(Choice::FaultEdge)))
        }
        AsState::Driving => Atoms::of(&[MissionRunning, MissionFinished, DirectionNeutral, Moving, AtRest]),
        AsState::EmergencyBrake | AsState::Finished => Atoms::NONE,
    })
}

/// Inputs for every combination of the atoms that can be, each checked to be seen as that combination.
fn all_inputs(atoms: Atoms) -> Vec<Inputs> {
    let atoms: Vec<Atom> = atoms.iter().collect();
    let combination = |bits: usize| {
        let on = atoms.iter().enumerate().filter(|(place, _)| bits >> place & 1 == 1);
        on.fold(Atoms::NONE, |set, (_, &atom)| set.with(atom))
    };
    let combinations = (0..1 << atoms.len()).map(combination).filter(|&atoms| possible(atoms));
    combinations
        .enumerate()
        .map(|(index, atoms)| {
            let inputs = inputs_with(atoms, index);
            // What the edition does not have may be as it will.
            let seen = inputs.observe(&Edition::DEFAULT.rules.thresholds).atoms();
            let seen = seen.intersection(Edition::DEFAULT.scope());
            let [too_many, too_few] = [seen.difference(atoms), atoms.difference(seen)];
            assert_eq!(
                seen, atoms,
                "these inputs show [{too_many}] and should not, and not [{too_few}] and should: `inputs_with` and `set_wheel_speeds` \
                 here have the numbers of the document once more\n{inputs:#?}"
            );
            inputs
        })
        .collect()
}

/// `MISSION_STATUS` has one value, and what moves is not at rest.
fn possible(atoms: Atoms) -> bool {
    let count = |set: &[Atom]| atoms.intersection(Atoms::of(set)).iter().count();
    count(&[Atom::MissionSelected, Atom::MissionRunning, Atom::MissionFinished]) <= 1
        && count(&[Atom::Moving, Atom::AtRest]) <= 1
}

/// Raw inputs that show these atoms and no others; `turn` chooses among the raw values that do.
fn inputs_with(atoms: Atoms, turn: usize) -> Inputs {
    // Consecutive combinations differ in the first atoms; mixing keeps raw values from following those.
    let turn = turn.wrapping_mul(0x9E37_79B1) >> 7 & 0xFFFF;
    let has = |atom| atoms.has(atom);
    let choose = |on: &[i32], off: &[i32], atom, shift: usize| {
        let values = if has(atom) { on } else { off };
        values[(turn >> shift) % values.len()]
    };
    let mut inputs =
        Inputs { asms: has(Atom::Asms), tsms: has(Atom::Tsms), go: has(Atom::GoOn), ..Inputs::default() };
    if has(Atom::AmiSelected) {
        inputs.ami = AmiState::ALL[1 + turn % (AmiState::ALL.len() - 1)];
    }
    inputs.ebs = match (has(Atom::EbsArmed), turn % 2) {
        (true, _) => EbsState::Armed,
        (false, 0) => EbsState::Unavailable,
        (false, _) => EbsState::Triggered,
    };
    if has(Atom::SdcOpen) {
        open_circuit(&mut inputs, turn);
    }
    let ai = &mut inputs.ai;
    ai.status.handshake = has(Atom::AiHandshake);
    ai.status.estop_request = has(Atom::AiEstop);
    ai.status.mission_status = if has(Atom::MissionSelected) {
        MissionStatus::Selected
    } else if has(Atom::MissionRunning) {
        MissionStatus::Running
    } else if has(Atom::MissionFinished) {
        MissionStatus::Finished
    } else {
        MissionStatus::NotSelected
    };
    ai.status.direction_request =
        if has(Atom::DirectionNeutral) { DirectionRequest::Neutral } else { DirectionRequest::Forward };
    let torque = |atom, shift| AxleTorqueRequest::clamped(choose(&[0], &[1, 1950], atom, shift));
    ai.drive_f.front_axle_trq_request = torque(Atom::FrontTorqueZero, 0);
    ai.drive_r.rear_axle_trq_request = torque(Atom::RearTorqueZero, 1);
    ai.steer.steer_request =
        SteerAngle::clamped(choose(&[0], &[1, -1, 240, -240], Atom::SteerRequestZero, 2));
    inputs.vehicle.steer_angle =
        SteerAngle::clamped(choose(&[49, -49, 0], &[50, -50, 51, 240, -240], Atom::SteerStraight, 3));
    set_wheel_speeds(&mut inputs, atoms, turn);
    inputs
}

/// Opens the shutdown circuit in one of the ways that section 3.5 and the faults of 520h give.
fn open_circuit(inputs: &mut Inputs, turn: usize) {
    let Inputs { sdc, reports, .. } = inputs;
    let ways = [
        &mut sdc.remote_estop,
        &mut sdc.res_link_lost,
        &mut sdc.vehicle_estop,
        &mut sdc.crash_sensor,
        &mut sdc.critical_fault,
        &mut sdc.bms_fault,
        &mut sdc.mpp_dongle_removed,
        &mut reports.hvil_open,
        &mut reports.hvil_short,
        &mut reports.ebs_fault,
        &mut reports.offboard_charger_fault,
        &mut reports.charging,
    ];
    // Charging is a fault only with a master switch on.
    let ways_that_open = if inputs.asms || inputs.tsms { ways.len() } else { ways.len() - 1 };
    for (index, way) in ways.into_iter().enumerate() {
        *way = index == turn % ways_that_open;
    }
}

/// Moving: one wheel is fast. At rest: all are slow. Neither: one turns at exactly 10 rpm.
fn set_wheel_speeds(inputs: &mut Inputs, atoms: Atoms, turn: usize) {
    let (one, others) = if atoms.has(Atom::Moving) {
        ([11, 1250], [0, 10])
    } else if atoms.has(Atom::AtRest) {
        ([9, 0], [9, 0])
    } else {
        ([10, 10], [9, 10])
    };
    let wheels = &mut inputs.vehicle.wheel_speeds;
    let wheels = [
        &mut wheels.fl_wheel_speed,
        &mut wheels.fr_wheel_speed,
        &mut wheels.rl_wheel_speed,
        &mut wheels.rr_wheel_speed,
    ];
    for (index, wheel) in wheels.into_iter().enumerate() {
        let speeds = if index == turn % 4 { one } else { others };
        *wheel = WheelSpeed::clamped(speeds[(turn >> 2) % 2]);
    }
}
