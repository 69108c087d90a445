//! The way back from an observation to inputs: making a fault be seen, or all that a step reads.
//!
//! [`Inputs::observe`] reduces inputs to atoms and faults. Here inputs are changed so that they are reduced to the ones
//! that are wanted, by as little as that takes; [`Inputs::show`] does so for a single atom.

use crate::atoms::Atom;
use crate::faults::{Fault, Faults};
use crate::inputs::{Inputs, ShutdownCircuit};
use crate::limits::Thresholds;
use crate::observation::Observation;
use crate::reads::Reads;

impl Inputs {
    /// Changes the inputs so that a fault of [`Observation::FAULTS`] is present, or is not.
    ///
    /// A fault that is so already changes nothing. [`Fault::HvilOpenFault`] comes as an open circuit that is reported,
    /// and goes with all that can be its cause. [`Fault::ChargeProcedureFault`] is a battery that is being charged: it
    /// is present only once a master switch is on, and switches stay as they are.
    ///
    /// Faults that a step finds out (those of the handshake, of NEUTRAL and of FINISHED while moving) are none of the
    /// inputs' making: nothing changes.
    pub const fn show_fault(&mut self, fault: Fault, value: bool) {
        if self.faults().has(fault) == value {
            return;
        }
        match fault {
            Fault::AiComputerRequest => self.ai.status.estop_request = value,
            Fault::HvilOpenFault => {
                let ShutdownCircuit { bms_fault, .. } = self.sdc;
                self.reports.hvil_open = value;
                self.sdc = ShutdownCircuit { bms_fault, ..CLOSED };
            }
            Fault::HvilShortFault => self.reports.hvil_short = value,
            Fault::EbsFault => self.reports.ebs_fault = value,
            Fault::OffboardChargerFault => self.reports.offboard_charger_fault = value,
            Fault::ChargeProcedureFault => self.reports.charging = value,
            Fault::BmsFault => self.sdc.bms_fault = value,
            Fault::AiCommsFault
            | Fault::AutonomousBrakingFault
            | Fault::MissionStatusFault
            | Fault::BrakePlausibilityFault => {}
        }
    }

    /// Takes away every fault that opens the shutdown circuit.
    pub(crate) const fn close_circuit(&mut self) {
        let mut i = 0;
        while i < Fault::ALL.len() {
            if Faults::OPENING.has(Fault::ALL[i]) {
                self.show_fault(Fault::ALL[i], false);
            }
            i += 1;
        }
    }

    /// The inputs nearest to these that look like `seen` in everything that is read.
    ///
    /// What is not read stays as it is, but where what is read takes it along: conditions that exclude each other, and
    /// a master switch without which charging is no fault.
    ///
    /// `reads.of(inputs.observe(thresholds))` is `reads.of(seen)` for every `seen` that [is
    /// possible](Observation::is_possible), where the thresholds have values on both sides. Of what excludes each other
    /// in a `seen` that is not, the last one in the order of [`Atom::ALL`] is shown.
    ///
    /// ```
    /// use adsdv_spec::{Atom, Atoms, Control, Faults, Inputs, Machine, Observation};
    /// let vcu = Machine::REFERENCE;
    /// let thresholds = vcu.edition().rules.thresholds;
    /// let reads = vcu.reads(&Control::INITIAL, 10);
    /// let seen = Observation::new(Atoms::of(&[Atom::Asms, Atom::EbsArmed]), Faults::NONE);
    /// let inputs = Inputs { go: true, ..Inputs::default() }.showing(seen, &reads, &thresholds);
    /// assert_eq!(reads.of(inputs.observe(&thresholds)), reads.of(seen));
    /// assert!(inputs.go); // AS_OFF does not read it
    /// ```
    #[must_use]
    pub fn showing(mut self, seen: Observation, reads: &Reads, thresholds: &Thresholds) -> Self {
        for atom in reads.atoms.difference(Observation::OF_FAULTS).iter() {
            self.show(atom, seen.atoms().has(atom), thresholds);
        }
        for fault in reads.faults.iter() {
            self.show_fault(fault, seen.faults().has(fault));
        }
        let charging = Fault::ChargeProcedureFault;
        if reads.faults.has(charging) && self.faults().has(charging) != seen.faults().has(charging) {
            // Both switches are off, at least one of them because nobody reads it.
            self.asms = seen.atoms().has(Atom::Asms);
            self.tsms = seen.atoms().has(Atom::Tsms);
        }
        self
    }
}

/// Nothing opens the shutdown circuit.
const CLOSED: ShutdownCircuit = ShutdownCircuit {
    remote_estop: false,
    res_link_lost: false,
    vehicle_estop: false,
    crash_sensor: false,
    critical_fault: false,
    bms_fault: false,
    mpp_dongle_removed: false,
};
