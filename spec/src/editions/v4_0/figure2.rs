//! Figure 2 of version 4.0: hold it against the figure.
//!
//! The arrows are those of version 3.0, and all rows but one are its rows: the way from `AS_DRIVING` into
//! `EMERGENCY_BRAKE` has ten alternatives now.

use crate::atoms::Atom;
use crate::editions::v3_0::figure2 as before;
use crate::faults::Fault;
use crate::messages::AsState;
use crate::readings::Choice;
use crate::table::{Cites, CitesOfCondition, Row, Table, Term};

const NONE: Cites = Cites::NONE;

/// What is behind FINISHED while the vehicle moves.
const FINISHED_MOVING: &Cites = &Cites {
    requirements: &["DTE-6", "DTE-7", "IMP-5", "MSG-61"],
    conditions: &[
        CitesOfCondition { atom: Atom::MissionFinished, requirements: &["IMP-5", "MSG-9"] },
        CitesOfCondition { atom: Atom::Moving, requirements: &["IMP-4"] },
    ],
    ..NONE
};

/// What is behind NEUTRAL while the vehicle moves.
const NEUTRAL_MOVING: &Cites = &Cites {
    requirements: &["DTE-6", "DTE-8", "IMP-6", "MSG-60"],
    conditions: &[CitesOfCondition { atom: Atom::Moving, requirements: &["IMP-4"] }],
    ..NONE
};

/// Torque and hydraulic braking at once: a term for the torque of each axle.
const fn braking_against(torque_zero: &[Atom]) -> Term {
    //= D-53, D-64
    Term::off("4", torque_zero)
        .fault(Fault::BrakePlausibilityFault)
        .reading(Choice::TorqueAlways)
        .cites(&Cites { requirements: &["DTE-6", "DTE-9", "IMP-8", "MSG-84"], ..NONE })
}

/// The way out of `AS_DRIVING` by an emergency, in the order of the figure.
//= IMP-9
const DRIVING_TO_EMERGENCY_BRAKE: Row = {
    #[allow(clippy::enum_glob_use, reason = "a row reads like the figure's label")]
    use Atom::*;

    Row::of(
        AsState::Driving,
        AsState::EmergencyBrake,
        "3.7",
        &[
            Term::on("3.7", &[SdcOpen]).cites(&Cites { requirements: &["DTE-1"], ..NONE }),
            Term::off("3.7", &[Asms])
                .fault(Fault::HvilOpenFault) //= D-13
                .cites(&Cites { requirements: &["DTE-3"], ..NONE }),
            Term::off("3.7", &[GoOn])
                .fault(Fault::HvilOpenFault) //= D-13
                .cites(&Cites { requirements: &["DTE-2"], ..NONE }),
            Term::on("4", &[MissionFinished, Moving]) //= D-65
                .fault(Fault::MissionStatusFault)
                .cites(FINISHED_MOVING),
            Term::on("4", &[DirectionNeutral, Moving]) //= D-65
                .fault(Fault::AutonomousBrakingFault)
                .cites(NEUTRAL_MOVING),
            braking_against(&[FrontTorqueZero, BrakeRequestZero]),
            braking_against(&[RearTorqueZero, BrakeRequestZero]),
            Term::on("3", &[AiEstop])
                .fault(Fault::AiComputerRequest)
                .cites(&Cites { requirements: &["DTE-10"], ..NONE }),
            Term::on("4", &[AiCommsLost])
                .fault(Fault::AiCommsFault)
                .cites(&Cites { requirements: &["DTE-6", "DTE-11", "IMP-7"], ..NONE }),
            Term::on("3", &[BmsFault])
                .fault(Fault::BmsFault)
                .cites(&Cites { requirements: &["DTE-12"], ..NONE }),
            Term::on("3", &[EbsUnavailable])
                .fault(Fault::EbsFault) //= D-55
                .cites(&Cites { requirements: &["DTE-13"], ..NONE }),
        ],
    )
    .cites(&Cites { requirements: &["SM-13"], ..NONE })
};

/// Figure 2 of the document, with the readings' terms beside the figure's own.
//= SM-1
pub(super) const FIGURE_2: Table = before::FIGURE_2.with(&DRIVING_TO_EMERGENCY_BRAKE);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braking_against_either_axle_is_an_alternative() {
        let terms = DRIVING_TO_EMERGENCY_BRAKE.terms();
        for axle in [Atom::FrontTorqueZero, Atom::RearTorqueZero] {
            let term = braking_against(&[axle, Atom::BrakeRequestZero]);
            assert!(terms.contains(&term), "{axle}");
        }
    }
}
