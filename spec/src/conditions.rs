//! What the inputs mean as conditions, and the way back: which atoms each of them decides, and how an atom is made to hold.
//!
//! Each source of conditions (a message of the AI Computer, a switch, a sensor) turns into atoms in one function, so that a judge
//! who sees only some of the messages observes with the very same code. Both ways stand side by side, so that a further condition on what the VCU already gets is a few lines of this file, beside its
//! name in `atoms.rs` and its place in a guard.
#![expect(clippy::inline_always, reason = "for speed, as in machine.rs")]

use crate::atoms::{Atom, Atoms};
use crate::faults::Fault;
use crate::inputs::Inputs;
use crate::limits::Thresholds;
use crate::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AmiState, AxleTorqueRequest,
    BrakePressure, DirectionRequest, EbsState, MissionStatus, SteerAngle, Vcu2AiStatus, Vcu2AiWheelSpeeds,
    Vcu2LogStatus, WheelSpeed,
};
use crate::observation::Observation;
use crate::silence::AiSilence;

impl Inputs {
    /// Reduces the inputs to atoms and faults.
    #[inline(always)]
    pub const fn observe(&self, thresholds: &Thresholds) -> Observation {
        let atoms = switch_atoms(self.asms, self.tsms, self.ami)
            .union(ebs_atoms(self.ebs))
            .union(Atoms::when(Atom::GoOn, self.go))
            .union(self.ai.status.atoms())
            .union(self.ai.drive_f.atoms())
            .union(self.ai.drive_r.atoms())
            .union(self.ai.steer.atoms())
            .union(self.ai.brake.atoms())
            .union(self.ai_silence.atoms(thresholds))
            .union(self.vehicle.steer_angle.atoms(thresholds))
            .union(self.vehicle.wheel_speeds.atoms(thresholds));
        Observation::new(atoms, self.faults())
    }

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
}

impl Observation {
    /// Whether some inputs look like this: `MISSION_STATUS` and the Emergency Braking System have one value, a vehicle that
    /// moves is not at rest, and charging is a fault only while a master switch is on.
    pub const fn is_possible(self) -> bool {
        let atoms = self.atoms();
        let missions = atoms.has(Atom::MissionSelected) as u8
            + atoms.has(Atom::MissionRunning) as u8
            + atoms.has(Atom::MissionFinished) as u8;
        let switched_on = atoms.has(Atom::Asms) || atoms.has(Atom::Tsms);
        missions <= 1
            && !(atoms.has(Atom::EbsArmed) && atoms.has(Atom::EbsUnavailable))
            && !(atoms.has(Atom::Moving) && atoms.has(Atom::AtRest))
            && (switched_on || !self.faults().has(Fault::ChargeProcedureFault))
    }
}

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

const fn switch_atoms(asms: bool, tsms: bool, ami: AmiState) -> Atoms {
    Atoms::when(Atom::Asms, asms)
        .union(Atoms::when(Atom::Tsms, tsms))
        .union(Atoms::when(Atom::AmiSelected, !matches!(ami, AmiState::NotSelected)))
}

const fn ebs_atoms(ebs: EbsState) -> Atoms {
    Atoms::when(Atom::EbsArmed, matches!(ebs, EbsState::Armed))
        .union(Atoms::when(Atom::EbsUnavailable, matches!(ebs, EbsState::Unavailable)))
}

impl Ai2VcuStatus {
    /// The atoms that this message decides.
    pub const SCOPE: Atoms = Atoms::of(&[
        Atom::AiHandshake,
        Atom::AiEstop,
        Atom::MissionSelected,
        Atom::MissionRunning,
        Atom::MissionFinished,
        Atom::DirectionNeutral,
    ]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self) -> Atoms {
        //= MSG-9
        let mission = match self.mission_status {
            MissionStatus::NotSelected => Atoms::NONE,
            MissionStatus::Selected => Atoms::NONE.with(Atom::MissionSelected),
            MissionStatus::Running => Atoms::NONE.with(Atom::MissionRunning),
            MissionStatus::Finished => Atoms::NONE.with(Atom::MissionFinished),
        };
        let neutral = matches!(self.direction_request, DirectionRequest::Neutral);
        mission
            .union(Atoms::when(Atom::AiHandshake, self.handshake))
            .union(Atoms::when(Atom::AiEstop, self.estop_request))
            .union(Atoms::when(Atom::DirectionNeutral, neutral))
    }
}

impl Ai2VcuDriveF {
    /// The atom that this message decides.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::FrontTorqueZero]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self) -> Atoms {
        //= DRV-5
        Atoms::when(Atom::FrontTorqueZero, self.front_axle_trq_request.raw() == 0)
    }
}

impl Ai2VcuDriveR {
    /// The atom that this message decides.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::RearTorqueZero]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self) -> Atoms {
        //= DRV-6
        Atoms::when(Atom::RearTorqueZero, self.rear_axle_trq_request.raw() == 0)
    }
}

impl Ai2VcuSteer {
    /// The atom that this message decides.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::SteerRequestZero]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self) -> Atoms {
        //= DRV-7
        Atoms::when(Atom::SteerRequestZero, self.steer_request.raw() == 0)
    }
}

impl Ai2VcuBrake {
    /// The atom that this message decides.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::BrakeRequestZero]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self) -> Atoms {
        //= IMP-8
        let zero = self.hyd_press_f_req.raw() == 0 && self.hyd_press_r_req.raw() == 0;
        Atoms::when(Atom::BrakeRequestZero, zero)
    }
}

impl Vcu2AiStatus {
    /// The input atoms that this message shows.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::Asms, Atom::Tsms, Atom::AmiSelected]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self) -> Atoms {
        switch_atoms(self.as_switch_status, self.ts_switch_status, self.ami_state)
    }
}

impl Vcu2LogStatus {
    /// The input atoms that this message shows, and, in version 3.0, no other does.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::EbsArmed, Atom::EbsUnavailable]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self) -> Atoms {
        ebs_atoms(self.state_ebs)
    }
}

impl SteerAngle {
    /// The atom that the actual steer angle decides.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::SteerStraight]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(self, thresholds: &Thresholds) -> Atoms {
        //= DRV-9, D-25
        Atoms::when(Atom::SteerStraight, self.raw().abs() < thresholds.straight.raw())
    }
}

impl Vcu2AiWheelSpeeds {
    /// The atoms that this message decides.
    pub const SCOPE: Atoms = Atoms::of(&[Atom::Moving, Atom::AtRest]);

    /// Those of [`SCOPE`](Self::SCOPE) that hold.
    pub const fn atoms(&self, thresholds: &Thresholds) -> Atoms {
        let limit = thresholds.wheel_speed.raw();
        let fastest = self.fastest().raw();
        //= IMP-4, D-24
        Atoms::when(Atom::Moving, fastest > limit).union(Atoms::when(Atom::AtRest, fastest < limit))
    }

    /// The speed of the fastest wheel: one is faster than a limit if that is, and all are slower if that is.
    pub const fn fastest(self) -> WheelSpeed {
        const fn faster(a: WheelSpeed, b: WheelSpeed) -> WheelSpeed {
            if a.raw() > b.raw() { a } else { b }
        }
        faster(
            faster(self.fl_wheel_speed, self.fr_wheel_speed),
            faster(self.rl_wheel_speed, self.rr_wheel_speed),
        )
    }
}
