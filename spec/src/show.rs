//! The way back from conditions to inputs: making an atom or a fault be seen.
//!
//! [`Inputs::observe`] reduces inputs to atoms and faults. Here inputs are changed so that they are reduced to the ones
//! that are wanted: by as little as that takes, and where a threshold decides, to the value next to it.

use crate::atoms::Atom;
use crate::edition::Thresholds;
use crate::faults::{Fault, Faults};
use crate::inputs::{Inputs, ShutdownCircuit};
use crate::messages::{
    AmiState, AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState, MissionStatus, SteerAngle,
    Vcu2AiWheelSpeeds, WheelSpeed,
};
use crate::observation::Observation;
use crate::reads::Reads;
use crate::silence::AiSilence;

impl Inputs {
    /// Changes the inputs so that an atom of [`Observation::SCOPE`] holds, or does not.
    ///
    /// An atom that has this value already changes nothing. Where a threshold decides, the new value is the one next to
    /// it: for all four wheels, and for a steer angle to the left. An open shutdown circuit is an open circuit that is
    /// reported, and to close it takes away every fault that opens it.
    ///
    /// Some atoms exclude each other. `MISSION_STATUS` has one value: making one of its atoms hold ends the other two,
    /// and making one not hold leaves NOT SELECTED. The Emergency Braking System that is made not armed is unavailable,
    /// and one that is made not unavailable is triggered. Likewise one of [`Atom::Moving`] and [`Atom::AtRest`] ends the
    /// other, and making it not hold leaves the limit itself, which is neither. A master switch that is turned on while
    /// the battery is being charged is a fault that opens the shutdown circuit.
    ///
    /// Atoms that the VCU's memory decides are none of the inputs' making: nothing changes.
    ///
    /// ```
    /// use adsdv_spec::{Atom, Inputs, Edition};
    /// let thresholds = Edition::V3_0.rules.thresholds;
    /// let mut inputs = Inputs::default();
    /// inputs.show(Atom::Moving, true, &thresholds);
    /// assert_eq!(inputs.vehicle.wheel_speeds.fl_wheel_speed.raw(), 11); // the slowest that is moving
    /// assert!(inputs.observe(&thresholds).atoms().has(Atom::Moving));
    /// ```
    pub const fn show(&mut self, atom: Atom, value: bool, thresholds: &Thresholds) {
        if self.observe(thresholds).atoms().has(atom) == value {
            return;
        }
        let limit = thresholds.wheel_speed.raw();
        let ai = &mut self.ai;
        match atom {
            Atom::SdcOpen if value => self.reports.hvil_open = true,
            Atom::SdcOpen => self.close_circuit(),
            Atom::Asms => self.asms = value,
            Atom::Tsms => self.tsms = value,
            Atom::AmiSelected => self.ami = if value { AmiState::TrackDrive } else { AmiState::NotSelected },
            Atom::MissionSelected => ai.status.mission_status = mission(MissionStatus::Selected, value),
            Atom::MissionRunning => ai.status.mission_status = mission(MissionStatus::Running, value),
            Atom::MissionFinished => ai.status.mission_status = mission(MissionStatus::Finished, value),
            Atom::EbsArmed => self.ebs = if value { EbsState::Armed } else { EbsState::Unavailable },
            Atom::FrontTorqueZero => {
                ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(least(value));
            }
            Atom::RearTorqueZero => {
                ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(least(value));
            }
            Atom::SteerRequestZero => ai.steer.steer_request = SteerAngle::clamped(least(value)),
            Atom::SteerStraight => {
                let straight = thresholds.straight.raw() - value as i32;
                self.vehicle.steer_angle = SteerAngle::clamped(straight);
            }
            Atom::DirectionNeutral => {
                ai.status.direction_request =
                    if value { DirectionRequest::Neutral } else { DirectionRequest::Forward };
            }
            Atom::GoOn => self.go = value,
            Atom::Moving => self.vehicle.wheel_speeds = all_wheels(limit + value as i32),
            Atom::AtRest => self.vehicle.wheel_speeds = all_wheels(limit - value as i32),
            Atom::BrakeRequestZero => {
                ai.brake.hyd_press_f_req = BrakePressure::clamped(least(value));
                ai.brake.hyd_press_r_req = BrakePressure::clamped(0);
            }
            Atom::EbsUnavailable => {
                self.ebs = if value { EbsState::Unavailable } else { EbsState::Triggered }
            }
            Atom::AiMessagesMissed => {
                let silence_ms = match thresholds.missed_ms {
                    Some(limit_ms) if value => limit_ms,
                    Some(limit_ms) => limit_ms.saturating_sub(1),
                    None => 0,
                };
                self.ai_silence = AiSilence::of(silence_ms);
            }
            Atom::BmsFault => self.show_fault(Fault::BmsFault, value),
            Atom::AiHandshake => ai.status.handshake = value,
            Atom::AiEstop => ai.status.estop_request = value,
            Atom::EbsTimerComplete
            | Atom::MissionFinishedEdge
            | Atom::DwellElapsed
            | Atom::DirectionNeutralEdge
            | Atom::GoEdge
            | Atom::AiCommsLost
            | Atom::PowerCycleNeeded => {}
        }
    }

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
    const fn close_circuit(&mut self) {
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

const fn mission(status: MissionStatus, value: bool) -> MissionStatus {
    if value { status } else { MissionStatus::NotSelected }
}

/// The raw request that is zero, or the smallest that is not.
const fn least(zero: bool) -> i32 {
    !zero as i32
}

const fn all_wheels(rpm: i32) -> Vcu2AiWheelSpeeds {
    let speed = WheelSpeed::clamped(rpm);
    Vcu2AiWheelSpeeds {
        fl_wheel_speed: speed,
        fr_wheel_speed: speed,
        rl_wheel_speed: speed,
        rr_wheel_speed: speed,
    }
}
