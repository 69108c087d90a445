//! Whose move it is that a condition holds, and where the bus shows it.

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, MessageDef, SignalDef, Vcu2AiBrake,
    Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelSpeeds, Vcu2LogStatus,
};
use adsdv_spec::{AsState, Atom, Bus};

/// Who, or what, can make a condition hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mover {
    /// The AI Computer, by what it sends.
    Ai,
    /// Somebody at the vehicle or at the remote control: the switches, and the choice of a mission.
    Operator,
    /// The vehicle: what it measures, and its Emergency Braking System.
    Vehicle,
    /// Nobody: it comes when time has passed.
    Time,
}

impl Mover {
    /// `AI Computer`, `operator`, `vehicle` or `time`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ai => "AI Computer",
            Self::Operator => "operator",
            Self::Vehicle => "vehicle",
            Self::Time => "time",
        }
    }

    /// Whose move a condition is.
    pub const fn of(atom: Atom) -> Self {
        match atom {
            Atom::MissionSelected
            | Atom::MissionRunning
            | Atom::MissionFinished
            | Atom::MissionFinishedEdge
            | Atom::FrontTorqueZero
            | Atom::RearTorqueZero
            | Atom::BrakeRequestZero
            | Atom::SteerRequestZero
            | Atom::DirectionNeutral
            | Atom::DirectionNeutralEdge
            | Atom::AiHandshake
            | Atom::AiMessagesMissed
            | Atom::AiCommsLost
            | Atom::AiEstop => Self::Ai,
            Atom::Asms
            | Atom::Tsms
            | Atom::AmiSelected
            | Atom::GoOn
            | Atom::GoEdge
            | Atom::PowerCycleNeeded => Self::Operator,
            Atom::SdcOpen
            | Atom::EbsArmed
            | Atom::EbsUnavailable
            | Atom::SteerStraight
            | Atom::Moving
            | Atom::AtRest
            | Atom::BmsFault => Self::Vehicle,
            Atom::EbsTimerComplete | Atom::DwellElapsed => Self::Time,
        }
    }
}

/// Where the bus shows a condition: a message, and those of its signals that decide it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The message.
    pub message: &'static MessageDef,
    /// Its signals.
    pub signals: [Option<&'static SignalDef>; 4],
}

/// The wheels, which decide together.
const WHEELS: &[&str] = &["fl_wheel_speed", "fr_wheel_speed", "rl_wheel_speed", "rr_wheel_speed"];

/// Where an edition's bus shows a condition; `None` where no message of the VCU or the AI Computer does.
///
/// ```
/// use adsdv_oracle::why::place_of;
/// use adsdv_spec::{Atom, Edition};
///
/// let place = |edition: &Edition, atom| place_of(&edition.bus, atom).map(|place| place.message.id);
/// assert_eq!(place(&Edition::V3_0, Atom::EbsArmed), Some(0x502));
/// assert_eq!(place(&Edition::V4_0, Atom::EbsArmed), Some(0x524)); // every 10 ms, and not every 100
/// assert_eq!(place(&Edition::V4_0, Atom::DwellElapsed), None);
/// ```
pub fn place_of(bus: &Bus, atom: Atom) -> Option<Place> {
    fields(atom).iter().find_map(|(id, fields)| {
        let message = bus.message(*id)?;
        let mut signals = [None; 4];
        for (signal, field) in signals.iter_mut().zip(*fields) {
            *signal = Some(message.signal_of(field)?);
        }
        Some(Place { message, signals })
    })
}

/// The places where some edition shows a condition, the best first.
const fn fields(atom: Atom) -> &'static [(u16, &'static [&'static str])] {
    match atom {
        Atom::Asms => &[(Vcu2AiStatus::ID, &["as_switch_status"])],
        Atom::Tsms => &[(Vcu2AiStatus::ID, &["ts_switch_status"])],
        Atom::AmiSelected => &[(Vcu2AiStatus::ID, &["ami_state"])],
        Atom::GoOn => &[(Vcu2AiStatus::ID, &["go_signal"])],
        Atom::AiCommsLost => &[(Vcu2AiStatus::ID, &["ai_comms_lost"])],
        Atom::BmsFault => &[(Vcu2AiStatus::ID, &["bms_fault"])],
        Atom::MissionSelected | Atom::MissionRunning | Atom::MissionFinished | Atom::MissionFinishedEdge => {
            &[(Ai2VcuStatus::ID, &["mission_status"])]
        }
        Atom::DirectionNeutral | Atom::DirectionNeutralEdge => &[(Ai2VcuStatus::ID, &["direction_request"])],
        Atom::AiEstop => &[(Ai2VcuStatus::ID, &["estop_request"])],
        Atom::AiHandshake => &[(Ai2VcuStatus::ID, &["handshake"])],
        Atom::EbsArmed | Atom::EbsUnavailable => {
            &[(Vcu2AiBrake::ID, &["status_ebs"]), (Vcu2LogStatus::ID, &["state_ebs"])]
        }
        Atom::FrontTorqueZero => &[(Ai2VcuDriveF::ID, &["front_axle_trq_request"])],
        Atom::RearTorqueZero => &[(Ai2VcuDriveR::ID, &["rear_axle_trq_request"])],
        Atom::BrakeRequestZero => &[(Ai2VcuBrake::ID, &["hyd_press_f_req", "hyd_press_r_req"])],
        Atom::SteerRequestZero => &[(Ai2VcuSteer::ID, &["steer_request"])],
        Atom::SteerStraight => &[(Vcu2AiSteer::ID, &["steer_angle"])],
        Atom::Moving | Atom::AtRest => &[(Vcu2AiWheelSpeeds::ID, WHEELS)],
        // What `GO_SIGNAL` is outside of AS_DRIVING is an open question.
        Atom::GoEdge
        | Atom::SdcOpen
        | Atom::EbsTimerComplete
        | Atom::DwellElapsed
        | Atom::AiMessagesMissed
        | Atom::PowerCycleNeeded => &[],
    }
}

/// The state that a mission goes on to from this one, as Figure 2 has it from the top: what one waits for in it.
pub const fn next_of_mission(state: AsState) -> AsState {
    match state {
        AsState::Off => AsState::Ready,
        AsState::Ready => AsState::Driving,
        AsState::Driving => AsState::Finished,
        AsState::Finished | AsState::EmergencyBrake => AsState::Off,
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;

    use super::*;

    /// A field that no edition has would be looked for in vain.
    #[test]
    fn every_place_is_one_of_some_edition() {
        for &atom in Atom::ALL {
            for (id, fields) in fields(atom) {
                let has = |edition: &&&Edition| {
                    let message = edition.bus.message(*id);
                    message
                        .is_some_and(|message| fields.iter().all(|field| message.signal_of(field).is_some()))
                };
                assert!(Edition::ALL.iter().any(|edition| has(&edition)), "{atom}: {id:03X}h {fields:?}");
            }
        }
    }

    #[test]
    fn the_mission_goes_on_along_arrows() {
        for edition in Edition::ALL {
            for state in AsState::ALL {
                let next = next_of_mission(state);
                let rows = edition.rules.table.rows();
                assert!(rows.iter().any(|row| (row.from, row.to) == (state, next)), "{state} -> {next}");
            }
        }
    }
}
