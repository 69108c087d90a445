//! Paths, written down as changes of what the VCU sees; and their logs, judged.

use adsdv_model::{Action, Run};
use adsdv_oracle::candump::write_frame;
use adsdv_oracle::judge::{Finding, JudgeOptions, Party, Report, Severity};
use adsdv_oracle::log::{LogOptions, judge_log};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Choice, Control, Edition, Fault, Faults, Machine, Observation, Readings};

/// The cycle in milliseconds.
pub(crate) const CYCLE_MS: u32 = Edition::DEFAULT.rules.timing.cycle_ms as u32;

/// A path under construction: a vehicle whose AI Computer answers the handshake, until it does not.
#[derive(Clone)]
pub(crate) struct Path {
    pub(crate) machine: Machine,
    pub(crate) control: Control,
    pub(crate) actions: Vec<Action>,
    pub(crate) answers: bool,
    atoms: Atoms,
    faults: Faults,
}

impl Path {
    /// The vehicle at rest, with every switch off.
    pub(crate) fn new(machine: &Machine) -> Self {
        let atoms = Atoms::of(&[
            Atom::FrontTorqueZero,
            Atom::RearTorqueZero,
            Atom::SteerRequestZero,
            Atom::SteerStraight,
            Atom::DirectionNeutral,
            Atom::AtRest,
        ]);
        let control = Control::INITIAL;
        Self { machine: *machine, control, actions: Vec::new(), answers: true, atoms, faults: Faults::NONE }
    }

    pub(crate) fn on(&mut self, atoms: &[Atom]) -> &mut Self {
        self.atoms = self.atoms.union(Atoms::of(atoms));
        self
    }

    pub(crate) fn off(&mut self, atoms: &[Atom]) -> &mut Self {
        self.atoms = self.atoms.difference(Atoms::of(atoms));
        self
    }

    pub(crate) fn fault(&mut self, fault: Fault) -> &mut Self {
        self.faults = self.faults.with(fault);
        self
    }

    /// One cycle with what is seen now.
    pub(crate) fn cycle(&mut self) {
        let bit = self.control.handshake.bit == self.answers;
        let atoms = self.atoms.union(Atoms::when(Atom::AiHandshake, bit));
        let seen = Observation::new(atoms, self.faults);
        assert!(seen.is_possible(), "inputs can show {atoms}");
        self.control = self.machine.react(&self.control, seen, CYCLE_MS).control;
        self.actions.push(Action::Step(seen));
    }

    pub(crate) fn hold(&mut self, ms: u32) -> &mut Self {
        (0..ms / CYCLE_MS).for_each(|_| self.cycle());
        self
    }

    pub(crate) fn power_cycle(&mut self) -> &mut Self {
        *self = Self { actions: std::mem::take(&mut self.actions), ..Self::new(&self.machine) };
        self.actions.push(Action::PowerCycle);
        self
    }

    /// To AS_READY.
    pub(crate) fn ready(&mut self) -> &mut Self {
        self.on(&[Atom::Tsms, Atom::AmiSelected, Atom::EbsArmed]).hold(400);
        self.on(&[Atom::MissionSelected]).hold(100);
        self.on(&[Atom::Asms]).hold(100);
        self.arrives(AsState::Ready)
    }

    /// To AS_DRIVING, with the wheels turning.
    pub(crate) fn driving(&mut self) -> &mut Self {
        self.ready().hold(5000);
        self.on(&[Atom::GoOn]).hold(100);
        self.off(&[Atom::MissionSelected, Atom::DirectionNeutral]).on(&[Atom::MissionRunning]).hold(100);
        self.off(&[Atom::AtRest]).on(&[Atom::Moving]).hold(1000);
        self.arrives(AsState::Driving)
    }

    pub(crate) fn arrives(&mut self, state: AsState) -> &mut Self {
        assert_eq!(self.control.state, state);
        self
    }

    pub(crate) fn run(&self) -> Run {
        Run::new(&self.machine, self.actions.iter().copied())
    }

    /// What the judge says of the log of this path, and of its aftermath. It knows which readings the VCU follows.
    pub(crate) fn judged(&self) -> Report {
        judged(&self.run().persisting(Run::AFTERMATH_MS), self.machine.readings())
    }
}

/// The reference VCU with one choice made otherwise.
pub(crate) fn with_choice(choice: Choice) -> Machine {
    Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice))
}

/// What the judge says of the log of a run, of a VCU that is to follow these readings.
pub(crate) fn judged(run: &Run, readings: Readings) -> Report {
    let mut log = Vec::new();
    for (t_ns, frame) in run.frames() {
        write_frame(&mut log, t_ns, "vcan0", frame.id.into(), frame.data()).expect("memory takes it all");
    }
    let judge = JudgeOptions { readings: readings.choices(), ..JudgeOptions::default() };
    let options = LogOptions { judge, ..LogOptions::default() };
    judge_log(log.as_slice(), &options, |_| {}).expect("what was written is read")
}

/// The violations that the judge lays to the VCU.
pub(crate) fn blamed(report: &Report) -> Vec<&Finding> {
    report
        .findings
        .iter()
        .filter(|finding| finding.party == Party::Vcu && finding.severity == Severity::Violation)
        .collect()
}
