//! The switches and the remote control, and what kind of operator moves them.

use adsdv_spec::messages::AmiState;

use super::Act;

/// Who moves the switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operator {
    /// Follows the procedure of sections 3.1 to 3.4, one act in a cycle of the VCU, each without much delay: mission,
    /// TSMS, ASMS and EBS in any order; in AS_READY "Go" off where it is found on (DRV-13), and on after the dwell; ASMS
    /// off after AS_FINISHED.
    WellBehaved,
    /// Moves any switch at any time, one of them, or the fault, in a cycle of the VCU: the open model has all at once. Only
    /// the VCU sees the switches, at its step, so that an act comes last in its cycle.
    Any,
}

/// The switches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Switches {
    /// The Autonomous System Master Switch.
    pub asms: bool,
    /// The Tractive System Master Switch.
    pub tsms: bool,
    /// The mission selected on the Autonomous Mission Indicator.
    pub ami: AmiState,
    /// The Emergency Braking System is armed.
    pub ebs_armed: bool,
    /// The remote "Go" switch.
    pub go: bool,
}

impl Switches {
    pub(super) const fn turn(&mut self, act: Act) {
        match act {
            Act::Mission(mission) => self.ami = mission,
            Act::Tsms(on) => self.tsms = on,
            Act::Asms(on) => self.asms = on,
            Act::EbsArmed(on) => self.ebs_armed = on,
            Act::Go(on) => self.go = on,
        }
    }
}
