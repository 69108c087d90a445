//! Random scenarios: walks that mostly do what leads on, so that every state is visited often, sometimes what leads
//! nowhere, and sometimes a fault.

use adsdv_spec::messages::{DirectionRequest, MissionStatus};
use adsdv_spec::{AiSilence, AsState, Atom, Control, Inputs, Machine};

use super::rng::Rng;
use crate::protocol::{Domain, Protocol};
use crate::suite::{Scenario, Step};

/// A scenario has so many moves at least, and at most twice as many.
const MOVES: usize = 12;
/// A scenario does not go on after so many steps.
const STEPS: usize = 20_000;
/// Of a hundred moves so many try to leave the state.
const LEAD: usize = 55;
/// Of a hundred of those so many to EMERGENCY_BRAKE.
const BRAKE: usize = 18;
/// More of them where more ways than so many lead there, as many as from AS_DRIVING in version 3.0.
const WAYS: usize = 7;
/// And so many more moves change an input.
const CHANGE: usize = 30;
/// Of a hundred moves so many begin with all messages there, if any was missing.
const MESSAGES_COME: usize = 75;
/// The part of the inputs that tells how long messages have been missing.
const SILENCE: &str = "ai_silence";

/// Someone who walks through the states of a machine.
#[derive(Debug)]
pub(super) struct Walker<'a> {
    machine: &'a Machine,
    /// The values that the inputs may have.
    protocol: Protocol,
    /// The time between two steps, if it is always the same.
    cycle_ms: Option<u32>,
    rng: Rng,
    control: Control,
    inputs: Inputs,
    steps: Vec<Step>,
}

impl<'a> Walker<'a> {
    pub(super) fn new(machine: &'a Machine, cycle_ms: Option<u32>, rng: Rng) -> Self {
        let (control, inputs) = (Control::INITIAL, Inputs::default());
        let protocol = Protocol::of(machine.edition());
        Self { machine, protocol, cycle_ms, rng, control, inputs, steps: Vec::new() }
    }

    /// The steps of a whole walk.
    pub(super) fn scenario(mut self) -> Scenario {
        for _ in 0..MOVES + self.rng.below(MOVES) {
            if self.steps.len() >= STEPS {
                break;
            }
            self.messages_come();
            self.drive_on();
            match self.rng.below(100) {
                kind if kind < LEAD => self.lead(),
                kind if kind < LEAD + CHANGE => self.change(),
                _ => self.wait(),
            }
        }
        Scenario { steps: self.steps }
    }

    /// Lets messages that are missed come again, as a rule: else hardly anything but AI_COMMS_LOST would be seen.
    fn messages_come(&mut self) {
        if self.inputs.ai_silence != AiSilence::default() && self.rng.percent(MESSAGES_COME) {
            self.inputs.ai_silence = AiSilence::default();
        }
    }

    /// Asks for FORWARD, as an AI Computer that drives does: else NEUTRAL at speed would hide what else ends AS_DRIVING. Where
    /// brakes and messages end it too; the walks of version 3.0 stay what they are.
    fn drive_on(&mut self) {
        let hides =
            self.control.state == AsState::Driving && self.machine.scope().has(Atom::BrakeRequestZero);
        if hides && self.rng.percent(70) {
            self.inputs.ai.status.direction_request = DirectionRequest::Forward;
        }
    }

    /// Takes away what would lead to EMERGENCY_BRAKE first.
    fn calm(&mut self) {
        self.show(Atom::SdcOpen, false);
        self.show(Atom::AiEstop, false);
        for (atom, value) in
            [(Atom::AiMessagesMissed, false), (Atom::BrakeRequestZero, true), (Atom::EbsUnavailable, false)]
        {
            if self.machine.scope().has(atom) {
                self.show(atom, value);
            }
        }
    }

    /// One message has been missing for about as long as counts; false where the edition does not watch them.
    fn miss_a_message(&mut self) -> bool {
        let Some(limit) = self.machine.edition().rules.thresholds.missed_ms.map(i32::from) else {
            return false;
        };
        let silences: Vec<_> =
            self.protocol.inputs().map(|(field, _)| field).filter(|field| field.part == SILENCE).collect();
        let around = [limit - 1, limit, limit, limit + 1];
        if let (Some(field), Some(silence)) = (self.rng.pick(&silences), self.rng.pick(&around)) {
            (field.set)(&mut self.inputs, silence);
        }
        true
    }

    /// Does what one of the arrows asks for.
    fn lead(&mut self) {
        let (machine, needed) = (self.machine, self.control.power_cycle_needed);
        let table = &machine.edition().rules.table;
        let arrows = machine
            .arrows(self.control.state)
            .filter_map(|taken| Some((taken.row(table)?.to, *taken.term(table)?)));
        let open = arrows.filter(|(_, term)| !(needed && term.off.has(Atom::PowerCycleNeeded)));
        let (brake, calm): (Vec<_>, Vec<_>) = open.partition(|(to, _)| *to == AsState::EmergencyBrake);
        // What leads on is left for AS_OFF only at times.
        let on: Vec<_> = calm.iter().copied().filter(|(to, _)| *to != AsState::Off).collect();
        let calm = if on.is_empty() || self.rng.percent(12) { calm } else { on };
        let often = BRAKE.max(BRAKE * brake.len() / WAYS);
        let from =
            if calm.is_empty() || (self.rng.percent(often) && !brake.is_empty()) { &brake } else { &calm };
        let Some((to, term)) = self.rng.pick(from) else { return self.change() };
        if to != AsState::EmergencyBrake {
            self.calm();
        }
        term.literals().for_each(|(atom, value)| self.show(atom, value));
        if term.on.has(Atom::MissionFinishedEdge) {
            self.inputs.ai.status.mission_status = MissionStatus::Running;
            self.step(10, true);
            self.show(Atom::MissionFinished, true);
        }
        if term.on.has(Atom::DirectionNeutralEdge) {
            self.inputs.ai.status.direction_request = DirectionRequest::Forward;
            self.step(10, true);
            self.show(Atom::DirectionNeutral, true);
        }
        if term.on.has(Atom::GoEdge) {
            self.inputs.go = false;
        }
        let left = self.left();
        if left > 0 && (term.on.has(Atom::DwellElapsed) || term.on.has(Atom::EbsTimerComplete)) {
            let around = [left, left, left, left.saturating_sub(1), left + 1];
            let dt_ms = self.rng.pick(&around).unwrap_or(left);
            self.step(dt_ms, true);
        }
        if term.on.has(Atom::GoEdge) {
            if !self.control.go_seen_low {
                self.step(10, true);
            }
            self.inputs.go = true;
            if self.rng.percent(80) {
                self.inputs.ai.status.mission_status = MissionStatus::Running;
            }
        }
        let messages = term.on.has(Atom::AiCommsLost)
            && self.machine.scope().has(Atom::AiMessagesMissed)
            && self.rng.percent(50)
            && self.miss_a_message();
        if messages {
            self.inputs.tsms = true;
            self.step(10, true);
        } else if term.on.has(Atom::AiCommsLost) {
            self.inputs.tsms = true;
            self.step(10, false);
            let limit = u32::from(self.machine.edition().rules.timing.handshake_ms);
            let dt_ms = self.rng.pick(&[limit.saturating_sub(1), limit, limit, limit + 1]).unwrap_or(limit);
            self.step(dt_ms, false);
        } else {
            let dt_ms = self.rng.pick(&[10, 10, 10, 0, 1, 20]).unwrap_or(10);
            self.step(dt_ms, true);
        }
    }

    /// Changes an input: seldom to a fault.
    fn change(&mut self) {
        let faults = self.rng.percent(15);
        let fields: Vec<_> = self
            .protocol
            .inputs()
            .filter(|(field, _)| field.key != "handshake")
            .filter(|(field, _)| {
                faults || !(matches!(field.part, "sdc" | "reports") || field.key == "estop_request")
            })
            .collect();
        for _ in 0..=self.rng.below(3) {
            let Some((field, domain)) = self.rng.pick(&fields) else { return };
            let raw = match domain {
                Domain::Flag => i32::from(self.rng.percent(if faults { 50 } else { 75 })),
                Domain::Names(names) => self.rng.pick(names).map_or(0, |(raw, _)| raw),
                Domain::Number { .. } if field.part == SILENCE => self.silence(),
                Domain::Number { min, max } => self.number(min, max),
            };
            // What is out of its range changes nothing.
            if domain.has(raw) {
                (field.set)(&mut self.inputs, raw);
            }
        }
        let answers = self.rng.percent(95);
        self.step(10, answers);
    }

    /// How long a message has been missing: mostly not at all, then about as long as counts.
    fn silence(&mut self) -> i32 {
        let limit = self.machine.edition().rules.thresholds.missed_ms.map_or(0, i32::from);
        self.rng.pick(&[0, 0, 0, 0, 0, 1, limit - 1, limit - 1, limit, limit + 1]).unwrap_or(0)
    }

    /// A number of a field: mostly one where something begins to count.
    fn number(&mut self, min: i32, max: i32) -> i32 {
        let thresholds = &self.machine.edition().rules.thresholds;
        let (straight, speed) = (thresholds.straight.raw(), thresholds.wheel_speed.raw());
        let around = [
            min,
            max,
            0,
            0,
            1,
            -1,
            speed - 1,
            speed,
            speed + 1,
            straight - 1,
            straight,
            straight + 1,
            1 - straight,
            -straight,
        ];
        if self.rng.percent(80) {
            self.rng.pick(&around).unwrap_or(0).clamp(min, max)
        } else {
            let span = usize::try_from(max.saturating_sub(min)).unwrap_or(0);
            min.saturating_add(i32::try_from(self.rng.below(span + 1)).unwrap_or(0))
        }
    }

    /// Lets time pass: around a limit.
    fn wait(&mut self) {
        let (left, handshake) = (self.left(), u32::from(self.machine.edition().rules.timing.handshake_ms));
        let times =
            [0, 1, 10, handshake - 1, handshake, handshake + 1, left.saturating_sub(1), left, left + 1];
        let dt_ms = self.rng.pick(&times).unwrap_or(10);
        let answers = self.rng.percent(85);
        self.step(dt_ms, answers);
    }

    /// How long the state has to last before it can be left in time.
    fn limit(&self) -> u32 {
        self.machine.edition().rules.timing.in_state_limit(self.control.state).into()
    }

    /// How much of that is left.
    fn left(&self) -> u32 {
        self.limit().saturating_sub(self.control.in_state_ms.into())
    }

    fn show(&mut self, atom: Atom, value: bool) {
        self.inputs.show(atom, value, &self.machine.edition().rules.thresholds);
    }

    /// Steps, in cycles if they are fixed. The AI Computer answers the handshake, or does not.
    fn step(&mut self, dt_ms: u32, answers: bool) {
        let (count, dt_ms) = match self.cycle_ms {
            Some(cycle_ms) => (dt_ms.div_ceil(cycle_ms.max(1)).max(1), cycle_ms),
            None => (1, dt_ms),
        };
        for _ in 0..count {
            self.inputs.ai.status.handshake = self.control.handshake.bit == answers;
            self.control = self.machine.step(&self.control, &self.inputs, dt_ms).0;
            self.steps.push(Step { dt_ms, inputs: self.inputs });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;
    use std::fmt::Write as _;
    use std::hash::Hasher as _;

    use adsdv_spec::{Edition, Readings};
    use expect_test::expect;
    use fnv::FnvHasher;

    use super::*;
    use crate::protocol::InputsAsJson;

    #[test]
    fn every_state_and_every_row_is_visited_often() {
        for edition in Edition::ALL {
            visits(&Machine::new(**edition, edition.readings));
        }
    }

    fn visits(machine: &Machine) {
        for cycle_ms in [None, Some(10)] {
            let (mut states, mut rows) = (HashMap::new(), HashMap::new());
            for run in 0..500 {
                let scenario = Walker::new(machine, cycle_ms, Rng::new(1, run)).scenario();
                let mut last = AsState::Off;
                for (control, outputs) in scenario.run(machine) {
                    if control.state != last {
                        *states.entry(control.state).or_insert(0) += 1;
                    }
                    last = control.state;
                    if let Some(taken) = outputs.taken {
                        *rows.entry((taken.row, taken.term)).or_insert(0) += 1;
                    }
                }
            }
            let terms = AsState::ALL.iter().flat_map(|&state| machine.arrows(state));
            let never: Vec<_> = terms
                .filter(|taken| !is_never_first(machine, *taken))
                .filter(|taken| rows.get(&(taken.row, taken.term)).is_none_or(|&count| count < 5))
                .collect();
            assert!(never.is_empty(), "{cycle_ms:?}: {never:?}: {rows:?}");
            assert!(
                states.len() == 5 && states.values().all(|&count| count > 60),
                "{cycle_ms:?}: {states:?}"
            );
        }
    }

    /// Whether an alternative stands behind one of the same row that holds whenever it does: by default a fault of the battery
    /// opens the circuit.
    fn is_never_first(machine: &Machine, taken: adsdv_spec::Taken) -> bool {
        let table = &machine.edition().rules.table;
        taken.term(table).is_some_and(|term| term.on == adsdv_spec::Atoms::of(&[Atom::BmsFault]))
    }

    /// What version 4.0 has and 3.0 has not is met often, and does not drown everything else.
    #[test]
    fn each_fault_that_ends_driving_is_met_often_and_none_drowns_the_others() {
        let machine = Machine::new(Edition::V4_0, Edition::V4_0.readings);
        let mut causes = HashMap::new();
        for run in 0..1000 {
            let scenario = Walker::new(&machine, None, Rng::new(1, run)).scenario();
            let mut last = AsState::Off;
            for (control, outputs) in scenario.run(&machine) {
                if control.state == AsState::EmergencyBrake && last == AsState::Driving {
                    *causes.entry(outputs.shutdown_cause).or_insert(0) += 1;
                }
                last = control.state;
            }
        }
        let all: usize = causes.values().sum();
        let table = &machine.edition().rules.table;
        let faults = machine.arrows(AsState::Driving).filter_map(|taken| taken.term(table)?.fault);
        for fault in faults {
            let times = causes.get(&fault.cause()).copied().unwrap_or(0);
            assert!(times >= 5 && times * 2 < all, "{fault}: {times} of {all}: {causes:?}");
        }
    }

    #[test]
    fn the_same_seed_is_the_same_walk_and_another_is_another() {
        let machine = Machine::REFERENCE;
        let walk = |seed, run| Walker::new(&machine, None, Rng::new(seed, run)).scenario();
        assert_eq!(walk(7, 3), walk(7, 3));
        assert_ne!(walk(7, 3), walk(7, 4));
        assert_ne!(walk(7, 3), walk(8, 3));
    }

    #[test]
    fn at_a_fixed_cycle_every_step_takes_it() {
        let machine = Machine::REFERENCE;
        let scenario = Walker::new(&machine, Some(20), Rng::new(0, 0)).scenario();
        assert!(scenario.steps.iter().all(|step| step.dt_ms == 20));
    }

    /// What is found with a seed is found with it again, on every machine: another walk is a change that the changelog names.
    #[test]
    fn the_walks_of_a_seed_are_these() {
        let readings = Edition::V3_0.choices.iter().fold(Readings::DEFAULT, Readings::with);
        let other = Machine::new(*Edition::DEFAULT, readings);
        let mut text = String::new();
        for (machine, cycle_ms) in
            [(&Machine::REFERENCE, None), (&Machine::REFERENCE, Some(10)), (&other, None), (&other, Some(50))]
        {
            let (mut sum, mut steps) = (FnvHasher::default(), 0);
            for run in 0..200 {
                let scenario = Walker::new(machine, cycle_ms, Rng::new(1, run)).scenario();
                steps += scenario.steps.len();
                for step in &scenario.steps {
                    sum.write(format!("{} {}\n", step.dt_ms, InputsAsJson(step.inputs)).as_bytes());
                }
            }
            let _ = writeln!(text, "{cycle_ms:?}: {steps} steps, {:016X}", sum.finish());
        }
        expect![[r"
            None: 3988 steps, 986DC06D91E4392F
            Some(10): 363831 steps, 8C3D6C767D267F00
            None: 4210 steps, 804BDF964887A243
            Some(50): 116868 steps, 3A26165977378DBC
        "]]
        .assert_eq(&text);
    }
}
