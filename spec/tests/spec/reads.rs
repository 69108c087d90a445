//! What a step reads is all that it depends on.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{
    AsState, Atom, Atoms, Choice, Control, Edition, Faults, Handshake, Machine, Observation, Reading,
    Readings, Taken,
};

use crate::random::Random;

impl Random {
    fn flag(&mut self) -> bool {
        self.next() & 64 == 64
    }

    fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.next() >> 16).unwrap_or_default() % limit
    }

    /// A time from 0 to a limit, often near to one of them.
    fn time(&mut self, limit: u16) -> u16 {
        let near = u16::try_from(self.below(40)).unwrap_or_default();
        match self.below(3) {
            0 => near.min(limit),
            1 => limit.saturating_sub(near),
            _ => u16::try_from(self.below(usize::from(limit) + 1)).unwrap_or_default(),
        }
    }

    /// A control state that keeps the invariant.
    fn control(&mut self, machine: &Machine) -> Control {
        let timing = &machine.edition().rules.timing;
        loop {
            let state = AsState::ALL[self.below(AsState::ALL.len())];
            let active = self.flag();
            let control = Control {
                state,
                in_state_ms: self.time(timing.in_state_limit(state)),
                go_seen_low: self.flag(),
                was_running: self.flag(),
                was_forward: self.flag(),
                handshake: Handshake {
                    active,
                    bit: active && self.flag(),
                    unanswered_ms: if active { self.time(timing.handshake_ms) } else { 0 },
                },
                power_cycle_needed: self.flag(),
                shutdown_cause: ShutdownCause::ALL[self.below(ShutdownCause::ALL.len())],
            };
            if control.is_consistent(timing, machine.readings()) {
                return control;
            }
        }
    }

    fn observation(&mut self) -> Observation {
        // Half of the conditions hold, or nearly all do: otherwise no arrow of many conditions is ever taken.
        let mut some = || {
            let (one, other) = (self.next(), self.next());
            if self.flag() { one } else { one | other | self.next() }
        };
        let mut atoms = Atoms::ALL.iter().collect::<Vec<_>>();
        let bits = some();
        atoms.retain(|&atom| bits >> (atom as u8) & 1 == 1);
        let faults = if self.flag() { 0 } else { self.next() & self.next() };
        let faults = Faults::ALL.iter().filter(|&fault| faults >> fault as u8 & 1 == 1);
        Observation::new(Atoms::of(&atoms), faults.fold(Faults::NONE, Faults::with))
    }
}

#[test]
fn a_step_depends_on_nothing_but_what_it_reads() {
    let mut random = Random::with_seed(0x0A15_D5DE);
    let machines: Vec<Machine> = Edition::ALL
        .iter()
        .flat_map(|edition| {
            edition.choices.combinations(Reading::ALL).map(|readings| Machine::new(**edition, readings))
        })
        .collect();
    let mut taken = 0;
    for round in 0..1_000_000 {
        let machine = &machines[round % machines.len()];
        let (control, seen) = (random.control(machine), random.observation());
        let dt_ms = [10, 10, 1, 25, 5000, 20_000][random.below(6)];
        let reads = machine.reads(&control, dt_ms);
        assert!(reads.atoms.is_subset(machine.scope()), "{reads:?}");
        let all = machine.react(&control, seen, dt_ms);
        let read = machine.react(&control, reads.of(seen), dt_ms);
        assert_eq!(
            (all.control, all.taken),
            (read.control, read.taken),
            "{}\n{control:?}\nafter {dt_ms} ms sees {seen:?}\nreads {reads:?}",
            machine.readings()
        );
        taken += usize::from(all.taken.is_some());
    }
    assert!(taken > 100_000, "only {taken} steps took an arrow: they are too alike");
}

#[test]
fn what_cannot_matter_is_not_read() {
    use adsdv_spec::Atom::{Asms, EbsArmed, FrontTorqueZero, GoOn};
    let machine = Machine::REFERENCE;
    let reads = |state, in_state_ms| {
        let control = Control { state, in_state_ms, ..Control::INITIAL };
        machine.reads(&control, u32::from(Edition::V3_0.rules.timing.cycle_ms)).atoms
    };
    let limit = |state| Edition::V3_0.rules.timing.in_state_limit(state);
    assert!(!reads(AsState::Ready, 0).has(FrontTorqueZero), "the dwell is not over");
    assert!(reads(AsState::Ready, limit(AsState::Ready)).has(FrontTorqueZero));
    assert!(!reads(AsState::EmergencyBrake, 0).has(Asms), "the EBS timer is not complete");
    assert!(reads(AsState::EmergencyBrake, limit(AsState::EmergencyBrake)).has(Asms));
    assert!(reads(AsState::Driving, 0).has(GoOn) && !reads(AsState::Driving, 0).has(EbsArmed));
    let latched = Control { power_cycle_needed: true, ..Control::INITIAL };
    assert!(!machine.reads(&latched, 10).atoms.has(EbsArmed), "AS_OFF cannot be left");
}

/// What is possible is asked of one alternative, or of all: the answers are the same.
#[test]
fn the_possible_alternatives_are_those_of_which_each_is_possible() {
    let mut random = Random::with_seed(0x0A15_D5DF);
    let (mut open, mut all) = (0, 0);
    let machines = Edition::ALL.iter().flat_map(|edition| {
        edition.choices.combinations(Reading::ALL).map(|readings| Machine::new(**edition, readings))
    });
    for machine in machines {
        let (edition, readings) = (machine.edition(), machine.readings());
        for _ in 0..20 {
            let control = random.control(&machine);
            let dt_ms = [10, 5000][random.below(2)];
            let listed: Vec<_> = machine.possible(&control, dt_ms).collect();
            let mut asked = Vec::new();
            for (row, def) in (0..).zip(edition.rules.table.rows()) {
                for (term, alternative) in (0..).zip(def.terms()) {
                    if machine.is_possible(&control, dt_ms, Taken { row, term }) {
                        asked.push((def, alternative));
                    }
                    all += 1;
                }
            }
            // A reading may change their order.
            assert_eq!(asked.len(), listed.len(), "{readings}\n{control:?}");
            assert!(asked.iter().all(|one| listed.contains(one)), "{readings}\n{control:?}");
            open += asked.len();
        }
    }
    assert!(open > 0 && open < all, "{open} of {all}");
    for nowhere in [Taken { row: 200, term: 0 }, Taken { row: 0, term: 200 }] {
        assert!(!Machine::REFERENCE.is_possible(&Control::INITIAL, 10, nowhere));
    }
}

#[test]
fn an_edge_is_decided_by_an_input_together_with_the_memory() {
    let inputs = [
        (Atom::GoEdge, Atom::GoOn),
        (Atom::MissionFinishedEdge, Atom::MissionFinished),
        (Atom::DirectionNeutralEdge, Atom::DirectionNeutral),
    ];
    for atom in Atoms::ALL.iter() {
        let input = inputs.iter().find(|(edge, _)| *edge == atom).map(|(_, input)| *input);
        assert_eq!(atom.input(), input, "{atom}");
    }
}

/// What no arrow asks for is read only where it is remembered.
#[test]
fn a_step_reads_no_more_than_it_remembers() {
    let reads = |state, choice| {
        let machine = Machine::new(Edition::V3_0, Readings::DEFAULT.with(choice));
        machine.reads(&Control { state, ..Control::INITIAL }, 10).atoms
    };
    for state in AsState::ALL {
        assert!(!reads(state, Choice::FaultLevel).has(Atom::MissionRunning), "{state}: the level counts");
        let driving = state == AsState::Driving;
        assert_eq!(reads(state, Choice::FaultEdge).has(Atom::MissionRunning), driving, "{state}");
    }
    assert!(!reads(AsState::Off, Choice::FaultLevel).has(Atom::DirectionNeutral));
}
