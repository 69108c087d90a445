//! The reference AI Computer: a small program that follows the document.
//!
//! Its cycle is a pure function of what it last heard and of how far it has come. It never asks for an emergency stop.

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, AmiState, AnyMessage, AsState, AxleTorqueRequest,
    BrakePressure, DirectionRequest, Frame, MissionStatus, MotorSpeedMax,
};
use adsdv_spec::{AiMessages, Atom, Edition, Thresholds, VcuMessages};

/// The AI Computer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AiComputer {
    /// What it has heard of the VCU.
    pub heard: FromVcu,
    /// The HANDSHAKE bit that it sends.
    pub handshake: bool,
    /// How far it has come.
    pub stage: Stage,
}

/// What the AI Computer keeps of the VCU's frames: all that its program looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FromVcu {
    /// HANDSHAKE of 520h.
    pub handshake: bool,
    /// AS_STATE of 520h.
    pub as_state: AsState,
    /// AMI_STATE of 520h.
    pub ami: AmiState,
    /// A torque request is in force at an axle, as 521h and 522h return it.
    pub torque: [bool; 2],
    /// A brake request is in force, as 524h returns it.
    pub brake: bool,
    /// A wheel is not at rest, as 525h shows.
    pub turning: bool,
    /// No 525h has arrived since the last change in 521h, 522h or 524h: the wheels may have turned since.
    pub outdated: bool,
}

/// How far the AI Computer has come with its mission, in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// No mission is selected.
    #[default]
    Idle,
    /// The mission selected is confirmed (RDY-7), with no request to move (DRV-5 to DRV-8).
    Selected,
    /// AS_DRIVING has come: RUNNING and FORWARD (DRV-10).
    Started,
    /// It drives.
    Driving,
    /// It stops the vehicle with the service brake at the end of the mission (FIN-2).
    Braking,
    /// The vehicle has stopped: FINISHED (FIN-1, FIN-3).
    Finished,
    /// FINISHED and NEUTRAL, the brakes still on.
    Neutral,
    /// After an emergency: nothing is requested but the brakes.
    Stopped,
}

/// How the AI Computer behaves. All but the first are wrong: they show that a property can fail.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Conduct {
    /// As the document says.
    #[default]
    Reference,
    /// It never answers the handshake (against HS-5).
    Mute,
    /// It says FINISHED and NEUTRAL without waiting until the vehicle has stopped (against FIN-3).
    Hasty,
    /// It says NEUTRAL while it brakes (against IMP-2).
    Coasting,
}

/// The frames that the AI Computer listens to.
pub(super) fn listens_to(messages: &VcuMessages, bus: &adsdv_spec::Bus) -> [Option<Frame>; 5] {
    let VcuMessages { status, drive_f, drive_r, brake, wheel_speeds, .. } = *messages;
    let all: [AnyMessage; 5] =
        [status.into(), drive_f.into(), drive_r.into(), brake.into(), wheel_speeds.into()];
    all.map(|message| bus.encode(message))
}

/// The frames that carry these messages, in the order in which they win the bus.
pub(super) fn frames(messages: &AiMessages, bus: &adsdv_spec::Bus) -> [Option<Frame>; 5] {
    messages.all().map(|message| bus.encode(message))
}

impl FromVcu {
    /// What is known after one more frame of an edition; one that does not decode changes nothing.
    #[must_use]
    pub fn with(self, frame: &Frame, edition: &Edition) -> Self {
        let message = edition.bus.decode(frame.id, frame.data());
        message.map_or(self, |message| self.with_message(message, &edition.rules.thresholds))
    }

    fn with_message(self, message: AnyMessage, thresholds: &Thresholds) -> Self {
        let after = self.with_values(message, thresholds);
        let outdated = match message {
            AnyMessage::Vcu2AiWheelSpeeds(_) => false,
            _ => self.outdated || (after.torque, after.brake) != (self.torque, self.brake),
        };
        Self { outdated, ..after }
    }

    fn with_values(self, message: AnyMessage, thresholds: &Thresholds) -> Self {
        let Self { torque: [front, rear], .. } = self;
        match message {
            AnyMessage::Vcu2AiStatus(status) => {
                Self { handshake: status.handshake, as_state: status.as_state, ami: status.ami_state, ..self }
            }
            AnyMessage::Vcu2AiDriveF(drive) => {
                Self { torque: [drive.front_axle_trq_request.raw() > 0, rear], ..self }
            }
            AnyMessage::Vcu2AiDriveR(drive) => {
                Self { torque: [front, drive.rear_axle_trq_request.raw() > 0], ..self }
            }
            AnyMessage::Vcu2AiBrake(brake) => {
                let axles = [brake.hyd_press_f_req.raw(), brake.hyd_press_r_req.raw()];
                Self { brake: !axles.contains(&0), ..self }
            }
            AnyMessage::Vcu2AiWheelSpeeds(speeds) => {
                Self { turning: !speeds.atoms(thresholds).has(Atom::AtRest), ..self }
            }
            _ => self,
        }
    }

    /// Whether the vehicle has stopped for good: the VCU returns the brake request and no torque request, so that none
    /// is on its way that could start the vehicle again, and the wheels have been seen at rest since then.
    const fn has_stopped(self) -> bool {
        let [front, rear] = self.torque;
        self.brake && !front && !rear && !self.turning && !self.outdated
    }
}

impl AiComputer {
    /// The AI Computer after one cycle of its program.
    #[must_use]
    pub fn cycle(self, conduct: Conduct) -> Self {
        let handshake = match conduct {
            Conduct::Mute => self.handshake,
            _ => self.heard.handshake, //= HS-5
        };
        Self { stage: self.next_stage(conduct), handshake, ..self }
    }

    fn next_stage(self, conduct: Conduct) -> Stage {
        match (self.heard.as_state, self.stage) {
            (AsState::Off | AsState::Ready, _) => match self.heard.ami {
                AmiState::NotSelected => Stage::Idle,
                _ => Stage::Selected,
            },
            (AsState::Driving, Stage::Idle | Stage::Selected) => Stage::Started,
            (AsState::Driving, Stage::Started) => Stage::Driving,
            (AsState::Driving, Stage::Braking) => match conduct {
                Conduct::Hasty => Stage::Finished,
                Conduct::Coasting => Stage::Stopped,
                _ if self.heard.has_stopped() => Stage::Finished,
                _ => Stage::Braking,
            },
            (AsState::Driving, Stage::Finished) | (AsState::Finished, _) => Stage::Neutral,
            (AsState::Driving, stage) => stage,
            (AsState::EmergencyBrake, _) => Stage::Stopped,
        }
    }

    /// Whether it may decide that the mission is completed.
    pub fn may_decide_to_stop(self) -> bool {
        self.stage == Stage::Driving && self.heard.as_state == AsState::Driving
    }

    /// What it sends (section 2.1).
    pub fn messages(self) -> AiMessages {
        let driving = self.stage == Stage::Driving;
        let torque = if driving { AxleTorqueRequest::MAX } else { AxleTorqueRequest::MIN };
        let speed = if driving { MotorSpeedMax::MAX } else { MotorSpeedMax::MIN };
        //= FIN-2
        let brake = if self.stage >= Stage::Braking { BrakePressure::MAX } else { BrakePressure::MIN };
        AiMessages {
            status: Ai2VcuStatus {
                handshake: self.handshake,
                mission_status: match self.stage {
                    Stage::Idle | Stage::Stopped => MissionStatus::NotSelected,
                    Stage::Selected => MissionStatus::Selected, //= RDY-7
                    Stage::Started | Stage::Driving | Stage::Braking => MissionStatus::Running,
                    Stage::Finished | Stage::Neutral => MissionStatus::Finished, //= FIN-1, FIN-3
                },
                direction_request: match self.stage {
                    Stage::Idle | Stage::Selected | Stage::Neutral | Stage::Stopped => {
                        DirectionRequest::Neutral
                    }
                    Stage::Started | Stage::Driving | Stage::Braking | Stage::Finished => {
                        //= DRV-10
                        DirectionRequest::Forward
                    }
                },
                ..Ai2VcuStatus::default()
            },
            drive_f: Ai2VcuDriveF { front_axle_trq_request: torque, front_motor_speed_max: speed },
            drive_r: Ai2VcuDriveR { rear_axle_trq_request: torque, rear_motor_speed_max: speed },
            brake: Ai2VcuBrake { hyd_press_f_req: brake, hyd_press_r_req: brake },
            ..AiMessages::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::messages::{
        AsState, AxleTorqueRequest, BrakePressure, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiStatus,
        Vcu2AiWheelSpeeds, WheelSpeed,
    };

    use super::{AiComputer, AiMessages, AnyMessage, Conduct, Edition, FromVcu, Stage};

    impl FromVcu {
        /// What is known after one more message of the default edition.
        fn hears(self, message: AnyMessage) -> Self {
            self.with_message(message, &Edition::DEFAULT.rules.thresholds)
        }
    }

    fn wheels(rpm: i32) -> Vcu2AiWheelSpeeds {
        Vcu2AiWheelSpeeds { rl_wheel_speed: WheelSpeed::clamped(rpm), ..Vcu2AiWheelSpeeds::default() }
    }

    #[test]
    fn the_vehicle_has_stopped_when_that_is_measured_after_the_brakes_are_on() {
        let (on, off) = (BrakePressure::MAX, AxleTorqueRequest::MIN);
        let brake = Vcu2AiBrake { hyd_press_f_req: on, hyd_press_r_req: on, ..Vcu2AiBrake::default() }.into();
        let rest = wheels(9).into();
        let before = FromVcu::default().hears(rest).hears(brake);
        assert!(!before.has_stopped(), "the wheels may have turned since");
        assert!(before.hears(rest).has_stopped());
        assert!(!before.hears(wheels(10).into()).has_stopped(), "exactly 10 rpm is not at rest (D-24)");
        let torque = |front_axle_trq_request| {
            Vcu2AiDriveF { front_axle_trq_request, ..Vcu2AiDriveF::default() }.into()
        };
        let pulled = before.hears(torque(AxleTorqueRequest::MAX)).hears(rest);
        assert!(!pulled.has_stopped(), "a torque request is still in force");
        assert!(
            !pulled.hears(torque(off)).has_stopped() && pulled.hears(torque(off)).hears(rest).has_stopped()
        );
    }

    //= HS-5
    #[test]
    fn the_handshake_is_echoed_and_no_emergency_stop_is_asked_for() {
        for as_state in AsState::ALL {
            for handshake in [false, true] {
                let status = Vcu2AiStatus { as_state, handshake, ..Vcu2AiStatus::default() };
                let mut ai =
                    AiComputer { heard: FromVcu::default().hears(status.into()), ..AiComputer::default() };
                for _ in 0..8 {
                    ai = ai.cycle(Conduct::Reference);
                    let messages = ai.messages();
                    assert_eq!(
                        (messages.status.handshake, messages.status.estop_request),
                        (handshake, false)
                    );
                }
            }
        }
    }

    /// From the mission on the AMI to FINISHED; the brakes are on before the vehicle stands, FINISHED comes after.
    //= RDY-7, DRV-10, FIN-1 to FIN-3
    #[test]
    fn it_follows_the_mission() {
        use adsdv_spec::messages::{AmiState, DirectionRequest, MissionStatus};

        let after = |ai: AiComputer, as_state, ami_state| {
            let status = Vcu2AiStatus { as_state, ami_state, ..Vcu2AiStatus::default() };
            let ai = AiComputer { heard: ai.heard.hears(status.into()), ..ai }.cycle(Conduct::Reference);
            let AiMessages { status, brake, .. } = ai.messages();
            (ai, status.mission_status, status.direction_request, brake.hyd_press_f_req.raw() > 0)
        };
        let (neutral, forward) = (DirectionRequest::Neutral, DirectionRequest::Forward);
        let mission = AmiState::TrackDrive;
        let (ai, status, direction, _) = after(AiComputer::default(), AsState::Off, AmiState::NotSelected);
        assert_eq!((status, direction), (MissionStatus::NotSelected, neutral));
        let (ai, status, direction, _) = after(ai, AsState::Off, mission);
        assert_eq!((status, direction), (MissionStatus::Selected, neutral));
        let (ai, status, direction, braked) = after(ai, AsState::Driving, mission);
        assert_eq!((status, direction, braked), (MissionStatus::Running, forward, false));
        let ai = AiComputer { stage: Stage::Braking, ..ai };
        let turning = AiComputer { heard: ai.heard.hears(wheels(11).into()), ..ai };
        let (ai, status, direction, braked) = after(turning, AsState::Driving, mission);
        assert_eq!((status, direction, braked), (MissionStatus::Running, forward, true));
        let returned = Vcu2AiBrake {
            hyd_press_f_req: BrakePressure::MAX,
            hyd_press_r_req: BrakePressure::MAX,
            ..Vcu2AiBrake::default()
        };
        let heard = ai.heard.hears(returned.into()).hears(wheels(0).into());
        let (_, status, direction, braked) = after(AiComputer { heard, ..ai }, AsState::Driving, mission);
        assert_eq!((status, direction, braked), (MissionStatus::Finished, forward, true));
    }

    #[test]
    fn it_drives_only_after_it_has_asked_for_forward() {
        let driving = Vcu2AiStatus { as_state: AsState::Driving, ..Vcu2AiStatus::default() };
        let ai = AiComputer { heard: FromVcu::default().hears(driving.into()), ..AiComputer::default() };
        let started = ai.cycle(Conduct::Reference);
        assert_eq!(started.stage, Stage::Started);
        assert_eq!(started.messages().drive_f.front_axle_trq_request, AxleTorqueRequest::MIN);
        assert!(!started.may_decide_to_stop() && started.cycle(Conduct::Reference).may_decide_to_stop());
    }
}
