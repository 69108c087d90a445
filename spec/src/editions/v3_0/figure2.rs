//! Figure 2 of version 3.0: hold it against the figure.

use crate::atoms::Atom;
use crate::faults::Fault;
use crate::messages::AsState;
use crate::readings::Choice;
use crate::table::{Cites, CitesOfCondition, Priority, Row, Table, Term};

const NONE: Cites = Cites::NONE;

/// The readings that change the order of rows.
pub(super) const PRIORITIES: &[Priority] = &[
    Priority { choice: Choice::ReadyOffFirst, from: AsState::Ready, first: AsState::Off },
    Priority { choice: Choice::FinishedOffFirst, from: AsState::Finished, first: AsState::Off },
    Priority { choice: Choice::DrivingFinishedFirst, from: AsState::Driving, first: AsState::Finished },
];

/// AI comms lost, as an arrow that the text has and Figure 2 does not.
//= D-10
const COMMS_LOST: Term = Term::on("2.4", &[Atom::AiCommsLost])
    .fault(Fault::AiCommsFault)
    .reading(Choice::CommsEveryState)
    .cites(&Cites { requirements: &["HS-10"], ..NONE });

/// An emergency stop that the AI Computer asks for outside `AS_DRIVING`.
const ESTOP_REQUEST: Term = Term::on("2.1", &[Atom::AiEstop])
    .fault(Fault::AiComputerRequest)
    .reading(Choice::EstopEveryState)
    .cites(&Cites { requirements: &["D-9"], ..NONE });

/// What is behind the conditions of the way into `AS_READY`.
const READY: &Cites = &Cites {
    conditions: &[
        CitesOfCondition { atom: Atom::Tsms, requirements: &["RDY-1"] },
        CitesOfCondition { atom: Atom::Asms, requirements: &["RDY-2"] },
        CitesOfCondition { atom: Atom::AmiSelected, requirements: &["RDY-3"] },
        CitesOfCondition { atom: Atom::EbsArmed, requirements: &["RDY-4"] },
        CitesOfCondition { atom: Atom::MissionSelected, requirements: &["SM-9", "MSG-9"] },
        CitesOfCondition { atom: Atom::PowerCycleNeeded, requirements: &["ETO-3"] },
    ],
    ..NONE
};

/// What is behind the conditions of the way into `AS_DRIVING`, and behind the edge as a whole.
const GO: &Cites = &Cites {
    requirements: &["DRV-14"],
    conditions: &[
        CitesOfCondition { atom: Atom::DwellElapsed, requirements: &["DRV-4"] },
        CitesOfCondition { atom: Atom::FrontTorqueZero, requirements: &["DRV-5"] },
        CitesOfCondition { atom: Atom::RearTorqueZero, requirements: &["DRV-6"] },
        CitesOfCondition { atom: Atom::SteerRequestZero, requirements: &["DRV-7"] },
        CitesOfCondition { atom: Atom::DirectionNeutral, requirements: &["DRV-8"] },
        CitesOfCondition { atom: Atom::SteerStraight, requirements: &["DRV-9"] },
        CitesOfCondition { atom: Atom::GoEdge, requirements: &["DRV-12"] },
    ],
    ..NONE
};

/// What is behind FINISHED while the vehicle moves.
const FINISHED_MOVING: &Cites = &Cites {
    requirements: &["DTE-4", "IMP-1", "MSG-61"],
    conditions: &[
        CitesOfCondition { atom: Atom::MissionFinished, requirements: &["DTE-4", "MSG-9"] },
        CitesOfCondition { atom: Atom::Moving, requirements: &["IMP-4"] },
    ],
    ..NONE
};
const FINISHED_EDGE_MOVING: &Cites = &Cites {
    requirements: &["IMP-3", "MSG-61"],
    conditions: &[CitesOfCondition { atom: Atom::Moving, requirements: &["IMP-4"] }],
    ..NONE
};

/// What is behind NEUTRAL while the vehicle moves.
const NEUTRAL_MOVING: &Cites = &Cites {
    requirements: &["DTE-5", "IMP-1", "MSG-60"],
    conditions: &[CitesOfCondition { atom: Atom::Moving, requirements: &["IMP-4"] }],
    ..NONE
};
const NEUTRAL_EDGE_MOVING: &Cites = &Cites {
    requirements: &["IMP-2", "MSG-60"],
    conditions: &[CitesOfCondition { atom: Atom::Moving, requirements: &["IMP-4"] }],
    ..NONE
};

/// What is behind the end of the mission at rest.
const AT_REST: &Cites = &Cites {
    conditions: &[
        CitesOfCondition { atom: Atom::MissionFinished, requirements: &["FIN-4", "MSG-9"] },
        CitesOfCondition { atom: Atom::AtRest, requirements: &["FIN-4"] },
    ],
    ..NONE
};

/// What is behind the end of an emergency.
const TIMER: &Cites = &Cites {
    conditions: &[CitesOfCondition { atom: Atom::EbsTimerComplete, requirements: &["ETO-1"] }],
    ..NONE
};

/// Figure 2 of the document, with the readings' terms beside the figure's own.
//= SM-1
pub(in crate::editions) const FIGURE_2: Table = {
    use AsState::{Driving, EmergencyBrake, Finished, Off, Ready};
    #[allow(clippy::enum_glob_use, reason = "a row reads like the figure's label")]
    use Atom::*;

    Table::of(&[
        //= D-45
        Row::of(
            Off,
            Ready,
            "3.1",
            &[
                Term::on("3.1", &[Asms, Tsms, AmiSelected, MissionSelected, EbsArmed]) //= D-1
                    .and_off(&[PowerCycleNeeded]) //= D-11
                    .reading(Choice::MissionBoth)
                    .cites(READY),
                Term::on("3.1", &[Asms, Tsms, AmiSelected, EbsArmed])
                    .and_off(&[PowerCycleNeeded])
                    .reading(Choice::MissionAmi)
                    .cites(READY),
                Term::on("3.1", &[Asms, Tsms, MissionSelected, EbsArmed])
                    .and_off(&[PowerCycleNeeded])
                    .reading(Choice::MissionStatusOnly)
                    .cites(READY),
            ],
        )
        .cites(&Cites { requirements: &["SM-9", "RDY-5"], ..NONE }),
        //= D-3
        Row::of(Ready, EmergencyBrake, "3.5", &[Term::on("3.5", &[SdcOpen]), COMMS_LOST, ESTOP_REQUEST])
            .cites(&Cites { requirements: &["SM-12", "RTE-1"], ..NONE }),
        //= D-22
        Row::of(Ready, Off, "3.6", &[Term::off("3.6", &[Asms])]).cites(&Cites {
            requirements: &["SM-10", "RTO-1"],
            order: &["D-22"],
            ..NONE
        }),
        Row::of(
            Ready,
            Driving,
            "3.2",
            &[Term::on(
                "3.2",
                &[
                    DwellElapsed,
                    FrontTorqueZero,
                    RearTorqueZero,
                    SteerRequestZero,
                    SteerStraight,
                    DirectionNeutral,
                    GoEdge,
                ],
            )
            .cites(GO)],
        )
        .cites(&Cites { requirements: &["SM-11", "DRV-15"], ..NONE }),
        //= D-5, D-27
        Row::of(
            Driving,
            EmergencyBrake,
            "3.7",
            &[
                Term::on("3.7", &[SdcOpen]).cites(&Cites { requirements: &["DTE-1"], ..NONE }),
                // Neither switch has a cause of its own: each opens the shutdown circuit.
                Term::off("3.7", &[GoOn])
                    .fault(Fault::HvilOpenFault) //= D-13
                    .cites(&Cites { requirements: &["DTE-2"], ..NONE }),
                Term::off("3.7", &[Asms])
                    .fault(Fault::HvilOpenFault) //= D-13
                    .cites(&Cites { requirements: &["DTE-3"], ..NONE }),
                Term::on("3.7", &[MissionFinished, Moving]) //= D-2
                    .fault(Fault::MissionStatusFault)
                    .reading(Choice::FaultLevel)
                    .cites(FINISHED_MOVING),
                Term::on("4", &[MissionFinishedEdge, Moving])
                    .fault(Fault::MissionStatusFault)
                    .reading(Choice::FaultEdge)
                    .cites(FINISHED_EDGE_MOVING),
                Term::on("3.7", &[DirectionNeutral, Moving]) //= D-2
                    .fault(Fault::AutonomousBrakingFault)
                    .reading(Choice::FaultLevel)
                    .cites(NEUTRAL_MOVING),
                Term::on("4", &[DirectionNeutralEdge, Moving])
                    .fault(Fault::AutonomousBrakingFault)
                    .reading(Choice::FaultEdge)
                    .cites(NEUTRAL_EDGE_MOVING),
                COMMS_LOST,
                Term::on("2.1", &[AiEstop])
                    .fault(Fault::AiComputerRequest)
                    .cites(&Cites { requirements: &["D-9"], ..NONE }),
            ],
        )
        .cites(&Cites { requirements: &["SM-13"], ..NONE }),
        Row::of(Driving, Finished, "3.3", &[Term::on("3.3", &[MissionFinished, AtRest]).cites(AT_REST)])
            .cites(&Cites { requirements: &["SM-14", "FIN-4"], ..NONE }),
        //= D-23
        Row::of(
            EmergencyBrake,
            Off,
            "3.9",
            &[Term::on("3.9", &[EbsTimerComplete]).and_off(&[Asms]).cites(TIMER)],
        )
        .cites(&Cites { requirements: &["SM-17", "ETO-2"], ..NONE }),
        //= D-4
        Row::of(Finished, EmergencyBrake, "3.8", &[Term::on("3.8", &[SdcOpen]), COMMS_LOST, ESTOP_REQUEST])
            .cites(&Cites { requirements: &["SM-15", "FTE-1"], ..NONE }),
        Row::of(Finished, Off, "3.4", &[Term::off("3.4", &[Asms])])
            .cites(&Cites { requirements: &["SM-16", "FTO-1"], ..NONE }),
    ])
};
